// How many circles each feature polygon gets: by an error threshold, or under a total budget.
#ifndef CAPFIT_CORE_CAPSULE_ALLOCATION_H_
#define CAPFIT_CORE_CAPSULE_ALLOCATION_H_

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "core/capsule/budget.h"
#include "core/circle/error_curve.h"
#include "core/section/feature_polygon.h"

namespace capfit::capsule {

// Spheres and cones that the counts give before pruning: sum of c_i, and sum of c_i * c_(i+1) over
// neighbours on a chain.
[[nodiscard]] PrimitiveCount CountPrimitives(std::span<const section::FeaturePolygon> polygons,
                                             std::span<const int> circle_counts);

// Counts within the budget that waste least volume: greedy by area saved, weighted by the length of
// chain that a polygon stands for, per primitive spent. Mirrored polygons rise together. Starts at
// one circle each; the result may exceed the budget only if one circle each already does.
[[nodiscard]] std::vector<int> AllocateUnderBudget(
    std::span<const section::FeaturePolygon> polygons, const Budget& budget, int max_circles,
    const circle::ErrorOf& error_m2);

// The fewest circles per polygon whose relative error (outside area / polygon area) is at most
// `threshold`, up to max_circles.
[[nodiscard]] std::vector<int> AllocateByThreshold(
    std::span<const section::FeaturePolygon> polygons, double threshold, int max_circles,
    const circle::ErrorOf& error_m2);

}  // namespace capfit::capsule

#endif  // CAPFIT_CORE_CAPSULE_ALLOCATION_H_
