// What BodyMesh promises, checked the slow way: for tests and fuzzers.
#ifndef CAPFIT_TESTS_FUZZ_MESH_PROMISES_H_
#define CAPFIT_TESTS_FUZZ_MESH_PROMISES_H_

#include <cstddef>
#include <string>

#include "core/mesh/body_mesh.h"
#include "core/mesh/prepare_mesh.h"

namespace capfit::fuzz {

// The first promise of BodyMesh that `mesh`, made from `source_vertices` vertices, breaks; empty if
// it keeps all.
[[nodiscard]] std::string BrokenPromise(const mesh::BodyMesh& mesh, std::size_t source_vertices);

// The same, and also: preparing the prepared mesh again changes nothing and warns of nothing.
[[nodiscard]] std::string BrokenPromiseOfPrepare(const mesh::PreparedMesh& prepared,
                                                 std::size_t source_vertices);

}  // namespace capfit::fuzz

#endif  // CAPFIT_TESTS_FUZZ_MESH_PROMISES_H_
