// A set that encloses the body in every pose of a motion, not only in the one that was fitted.
#ifndef CAPFIT_CORE_MOTION_COVER_MOTION_H_
#define CAPFIT_CORE_MOTION_COVER_MOTION_H_

#include <Eigen/Core>
#include <functional>
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

// Radii that hold in all frames, or some of each frame's own on top of those of rest.
enum class MotionRadii { kConstant, kPerFrame };

struct MotionOptions {
  // tolerance_m and max_gap_m count.
  coverage::CoverOptions cover;
  MotionRadii radii = MotionRadii::kConstant;
};

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
  // The same of the union in a frame, the mean over all of them, over that at rest before.
  double mean_volume_ratio = 1.0;
  // With kPerFrame: by frame, then by sphere, metres.
  std::vector<std::vector<double>> radii_m;
};

// Changes centres and radii until all points of all frames are inside; spheres, capsules and mirror
// images stay what they are. The steps are those of tighten::Tighten, with rows for the points of
// all frames: a centre's step at rest is turned into each frame as the body around it has turned.
// Rounds of them, for the weights follow the centres. What then is still outside is met by growing
// radii alone, which no frame can lose by.
//
// kConstant: the radii of the set hold in every frame. kPerFrame: centres and the set's radii are
// for rest, and each frame has radii of its own, the least that enclose it.
//
// The set must be one of tangent hulls that encloses the target already. Cancelled: frames not
// reached may stick out. O(steps * frames * points): about 5 s for 72 frames of 5k points and 64
// primitives.
[[nodiscard]] MotionReport CoverMotion(const tighten::CoverTarget& target,
                                       const MotionFrames& frames, const Carry& carry,
                                       const MotionOptions& options, const ThreadPool& pool,
                                       FitObserver& observer, capsule::PrimitiveSet& set);

}  // namespace capfit::motion

#endif  // CAPFIT_CORE_MOTION_COVER_MOTION_H_
