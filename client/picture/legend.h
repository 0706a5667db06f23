// What the colours and lines on a page mean.
#ifndef CAPFIT_CLIENT_PICTURE_LEGEND_H_
#define CAPFIT_CLIENT_PICTURE_LEGEND_H_

#include <string>
#include <vector>

#include "client/picture/color.h"
#include "client/picture/page.h"

namespace capfit::client {

enum class LegendMark { kArea, kLine, kDashedLine };

struct LegendEntry {
  std::string words;  // "left arm"
  Color color = kInk;
  LegendMark mark = LegendMark::kArea;
};

// "left_arm" gives "left arm".
[[nodiscard]] std::string Spaced(std::string name);

// Writes the entries from left to right in as many lines as they need, each mark as a path with the
// entry's words for its name. `y`: upper edge. Gives the height of all lines.
double AddLegend(const std::vector<LegendEntry>& entries, double x, double y, double width,
                 double text_size, Page& page);

// The bar of SignedColor from -limit_mm (dark red, the primitives stand off) at the upper end to
// +limit_mm (blue, the body sticks out), with its words, within `box`.
void AddGapBar(double limit_mm, const Rect& box, double text_size, Page& page);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_LEGEND_H_
