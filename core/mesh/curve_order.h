// The order in which every room works on a surface, whatever order it came in.
#ifndef CAPFIT_CORE_MESH_CURVE_ORDER_H_
#define CAPFIT_CORE_MESH_CURVE_ORDER_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/raw_vector.h"
#include "core/base/thread_pool.h"
#include "core/mesh/edge_mates.h"

namespace capfit::mesh {

// Vertices along a space-filling curve, triangles by their corners in that order: neighbours on the
// surface are near each other in memory, which makes all that follows several times as fast.
struct CurveOrder {
  RawVector<std::uint32_t> source;            // of each vertex here the one that came
  RawVector<std::uint32_t> rank;              // of each that came the vertex here
  RawVector<Triangle> triangles;              // of vertices here, lowest corners first
  std::vector<std::uint32_t> first_triangle;  // of those that begin at each vertex; the last: end
};

// By `points` alone, and among equal ones by the order in which they came: snapped points give the
// same order for every copy of a mesh (see principal_frame.h). All finite. O(vertices + triangles).
// Not whole where the observer cancels.
[[nodiscard]] CurveOrder OrderAlongCurve(std::span<const Eigen::Vector3d> points,
                                         std::span<const Triangle> triangles,
                                         const ThreadPool& pool, const FitObserver& observer);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_CURVE_ORDER_H_
