#include "core/geometry/tapered_capsule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace capfit::geometry {
namespace {

// A unit vector across `axis`, for points on the axis, where every direction is as good.
Eigen::Vector3d AcrossOf(const Eigen::Vector3d& axis) {
  const Eigen::Vector3d helper =
      std::abs(axis.x()) < 0.6 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  return axis.cross(helper).normalized();
}

// The unit vector off the axis towards a point whose offset across the axis is `radial_vector`.
// Very near the axis that offset is rounding noise, not even square to the axis.
Eigen::Vector3d OutwardOf(const Eigen::Vector3d& radial_vector, double radial,
                          const Eigen::Vector3d& axis, double noise) {
  if (radial <= noise) return AcrossOf(axis);
  const Eigen::Vector3d outward = radial_vector / radial;
  return (outward - outward.dot(axis) * axis).normalized();
}

// Roots of a t^2 + 2 b t + c, in rising order; how many.
int SolveQuadratic(double a, double b, double c, std::array<double, 2>& roots) {
  const double scale = std::abs(a) + std::abs(b) + std::abs(c);
  if (std::abs(a) <= 1e-15 * scale) {
    if (std::abs(b) <= 1e-15 * scale) return 0;
    roots[0] = -0.5 * c / b;
    return 1;
  }
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0) return 0;
  // The root without cancellation first, the other from the product.
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  roots = {q / a, q != 0.0 ? c / q : 0.0};
  if (roots[0] > roots[1]) std::swap(roots[0], roots[1]);
  return 2;
}

void Extend(std::optional<Interval>& hull, double begin, double end) {
  hull = hull ? Interval{std::min(hull->begin, begin), std::max(hull->end, end)}
              : Interval{begin, end};
}

// Volume of the part of a ball between -radius and `height` along an axis through its centre.
double CappedBallVolume(double radius, double height) {
  return std::numbers::pi * (radius * radius * (height + radius) -
                             (height * height * height + radius * radius * radius) / 3.0);
}

}  // namespace

std::optional<Interval> Intersect(const Sphere& sphere, const Eigen::Vector3d& origin_m,
                                  const Eigen::Vector3d& direction) {
  const Eigen::Vector3d from_center = origin_m - sphere.center_m;
  const double a = direction.squaredNorm();
  const double b = from_center.dot(direction);
  if (a == 0.0) return std::nullopt;
  // Distance from the line to the centre, not b^2 - ac: the latter loses half the digits far away.
  const double squared_miss = (from_center - (b / a) * direction).squaredNorm();
  const double rest = sphere.radius_m * sphere.radius_m - squared_miss;
  if (rest < 0.0) return std::nullopt;
  const double half = std::sqrt(rest / a);
  return Interval{-b / a - half, -b / a + half};
}

TaperedCapsule::TaperedCapsule(const Sphere& a, const Sphere& b)
    : a_(a), b_(b), a_is_larger_(a.radius_m >= b.radius_m) {
  const Eigen::Vector3d across = b.center_m - a.center_m;
  const double difference = a.radius_m - b.radius_m;
  length_m_ = across.norm();
  if (length_m_ > 0.0) axis_ = across / length_m_;
  is_sphere_ = length_m_ <= std::abs(difference);
  if (is_sphere_) return;
  sin_ = difference / length_m_;
  cos_ = std::sqrt((length_m_ - difference) * (length_m_ + difference)) / length_m_;
}

CapsuleDistance TaperedCapsule::Locate(const Eigen::Vector3d& point_m) const {
  CapsuleDistance result;
  const Eigen::Vector3d from_a = point_m - a_.center_m;
  const double axial = from_a.dot(axis_);
  const Eigen::Vector3d radial_vector = from_a - axial * axis_;
  const double radial = radial_vector.norm();
  // Coordinate along the cone's slant, from the tangent circle of a (0) to that of b (cos * L).
  const double slant = cos_ * axial - sin_ * radial;
  const bool at_a = is_sphere_ ? a_is_larger_ : slant <= 0.0;
  const bool at_b = is_sphere_ ? !a_is_larger_ : slant >= cos_ * length_m_;
  if (at_a || at_b) {
    const Sphere& end = at_a ? a_ : b_;
    const Eigen::Vector3d from_end = point_m - end.center_m;
    const double distance = from_end.norm();
    result.distance_m = distance - end.radius_m;
    result.axis_parameter = at_a ? 0.0 : 1.0;
    result.normal = distance > 0.0 ? Eigen::Vector3d(from_end / distance) : AcrossOf(axis_);
    return result;
  }
  const Eigen::Vector3d outward =
      OutwardOf(radial_vector, radial, axis_, 1e-12 * (from_a.norm() + length_m_));
  result.distance_m = cos_ * radial + sin_ * axial - a_.radius_m;
  result.axis_parameter = std::clamp(slant / (cos_ * length_m_), 0.0, 1.0);
  result.normal = sin_ * axis_ + cos_ * outward;
  return result;
}

std::optional<Interval> TaperedCapsule::Intersect(const Eigen::Vector3d& origin_m,
                                                  const Eigen::Vector3d& direction) const {
  if (is_sphere_) return geometry::Intersect(a_is_larger_ ? a_ : b_, origin_m, direction);
  const double squared_length = direction.squaredNorm();
  if (squared_length == 0.0) return std::nullopt;
  std::optional<Interval> hull;
  for (const Sphere* end : {&a_, &b_}) {
    const std::optional<Interval> inside = geometry::Intersect(*end, origin_m, direction);
    if (inside) Extend(hull, inside->begin, inside->end);
  }
  // Where the ray meets the cone between the tangent circles. Parameters count from the ray's point
  // nearest to a, so that an origin far away costs no digits.
  const double shift = -(origin_m - a_.center_m).dot(direction) / squared_length;
  const Eigen::Vector3d from_a = origin_m + shift * direction - a_.center_m;
  const double axial = from_a.dot(axis_);
  const double axial_rate = direction.dot(axis_);
  // radial^2 = (radius on the cone)^2, where that radius is (r_a - sin * axial) / cos.
  const double radius = (a_.radius_m - sin_ * axial) / cos_;
  const double radius_rate = -sin_ * axial_rate / cos_;
  std::array<double, 2> roots{};
  const int count =
      SolveQuadratic(squared_length - axial_rate * axial_rate - radius_rate * radius_rate,
                     from_a.dot(direction) - axial * axial_rate - radius * radius_rate,
                     from_a.squaredNorm() - axial * axial - radius * radius, roots);
  const double first_axial = a_.radius_m * sin_;
  const double last_axial = length_m_ + b_.radius_m * sin_;
  for (int i = 0; i < count; ++i) {
    const double at = axial + roots[i] * axial_rate;
    if (at < first_axial || at > last_axial) continue;
    Extend(hull, shift + roots[i], shift + roots[i]);
  }
  return hull;
}

double TaperedCapsule::Volume_m3() const {
  if (is_sphere_) {
    const double r = std::max(a_.radius_m, b_.radius_m);
    return 4.0 / 3.0 * std::numbers::pi * r * r * r;
  }
  const double ring_a = a_.radius_m * cos_;  // radii of the tangent circles
  const double ring_b = b_.radius_m * cos_;
  const double frustum = std::numbers::pi / 3.0 * length_m_ * cos_ * cos_ *
                         (ring_a * ring_a + ring_a * ring_b + ring_b * ring_b);
  return frustum + CappedBallVolume(a_.radius_m, a_.radius_m * sin_) +
         CappedBallVolume(b_.radius_m, -b_.radius_m * sin_);
}

}  // namespace capfit::geometry
