#include "core/motion/cover_motion.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "core/base/work_meter.h"
#include "core/geometry/tapered_capsule.h"
#include "core/motion/local_turns.h"
#include "core/tighten/point_grid.h"
#include "core/tighten/set_variables.h"
#include "core/tighten/tighten.h"
#include "core/tighten/union_volume.h"

namespace capfit::motion {
namespace {

using geometry::TaperedCapsule;
using Vec3 = Eigen::Vector3d;

constexpr double kOutM = 1e-4;  // what counts as outside in the report; less is grown away
constexpr double kVolumeSpacing = 0.0075;  // of samples, relative to the body's size
constexpr double kTightenUntil = 0.7;      // share of the time

// Rounds of these steps; after each the centres are bound anew and the next goes half as far.
constexpr int kRounds = 4;
constexpr double kCalmer = 0.5;
// Radii that hold in all frames: a row for each cell of row_spacing, solid and frame; every point
// must come in.
constexpr tighten::TightenPhase kAllFramesPhase{.steps = 5,
                                                .first_trust = 0.008,
                                                .last_trust = 0.003,
                                                .first_penalty = 0.4,
                                                .last_penalty = 0.4,
                                                .row_spacing = 0.015};
// Radii of each frame's own: what sticks out of one costs about what growing there will, which is
// the share of the area that it stands for. (Four times as much did best; 3 and 6 came within a
// thousandth of the volume.)
constexpr tighten::TightenPhase kOwnRadiiPhase{.steps = 3,
                                               .first_trust = 0.008,
                                               .last_trust = 0.003,
                                               .first_penalty = 4.0,
                                               .last_penalty = 4.0};
// Radii alone: a convex task but for which solid is the nearest.
constexpr tighten::TightenPhase kRadiiPhase{.steps = 6,
                                            .first_trust = 0.006,
                                            .last_trust = 0.0005,
                                            .first_penalty = 0.4,
                                            .last_penalty = 0.4,
                                            .fixed_centers = true};

// What a frame's set is: images are images at rest only.
capsule::PrimitiveSet Posed(const capsule::PrimitiveSet& set, std::span<const Vec3> centers) {
  capsule::PrimitiveSet posed = set;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    posed.spheres[i].center_m = centers[i];
    posed.origins[i].mirror = -1;
  }
  return posed;
}

class MotionCoverer {
 public:
  MotionCoverer(const tighten::CoverTarget& target, const MotionFrames& frames, const Carry& carry,
                const MotionOptions& options, const ThreadPool& pool, FitObserver& observer,
                capsule::PrimitiveSet& set)
      : target_(target),
        frames_(frames),
        carry_(carry),
        options_(options),
        pool_(pool),
        meter_(observer),
        set_(set),
        size_(tighten::SizeOf(target)),
        allowed_(coverage::AllowedAtVertices(options.cover.tolerance_m)) {
    grids_.reserve(frames.size());
    for (const std::vector<Vec3>& points : frames) grids_.emplace_back(points);
  }

  MotionReport Run() {
    report_.frame_count = static_cast<int>(grids_.size());
    centers_ = carry_(set_);
    report_.max_out_before_m = FurthestOut(&report_.most_points_out_before);
    const double before = VolumeOf(set_);
    if (report_.max_out_before_m > options_.cover.tolerance_m + kOutM) {
      TightenInAllFrames();
      CoverRest();
    }
    centers_ = carry_(set_);
    if (options_.radii == MotionRadii::kConstant) GrowForAllFrames();
    if (options_.radii == MotionRadii::kPerFrame) FitRadiiToFrames();
    report_.max_out_m = FurthestOut(nullptr);
    report_.volume_ratio = VolumeOf(set_) / before;
    report_.mean_volume_ratio = MeanVolume() / before;
    return std::move(report_);
  }

