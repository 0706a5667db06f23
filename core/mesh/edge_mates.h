// Which triangles meet at each edge: the one adjacency structure of the core.
#ifndef CAPFIT_CORE_MESH_EDGE_MATES_H_
#define CAPFIT_CORE_MESH_EDGE_MATES_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/raw_vector.h"
#include "core/base/thread_pool.h"

namespace capfit::mesh {

using Triangle = std::array<std::uint32_t, 3>;

// Half-edge h = 3 * triangle + k runs from corner k of its triangle to corner (k + 1) % 3.
using HalfEdge = std::uint32_t;
inline constexpr HalfEdge kNoMate = 0xFFFFFFFFu;

[[nodiscard]] inline HalfEdge NextInTriangle(HalfEdge h) { return h % 3 == 2 ? h - 2 : h + 1; }
[[nodiscard]] inline HalfEdge PreviousInTriangle(HalfEdge h) { return h % 3 == 0 ? h + 2 : h - 1; }
[[nodiscard]] inline std::uint32_t StartOf(std::span<const Triangle> triangles, HalfEdge h) {
  return triangles[h / 3][h % 3];
}
[[nodiscard]] inline std::uint32_t EndOf(std::span<const Triangle> triangles, HalfEdge h) {
  return StartOf(triangles, NextInTriangle(h));
}

struct EdgeMates {
  // For each half-edge the one across the edge; kNoMate where the edge is open or crowded.
  RawVector<HalfEdge> mate;
  // Edges with three or more triangles: their half-edges (ascending), one edge after the other.
  std::vector<HalfEdge> crowded;
  std::vector<std::uint32_t> crowded_sizes;
  std::size_t open = 0;         // edges with one triangle
  std::size_t misdirected = 0;  // edges that both of their two triangles run the same way

  // Every edge has two triangles, which run it in opposite directions.
  [[nodiscard]] bool IsClosedAndOriented() const {
    return open == 0 && misdirected == 0 && crowded_sizes.empty();
  }
};

// Pairs the half-edges of `triangles`, whose corners are all below `vertex_count` and differ from
// each other within a triangle. O(triangles + vertices); the order of triangles decides no ties.
// Empty once the observer cancels. `first_triangle`: of triangles listed by their lowest corners,
// those first, the start of each vertex's (see curve_order.h), which takes half the time; empty
// where they are not.
[[nodiscard]] EdgeMates FindEdgeMates(std::span<const Triangle> triangles, std::size_t vertex_count,
                                      const ThreadPool& pool = ThreadPool(1),
                                      const FitObserver& observer = NullObserver(),
                                      std::span<const std::uint32_t> first_triangle = {});

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_EDGE_MATES_H_
