// Mesh files from memory: OBJ, PLY, STL, OFF and glTF 2.0.
#ifndef CAPFIT_CORE_FORMATS_READ_MESH_H_
#define CAPFIT_CORE_FORMATS_READ_MESH_H_

#include <cstddef>
#include <span>
#include <string>

#include "absl/status/statusor.h"
#include "core/formats/mesh_limits.h"
#include "core/formats/polygon_soup.h"

namespace capfit::formats {

// kGlb: glTF 2.0 in any of its packings: GLB, VRM, and JSON with its buffers inside (.gltf).
enum class MeshFormat { kUnknown, kObj, kPly, kStl, kOff, kGlb };

// From a file name's ending (case does not matter); kUnknown for others.
[[nodiscard]] MeshFormat FormatFromFileName(const std::string& file_name);

// From the first bytes; kUnknown where they tell nothing.
[[nodiscard]] MeshFormat FormatFromBytes(std::span<const std::byte> bytes);

// Reads one mesh, sound but for how its faces lie: coordinates are finite and within 1e12, indices
// below the number of vertices. It may have no faces: that is for PrepareMesh to refuse. Vertex and
// face order are the file's (GLB: meshes in scene order, node transforms applied). kUnknown: the
// format is found from the bytes. Hostile bytes give INVALID_ARGUMENT with the field "mesh.file"
// and a place (see file_error.h), never a crash; counts in headers are checked against the bytes
// present before anything is allocated.
[[nodiscard]] absl::StatusOr<PolygonSoup> ReadMesh(std::span<const std::byte> bytes,
                                                   MeshFormat format = MeshFormat::kUnknown,
                                                   const MeshLimits& limits = {});

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_READ_MESH_H_