 private:
  double VolumeOf(capsule::PrimitiveSet set) const {
    const tighten::SetVariables variables(set);
    return tighten::UnionVolumeGradient(set, variables, kVolumeSpacing * size_, /*seed=*/7, pool_)
        .volume_m3;
  }

  double MeanVolume() const {
    double sum = 0.0;
    for (std::size_t f = 0; f < grids_.size(); ++f) sum += VolumeOf(InFrame(f));
    return sum / static_cast<double>(grids_.size());
  }

  capsule::PrimitiveSet InFrame(std::size_t frame) const {
    capsule::PrimitiveSet posed = Posed(set_, centers_[frame]);
    if (frame >= report_.radii_m.size()) return posed;
    for (std::size_t i = 0; i < posed.spheres.size(); ++i) {
      posed.spheres[i].radius_m = report_.radii_m[frame][i];
    }
    return posed;
  }

  // Over all frames; and the most points that are outside in one.
  double FurthestOut(int* most_out) const {
    double furthest = -std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < grids_.size() && !meter_.IsCancelled(); ++f) {
      const tighten::UnionDistances at =
          grids_[f].DistancesTo(capsule::Solids(InFrame(f)), -1.0, pool_);
      int count = 0;
      for (const double distance : at.distance_m) {
        furthest = std::max(furthest, distance);
        count += distance > kOutM ? 1 : 0;
      }
      if (most_out != nullptr) *most_out = std::max(*most_out, count);
    }
    return furthest;
  }

  void TightenInAllFrames() {
    const bool is_own = options_.radii == MotionRadii::kPerFrame;
    const std::vector<double> weights =
        is_own ? tighten::WeightsByArea(target_).of_point_m2 : std::vector<double>();
    const tighten::PointGrid rest(target_.points_m);
    tighten::TightenPhase phase = is_own ? kOwnRadiiPhase : kAllFramesPhase;
    for (int round = 0; round < kRounds && !meter_.IsCancelled(); ++round) {
      const std::vector<tighten::CarriedPose> poses = Poses();
      std::vector<tighten::PointsToHold> points = {{rest, allowed_, weights}};
      for (std::size_t f = 0; f < grids_.size(); ++f) {
        points.push_back({grids_[f], allowed_, weights, &poses[f]});
      }
      meter_.Expect(kTightenUntil * (round + 1) / kRounds,
                    std::int64_t{phase.steps} * set_.primitive_count());
      tighten::Tighten(points, size_, phase, 1 + 100 * static_cast<std::uint64_t>(round), pool_,
                       meter_, set_);
      phase.first_trust *= kCalmer;
      phase.last_trust *= kCalmer;
      centers_ = carry_(set_);
    }
  }

  // With all that CoverBody promises of what lies between vertices.
  void CoverRest() {
    if (options_.radii == MotionRadii::kPerFrame) {
      const tighten::PointGrid rest(target_.points_m);
      const std::vector<tighten::PointsToHold> points = {{rest, allowed_}};
      tighten::Tighten(points, size_, kRadiiPhase, /*seed=*/1001, pool_, meter_, set_);
    }
    options_.cover.tighten = false;
    options_.cover.keeps_swallowed = true;
    (void)coverage::CoverBody(target_, options_.cover, pool_, meter_.observer(), set_);
  }

  std::vector<tighten::CarriedPose> Poses() const {
    std::vector<Vec3> rest;
    for (const geometry::Sphere& sphere : set_.spheres) rest.push_back(sphere.center_m);
    const LocalTurns turns(target_.points_m, set_, pool_);
    std::vector<tighten::CarriedPose> poses(frames_.size());
    pool_.ForEach(frames_.size(), [&](std::size_t f) {
      poses[f] = {rest, centers_[f], turns.At(frames_[f])};
    });
    return poses;
  }

