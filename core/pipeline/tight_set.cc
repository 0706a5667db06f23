#include "core/pipeline/tight_set.h"

#include <algorithm>

#include "core/coverage/gap_volume.h"
#include "core/pipeline/spend_rest.h"
#include "core/refine/refine.h"

namespace capfit::pipeline {
namespace {

constexpr int kRefinedPrimitives = 64;
constexpr double kGrowth = 1.4;

Spare SpareOf(const circle::Budget& budget, int primitives, const capsule::PrimitiveSet& set) {
  return {budget.max_spheres - static_cast<int>(set.spheres.size()),
          budget.max_capsules - static_cast<int>(set.capsules.size()),
          primitives - set.primitive_count()};
}

}  // namespace

coverage::CoverOptions CoverTight(const FitOptions& options) {
  coverage::CoverOptions cover;
  cover.tolerance_m = options.tolerance_m;
  cover.suspect_growth = 1.0;
  return cover;
}

capsule::PrimitiveSet TightSet(const body::Body& body, const FitOptions& options,
                               const circle::Budget& budget, const coverage::CoverTarget& target,
                               const ThreadPool& pool, const FitObserver& observer) {
  refine::RefineOptions refine_options;
  refine_options.enclose = options.fit == FitMode::kEnclose;
  refine_options.budget = budget;
  refine_options.tolerance_m = options.tolerance_m;
  refine_options.parts = options.parts;
  refine_options.seed = options.seed;
  if (!refine_options.enclose) return refine::RefineSet(body, refine_options, pool, observer);

  refine_options.budget.max_primitives = std::min(budget.max_primitives, kRefinedPrimitives);
  capsule::PrimitiveSet set = refine::RefineSet(body, refine_options, pool, observer);
  while (!observer.IsCancelled() && set.primitive_count() + 1 < budget.max_primitives) {
    static_cast<void>(coverage::CoverBody(target, CoverTight(options), pool, observer, set));
    const int before = set.primitive_count();
    const int next =
        std::min(budget.max_primitives, std::max(before + 4, static_cast<int>(before * kGrowth)));
    CutWherePromising(SpareOf(budget, next, set), coverage::GapVolumes(target, set, pool), set);
    if (set.primitive_count() == before) break;  // the spheres or capsules are used up
  }
  return set;
}

}  // namespace capfit::pipeline
