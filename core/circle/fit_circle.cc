#include "core/circle/fit_circle.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/circle/circle_outside_area.h"
#include "core/circle/quadratic_program.h"

namespace capfit::circle {
namespace {

// Points nearer to the centre than this share of the radius cannot become tight in one step.
constexpr double kNearlyTight = 0.85;
// A step that saves less than this share of the area ends the search.
constexpr double kRelativeGain = 1e-6;

// One centre with all that is known about it.
struct Trial {
  Eigen::Vector2d center;
  double radius = 0.0;
  OutsideArea area;
};

class Fitter {
 public:
  Fitter(const section::Polygon& outline, std::span<const Eigen::Vector2d> points, Place place)
      : outline_(outline), points_(points), centred_(place == Place::kCentred) {}

  CircleFit Run(const Eigen::Vector2d& start, int max_steps) {
    best_ = Try(centred_ ? Eigen::Vector2d(0.0, start.y()) : start);
    Eigen::Matrix3d b = InitialCurvature();
    bool is_fresh = true;  // a stop with learnt curvature is tried again without
    for (int step = 0; step < max_steps && best_.area.by_radius_m > 0.0; ++step) {
      if (Step(b)) {
        is_fresh = false;
        continue;
      }
      if (is_fresh) break;
      b = InitialCurvature();
      is_fresh = true;
    }
    return {{best_.center, best_.radius}, best_.area.area_m2};
  }

 private:
  Trial Try(const Eigen::Vector2d& center) const {
    double farthest2 = 0.0;
    for (const Eigen::Vector2d& p : points_) {
      farthest2 = std::max(farthest2, (p - center).squaredNorm());
    }
    const double radius = std::sqrt(farthest2);
    return {center, radius, CircleOutsideAreaWithGradient({center, radius}, outline_)};
  }

  Eigen::Matrix3d InitialCurvature() const {
    const double scale = std::max(best_.area.by_radius_m, 1e-9) / std::max(best_.radius, 1e-9);
    return scale * Eigen::Matrix3d::Identity();
  }

  static Eigen::Vector3d Gradient(const Trial& trial) {
    return {trial.area.by_center_m.x(), trial.area.by_center_m.y(), trial.area.by_radius_m};
  }

  // l_j - r + u_j . d_o - d_r <= 0 for each point that is nearly tight.
  void Linearise() {
    constraints_.clear();
    for (const Eigen::Vector2d& p : points_) {
      const Eigen::Vector2d away = best_.center - p;
      const double distance = away.norm();
      if (distance <= kNearlyTight * best_.radius) continue;
      constraints_.push_back(
          {{-away.x() / distance, -away.y() / distance, 1.0}, distance - best_.radius});
    }
  }

  Eigen::Matrix3d Inverse(const Eigen::Matrix3d& b) const {
    if (!centred_) return b.inverse();
    Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
    inverse.bottomRightCorner<2, 2>() = Eigen::Matrix2d(b.bottomRightCorner<2, 2>()).inverse();
    return inverse;
  }

  // One quadratic programme and a backtracking search along its answer. False at the end.
  bool Step(Eigen::Matrix3d& b) {
    Linearise();
    const Eigen::Vector3d gradient = Gradient(best_);
    const QuadraticSolution qp = SolveQuadraticProgram(Inverse(b), gradient, constraints_);
    const double slope = gradient.dot(qp.x);
    if (!(slope < -kRelativeGain * best_.area.area_m2)) return false;
    for (double t = 1.0; t > 0.02; t *= 0.4) {
      const Trial next = Try(best_.center + t * qp.x.head<2>());
      if (next.area.area_m2 > best_.area.area_m2 + 1e-3 * t * slope) continue;
      const double gain = best_.area.area_m2 - next.area.area_m2;
      Learn(next, qp, b);
      best_ = next;
      return gain > kRelativeGain * next.area.area_m2;
    }
    return false;
  }

  // Damped BFGS on the Lagrangian: the constraints' own curvature is part of it.
  void Learn(const Trial& next, const QuadraticSolution& qp, Eigen::Matrix3d& b) const {
    const Eigen::Vector3d s(next.center.x() - best_.center.x(), next.center.y() - best_.center.y(),
                            next.radius - best_.radius);
    Eigen::Vector3d y = Gradient(next) - Gradient(best_);
    for (int k = 0; k < qp.active_count; ++k) {
      const Eigen::Vector3d& normal = constraints_[qp.active[k]].normal;
      // normal = (p - o) / |p - o|: how it turned on the way from the old centre to the new one.
      const Eigen::Vector2d p = best_.center + normal.head<2>() * DistanceOf(qp.active[k]);
      const Eigen::Vector2d turned = (p - next.center).normalized();
      y.head<2>() -= qp.multipliers[k] * (turned - normal.head<2>());
    }
    const Eigen::Vector3d bs = b * s;
    const double sbs = s.dot(bs);
    if (!(sbs > 0.0)) return;
    const double sy = s.dot(y);
    if (sy < 0.2 * sbs) {
      const double theta = 0.8 * sbs / (sbs - sy);
      y = theta * y + (1.0 - theta) * bs;
    }
    b += y * y.transpose() / s.dot(y) - bs * bs.transpose() / sbs;
  }

  double DistanceOf(int constraint) const { return constraints_[constraint].bound + best_.radius; }

  const section::Polygon& outline_;
  std::span<const Eigen::Vector2d> points_;
  bool centred_;
  Trial best_;
  std::vector<HalfSpace> constraints_;
};

double Turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

}  // namespace

std::vector<Eigen::Vector2d> ConvexHull(std::span<const Eigen::Vector2d> sorted_points_m) {
  if (sorted_points_m.size() < 3) return {sorted_points_m.begin(), sorted_points_m.end()};
  std::vector<Eigen::Vector2d> hull;
  const auto add = [&hull](const Eigen::Vector2d& p, std::size_t keep) {
    while (hull.size() >= keep + 2 && Turn(hull[hull.size() - 2], hull.back(), p) <= 0.0) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const Eigen::Vector2d& p : sorted_points_m) add(p, 0);  // lower chain
  const std::size_t lower = hull.size() - 1;
  for (std::size_t i = sorted_points_m.size() - 1; i-- > 0;) add(sorted_points_m[i], lower);
  hull.pop_back();  // the first point again
  return hull;
}

CircleFit FitCircle(const section::Polygon& outline, std::span<const Eigen::Vector2d> points_m,
                    const Eigen::Vector2d& start_m, Place place, int max_steps) {
  if (points_m.size() == 1 && (place != Place::kCentred || points_m[0].x() == 0.0)) {
    return {{points_m[0], 0.0}, 0.0};
  }
  return Fitter(outline, points_m, place).Run(start_m, max_steps);
}

}  // namespace capfit::circle
