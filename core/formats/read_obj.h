// Wavefront OBJ from memory.
#ifndef CAPFIT_CORE_FORMATS_READ_OBJ_H_
#define CAPFIT_CORE_FORMATS_READ_OBJ_H_

#include <string_view>

#include "absl/status/statusor.h"
#include "core/formats/mesh_limits.h"
#include "core/formats/polygon_soup.h"

namespace capfit::formats {

// The vertices (`v`) and faces (`f`) of an OBJ file, in file order and in double precision.
// Understands negative and forward indices, `a/b/c` corners, line continuations and CRLF; all else
// (texture coordinates, normals, groups, materials) is skipped, and no other file is opened.
// INVALID_ARGUMENT (field "mesh.file") names the line, also of a coordinate that is not finite or
// an index that refers to nothing.
//
// Not OpenMesh's reader: that one keeps coordinates as float (a body kilometres from the origin
// loses its fingers), opens the files that `mtllib` names on the server's disk, adds the missing
// vertices silently where an index is out of range, and shares state between threads.
[[nodiscard]] absl::StatusOr<PolygonSoup> ReadObj(std::string_view text, const MeshLimits& limits);

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_READ_OBJ_H_
