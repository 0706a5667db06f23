// GLB (binary glTF 2.0) from memory.
#ifndef CAPFIT_CORE_FORMATS_READ_GLB_H_
#define CAPFIT_CORE_FORMATS_READ_GLB_H_

#include <cstddef>
#include <span>

#include "absl/status/statusor.h"
#include "core/formats/mesh_limits.h"
#include "core/formats/polygon_soup.h"

namespace capfit::formats {

// All triangles of the default scene (or of all nodes, where the file has no scene) with the node
// transforms applied, meshes in scene order; primitives that share their positions share their
// vertices. Of a skinned mesh, the bind pose: placed as the scene places its first joint, together
// with the names and positions of all joints. Morph targets count as zero.
//
// Coordinates and indices are checked as they are read; INVALID_ARGUMENT (field "mesh.file") names
// the accessor and its row. Not read (UNSUPPORTED_FILE): Draco and meshopt compression, sparse
// accessors, buffers in other files. Materials, textures and animations are skipped unseen, and no
// other file is opened. That is why this reads the JSON itself (nlohmann/json) and not with
// TinyGLTF, which would decode images and open files unless told otherwise, and checks no accessor
// against its buffer.
[[nodiscard]] absl::StatusOr<PolygonSoup> ReadGlb(std::span<const std::byte> bytes,
                                                  const MeshLimits& limits);

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_READ_GLB_H_
