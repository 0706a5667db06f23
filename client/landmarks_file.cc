#include "client/landmarks_file.h"

#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::client {
namespace {

using Json = nlohmann::json;

absl::StatusOr<Eigen::Vector3d> PositionOf(const Json& value, const std::string& field) {
  if (value.is_object() && value.contains("position")) return PositionOf(value["position"], field);
  Eigen::Vector3d position = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  if (value.is_array() && value.size() == 3) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (value[i].is_number()) position[static_cast<Eigen::Index>(i)] = value[i].get<double>();
    }
  }
  if (!position.allFinite())
    return InvalidField(ErrorReason::kMalformedFile, field,
                        "must be [x, y, z], three finite numbers");
  return position;
}

}  // namespace

absl::StatusOr<std::map<body::LandmarkId, Eigen::Vector3d>> ParseLandmarks(
    const std::string& json_text) {
  const Json root = Json::parse(json_text, nullptr, /*allow_exceptions=*/false);
  if (!root.is_object())
    return InvalidField(ErrorReason::kMalformedFile, "landmarks", "is not a JSON object");
  const auto inner = root.find("landmarks");
  const Json& landmarks = inner != root.end() && inner->is_object() ? *inner : root;
  std::map<body::LandmarkId, Eigen::Vector3d> positions;
  for (const auto& [name, value] : landmarks.items()) {
    const std::string field = absl::StrCat("landmarks.", name);
    const std::optional<body::LandmarkId> id = body::LandmarkFromName(name);
    if (!id) {
      return InvalidField(
          ErrorReason::kMalformedFile, field,
          absl::StrCat("is no landmark's name, must be one of ", body::LandmarkNames()));
    }
    CAPFIT_ASSIGN_OR_RETURN(positions[*id], PositionOf(value, field));
  }
  return positions;
}

}  // namespace capfit::client
