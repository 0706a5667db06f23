#include "tests/bench/sphere_mesh/spherical_quadric.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <limits>

namespace capfit::bench {
namespace {

using geometry::Sphere;

// Determinants below this, for quadrics scaled to a trace of about 1, leave the sphere open.
constexpr double kOpenDeterminant = 1e-9;

Eigen::Vector4d Numbers(const Sphere& sphere) {
  return {sphere.center_m.x(), sphere.center_m.y(), sphere.center_m.z(), sphere.radius_m};
}

// Least value of k0 x^2 - 2 k1 x over [low, high], k0 >= 0.
double ArgMin(double k0, double k1, double low, double high) {
  if (k0 <= 0.0) return k1 > 0.0 ? high : low;
  return std::clamp(k1 / k0, low, high);
}

}  // namespace

void SphericalQuadric::AddPlane(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                                double weight) {
  const Eigen::Vector4d n(normal.x(), normal.y(), normal.z(), 1.0);
  const double offset = normal.dot(point);
  a_ += weight * n * n.transpose();
  b_ += weight * offset * n;
  c_ += weight * offset * offset;
}

SphericalQuadric& SphericalQuadric::operator+=(const SphericalQuadric& other) {
  a_ += other.a_;
  b_ += other.b_;
  c_ += other.c_;
  return *this;
}

double SphericalQuadric::Error(const Sphere& sphere) const {
  const Eigen::Vector4d s = Numbers(sphere);
  return std::max(0.0, s.dot(a_ * s) - 2.0 * b_.dot(s) + c_);
}

std::optional<Eigen::Vector3d> SphericalQuadric::CenterFor(double radius) const {
  const Eigen::Matrix3d normals = a_.topLeftCorner<3, 3>();
  const double weight = a_(3, 3);
  Eigen::Matrix3d inverse;
  bool is_closed = false;
  normals.computeInverseWithCheck(inverse, is_closed, kOpenDeterminant * weight * weight * weight);
  if (!is_closed) return std::nullopt;
  return inverse * (b_.head<3>() - radius * a_.topRightCorner<3, 1>());
}

std::optional<Sphere> SphericalQuadric::Minimise(double max_radius) const {
  const double weight = a_(3, 3);
  Eigen::Matrix4d inverse;
  bool is_closed = false;
  a_.computeInverseWithCheck(inverse, is_closed,
                             kOpenDeterminant * weight * weight * weight * weight);
  if (!is_closed) return std::nullopt;
  const Eigen::Vector4d s = inverse * b_;
  if (s[3] >= 0.0 && s[3] <= max_radius) return Sphere{s.head<3>(), s[3]};
  // Convex: with the best radius out of range, the best one in range is at its end.
  const double radius = s[3] < 0.0 ? 0.0 : max_radius;
  const std::optional<Eigen::Vector3d> center = CenterFor(radius);
  if (!center) return std::nullopt;
  return Sphere{*center, radius};
}

Sphere SphericalQuadric::MinimiseOnSegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                           double max_radius) const {
  // Error as a quadratic of (t, radius), center = a + t (b - a): h.x - 2 g.x, by its four borders
  // and the inside.
  const Eigen::Vector3d along = b - a;
  const Eigen::Matrix3d normals = a_.topLeftCorner<3, 3>();
  const Eigen::Vector3d mixed = a_.topRightCorner<3, 1>();
  const double h_tt = along.dot(normals * along), h_tr = along.dot(mixed), h_rr = a_(3, 3);
  const double g_t = along.dot(b_.head<3>() - normals * a), g_r = b_[3] - mixed.dot(a);
  std::array<Eigen::Vector2d, 5> candidates;
  std::size_t count = 0;
  for (const double t : {0.0, 1.0}) {
    candidates[count++] = {t, ArgMin(h_rr, g_r - h_tr * t, 0.0, max_radius)};
  }
  for (const double radius : {0.0, max_radius}) {
    candidates[count++] = {ArgMin(h_tt, g_t - h_tr * radius, 0.0, 1.0), radius};
  }
  const double determinant = h_tt * h_rr - h_tr * h_tr;
  if (determinant > kOpenDeterminant * h_tt * h_rr) {
    const Eigen::Vector2d inside((h_rr * g_t - h_tr * g_r) / determinant,
                                 (h_tt * g_r - h_tr * g_t) / determinant);
    if (inside[0] > 0.0 && inside[0] < 1.0 && inside[1] > 0.0 && inside[1] < max_radius) {
      candidates[count++] = inside;
    }
  }
  Sphere best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const Sphere sphere{a + candidates[i][0] * along, candidates[i][1]};
    const double error = Error(sphere);
    if (error < least) {
      least = error;
      best = sphere;
    }
  }
  return best;
}

}  // namespace capfit::bench
