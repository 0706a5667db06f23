#include "client/picture/centers_file.h"

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "client/picture/file_bytes.h"
#include "core/base/status.h"

namespace capfit::client {
namespace {

using Tree = nlohmann::json;

static_assert(std::endian::native == std::endian::little, "frames are little-endian float32");

constexpr char kJsonEnding[] = ".json";

void AppendFloats(const Eigen::Vector3d& center, std::string& bytes) {
  const Eigen::Vector3f single = center.cast<float>();
  bytes.append(reinterpret_cast<const char*>(single.data()), 3 * sizeof(float));
}

absl::Status Malformed(const std::string& field, const std::string& problem) {
  return InvalidField(ErrorReason::kMalformedFile, field, problem);
}

absl::Status AppendPoint(const Tree& point, const std::string& field, std::string& bytes) {
  Eigen::Vector3d center;
  bool is_point = point.is_array() && point.size() == 3;
  for (std::size_t i = 0; is_point && i < 3; ++i) {
    is_point = point[i].is_number() && std::isfinite(point[i].get<double>());
    if (is_point) center[static_cast<Eigen::Index>(i)] = point[i].get<double>();
  }
  if (!is_point) return Malformed(field, "must be three finite numbers");
  AppendFloats(center, bytes);
  return absl::OkStatus();
}

absl::Status AppendRadius(const Tree& radius, const std::string& field, std::string& bytes) {
  if (!radius.is_number() || !std::isfinite(radius.get<double>())) {
    return Malformed(field, "must be a finite number");
  }
  const auto single = static_cast<float>(radius.get<double>());
  bytes.append(reinterpret_cast<const char*>(&single), sizeof single);
  return absl::OkStatus();
}

// `name`: of what the file holds; `append`: one of them to the bytes.
template <typename Append>
absl::StatusOr<std::string> FloatsOf(const std::string& text, const std::string& name,
                                     const Append& append) {
  const Tree root = Tree::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!root.is_object() || !root.contains("frames") || !root["frames"].is_array()) {
    return Malformed(name, "must be a JSON object with a list \"frames\"");
  }
  std::string bytes;
  for (std::size_t f = 0; f < root["frames"].size(); ++f) {
    const Tree& frame = root["frames"][f];
    const std::string field = absl::StrCat(name, "[", f, "]");
    if (!frame.is_array() || frame.size() != root["frames"][0].size()) {
      return Malformed(field, "must be a list of as many entries as the first frame");
    }
    for (std::size_t i = 0; i < frame.size(); ++i) {
      CAPFIT_RETURN_IF_ERROR(append(frame[i], absl::StrCat(field, "[", i, "]"), bytes));
    }
  }
  return bytes;
}

}  // namespace

std::string FormatCenters(const std::vector<std::vector<Eigen::Vector3d>>& frames,
                          const std::string& path) {
  const bool is_json = FileEnding(path) == kJsonEnding;
  std::string bytes;
  for (const std::vector<Eigen::Vector3d>& centers : frames) {
    Tree row = Tree::array();
    for (const Eigen::Vector3d& c : centers) {
      if (is_json) {
        row.push_back({c.x(), c.y(), c.z()});
      } else {
        AppendFloats(c, bytes);
      }
    }
    if (is_json) bytes += (bytes.empty() ? "{\"frames\": [\n  " : ",\n  ") + row.dump();
  }
  return is_json ? bytes + "\n]}\n" : bytes;
}

std::string FormatRadii(const std::vector<std::vector<double>>& frames, const std::string& path) {
  if (FileEnding(path) == kJsonEnding) return Tree{{"frames", frames}}.dump() + "\n";
  std::string bytes;
  for (const std::vector<double>& radii : frames) {
    for (const double radius : radii) {
      const auto single = static_cast<float>(radius);
      bytes.append(reinterpret_cast<const char*>(&single), sizeof single);
    }
  }
  return bytes;
}

absl::StatusOr<std::string> ReadCenters(const std::string& path) {
  CAPFIT_ASSIGN_OR_RETURN(std::string bytes, ReadFileBytes(path));
  return FileEnding(path) == kJsonEnding ? FloatsOf(bytes, "centers", AppendPoint) : bytes;
}

absl::StatusOr<std::string> ReadRadii(const std::string& path) {
  CAPFIT_ASSIGN_OR_RETURN(std::string bytes, ReadFileBytes(path));
  return FileEnding(path) == kJsonEnding ? FloatsOf(bytes, "radii", AppendRadius) : bytes;
}

}  // namespace capfit::client
