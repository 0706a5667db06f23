// Mesh files as bytes.
#ifndef CAPFIT_CLIENT_PICTURE_WRITE_MESH_H_
#define CAPFIT_CLIENT_PICTURE_WRITE_MESH_H_

#include <string>

#include "core/mesh/polygon_soup.h"

namespace capfit::client {

// Wavefront OBJ, coordinates with 7 decimals (0.1 um in metres). Mirrored vertices stay mirrored.
[[nodiscard]] std::string ObjText(const mesh::PolygonSoup& soup);

// Stanford PLY, binary little endian, double coordinates, faces with up to 255 corners.
[[nodiscard]] std::string PlyBytes(const mesh::PolygonSoup& soup);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_WRITE_MESH_H_
