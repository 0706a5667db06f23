// How far the points to cover are from a set that changes: measured only as far as it has changed.
#ifndef CAPFIT_CORE_COVERAGE_POINT_DISTANCES_H_
#define CAPFIT_CORE_COVERAGE_POINT_DISTANCES_H_

#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/capsule/primitive_set.h"
#include "core/tighten/cover_target.h"
#include "core/tighten/point_grid.h"
#include "core/tighten/set_variables.h"

namespace capfit::coverage {

// Keeps references to all it is given. What it returns holds until the next call.
class PointDistances {
 public:
  // `points`: those of the target, folded where the set is its own mirror image. Nothing is deeper
  // than `size_m`.
  PointDistances(const tighten::CoverTarget& target, const tighten::PointGrid& points,
                 double size_m, const tighten::SetVariables& variables,
                 const capsule::PrimitiveSet& set, const ThreadPool& pool)
      : target_(target),
        points_(points),
        size_m_(size_m),
        variables_(variables),
        set_(set),
        pool_(pool) {}

  // Of the set as it is, in the order of `points`.
  [[nodiscard]] const tighten::UnionDistances& InOrderOfPoints() {
    Measure();
    return at_points_;
  }
  // By the target's index, each with the solid on its own side.
  [[nodiscard]] const tighten::UnionDistances& ByTargetIndex();
  // What InOrderOfPoints gives, where that takes no measuring; else nothing.
  [[nodiscard]] const tighten::UnionDistances* Known() const {
    return IsMeasured() ? &at_points_ : nullptr;
  }
  // The last of ByTargetIndex, which is gone from here then.
  [[nodiscard]] tighten::UnionDistances TakeByTargetIndex() { return std::move(by_target_index_); }

 private:
  [[nodiscard]] bool IsMeasured() const;
  // Since it was measured: each sphere contains what it was.
  [[nodiscard]] bool HasOnlyGrown() const;
  void Measure();
  [[nodiscard]] std::vector<std::int32_t> ChangedSolids() const;

  const tighten::CoverTarget& target_;
  const tighten::PointGrid& points_;
  double size_m_;
  const tighten::SetVariables& variables_;
  const capsule::PrimitiveSet& set_;
  const ThreadPool& pool_;
  std::vector<geometry::Sphere> measured_;  // the set's, when it was measured
  tighten::UnionDistances at_points_;
  tighten::UnionDistances by_target_index_;
  bool is_by_target_index_ = false;  // that tells what at_points_ does
};

}  // namespace capfit::coverage

#endif  // CAPFIT_CORE_COVERAGE_POINT_DISTANCES_H_
