// What each polygon wastes with 1, 2, 3 ... circles, computed when first asked for and kept.
#ifndef CAPFIT_CORE_CIRCLE_ERROR_CURVE_H_
#define CAPFIT_CORE_CIRCLE_ERROR_CURVE_H_

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/circle/approximate_polygon.h"
#include "core/section/feature_polygon.h"

namespace capfit::circle {

// Outside area of polygon `polygon_index` with `circle_count` circles, in square metres; expected
// not to rise with the count (the caller keeps the best so far).
using ErrorOf = std::function<double(int polygon_index, int circle_count)>;

// The error curves E_j(c) of all polygons with their circles. Safe to use from several threads; an
// approximation is computed once, by whoever asks first. Mirrored polygons share one computation:
// the one with the lower index is fitted, the other gets its mirror image, exact to the bit. Trunk
// polygons that are their own image are fitted symmetrically. The polygons, the pool and the
// observer must outlive the curves.
//
// What is returned does not depend on the order of the questions, only on polygons and options.
class ErrorCurves {
 public:
  ErrorCurves(std::span<const section::FeaturePolygon> polygons, int max_circles,
              const CircleOptions& options, const ThreadPool& pool, const FitObserver& observer);
  ~ErrorCurves();
  ErrorCurves(const ErrorCurves&) = delete;
  ErrorCurves& operator=(const ErrorCurves&) = delete;

  [[nodiscard]] int max_circles() const { return max_circles_; }

  // Exactly `circle_count` circles, in [1, max_circles].
  [[nodiscard]] const PolygonApproximation& Approximation(int polygon_index,
                                                          int circle_count) const;

  // Least outside area with at most `circle_count` circles: never rises with the count.
  [[nodiscard]] double BestAreaM2(int polygon_index, int circle_count) const;

  // For the allocations: BestAreaM2 as a function.
  [[nodiscard]] ErrorOf AsErrorOf() const {
    return [this](int polygon, int count) { return BestAreaM2(polygon, count); };
  }

  // Computes 1 to `circle_count` circles for every polygon in parallel: what an allocation will
  // surely ask for.
  void Prepare(int circle_count) const;
  // So many circles for each polygon, in parallel.
  void Prepare(std::span<const int> circle_counts) const;

 private:
  struct Entry;
  [[nodiscard]] Entry& EntryOf(int polygon_index, int circle_count) const;
  const PolygonApproximation& Compute(int polygon_index, int circle_count) const;
  void ComputeTogether(int polygon_index, int circle_count) const;

  std::span<const section::FeaturePolygon> polygons_;
  int max_circles_;
  CircleOptions options_;
  const ThreadPool& pool_;
  const FitObserver& observer_;
  std::unique_ptr<Entry[]> entries_;           // polygon-major
  std::unique_ptr<std::atomic<int>[]> asked_;  // by polygon: the largest count so far
};

}  // namespace capfit::circle

#endif  // CAPFIT_CORE_CIRCLE_ERROR_CURVE_H_
