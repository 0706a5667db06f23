// What BodyMesh and refusals promise, checked the slow way: for tests and fuzzers.
#ifndef CAPFIT_TESTS_FUZZ_MESH_PROMISES_H_
#define CAPFIT_TESTS_FUZZ_MESH_PROMISES_H_

#include <cstddef>
#include <string>

#include "absl/status/status.h"
#include "core/formats/polygon_soup.h"
#include "core/mesh/body_mesh.h"
#include "core/mesh/prepare_mesh.h"

namespace capfit::fuzz {

// The first promise of BodyMesh that `mesh`, made from `source_vertices` vertices, breaks; empty if
// it keeps all.
[[nodiscard]] std::string BrokenPromise(const mesh::BodyMesh& mesh, std::size_t source_vertices);

// Whether `mesh` has the vertices and triangles of `soup`, which are triangles all, in some order,
// and vertex_of_source leads from one to the other.
[[nodiscard]] bool IsReordered(const formats::PolygonSoup& soup, const mesh::BodyMesh& mesh);

// As BrokenPromise, and also: preparing the prepared mesh again changes nothing but the order and
// warns of nothing.
[[nodiscard]] std::string BrokenPromiseOfPrepare(const mesh::PreparedMesh& prepared,
                                                 std::size_t source_vertices);

// Why a refusal does not tell enough: it has no reason of its code or no message, or the request is
// at fault and no field is named. `is_file`: the field must be "mesh.file".
[[nodiscard]] std::string BrokenPromiseOfRefusal(const absl::Status& refusal, bool is_file);

}  // namespace capfit::fuzz

#endif  // CAPFIT_TESTS_FUZZ_MESH_PROMISES_H_
