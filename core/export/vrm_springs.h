// The springs of a VRM: the chains of bones that swing and what they collide with.
#ifndef CAPFIT_CORE_EXPORT_VRM_SPRINGS_H_
#define CAPFIT_CORE_EXPORT_VRM_SPRINGS_H_

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/export/gltf_document.h"

namespace capfit::exports {

// What of a spring collides, at rest, in the scene.
struct SpringPoint {
  Eigen::Vector3d position;
  double radius = 0.0;
};

// The points of a spring of VRM 1.0: each joint but the first, with the radius of the one before.
[[nodiscard]] std::vector<SpringPoint> SpringPoints(const GltfDocument& document,
                                                    const nlohmann::json& spring);

// The points of a bone group of VRM 0: below each of its bones, for every node its first child; for
// one without children a place 7 cm further on.
[[nodiscard]] std::vector<SpringPoint> BoneGroupPoints(const GltfDocument& document,
                                                       const nlohmann::json& bone_group);

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_VRM_SPRINGS_H_
