// STL from memory.
#ifndef CAPFIT_CORE_FORMATS_READ_STL_H_
#define CAPFIT_CORE_FORMATS_READ_STL_H_

#include <cstddef>
#include <span>

#include "absl/status/statusor.h"
#include "core/formats/mesh_limits.h"
#include "core/formats/polygon_soup.h"

namespace capfit::formats {

// The triangles of a binary or text STL file, in file order. STL repeats each corner in each
// triangle; corners with equal coordinates become one vertex, in order of first appearance. The
// triangle count is checked against the bytes present first. INVALID_ARGUMENT (field
// "mesh.file") names the line, or the triangle and its corner.
//
// Not OpenMesh's reader: from memory it takes every binary file for an empty text file.
[[nodiscard]] absl::StatusOr<PolygonSoup> ReadStl(std::span<const std::byte> bytes,
                                                  const MeshLimits& limits);

// Whether the size of the file is what the count in it asks for: any 80 bytes, even "solid", may
// begin a binary STL.
[[nodiscard]] bool HasSizeOfBinaryStl(std::span<const std::byte> bytes);

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_READ_STL_H_
