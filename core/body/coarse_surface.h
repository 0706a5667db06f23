// The surface with fewer points: for what a coarse copy can answer as well.
#ifndef CAPFIT_CORE_BODY_COARSE_SURFACE_H_
#define CAPFIT_CORE_BODY_COARSE_SURFACE_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/body/working_copy.h"
#include "core/mesh/body_mesh.h"

namespace capfit::body {

// Each node stands for a few vertices of the working copy that hang together, and lies in their
// middle. Distances over the surface, its branches and sections are as good on some thousand nodes
// as on any number of vertices. A copy of few vertices is taken as it is: a node for each.
struct CoarseSurface {
  std::vector<Eigen::Vector3d> points;  // of the nodes, in the working copy's coordinates
  std::vector<double> areas;            // a third of the triangles around; they sum to 1
  // Of nodes: the copy's triangles whose corners belong to three of them. As they were neighbours
  // before the others shrank to edges and points, the surface is closed, but three nodes may have
  // more than one triangle, and two of them more than one edge.
  std::vector<mesh::Triangle> triangles;
  std::vector<mesh::HalfEdge> mates;
  // The copy's vertices node by node; those of node n begin at first[n] and end at first[n + 1].
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> first;

  [[nodiscard]] std::span<const std::uint32_t> VerticesOf(std::uint32_t node) const {
    return std::span(vertices).subspan(first[node], first[node + 1] - first[node]);
  }
};

// Depends on nothing but the working copy. O(vertices + triangles).
[[nodiscard]] CoarseSurface MakeCoarseSurface(const WorkingCopy& copy, const ThreadPool& pool);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_COARSE_SURFACE_H_
