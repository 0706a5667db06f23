// What the fuzzers of the mesh room do with one input; ordinary tests replay the corpus with it.
#ifndef CAPFIT_TESTS_FUZZ_MESH_TARGETS_H_
#define CAPFIT_TESTS_FUZZ_MESH_TARGETS_H_

#include <cstddef>
#include <span>
#include <string>

#include "core/formats/polygon_soup.h"

namespace capfit::fuzz {

// The first byte names a format (see formats::MeshFormat), the rest is a file: any bytes give an
// error or a mesh that keeps its promises. Returns the broken promise, empty if there is none.
[[nodiscard]] std::string TryReadMesh(std::span<const std::byte> bytes);

// A soup of a few vertices on a grid and faces between them, so that the odd connections that files
// seldom have are common. First byte: switches. Second byte: number of vertices. Then three signed
// bytes for each vertex, then the faces.
[[nodiscard]] formats::PolygonSoup SoupFrom(std::span<const std::byte> bytes);

// Any such soup gives an error or a mesh that keeps its promises.
[[nodiscard]] std::string TryPrepareMesh(std::span<const std::byte> bytes);

}  // namespace capfit::fuzz

#endif  // CAPFIT_TESTS_FUZZ_MESH_TARGETS_H_
