// What has to be inside of a set.
#ifndef CAPFIT_CORE_TIGHTEN_COVER_TARGET_H_
#define CAPFIT_CORE_TIGHTEN_COVER_TARGET_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/base/lent_or_own.h"
#include "core/base/thread_pool.h"
#include "core/body/body.h"

namespace capfit::tighten {

// Vertices and triangles of the fitted parts, in the body frame.
struct CoverTarget {
  LentOrOwn<Eigen::Vector3d> points_m;
  LentOrOwn<mesh::Triangle> triangles;  // indices into points_m
  std::vector<std::uint32_t> vertices;  // which vertex of Body::enclosed() each point is
};

// The vertices of the selected parts, and the triangles whose three corners are all among them.
// Where all parts are selected the body lends its arrays: it must outlive the target.
[[nodiscard]] CoverTarget TargetOf(const body::Body& body, const body::PartSelection& parts,
                                   const ThreadPool& pool = ThreadPool(1));
CoverTarget TargetOf(body::Body&& body, const body::PartSelection& parts,
                     const ThreadPool& pool = ThreadPool(1)) = delete;

// What lengths of tightening are relative to: the square root of the triangles' area, without
// triangles the diagonal of the points' box. There must be a point.
[[nodiscard]] double SizeOf(const CoverTarget& target);

struct AreaWeights {
  // By point a third of the area of the triangles around it; a billionth of the whole for those
  // without any.
  std::vector<double> of_point_m2;
  double size_m = 0.0;  // SizeOf the target
};
[[nodiscard]] AreaWeights WeightsByArea(const CoverTarget& target);

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_COVER_TARGET_H_
