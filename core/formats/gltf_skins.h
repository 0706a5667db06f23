// Who moves whom in a glTF file: skins, joints and what VRM says they are.
#ifndef CAPFIT_CORE_FORMATS_GLTF_SKINS_H_
#define CAPFIT_CORE_FORMATS_GLTF_SKINS_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "core/formats/gltf_file.h"
#include "core/formats/gltf_nodes.h"
#include "core/formats/polygon_soup.h"

namespace capfit::formats {

// Whether the way from where a vertex is stored to where it is drawn leaves a body a body: zeros
// are common where an exporter knew no bind pose.
[[nodiscard]] bool IsPlacing(const Placing& placing);

struct GltfSkin {
  std::vector<std::uint16_t> joints;  // indices into the skeleton's, in the order of the skin
  // Where each moves the vertices that it alone holds: node_to_world * inverse_bind. A matrix that
  // is no placing moves nothing.
  std::vector<Placing> placings;
  std::vector<char> is_placing;  // of each, see IsPlacing
  // The first that is one; nothing where none is, or where the file has no bind matrices.
  std::optional<Placing> first_placing;
};

struct GltfSkeleton {
  std::vector<NamedJoint> joints;
  std::map<std::size_t, GltfSkin> skins;    // those of drawn nodes, by index
  std::vector<std::int32_t> nearest_joint;  // of each node: itself or the nearest above it, else -1
};

// The skins of the nodes that are drawn. Joints: each node that one of them lists, then those that
// VRM (0 or 1) calls a human's bone, once each. Errors name the skin. O(nodes + joints).
[[nodiscard]] absl::StatusOr<GltfSkeleton> ReadGltfSkeleton(GltfFile& file, const GltfNodes& nodes);

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_GLTF_SKINS_H_
