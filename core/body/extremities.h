// Which tips of the surface are the head, the hands and the feet.
#ifndef CAPFIT_CORE_BODY_EXTREMITIES_H_
#define CAPFIT_CORE_BODY_EXTREMITIES_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/enum_index.h"
#include "core/base/fit_observer.h"
#include "core/body/branches.h"
#include "core/body/coarse_surface.h"
#include "core/body/rig_ends.h"
#include "core/body/surface_graph.h"

namespace capfit::body {

// The two hands and the two feet are told apart into left and right only later.
enum class Tip : std::uint8_t { kHead, kHandA, kHandB, kFootA, kFootB };
inline constexpr int kTipCount = 5;

// A head, arm or leg: what the surface runs out into beyond the level where it joins the rest.
struct Limb {
  std::uint32_t tip = 0;
  double junction = 0.0;                // distance at which it joins another limb
  double tip_distance = 0.0;            // distance of the tip
  std::vector<std::uint32_t> vertices;  // those farther than the junction
  std::optional<bool> is_left;          // where a skeleton tells
};

struct Extremities {
  std::vector<double> distance;  // from the middle of the body, for every vertex
  std::array<std::optional<Limb>, kTipCount> limbs;
  bool legs_are_cut = false;  // both of them, anywhere above the ankles
  double misfit = 0.0;        // how far the proportions are from a body's; 0.1 is usual

  [[nodiscard]] const std::optional<Limb>& limb(Tip tip) const { return limbs[Index(tip)]; }
  [[nodiscard]] int found() const;
  // Whether there is a leg, and not both of them are cut off.
  [[nodiscard]] bool has_whole_leg() const;
};

// `surface` in a frame where its area is 1 and the body's centroid lies at the origin.
// Lengths along the surface do not change when limbs bend, so neither does the answer: tips are
// the maxima of the geodesic distance from the middle, and their roles follow from the lengths of
// the ways between them (the head is near the hands, the feet are far from all) and from how thick
// the limbs are. Where a skeleton tells which vertices belong to head, hands and feet, a tip that
// does not hold the one of its role counts as a bad fit, and one that holds none (of a hat, a
// sword, a tail) may go without a role. Where that fits badly, it is tried whether limbs are cut
// off, or all below the trunk (tip_roles.h). O(n log n). What comes back once the observer cancels
// means nothing.
[[nodiscard]] Extremities FindExtremities(const CoarseSurface& surface, const SurfaceGraph& graph,
                                          const ThreadPool& pool, const FitObserver& observer,
                                          const std::optional<RigEnds>& rig = std::nullopt);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_EXTREMITIES_H_
