#include "core/motion/cover_motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "core/geometry/tapered_capsule.h"
#include "core/tighten/point_grid.h"
#include "core/tighten/set_variables.h"
#include "core/tighten/union_volume.h"

namespace capfit::motion {
namespace {

using geometry::TaperedCapsule;
using Vec3 = Eigen::Vector3d;

constexpr int kRounds = 3;
constexpr double kDepthM = 1e-6;  // as deep as CoverBody leaves vertices
constexpr double kOutM = 1e-4;    // what counts as outside in the report
constexpr double kVolumeSpacingM = 0.01;

std::size_t U(int i) { return static_cast<std::size_t>(i); }

class MotionCoverer {
 public:
  MotionCoverer(const tighten::CoverTarget& target, const MotionFrames& frames, const Carry& carry,
                const coverage::CoverOptions& options, const ThreadPool& pool,
                FitObserver& observer, capsule::PrimitiveSet& set)
      : target_(target),
        carry_(carry),
        options_(options),
        pool_(pool),
        observer_(observer),
        set_(set),
        allowed_(options.tolerance_m > kDepthM ? options.tolerance_m - kDepthM : -kDepthM) {
    options_.tighten = true;
    options_.loosen = false;
    options_.keeps_swallowed = true;
    grids_.reserve(frames.size());
    for (const std::vector<Vec3>& points : frames) grids_.emplace_back(points);
  }

  MotionReport Run() {
    MotionReport report;
    report.frame_count = static_cast<int>(grids_.size());
    const double volume = Volume();
    FindStickingOut(&report);
    tighten::CoverTarget extended = target_;
    for (int round = 0; round < kRounds && !observer_.IsCancelled(); ++round) {
      const std::vector<Vec3> laid_back = LayBack();
      if (laid_back.empty()) break;
      extended.points_m.insert(extended.points_m.end(), laid_back.begin(), laid_back.end());
      extended.point_parts.resize(extended.points_m.size(), body::Part::kTorso);
      (void)coverage::CoverBody(extended, options_, pool_, observer_, set_);
      FindStickingOut(nullptr);
    }
    GrowRadii();
    MotionReport after;
    FindStickingOut(&after);
    report.max_out_m = after.max_out_before_m;
    report.volume_ratio = Volume() / volume;
    return report;
  }

 private:
  // A point of a frame that sticks out, as far as any frame shows it.
  struct OutPoint {
    double missing_m = 0.0;
    int solid = -1;
    double along = 0.0;      // of the axis, from its first end, in its lengths; may be beyond
    double from_axis = 0.0;  // metres
  };

  double Volume() {
    capsule::PrimitiveSet copy = set_;
    const tighten::SetVariables variables(copy);
    return tighten::UnionVolumeGradient(copy, variables, kVolumeSpacingM, /*seed=*/7, pool_)
        .volume_m3;
  }

  // The set's solids in a frame. (Images are images at rest only, so only ends count here.)
  std::vector<TaperedCapsule> ShapesIn(const std::vector<Vec3>& centers) const {
    capsule::PrimitiveSet posed = set_;
    for (std::size_t i = 0; i < centers.size(); ++i) posed.spheres[i].center_m = centers[i];
    return tighten::ShapesOf(solids_, posed);
  }

  // Carries the set through all frames and keeps of each point the frame where it is furthest out.
  void FindStickingOut(MotionReport* report) {
    solids_ = [this] {
      capsule::PrimitiveSet copy = set_;
      return tighten::SetVariables(copy).solids();
    }();
    centers_ = carry_(set_);
    out_.assign(target_.points_m.size(), {});
    double furthest = -std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < grids_.size() && !observer_.IsCancelled(); ++f) {
      const std::vector<TaperedCapsule> shapes = ShapesIn(centers_[f]);
      const tighten::UnionDistances at = grids_[f].DistancesTo(shapes, -1.0, pool_);
      int count = 0;
      for (std::size_t i = 0; i < grids_[f].size(); ++i) {
        furthest = std::max(furthest, at.distance_m[i]);
        count += at.distance_m[i] > kOutM ? 1 : 0;
        if (at.distance_m[i] > allowed_) Note(f, i, at.solid[i], shapes);
      }
      if (report != nullptr) {
        report->most_points_out_before = std::max(report->most_points_out_before, count);
      }
    }
    if (report != nullptr) report->max_out_before_m = furthest;
  }

