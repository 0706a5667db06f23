#include "core/mesh/main_part.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/status.h"
#include "core/mesh/surface_parts.h"
#include "core/mesh/surface_sums.h"

namespace capfit::mesh {
namespace {

// A second part of this share of the main part's volume is no accessory: it may be the body.
constexpr double kRivalShare = 0.5;
// A body has an inner wall or two; more large parts in each other are something else.
constexpr std::size_t kMostInnerWalls = 4;

Eigen::AlignedBox3d BoxOf(std::span<const Eigen::Vector3d> positions, const Surface& surface,
                          const SurfaceParts& found, std::uint32_t part) {
  Eigen::AlignedBox3d box;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (found.part_of_triangle[t] != part) continue;
    for (const std::uint32_t v : surface.triangles[t]) box.extend(positions[v]);
  }
  return box;
}

// A part of similar size is another body, unless it lies within the main part's box: then it is its
// inner wall.
absl::Status CheckRivals(std::span<const Eigen::Vector3d> positions, const Surface& surface,
                         const SurfaceParts& found, std::uint32_t main) {
  const double main_volume = std::abs(found.parts[main].volume);
  const Eigen::AlignedBox3d main_box = BoxOf(positions, surface, found, main);
  std::size_t rivals = 0;
  for (std::uint32_t p = 0; p < found.parts.size(); ++p) {
    const double share = std::abs(found.parts[p].volume) / main_volume;
    if (p == main || share < kRivalShare) continue;
    if (++rivals > kMostInnerWalls || !main_box.contains(BoxOf(positions, surface, found, p))) {
      return Refused(ErrorReason::kTwoBodies,
                     absl::StrFormat("two separate parts are of similar size (the second has "
                                     "%.0f %% of the first one's volume); send one body",
                                     100.0 * share));
    }
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status CheckEnclosedVolume(double volume, double least_volume, std::size_t parts) {
  if (std::abs(volume) > least_volume) return absl::OkStatus();
  return Refused(ErrorReason::kNoVolume,
                 absl::StrFormat("the surface encloses no volume; it has %d parts that share "
                                 "no edge: do neighbouring faces have the same vertices, or "
                                 "equal ones to within %g of the diagonal?",
                                 parts, kWeldShare));
}

absl::StatusOr<MainPart> KeepMainPart(std::span<const Eigen::Vector3d> positions,
                                      double least_volume, Surface& surface) {
  const SurfaceParts found = OrientParts(positions, surface);
  const auto is_smaller = [](const SurfacePart& a, const SurfacePart& b) {
    return std::abs(a.volume) < std::abs(b.volume);
  };
  const auto main = std::max_element(found.parts.begin(), found.parts.end(), is_smaller);
  const auto main_index = static_cast<std::uint32_t>(main - found.parts.begin());
  CAPFIT_RETURN_IF_ERROR(CheckEnclosedVolume(main->volume, least_volume, found.parts.size()));
  const bool is_alone = found.parts.size() == 1;
  if (!is_alone) CAPFIT_RETURN_IF_ERROR(CheckRivals(positions, surface, found, main_index));
  if (main->conflicts > 0) {
    return Refused(ErrorReason::kNotOrientable,
                   absl::StrCat("the surface has no inside: its faces cannot be turned the "
                                "same way round at ",
                                main->conflicts, " edges"));
  }
  MainPart kept{main->turned, found.parts.size() - 1,
                surface.triangles.size() - found.parts[main_index].triangles, 0.0};
  if (is_alone) return kept;
  const double all = AreaOf(positions, surface.triangles);
  KeepPart(found, main_index, surface);
  kept.left_out_share = 1.0 - AreaOf(positions, surface.triangles) / all;
  return kept;
}

}  // namespace capfit::mesh
