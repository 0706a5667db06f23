// Which steps a fit takes and with which options, from what its caller asked for.
#ifndef CAPFIT_CORE_PIPELINE_FIT_STEPS_H_
#define CAPFIT_CORE_PIPELINE_FIT_STEPS_H_

#include "core/body/body.h"
#include "core/capsule/budget.h"
#include "core/coverage/cover_body.h"
#include "core/pipeline/fit.h"
#include "core/refine/refine_options.h"

namespace capfit::pipeline {

// Of all functions: `options` with the engine's limits.

// Centres, radii and topology are found together, without polygons.
[[nodiscard]] bool IsSearched(const FitOptions& options);

// A searched fit needs polygons only to show them, or to count what an error threshold asks for.
[[nodiscard]] bool NeedsPolygons(const FitOptions& options);

// With few primitives, or without a part that the layouts are made for, the published method is at
// times the better one, and it is quick: then the smaller of the two sets is taken.
[[nodiscard]] bool ComparesWithPaper(const FitOptions& options);

// Whether drafts of the circles will do: tightening leads on from them to as small a set as from
// the best circles (over 25 meshes and 17 budgets from 128 to 1000 E_r is .6 % less on average).
[[nodiscard]] bool DraftsServe(const FitOptions& options);

// Searched sets have their shape before they are covered, and kept layouts.
[[nodiscard]] bool HasShape(const FitOptions& options);

// The set is not changed after covering, which tells how far all vertices are from it.
[[nodiscard]] bool CoversLast(const FitOptions& options, const body::Body& body);

// `will_move`: the body has a rig or a motion.
[[nodiscard]] refine::RefineOptions RefineOptionsFor(const FitOptions& options,
                                                     const capsule::Budget& budget, bool will_move);

// `has_shape`: of the set to cover, which may be another than the searched one.
[[nodiscard]] coverage::CoverOptions CoverOptionsFor(const FitOptions& options, bool has_shape);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_FIT_STEPS_H_
