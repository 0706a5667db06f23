// The poses that a set is to enclose besides the one that is fitted.
#ifndef CAPFIT_CORE_PIPELINE_MOTION_FRAMES_H_
#define CAPFIT_CORE_PIPELINE_MOTION_FRAMES_H_

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "absl/status/status.h"
#include "core/formats/polygon_soup.h"
#include "core/motion/cover_motion.h"

namespace capfit::pipeline {

inline constexpr std::size_t kMostMotionFrames = 1000;

// Frame by frame all vertices of the caller's mesh, in its frame, unit and order.
struct Motion {
  std::vector<std::vector<Eigen::Vector3f>> frames;
  // Frame by frame where each of the mesh's joints then stands; empty: nobody knows. Needed where
  // bones are to carry the centres.
  std::vector<std::vector<formats::Placing>> joints = {};
  motion::MotionRadii radii = motion::MotionRadii::kConstant;
};

// INVALID_ARGUMENT naming the frame ("motion[3] has 12 vertices, must have 6890"): none or more
// than kMostMotionFrames, another number of vertices or
// joints, coordinates that are not finite.
[[nodiscard]] absl::Status CheckMotion(const Motion& motion, const formats::PolygonSoup& soup);

// The mesh's vertices by linear blend skinning with its joints standing at `to_mesh`, one for each
// of soup.joints: where glTF puts them, up to influences beyond the strongest four. Vertices
// without influences, and those whose joints have no inverse, stay. O(vertices).
[[nodiscard]] std::vector<Eigen::Vector3f> PoseVertices(
    const formats::PolygonSoup& soup, const std::vector<formats::Placing>& to_mesh);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_MOTION_FRAMES_H_
