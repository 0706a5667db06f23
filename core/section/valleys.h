// Splitting the outlines of hip and bust at their valleys (paper, III-E).
#ifndef CAPFIT_CORE_SECTION_VALLEYS_H_
#define CAPFIT_CORE_SECTION_VALLEYS_H_

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "core/section/feature_polygon.h"

namespace capfit::section {

// The valleys of figures 6 and 7: indices of outline vertices.
struct Valleys {
  int middle = 0;               // B: between the buttocks, or between the breasts
  std::array<int, 2> side{};    // A and C: where they end, counter-clockwise before and after B
  std::array<int, 2> apex{};    // the furthest out between A and B, and between B and C
  double middle_depth_m = 0.0;  // how far B lies behind the line over both bulges
  double bulge_height_m = 0.0;  // how far the bulges stand out beyond B, the lower of the two
  double width_m = 0.0;         // extent of the outline across
};

// Looks for the valleys on the side of the outline that `outward` (length 1, in the outline's
// plane) points to: B is the deepest one within 25 degrees of `outward` as seen from the centroid,
// A and C the deepest 35 to 110 degrees from it on either side, or the widest places where there is
// none. Depth is measured against the ellipse with the outline's extents, smoothed over 4 degrees.
// Nothing where no valley lies near the middle. On an outline that is symmetric to the bit the
// valleys are, too.
[[nodiscard]] std::optional<Valleys> FindValleys(std::span<const Eigen::Vector2d> outline,
                                                 const Eigen::Vector2d& outward);

// The three pieces A to B, B to C and the rest; neighbours share their border vertex.
[[nodiscard]] PolygonSplit SplitAtValleys(std::size_t vertex_count, const Valleys& valleys);

}  // namespace capfit::section

#endif  // CAPFIT_CORE_SECTION_VALLEYS_H_
