// Primitives that KHR_draco_mesh_compression packed.
#ifndef CAPFIT_CORE_FORMATS_GLTF_DRACO_H_
#define CAPFIT_CORE_FORMATS_GLTF_DRACO_H_

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "core/formats/file_error.h"
#include "core/formats/gltf_accessor.h"
#include "core/formats/mesh_limits.h"

namespace capfit::formats {

inline constexpr const char* kDracoExtension = "KHR_draco_mesh_compression";

struct DracoPrimitive {
  std::vector<std::uint32_t> corners;  // three for each face, below the number of points
  // By Draco's number of the attribute, one element for each point; those that were asked for and
  // are there. Not normalized: the file's accessors say that.
  std::map<std::uint32_t, GltfAccessor> attributes;
};

// The faces of `packed` and the attributes of those numbers. Any bytes give an error or that; what
// they claim is held against `limits` and the file's memory before Draco takes any. Refused
// besides: point clouds, metadata and bitstreams before 2.2, which no glTF file has.
[[nodiscard]] absl::StatusOr<DracoPrimitive> DecodeDraco(std::span<const std::byte> packed,
                                                         std::span<const std::uint32_t> attributes,
                                                         const MeshLimits& limits, GltfFile& file,
                                                         const FilePlace& place);

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_GLTF_DRACO_H_
