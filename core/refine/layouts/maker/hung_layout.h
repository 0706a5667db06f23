// A layout as a search makes it, from graphs on several bodies.
#ifndef CAPFIT_CORE_REFINE_LAYOUTS_MAKER_HUNG_LAYOUT_H_
#define CAPFIT_CORE_REFINE_LAYOUTS_MAKER_HUNG_LAYOUT_H_

#include <span>
#include <vector>

#include "core/refine/layouts/layout.h"
#include "core/refine/layouts/maker/layout_subjects.h"

namespace capfit::refine {

struct HungLayout {
  std::vector<LayoutNode> nodes;
  std::vector<LayoutEdge> edges;

  [[nodiscard]] Layout view() const { return {nodes, edges}; }
};

// Each sphere on the bone that it is nearest to on all bodies, at its mean place, rounded as in
// the tables.
[[nodiscard]] HungLayout LayoutOf(std::span<const Subject> subjects, const Graphs& graphs);

// As it stands in the tables, to stdout.
void Print(const HungLayout& layout);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_LAYOUTS_MAKER_HUNG_LAYOUT_H_
