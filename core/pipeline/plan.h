// What a budget allows: how many feature polygons on each chain, and what is left for them.
#ifndef CAPFIT_CORE_PIPELINE_PLAN_H_
#define CAPFIT_CORE_PIPELINE_PLAN_H_

#include "absl/status/status.h"
#include "core/body/body.h"
#include "core/capsule/allocation.h"
#include "core/capsule/build_primitives.h"
#include "core/pipeline/fit.h"
#include "core/section/feature_polygon.h"

namespace capfit::pipeline {

// The caller's budget for the whole set; never more than 500 spheres and 1000 capsules. Spheres
// alone: twice as many capsules. An error threshold: the largest that could be asked for.
[[nodiscard]] capsule::Budget TotalBudget(const FitOptions& options);

// Balls that head, hands and feet will take, the more the larger the budget; and capsules that link
// limbs to the trunk, and balls to each other and to their chains (none where the budget has no
// room for them beside the smallest chains; of balls none either where spheres only grow).
struct Overhead {
  capsule::EndBalls end_balls;
  int balls = 0;  // of all ends together
  int limb_links = 0;
  int ball_links = 0;
};
[[nodiscard]] Overhead OverheadOf(const body::Body& body, const FitOptions& options,
                                  const capsule::Budget& total);

// INVALID_ARGUMENT naming the limit that is too low for the parts found: a chain takes two spheres
// and a capsule at least, a head, hand or foot one sphere. It is the caller's own limit in `asked`,
// or the engine's where that is what is too low; `limited`: WithEngineLimits(asked), or less.
[[nodiscard]] absl::Status CheckBudget(const body::Body& body, const FitOptions& asked,
                                       const FitOptions& limited);

// `total` without the overhead: what the feature polygons of the chains may use.
[[nodiscard]] capsule::Budget ChainBudget(const capsule::Budget& total, const Overhead& overhead);

// The feature polygons that the budget carries: the largest layout of a fixed ladder that has the
// room it asks for. About as many as the paper's twenty (6 on the torso, 3 on an arm, 4 on a leg)
// come with some 60 primitives; fewer below, more above.
[[nodiscard]] section::SectionOptions PlanSections(const FitOptions& options,
                                                   const body::Body& body,
                                                   const capsule::Budget& chain_budget);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_PLAN_H_
