#include "core/metrics/revolved_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace capfit::metrics {

RevolvedSurface::RevolvedSurface(const geometry::TaperedCapsule& solid)
    : a_(solid.a()), b_(solid.b()), axis_(solid.axis()) {
  across_ = axis_.unitOrthogonal();
  third_ = axis_.cross(across_);
  if (solid.IsSphere()) {
    if (b_.radius_m > a_.radius_m) a_ = b_;
    b_ = a_;
    arc_a_ = slant_end_ = std::numbers::pi * a_.radius_m;
    return;
  }
  sin_ = solid.sin_half_angle();
  cos_ = solid.cos_half_angle();
  const double leave = 0.5 * std::numbers::pi + std::asin(sin_);
  arc_a_ = leave * a_.radius_m;
  slant_end_ = arc_a_ + cos_ * solid.length_m();
  arc_b_ = (std::numbers::pi - leave) * b_.radius_m;
}

double RevolvedSurface::largest_radius_m() const { return std::max(a_.radius_m, b_.radius_m); }

RevolvedSurface::Ring RevolvedSurface::RingAt(double arc_length_m) const {
  const auto on_ball = [&](const geometry::Sphere& ball, double from_pole) {
    return Ring{ball.center_m - ball.radius_m * std::cos(from_pole) * axis_,
                ball.radius_m * std::sin(from_pole)};
  };
  if (arc_length_m <= arc_a_) {
    return on_ball(a_, a_.radius_m > 0.0 ? arc_length_m / a_.radius_m : 0.0);
  }
  if (arc_length_m < slant_end_) {
    const double along = arc_length_m - arc_a_;
    return {a_.center_m + (a_.radius_m * sin_ + along * cos_) * axis_,
            a_.radius_m * cos_ - along * sin_};
  }
  const double left = std::max(0.0, profile_length_m() - arc_length_m);
  return on_ball(b_, std::numbers::pi - (b_.radius_m > 0.0 ? left / b_.radius_m : 0.0));
}

}  // namespace capfit::metrics
