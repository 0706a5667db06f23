// Beyond the paper: the tightest set for a number of primitives.
#ifndef CAPFIT_CORE_REFINE_REFINE_H_
#define CAPFIT_CORE_REFINE_REFINE_H_

#include "absl/status/statusor.h"
#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/body/body.h"
#include "core/capsule/primitive_set.h"
#include "core/refine/layouts/kept_layout.h"
#include "core/refine/refine_options.h"
#include "core/tighten/cover_target.h"

namespace capfit::refine {

// Finds centres, radii and topology together: hangs layouts on the body's bones, optimises them,
// spares or grows primitives where that pays most, up to the budget, and then gives up some and
// spends them anew, again and again. A body whose is_symmetric holds gets an exactly symmetric set;
// others are not forced. Any parts may be missing. A best fit prefers capsules that hang together
// to lone spheres (one piece is worth nearly half a primitive) and leaves out no limb; beside the
// best of unconnected spheres that costs about a twentieth of E_r.
//
// `target`: tighten::TargetOf(body, options.parts). Same input, same bits, for any pool. On
// cancellation the set so far comes back. Tells the observer the fraction of the stage. Grows with
// budget and vertices.
[[nodiscard]] capsule::PrimitiveSet RefineSet(const body::Body& body,
                                              const tighten::CoverTarget& target,
                                              const RefineOptions& options, const ThreadPool& pool,
                                              FitObserver& observer);

// A best fit from a set that is there, as the published method builds it: centres and radii move to
// the smallest E_r, and what fills least is given up to cut capsules in two where the error is, up
// to the budget. Spheres that stay keep their origins. Nothing comes of an empty set. Same bits for
// any pool; on cancellation the set so far. About 50 ms at 64 primitives, 1 s at 350.
[[nodiscard]] capsule::PrimitiveSet SettleSet(const body::Body& body, const RefineOptions& options,
                                              const ThreadPool& pool, FitObserver& observer,
                                              capsule::PrimitiveSet set);

// The tightest set of a given layout: its spheres and capsules by the same numbers, moved and sized
// for this body. Of the options the budget does not count. Errors as HangLayout's. The layout must
// pass CheckLayout. A tenth to a third of the time of RefineSet.
[[nodiscard]] absl::StatusOr<capsule::PrimitiveSet> FitToLayout(
    const body::Body& body, const tighten::CoverTarget& target, const KeptLayout& layout,
    const RefineOptions& options, const ThreadPool& pool, FitObserver& observer);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_REFINE_H_
