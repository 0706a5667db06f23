// Sphere centres and radii of an animation: what `animate` computes.
#ifndef CAPFIT_CLIENT_CARRIED_FRAMES_H_
#define CAPFIT_CLIENT_CARRIED_FRAMES_H_

#include <Eigen/Core>
#include <istream>
#include <string>
#include <variant>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/thread_pool.h"
#include "core/formats/gltf_clips.h"
#include "core/formats/polygon_soup.h"
#include "core/skinning/bone_weights.h"
#include "core/skinning/mean_value_coordinates.h"
#include "core/skinning/sparse_weights.h"

namespace capfit::client {

// Weights of one of the three forms.
using AnyWeights =
    std::variant<skinning::DenseWeights, skinning::SparseWeights, skinning::BoneWeights>;

// What is carried, and the pose in which it was fitted.
struct CarriedSet {
  AnyWeights weights;  // may carry further points after the spheres
  std::size_t sphere_count = 0;
  std::vector<double> radii;                // of all that is carried
  std::vector<Eigen::Vector3d> vertices;    // of the body at rest
  std::vector<formats::NamedJoint> joints;  // at rest; those of bone weights
  bool stretches_radii = false;             // see core/skinning/stretched_radii.h
};

// In the unit of what moves.
struct CarriedFrames {
  std::vector<std::vector<Eigen::Vector3d>> centers;
  std::vector<std::vector<double>> radii;
};

// Dense or sparse weights: frame after frame all vertices, little-endian float32 x, y, z. Bones:
// frame after frame of each joint the 3 rows of 4 numbers that lead from its frame to the mesh's.
// INVALID_ARGUMENT for a frame that is cut short, a number that is not finite, no frame at all.
[[nodiscard]] absl::StatusOr<CarriedFrames> CarryAlong(const CarriedSet& set, std::istream& in,
                                                       const ThreadPool& pool);

// Bones with a clip of the body's own file, `fps` frames a second from its start to its end.
// INVALID_ARGUMENT for more than 100,000 frames.
[[nodiscard]] absl::StatusOr<CarriedFrames> CarryAlong(const CarriedSet& set,
                                                       const formats::GltfClips& clips,
                                                       std::size_t clip, double fps);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_CARRIED_FRAMES_H_
