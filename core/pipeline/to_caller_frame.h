// Results back into the unit and axes in which the mesh came.
#ifndef CAPFIT_CORE_PIPELINE_TO_CALLER_FRAME_H_
#define CAPFIT_CORE_PIPELINE_TO_CALLER_FRAME_H_

#include <span>
#include <vector>

#include "core/body/body.h"
#include "core/capsule/primitive_set.h"
#include "core/circle/approximate_polygon.h"
#include "core/pipeline/fit.h"
#include "core/section/feature_polygon.h"

namespace capfit::pipeline {

// Centres and radii in the caller's unit; origins and capsules as they are.
[[nodiscard]] capsule::PrimitiveSet ToCallerFrame(capsule::PrimitiveSet set,
                                                  const geometry::Similarity& caller_from_body);

// The landmarks that were found, in the order of LandmarkId.
[[nodiscard]] std::vector<LandmarkResult> LandmarkResults(
    const body::Body& body, const geometry::Similarity& caller_from_body);

// Each feature polygon with its circles (paper, Fig. 2).
[[nodiscard]] std::vector<PolygonResult> PolygonResults(
    std::span<const section::FeaturePolygon> polygons,
    std::span<const circle::PolygonApproximation> approximations,
    const geometry::Similarity& caller_from_body);

// Values of the vertices of body::Body::enclosed() in metres as FitResult::vertex_gaps: by the
// caller's vertices, in the caller's unit, NaN where nothing is left of a vertex.
[[nodiscard]] std::vector<float> VertexGaps(std::span<const std::int32_t> vertex_of_source,
                                            std::span<const double> gaps_m,
                                            const geometry::Similarity& caller_from_body);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_TO_CALLER_FRAME_H_
