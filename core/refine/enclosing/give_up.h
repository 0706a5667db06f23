// Giving up many primitives of an enclosing graph at once, what is least missed.
#ifndef CAPFIT_CORE_REFINE_ENCLOSING_GIVE_UP_H_
#define CAPFIT_CORE_REFINE_ENCLOSING_GIVE_UP_H_

#include "core/capsule/budget.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/enclosing/enclosing_task.h"

namespace capfit::refine {

// Until no more than `left` is beyond the budget; of spheres alone where there are only too many of
// them. Half of what is too much goes by what each was missed at first, the rest after another
// look. False where nothing may go any more.
bool GiveUpExcess(const EnclosingTask& task, const capsule::Budget& budget, int left,
                  capsule::MirroredSet& graph);

// The same until there are no more than so many primitives.
bool GiveUpTo(const EnclosingTask& task, int primitives, capsule::MirroredSet& graph);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_ENCLOSING_GIVE_UP_H_
