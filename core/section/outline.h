// From the loops of a section to the outline of one body part.
#ifndef CAPFIT_CORE_SECTION_OUTLINE_H_
#define CAPFIT_CORE_SECTION_OUTLINE_H_

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/section/plane_section.h"

namespace capfit::section {

// Area inside a closed curve, negative where it runs clockwise.
[[nodiscard]] double SignedArea(std::span<const Eigen::Vector2d> points);

// Whether a point of the section belongs to the wanted part, told by the mesh vertex nearest to it.
using BelongsTo = std::function<bool(std::uint32_t vertex)>;

// The outline of the part: of all loops the one nearest to the frame's origin (the medial point),
// among those that the part has a fair share in. Stretches of other parts are left out and the ends
// joined by a straight line: a chest without the arms is closed at the armholes. Nothing where the
// plane misses the part.
[[nodiscard]] std::optional<std::vector<Eigen::Vector2d>> PartOutline(
    const std::vector<SectionLoop>& loops, const BelongsTo& belongs);

// `count` points at equal steps along the closed curve, from its first point on.
[[nodiscard]] std::vector<Eigen::Vector2d> Resample(std::span<const Eigen::Vector2d> points,
                                                    int count);

// The mean of the curve and its mirror image in x = 0, resampled to `count` points (made even):
// symmetric to the bit, with a point on the axis at either end. Counter-clockwise like the curve.
// Nothing where the curve does not cross the axis.
[[nodiscard]] std::optional<std::vector<Eigen::Vector2d>> Symmetrised(
    std::span<const Eigen::Vector2d> points, int count);

}  // namespace capfit::section

#endif  // CAPFIT_CORE_SECTION_OUTLINE_H_
