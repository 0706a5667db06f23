// The parts of a surface: body, eyeballs, hair ...; each turned the same way round.
#ifndef CAPFIT_CORE_MESH_SURFACE_PARTS_H_
#define CAPFIT_CORE_MESH_SURFACE_PARTS_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/surface.h"

namespace capfit::mesh {

// Triangles that hang together by edges.
struct SurfacePart {
  std::size_t triangles = 0;
  std::size_t turned = 0;      // how many OrientParts turned round
  std::size_t open_edges = 0;  // edges without a second triangle
  // Edges at which no way of turning the triangles agrees, as on a Möbius strip.
  std::size_t conflicts = 0;
  // As if each hole were closed by a cone whose tip is the mean of all its open vertices.
  double volume = 0.0;
};

struct SurfaceParts {
  std::vector<std::uint32_t> part_of_triangle;
  std::vector<SurfacePart> parts;  // by their first triangle
};

// Finds the parts and turns triangles where needed, so that neighbours run their common edge in
// opposite directions; each part follows its first triangle. Conflicting edges are cut. O(n).
[[nodiscard]] SurfaceParts OrientParts(std::span<const Eigen::Vector3d> positions,
                                       Surface& surface);

// Leaves only the triangles of one part, in their order.
void KeepPart(const SurfaceParts& parts, std::uint32_t part, Surface& surface);

// Turns every triangle round.
void TurnInsideOut(Surface& surface);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_SURFACE_PARTS_H_
