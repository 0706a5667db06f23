// What BodyMesh and refusals promise, checked the slow way: for tests and fuzzers.
#ifndef CAPFIT_TESTS_FUZZ_MESH_PROMISES_H_
#define CAPFIT_TESTS_FUZZ_MESH_PROMISES_H_

#include <cstddef>
#include <string>

#include "absl/status/status.h"
#include "core/mesh/body_mesh.h"
#include "core/mesh/prepare_mesh.h"

namespace capfit::fuzz {

// The first promise of BodyMesh that `mesh`, made from `source_vertices` vertices, breaks; empty if
// it keeps all.
[[nodiscard]] std::string BrokenPromise(const mesh::BodyMesh& mesh, std::size_t source_vertices);

// The same, and also: preparing the prepared mesh again changes nothing and warns of nothing.
[[nodiscard]] std::string BrokenPromiseOfPrepare(const mesh::PreparedMesh& prepared,
                                                 std::size_t source_vertices);

// Why a refusal does not tell enough: it has no reason of its code or no message, or the request is
// at fault and no field is named. `is_file`: the field must be "mesh.file".
[[nodiscard]] std::string BrokenPromiseOfRefusal(const absl::Status& refusal, bool is_file);

}  // namespace capfit::fuzz

#endif  // CAPFIT_TESTS_FUZZ_MESH_PROMISES_H_
