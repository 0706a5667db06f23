// Animations of a glTF file: where its joints stand at any time.
#ifndef CAPFIT_CORE_FORMATS_GLTF_CLIPS_H_
#define CAPFIT_CORE_FORMATS_GLTF_CLIPS_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/formats/gltf_nodes.h"
#include "core/formats/polygon_soup.h"

namespace capfit::formats {

// A glTF file (GLB, VRM, or JSON with its buffers inside) is read a second time, for its animations
// alone: ReadGlb passes over them. Translation, rotation and scale of nodes are played, by STEP,
// LINEAR (rotations along the shorter arc) and CUBICSPLINE as the format says; morph weights and
// what extensions animate are left as they are. Before its first key and behind its last a channel
// stands still.
class GltfClips {
 public:
  struct Clip {
    std::string name;       // may be empty, and several may have the same
    double length_s = 0.0;  // of the last key of any channel that is played
  };

  // O(file). INVALID_ARGUMENT (field "mesh.file") names the animation and what is wrong with it:
  // times that do not rise, counts that do not fit, numbers that are not finite. A file without
  // animations is fine.
  [[nodiscard]] static absl::StatusOr<GltfClips> Read(std::span<const std::byte> bytes);

  [[nodiscard]] std::span<const Clip> clips() const& { return clips_; }
  std::span<const Clip> clips() && = delete;

  // For each of the joints that ReadGlb finds, in its order, from the joint's own frame to the
  // mesh's, `time_s` into the clip (an index below clips().size()). Nodes that the clip does not
  // move stand as the file has them. O(nodes + channels * log keys).
  [[nodiscard]] std::vector<Placing> JointsAt(std::size_t clip, double time_s) const;

 private:
  friend class GltfClipsReader;

  enum class Path : std::uint8_t { kTranslation, kRotation, kScale };
  enum class Interpolation : std::uint8_t { kStep, kLinear, kCubicSpline };
  struct Channel {
    std::size_t node = 0;
    Path path = Path::kTranslation;
    Interpolation interpolation = Interpolation::kLinear;
    std::vector<double> times_s;          // rising, at least one
    std::vector<Eigen::Vector4d> values;  // one a key; cubic: in-tangent, value, out-tangent
  };
  [[nodiscard]] static Eigen::Vector4d ValueAt(const Channel& channel, double time_s);
  static void Move(const Channel& channel, double time_s, GltfNodePlace& place);

  std::vector<Clip> clips_;
  std::vector<std::vector<Channel>> channels_;  // of each clip
  GltfNodes nodes_;
  std::vector<GltfNodePlace> places_;     // of each node, at rest
  std::vector<std::size_t> joint_nodes_;  // of each joint
};

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_GLTF_CLIPS_H_
