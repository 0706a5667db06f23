// Mesh files as bytes.
#ifndef CAPFIT_CLIENT_PICTURE_WRITE_MESH_H_
#define CAPFIT_CLIENT_PICTURE_WRITE_MESH_H_

#include <string>

#include "core/formats/polygon_soup.h"

namespace capfit::client {

// Wavefront OBJ, coordinates with 7 decimals (0.1 um in metres). Mirrored vertices stay mirrored.
[[nodiscard]] std::string ObjText(const formats::PolygonSoup& soup);

// Stanford PLY, binary little endian, double coordinates, faces with up to 255 corners.
[[nodiscard]] std::string PlyBytes(const formats::PolygonSoup& soup);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_WRITE_MESH_H_
