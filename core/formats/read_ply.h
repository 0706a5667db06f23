// Stanford PLY from memory.
#ifndef CAPFIT_CORE_FORMATS_READ_PLY_H_
#define CAPFIT_CORE_FORMATS_READ_PLY_H_

#include <cstddef>
#include <span>

#include "absl/status/statusor.h"
#include "core/formats/mesh_limits.h"
#include "core/formats/polygon_soup.h"

namespace capfit::formats {

// The elements `vertex` (x, y, z) and `face` (vertex_indices or vertex_index) of a text or binary
// PLY file of either byte order; all other elements and properties are skipped. Counts are checked
// against the bytes present first. Coordinates and indices are checked as they are read.
// INVALID_ARGUMENT (field "mesh.file") names the line, in a binary file the element and its row.
//
// Not OpenMesh's reader: its per-file state lives in one object for the whole process, so two
// requests would mix their headers, and it rounds doubles to float.
[[nodiscard]] absl::StatusOr<PolygonSoup> ReadPly(std::span<const std::byte> bytes,
                                                  const MeshLimits& limits);

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_READ_PLY_H_
