#include "core/export/usd_text.h"

#include <cctype>

#include "absl/strings/str_cat.h"
#include "core/base/plain_text.h"
#include "core/export/file_text.h"

namespace capfit::exports {

std::string UsdVector(const Eigen::Vector3d& vector) {
  return absl::StrCat("(", NumberText(vector.x()), ", ", NumberText(vector.y()), ", ",
                      NumberText(vector.z()), ")");
}

std::string UsdQuaternion(const Eigen::Quaterniond& q) {
  return absl::StrCat("(", NumberText(q.w()), ", ", NumberText(q.x()), ", ", NumberText(q.y()),
                      ", ", NumberText(q.z()), ")");
}

std::string UsdString(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : ValidUtf8(text)) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += static_cast<unsigned char>(c) < ' ' || c == '\x7f' ? ' ' : c;
  }
  return quoted + "\"";
}

std::string UsdIdentifier(const std::string& name) {
  std::string word = name;
  for (char& c : word) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 128 || (std::isalnum(byte) == 0 && c != '_')) c = '_';
  }
  if (word.empty() || std::isdigit(static_cast<unsigned char>(word[0])) != 0) word = "_" + word;
  return word;
}

}  // namespace capfit::exports
