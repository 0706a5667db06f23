#include "core/export/file_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <set>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/plain_text.h"

namespace capfit::exports {
namespace {

std::string ProfileWord(capsule::CapsuleProfile profile) {
  switch (profile) {
    case capsule::CapsuleProfile::kTangentHull:
      return "tangent_hull";
    case capsule::CapsuleProfile::kLerpedRadius:
      return "lerped_radius";
    case capsule::CapsuleProfile::kUniformRadius:
      return "uniform_radius";
  }
  return {};
}

template <typename Number>
std::string Shortest(Number number) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  return {text.data(), end};
}

bool IsControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

bool IsPrintableAscii(char c) { return static_cast<unsigned char>(c) < 0x80 && !IsControl(c); }

}  // namespace

Statement StatementOf(const ColliderSet& set, const std::string& format, const Frame& frame,
                      const std::string& axis) {
  return {{"format", format},
          {"format_version", absl::StrCat(kFormatVersion)},
          {"capfit", set.version},
          {"source", set.source},
          {"frame", std::string(frame.name)},
          {"axis", axis},
          {"profile", ProfileWord(set.profile)}};
}

std::string StatementLines(const Statement& statement, const std::string& before,
                           const std::string& after) {
  std::string lines;
  for (const auto& [key, value] : statement) {
    absl::StrAppend(&lines, before, key, ": ", CommentText(value), after, "\n");
  }
  return lines;
}

// (Adding 0 makes +0 of -0.)
std::string NumberText(double number) { return Shortest(number + 0.0); }

std::string FloatText(double number) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  std::string text = Shortest(static_cast<float>(std::clamp(number, -kLargest, kLargest)) + 0.0F);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string NumbersText(const Eigen::Vector3d& numbers) {
  return absl::StrCat(NumberText(numbers.x()), " ", NumberText(numbers.y()), " ",
                      NumberText(numbers.z()));
}

std::string XmlText(const std::string& text) {
  std::string xml;
  for (const char c : ValidUtf8(text)) {
    switch (c) {
      case '&':
        xml += "&amp;";
        break;
      case '<':
        xml += "&lt;";
        break;
      case '>':
        xml += "&gt;";
        break;
      case '"':
        xml += "&quot;";
        break;
      case '\'':
        xml += "&apos;";
        break;
      default:
        xml += IsControl(c) ? '_' : c;
    }
  }
  return xml;
}

std::string CommentText(const std::string& text) {
  std::string comment;
  for (const char c : text) {
    const bool is_plain = IsPrintableAscii(c) && c != '*' && c != '\\';
    const bool repeats_dash = c == '-' && !comment.empty() && comment.back() == '-';
    comment += is_plain && !repeats_dash ? c : '_';
  }
  return comment;
}

std::string CStringText(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    // (Of "??/" old compilers make a backslash.)
    const bool is_plain = byte >= 0x20 && byte < 0x7f && c != '"' && c != '\\' && c != '?';
    if (is_plain) {
      quoted += c;
    } else {
      absl::StrAppendFormat(&quoted, "\\%03o", byte);
    }
  }
  return quoted + "\"";
}

std::string CsvText(const std::string& text) {
  if (text.find_first_of(",\"\r\n#") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::vector<std::string> UniqueNames(std::vector<std::string> names, const std::string& unnamed) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty()) names[i] = absl::StrCat(unnamed, "_", i);
  }
  // Names that are there keep their right to themselves: a copy never takes one of a later name.
  std::set<std::string> taken(names.begin(), names.end());
  std::map<std::string, int> copies;  // of each name, with itself: many copies stay cheap
  for (std::string& name : names) {
    int& copy = copies[name];
    if (++copy == 1) continue;
    while (!taken.insert(absl::StrCat(name, "_", copy)).second) ++copy;
    name = absl::StrCat(name, "_", copy);
  }
  return names;
}

std::vector<std::string> JointNames(const ColliderSet& set) {
  std::vector<std::string> names;
  names.reserve(set.joints.size());
  for (const formats::NamedJoint& joint : set.joints) names.push_back(joint.name);
  return UniqueNames(std::move(names), "joint");
}

}  // namespace capfit::exports
