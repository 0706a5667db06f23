// The animations (clips) of a glTF file: where its nodes stand at any time.
#ifndef CAPFIT_CORE_FORMATS_GLTF_CLIPS_H_
#define CAPFIT_CORE_FORMATS_GLTF_CLIPS_H_

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/formats/gltf_nodes.h"
#include "core/formats/polygon_soup.h"

namespace capfit::formats {

// One node's translation, rotation or scale over time.
struct GltfChannel {
  enum class Path { kTranslation, kRotation, kScale };
  enum class Interpolation { kStep, kLinear, kCubicSpline };

  std::size_t node = 0;
  Path path = Path::kTranslation;
  Interpolation interpolation = Interpolation::kLinear;
  std::vector<double> seconds;  // of the keys, rising
  // For each key its value, three numbers or the four of a quaternion (x, y, z, w); with cubic
  // splines the tangent in, the value and the tangent out.
  std::vector<Eigen::Vector4d> values;
};

struct GltfClip {
  std::string name;      // may be empty
  double seconds = 0.0;  // of the last key
  std::vector<GltfChannel> channels;
};

class GltfClips {
 public:
  // Reads all animations of GLB, VRM or .gltf bytes; meshes are not looked at, morph targets are
  // not moved. INVALID_ARGUMENT (field "mesh.file") names the animation and what is wrong with it:
  // keys that do not rise, a sampler whose values do not fit its keys, numbers that are not finite;
  // TOO_LARGE beyond 2 million keys in all. O(file).
  [[nodiscard]] static absl::StatusOr<GltfClips> Read(std::span<const std::byte> bytes);

  [[nodiscard]] const std::vector<GltfClip>& clips() const { return clips_; }
  // By its name, else by its index in the file. INVALID_ARGUMENT (field "clip") lists those that
  // are there.
  [[nodiscard]] absl::StatusOr<std::size_t> Find(const std::string& name_or_index) const;

  // Where the joints stand `seconds` into the clip (before the first key as at it, behind the last
  // as at that): their to_mesh, in their order. Joints that no file's node stands for, and nodes
  // that the clip does not move, stand as the file says. O(nodes + keys' logarithm).
  [[nodiscard]] std::vector<Placing> JointsAt(std::size_t clip, double seconds,
                                              std::span<const NamedJoint> joints) const;

 private:
  std::vector<NodePose> poses_;  // of every node, as the file says
  GltfNodes nodes_;
  std::vector<GltfClip> clips_;
};

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_GLTF_CLIPS_H_
