// The search for a best fit's topology that serves several bodies at once.
#ifndef CAPFIT_CORE_REFINE_LAYOUTS_MAKER_BEST_FIT_LAYOUT_SEARCH_H_
#define CAPFIT_CORE_REFINE_LAYOUTS_MAKER_BEST_FIT_LAYOUT_SEARCH_H_

#include <vector>

#include "core/refine/layouts/maker/layout_subjects.h"

namespace capfit::refine {

// Starts from joint to joint and changes the topology at random for the task's CPU time. The graphs
// stay in one piece.
[[nodiscard]] Graphs SearchBestFitLayout(const LayoutTask& task,
                                         const std::vector<Subject>& subjects);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_LAYOUTS_MAKER_BEST_FIT_LAYOUT_SEARCH_H_
