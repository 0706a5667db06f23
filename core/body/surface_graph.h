// Geodesic distances on the surface, and the branches they reveal: limbs and head.
#ifndef CAPFIT_CORE_BODY_SURFACE_GRAPH_H_
#define CAPFIT_CORE_BODY_SURFACE_GRAPH_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/mesh/body_mesh.h"

namespace capfit::body {

// A vertex where a distance field starts, and the value it starts with.
struct GeodesicSource {
  std::uint32_t vertex = 0;
  double distance = 0.0;
};

// Edges of a closed surface and, across each edge, the straight line between the two opposite
// corners where it crosses that edge once both triangles are laid flat. With these shortcuts the
// shortest path overestimates the true geodesic by a few per cent (a tenth on a regular grid whose
// diagonals all run the same way), and the way a quad was cut into triangles hardly matters.
class SurfaceGraph {
 public:
  // `mates` are those of the triangles' half-edges. O(vertices + triangles). Not whole once the
  // observer cancels.
  SurfaceGraph(std::span<const Eigen::Vector3d> points, std::span<const mesh::Triangle> triangles,
               std::span<const mesh::HalfEdge> mates, const ThreadPool& pool = ThreadPool(1),
               const FitObserver& observer = NullObserver());

  // Shortest path length from the sources to every vertex; infinity where there is no path. The
  // result does not depend on the order of vertices, faces or sources. Close to O(vertices). Once
  // the observer cancels, what was not reached yet stays infinite.
  [[nodiscard]] std::vector<double> Distances(std::span<const GeodesicSource> sources,
                                              const ThreadPool& pool = ThreadPool(1),
                                              const FitObserver& observer = NullObserver()) const;

  [[nodiscard]] std::size_t vertex_count() const { return offsets_.size() - 1; }
  // The vertices that share an edge with `vertex`.
  [[nodiscard]] std::span<const std::uint32_t> Neighbours(std::uint32_t vertex) const {
    return {next_.data() + offsets_[vertex], offsets_[vertex + 1] - offsets_[vertex]};
  }

 private:
  struct Link {
    std::uint32_t across = 0;  // where the shortcut leads; to the vertex itself: there is none
    float edge_length = 0.0f;  // to the slot's corner
    float across_length = std::numeric_limits<float>::infinity();  // there is none
  };
  class Search;
  // What the graph is made from. `slot` is that of each half-edge's start in its triangle.
  struct Surface {
    std::span<const Eigen::Vector3d> points;
    std::span<const mesh::Triangle> triangles;
    std::span<const mesh::HalfEdge> mates;
    std::span<const std::uint32_t> slot;
  };
  // The sum of the lengths.
  double AddEdges(const Surface& surface, std::size_t begin, std::size_t end);
  void AddShortcuts(const Surface& surface, std::size_t begin, std::size_t end);
  void FinishInOrder(std::span<const std::uint32_t> open, std::vector<double>& distance) const;

  std::vector<std::uint32_t> offsets_;  // into next_, one slot per corner at the vertex
  std::vector<std::uint32_t> next_;     // the corner after the vertex in that triangle
  std::vector<Link> links_;             // one per slot
  // By the sign of x: above and below the middle of a body, from where it is searched. Shortest
  // ways lead away from that border; one along them would be crossed again and again.
  static constexpr std::uint8_t kRegions = 2;
  std::vector<std::uint8_t> region_;
  std::array<std::size_t, kRegions> region_links_{};
  double buckets_per_unit_ = 1.0;
};

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_SURFACE_GRAPH_H_