  // Radii of the set, and those of images with them, until no frame has anything outside.
  void GrowForAllFrames() {
    for (std::size_t f = 0; f < grids_.size() && !meter_.IsCancelled(); ++f) {
      for (bool has_grown = true; has_grown;) {
        capsule::PrimitiveSet posed = Posed(set_, centers_[f]);
        has_grown = GrowIn(f, posed);
        for (std::size_t i = 0; i < set_.spheres.size(); ++i) Raise(i, posed.spheres[i].radius_m);
      }
    }
  }

  void Raise(std::size_t sphere, double radius_m) {
    if (!(radius_m > set_.spheres[sphere].radius_m)) return;
    set_.spheres[sphere].radius_m = radius_m;
    const int image = set_.origins[sphere].mirror;
    if (image >= 0) set_.spheres[image].radius_m = radius_m;
  }

  void FitRadiiToFrames() {
    std::vector<std::vector<double>> radii(grids_.size());
    for (std::size_t f = 0; f < grids_.size() && !meter_.IsCancelled(); ++f) {
      capsule::PrimitiveSet posed = Posed(set_, centers_[f]);
      const std::vector<tighten::PointsToHold> points = {{grids_[f], allowed_}};
      tighten::Tighten(points, size_, kRadiiPhase, /*seed=*/1001, pool_, meter_, posed);
      while (GrowIn(f, posed)) {
      }
      for (const geometry::Sphere& sphere : posed.spheres) radii[f].push_back(sphere.radius_m);
    }
    report_.radii_m = std::move(radii);
  }

  // Whether anything grew. One pass of points, each against the solid that was nearest. Not
  // coverage::GrowTo: it moves centres, and here they stay where they are carried to.
  bool GrowIn(std::size_t frame, capsule::PrimitiveSet& posed) const {
    const std::vector<capsule::CapsuleEnds> solids = capsule::SolidEnds(posed);
    const std::vector<TaperedCapsule> shapes = capsule::Solids(posed);
    const tighten::UnionDistances at = grids_[frame].DistancesTo(shapes, -1.0, pool_);
    bool has_grown = false;
    for (std::size_t i = 0; i < grids_[frame].size(); ++i) {
      if (at.distance_m[i] <= allowed_) continue;
      has_grown = GrowTo(grids_[frame].point(i), solids[at.solid[i]], posed) || has_grown;
    }
    return has_grown;
  }

  bool GrowTo(const Vec3& point, const capsule::CapsuleEnds& solid,
              capsule::PrimitiveSet& posed) const {
    geometry::Sphere& a = posed.spheres[solid[0]];
    geometry::Sphere& b = posed.spheres[solid[1]];
    const geometry::CapsuleDistance at = TaperedCapsule(a, b).Locate(point);
    const double missing = at.distance_m - allowed_;
    if (!(missing > 1e-12)) return false;
    // The least growth of both that makes the ball between them grow by what is missing.
    const double t = &a == &b ? 0.0 : at.axis_parameter;
    const double share = missing / (t * t + (1.0 - t) * (1.0 - t));
    if (t < 1.0) a.radius_m += (1.0 - t) * share + 1e-12;
    if (t > 0.0) b.radius_m += t * share + 1e-12;
    return true;
  }

  const tighten::CoverTarget& target_;
  const MotionFrames& frames_;
  const Carry& carry_;
  MotionOptions options_;
  const ThreadPool& pool_;
  WorkMeter meter_;
  capsule::PrimitiveSet& set_;
  double size_;
  double allowed_;
  std::vector<tighten::PointGrid> grids_;   // of each frame's points
  std::vector<std::vector<Vec3>> centers_;  // in each frame
  MotionReport report_;
};

}  // namespace

MotionReport CoverMotion(const tighten::CoverTarget& target, const MotionFrames& frames,
                         const Carry& carry, const MotionOptions& options, const ThreadPool& pool,
                         FitObserver& observer, capsule::PrimitiveSet& set) {
  if (frames.empty() || set.spheres.empty()) return {};
  return MotionCoverer(target, frames, carry, options, pool, observer, set).Run();
}

}  // namespace capfit::motion