  void Note(std::size_t frame, std::size_t i, std::int32_t solid,
            const std::vector<TaperedCapsule>& shapes) {
    const TaperedCapsule& shape = shapes[static_cast<std::size_t>(solid)];
    const Vec3& point = grids_[frame].point(i);
    const double missing = shape.SignedDistance(point) - allowed_;
    OutPoint& out = out_[grids_[frame].order()[i]];
    if (missing <= out.missing_m) return;
    const Vec3 axis = shape.b().center_m - shape.a().center_m;
    const double length = axis.norm();
    const double along = length > 0.0 ? (point - shape.a().center_m).dot(axis) / length : 0.0;
    out = {missing, solid, length > 0.0 ? along / length : 0.0,
           (point - shape.a().center_m - along / std::max(length, 1e-12) * axis).norm()};
  }

  // On the body at rest: as far along and as far from its capsule, on the side on which the point
  // itself is.
  std::vector<Vec3> LayBack() const {
    const std::vector<TaperedCapsule> shapes = tighten::ShapesOf(solids_, set_);
    std::vector<Vec3> points;
    for (std::size_t v = 0; v < out_.size(); ++v) {
      if (out_[v].solid < 0) continue;
      const TaperedCapsule& shape = shapes[U(out_[v].solid)];
      const Vec3 axis = shape.b().center_m - shape.a().center_m;
      const Vec3 from_a = target_.points_m[v] - shape.a().center_m;
      const double squared = axis.squaredNorm();
      Vec3 aside = squared > 0.0 ? Vec3(from_a - from_a.dot(axis) / squared * axis) : from_a;
      if (!(aside.norm() > 0.0)) aside = axis.unitOrthogonal();
      points.push_back(shape.a().center_m + out_[v].along * axis +
                       out_[v].from_axis * aside.normalized());
    }
    return points;
  }

  // What is still outside: radii grow, and those of their images with them.
  void GrowRadii() {
    for (std::size_t f = 0; f < grids_.size() && !observer_.IsCancelled(); ++f) {
      while (GrowIn(f)) {
      }
    }
  }

  // Whether anything grew. One pass of points, each against the solid that was nearest.
  bool GrowIn(std::size_t frame) {
    const std::vector<TaperedCapsule> shapes = ShapesIn(centers_[frame]);
    const tighten::UnionDistances at = grids_[frame].DistancesTo(shapes, -1.0, pool_);
    bool has_grown = false;
    for (std::size_t i = 0; i < grids_[frame].size(); ++i) {
      if (at.distance_m[i] <= allowed_) continue;
      has_grown = GrowTo(frame, grids_[frame].point(i), U(at.solid[i])) || has_grown;
    }
    return has_grown;
  }

  bool GrowTo(std::size_t frame, const Vec3& point, std::size_t solid) {
    const tighten::Solid& ends = solids_[solid];
    const auto sphere = [&](int end) {
      return geometry::Sphere{centers_[frame][U(end)], set_.spheres[U(end)].radius_m};
    };
    const TaperedCapsule shape(sphere(ends.ends[0]), sphere(ends.ends[1]));
    const geometry::CapsuleDistance at = shape.Locate(point);
    const double missing = at.distance_m - allowed_;
    if (!(missing > 1e-12)) return false;
    // The least growth of both that makes the ball between them grow by what is missing.
    const double t = ends.ends[0] == ends.ends[1] ? 0.0 : at.axis_parameter;
    const double share = missing / (t * t + (1.0 - t) * (1.0 - t));
    if (t < 1.0) Grow(ends.ends[0], (1.0 - t) * share);
    if (t > 0.0) Grow(ends.ends[1], t * share);
    return true;
  }

  void Grow(int sphere, double by_m) {
    const double radius = set_.spheres[U(sphere)].radius_m + by_m + 1e-12;
    set_.spheres[U(sphere)].radius_m = radius;
    const int image = set_.origins[U(sphere)].mirror;
    if (image >= 0) set_.spheres[U(image)].radius_m = radius;
  }

  const tighten::CoverTarget& target_;
  const Carry& carry_;
  coverage::CoverOptions options_;
  const ThreadPool& pool_;
  FitObserver& observer_;
  capsule::PrimitiveSet& set_;
  double allowed_;
  std::vector<tighten::PointGrid> grids_;  // of each frame's points
  std::vector<tighten::Solid> solids_;
  std::vector<std::vector<Vec3>> centers_;  // in each frame
  std::vector<OutPoint> out_;  // by point of the target; solid -1: inside in all frames
};

}  // namespace

MotionReport CoverMotion(const tighten::CoverTarget& target, const MotionFrames& frames,
                         const Carry& carry, const coverage::CoverOptions& options,
                         const ThreadPool& pool, FitObserver& observer,
                         capsule::PrimitiveSet& set) {
  if (frames.empty() || set.spheres.empty()) return {};
  return MotionCoverer(target, frames, carry, options, pool, observer, set).Run();
}

}  // namespace capfit::motion
