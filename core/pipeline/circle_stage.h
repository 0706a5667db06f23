// All feature polygons as circles: independent jobs on the pool, each result computed once.
#ifndef CAPFIT_CORE_PIPELINE_CIRCLE_STAGE_H_
#define CAPFIT_CORE_PIPELINE_CIRCLE_STAGE_H_

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/circle/approximate_polygon.h"
#include "core/section/feature_polygon.h"

namespace capfit::pipeline {

// The curves E_j(c) of all polygons (paper, III-B). A polygon and its mirror image share one fit.
class CircleStage {
 public:
  // The polygons, pool and observer must outlive the stage.
  CircleStage(std::span<const section::FeaturePolygon> polygons, std::uint64_t seed,
              const ThreadPool& pool, const FitObserver& observer);

  // Fits every polygon with 1 to `max_circles` circles, all in parallel.
  void Prepare(int max_circles);

  // Outside area with `circle_count` circles, never more than with fewer; fits on demand.
  [[nodiscard]] double Error_m2(int polygon, int circle_count);

  // The fit itself; the right side's is the left side's, mirrored.
  [[nodiscard]] circle::PolygonApproximation Approximation(int polygon, int circle_count);

 private:
  [[nodiscard]] int OwnerOf(int polygon) const;  // the one of a mirrored pair that is fitted
  [[nodiscard]] circle::PolygonApproximation Fit(int owner, int circle_count) const;
  std::optional<circle::PolygonApproximation>& Slot(int owner, int circle_count);

  std::span<const section::FeaturePolygon> polygons_;
  std::uint64_t seed_;
  const ThreadPool& pool_;
  const FitObserver& observer_;
  std::vector<std::vector<std::optional<circle::PolygonApproximation>>>
      fits_;  // [polygon][count - 1]
};

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_CIRCLE_STAGE_H_
