// The body's own axes, found from its shape alone.
#ifndef CAPFIT_CORE_BODY_INTRINSIC_FRAME_H_
#define CAPFIT_CORE_BODY_INTRINSIC_FRAME_H_

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/body/extremities.h"
#include "core/body/rig_ends.h"
#include "core/body/symmetry_plane.h"

namespace capfit::body {

// The axes in the coordinates of the points that they were found from.
struct IntrinsicFrame {
  Eigen::Vector3d left = Eigen::Vector3d::UnitX();  // normal of the symmetry plane
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  Eigen::Vector3d forward = Eigen::Vector3d::UnitZ();
  double plane_offset = 0.0;       // the symmetry plane: left . p = plane_offset
  double facing_trust = 0.0;       // [0, 1]; how clear front and back are
  bool first_hand_is_left = true;  // kHandA of the extremities
  bool first_foot_is_left = true;  // kFootA
};

// Symmetry plane: least squares over what mirrors what (rings of left and right limbs, rings of
// trunk and head onto themselves), with limbs in different poses weighed down. Up: in that plane,
// so that the body would stand at rest on its soles, where that is near to the trunk's own
// direction; else the trunk's direction. Forward: where the toes point, and the knees bend to.
// Exact for bodies that are symmetric; the same for any turned, moved or scaled copy. `up` given:
// taken as it is. A skeleton's axes take the place of those found that are more than 20 degrees
// off, as a backpack or a stride may make them. Needs three limbs or more.
// The soles are those of the `copy`, all else is told by the nodes. Rings of nodes that stand for
// several vertices tell the plane to some thousandths and millimetres only: the `mirror` sharpens
// it, where there is one.
[[nodiscard]] IntrinsicFrame FindIntrinsicFrame(
    const WorkingCopy& copy, const CoarseSurface& coarse, const MirrorSurface* mirror,
    const Extremities& extremities, const ThreadPool& pool,
    const std::optional<Eigen::Vector3d>& up, const std::optional<RigEnds>& rig = std::nullopt);

// Front and back, left and right exchanged.
[[nodiscard]] IntrinsicFrame TurnedAbout(const IntrinsicFrame& frame);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_INTRINSIC_FRAME_H_
