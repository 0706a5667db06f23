// A set that encloses the body in every pose of a motion, not only in the one that was fitted.
#ifndef CAPFIT_CORE_MOTION_COVER_MOTION_H_
#define CAPFIT_CORE_MOTION_COVER_MOTION_H_

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/capsule/primitive_set.h"
#include "core/coverage/cover_body.h"
#include "core/tighten/cover_target.h"

namespace capfit::motion {

// The target's points in each frame, in the target's order and frame, metres.
using MotionFrames = std::vector<std::vector<Eigen::Vector3d>>;

// Where each frame carries the centres of a set whose spheres lie at rest where they do.
using Carry =
    std::function<std::vector<std::vector<Eigen::Vector3d>>(const capsule::PrimitiveSet& at_rest)>;

struct MotionReport {
  int frame_count = 0;
  // Of the set as it came, in the frame where it is worst: points more than 0.1 mm outside, and how
  // far the furthest of all frames is.
  int most_points_out_before = 0;
  double max_out_before_m = 0.0;
  // The furthest point of all frames now; below 0: all are inside.
  double max_out_m = 0.0;
  // The volume of the set's union at rest, now over before. Range: [1, inf) or a little below.
  double volume_ratio = 1.0;
};

// Changes centres and radii until all points of all frames are inside, with radii that hold in
// every frame; spheres, capsules and mirror images stay what they are. What sticks out of a frame
// is laid back onto the body at rest, as far from its capsule and as far along it as it was, and
// the set is tightened anew around body and such points (CoverBody); three rounds, for each moves
// the centres. What then is still outside is met by growing radii alone, which no frame can lose
// by.
//
// Of `options` tolerance_m and max_gap_m count; the set must be one of tangent hulls that encloses
// the target already. Cancelled: frames not reached may stick out. O(rounds * (CoverBody + frames *
// points)): about 0.5 s for 72 frames of 5k points and 64 primitives.
[[nodiscard]] MotionReport CoverMotion(const tighten::CoverTarget& target,
                                       const MotionFrames& frames, const Carry& carry,
                                       const coverage::CoverOptions& options,
                                       const ThreadPool& pool, FitObserver& observer,
                                       capsule::PrimitiveSet& set);

}  // namespace capfit::motion

#endif  // CAPFIT_CORE_MOTION_COVER_MOTION_H_
