// The search for an enclosing topology that serves several bodies at once.
#ifndef CAPFIT_CORE_REFINE_LAYOUTS_MAKER_ENCLOSING_LAYOUT_SEARCH_H_
#define CAPFIT_CORE_REFINE_LAYOUTS_MAKER_ENCLOSING_LAYOUT_SEARCH_H_

#include <vector>

#include "core/refine/layouts/maker/layout_subjects.h"

namespace capfit::refine {

// Starts from a stored layout, or from what quality tight finds for one of the bodies where
// that serves all of them better, and exchanges primitives at random for the task's CPU time: what
// is least missed goes most often, capsules are cut where they are loose, near spheres are tied. A
// change stays where the mean volume over the bodies falls, or, at first, hardly rises. A few
// minutes: what a longer one finds may suit these bodies ever better and others less. Says
// on stderr how it goes.
[[nodiscard]] Graphs SearchEnclosingLayout(const LayoutTask& task,
                                           const std::vector<Subject>& subjects);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_LAYOUTS_MAKER_ENCLOSING_LAYOUT_SEARCH_H_
