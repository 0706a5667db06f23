// Circles to primitives under the caller's budget: the one loop of the pipeline that goes back.
#ifndef CAPFIT_CORE_PIPELINE_PRIMITIVE_STAGE_H_
#define CAPFIT_CORE_PIPELINE_PRIMITIVE_STAGE_H_

#include <optional>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/base/warning.h"
#include "core/body/body.h"
#include "core/capsule/allocation.h"
#include "core/capsule/primitive_set.h"
#include "core/circle/approximate_polygon.h"
#include "core/circle/error_curve.h"
#include "core/pipeline/fit.h"
#include "core/section/feature_polygon.h"

namespace capfit::pipeline {

// What the circles of the feature polygons became.
struct PrimitiveStage {
  std::vector<circle::PolygonApproximation> approximations;  // one for each polygon
  capsule::PrimitiveSet set;                                 // before coverage
};

// Allocates circles, builds spheres and capsules, removes the covered ones, and gives what the
// removal freed to more circles, until the budget is used up (within 3 primitives) or nothing more
// can be bought. Never above the budget unless one circle per polygon already is.
//
// `drafts` tell what circles would save, and need not be the best ones: only the circles that were
// allocated, and all of those that an error threshold asks for, are taken from `curves`.
[[nodiscard]] PrimitiveStage BuildUnderBudget(const body::Body& body, const FitOptions& options,
                                              std::span<const section::FeaturePolygon> polygons,
                                              const circle::ErrorCurves& drafts,
                                              const circle::ErrorCurves& curves,
                                              const ThreadPool& pool);

// POLYGON_ERROR_MISSED where polygons have more error than options.polygon_error asks for: no
// polygon has more circles than kMaxCirclesPerPolygon, and no set more primitives than any may
// have.
[[nodiscard]] std::optional<Warning> WarningOfPolygonError(
    double polygon_error, std::span<const section::FeaturePolygon> polygons,
    std::span<const circle::PolygonApproximation> approximations);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_PRIMITIVE_STAGE_H_
