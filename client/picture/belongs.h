// Whether a result, and what stands beside it, is of the body at hand.
#ifndef CAPFIT_CLIENT_PICTURE_BELONGS_H_
#define CAPFIT_CLIENT_PICTURE_BELONGS_H_

#include <cstddef>
#include <string>

#include "absl/status/status.h"
#include "client/picture/result_set.h"
#include "core/formats/polygon_soup.h"

namespace capfit::client {

// INVALID_ARGUMENT with both figures where the result cannot be of this mesh.
//
// A result of capfit says which box it was fitted to: the mesh's (of what mending keeps of it) must
// be the same to 2 % of the diagonal on every side. A decimated or otherwise tessellated copy of
// the body passes; another unit, other axes, another pose or person do not.
//
// Of another program's there are only spheres. All centres must lie within the mesh's box and a
// quarter of its diagonal around it (centres of a set that stands for a body lie within the body,
// whatever its radii), and the set's diagonal must be between 0.12 and 2 of the mesh's: twice the
// body is more than any set's excess, and 0.12 less than a set of one hand (0.18), while units
// differ by factors of 10 and more, but for inches and centimetres (2.54: caught one way round).
// Empty sets pass.
[[nodiscard]] absl::Status CheckBelongs(const ResultSet& result, const formats::PolygonSoup& body);

// INVALID_ARGUMENT where what `name` holds is for another number of vertices.
[[nodiscard]] absl::Status CheckVertexCount(const std::string& name, std::size_t vertex_count,
                                            const formats::PolygonSoup& body);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_BELONGS_H_
