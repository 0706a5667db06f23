// Quality tight: the refined set, and beyond the size up to which refining from scratch pays, its
// looser capsules cut and all of it settled again.
#ifndef CAPFIT_CORE_PIPELINE_TIGHT_SET_H_
#define CAPFIT_CORE_PIPELINE_TIGHT_SET_H_

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/body/body.h"
#include "core/capsule/primitive_set.h"
#include "core/circle/allocation.h"
#include "core/coverage/cover_vertices.h"
#include "core/pipeline/fit.h"

namespace capfit::pipeline {

// How a set that is nearly there already is covered: tightened once more, and kept as it was where
// that does not make it smaller.
[[nodiscard]] coverage::CoverOptions CoverTight(const FitOptions& options);

// The set for `budget`. A best fit is all the refine room's. An enclosing one is refined with up to
// 64 primitives, which settles the topology; from there on the capsules with most volume between
// them and the body are cut in two, two fifths more of them each time, and coverage moves the new
// spheres to where they serve: half the time of growing in the refine room, and tighter.
// `target` is what has to be inside; what was cut last is not settled yet, so the caller covers the
// set once more, with CoverTight. About 0.25 s for 64 primitives, 0.5 s for 128, 1 s for 250.
[[nodiscard]] capsule::PrimitiveSet TightSet(const body::Body& body, const FitOptions& options,
                                             const circle::Budget& budget,
                                             const coverage::CoverTarget& target,
                                             const ThreadPool& pool, const FitObserver& observer);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_TIGHT_SET_H_
