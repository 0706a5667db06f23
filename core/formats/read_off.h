// OFF (Object File Format) from memory.
#ifndef CAPFIT_CORE_FORMATS_READ_OFF_H_
#define CAPFIT_CORE_FORMATS_READ_OFF_H_

#include <string_view>

#include "absl/status/statusor.h"
#include "core/formats/mesh_limits.h"
#include "core/formats/polygon_soup.h"

namespace capfit::formats {

// The vertices and faces of a text OFF file in three dimensions, in file order. Colours, normals
// and texture coordinates behind a vertex or a face on its line are skipped, comments and blank
// lines too. Counts are checked against the bytes present first. Coordinates and indices are
// checked as they are read. INVALID_ARGUMENT (field "mesh.file") names the line.
//
// Not OpenMesh's reader: a comment before the counts makes it reserve faces without end.
[[nodiscard]] absl::StatusOr<PolygonSoup> ReadOff(std::string_view text, const MeshLimits& limits);

// Whether the word may begin an OFF file: OFF, COFF, NOFF, STCNOFF ...
[[nodiscard]] bool IsOffKeyword(std::string_view word);

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_READ_OFF_H_
