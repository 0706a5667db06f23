#include "core/export/usd_text.h"

#include <array>
#include <cctype>
#include <charconv>

#include "absl/strings/str_cat.h"

namespace capfit::exports {

std::string UsdNumber(double number) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  return {text.data(), end};
}

std::string UsdVector(const Eigen::Vector3d& vector) {
  return absl::StrCat("(", UsdNumber(vector.x()), ", ", UsdNumber(vector.y()), ", ",
                      UsdNumber(vector.z()), ")");
}

std::string UsdQuaternion(const Eigen::Quaterniond& q) {
  return absl::StrCat("(", UsdNumber(q.w()), ", ", UsdNumber(q.x()), ", ", UsdNumber(q.y()), ", ",
                      UsdNumber(q.z()), ")");
}

std::string UsdString(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += static_cast<unsigned char>(c) < ' ' || c == '\x7f' ? ' ' : c;
  }
  return quoted + "\"";
}

std::string UsdNames::Add(const std::string& name) {
  std::string word = name;
  for (char& c : word) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 128 || (std::isalnum(byte) == 0 && c != '_')) c = '_';
  }
  if (word.empty() || std::isdigit(static_cast<unsigned char>(word[0])) != 0) word = "_" + word;
  std::string unique = word;
  for (int number = 2; !taken_.insert(unique).second; ++number) {
    unique = absl::StrCat(word, "_", number);
  }
  return unique;
}

}  // namespace capfit::exports
