#include "tests/bench/sphere_mesh/sphere_mesh_distance.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace capfit::bench {
namespace {

using Eigen::Vector3d;
using geometry::Sphere;

// Triangles thinner than this, as the sine of their least angle or so, have sides only.
constexpr double kThin = 1e-6;

// A ball around spheres, not the least one.
void Enclose(std::span<const Sphere> spheres, Vector3d& middle, double& reach) {
  middle = Vector3d::Zero();
  for (const Sphere& s : spheres) middle += s.center_m / static_cast<double>(spheres.size());
  reach = 0.0;
  for (const Sphere& s : spheres) {
    reach = std::max(reach, (s.center_m - middle).norm() + s.radius_m);
  }
}

}  // namespace

TrianglePlates::TrianglePlates(const Sphere& a, const Sphere& b, const Sphere& c) : a_(a) {
  sides_ << b.center_m - a.center_m, c.center_m - a.center_m;
  growth_ << b.radius_m - a.radius_m, c.radius_m - a.radius_m;
  shares_of_.setZero();
  const Vector3d doubled = sides_.col(0).cross(sides_.col(1));
  if (doubled.norm() <= kThin * sides_.col(0).squaredNorm() ||
      doubled.norm() <= kThin * sides_.col(1).squaredNorm()) {
    return;
  }
  const Eigen::Matrix2d gram = sides_.transpose() * sides_;
  shares_of_ = gram.inverse() * sides_.transpose();
  across_ = doubled.normalized();
  // A plane of unit normal n touches all three where n . side = -growth along both sides.
  lean_ = -shares_of_.transpose() * growth_;
  rise_ = std::sqrt(std::max(0.0, 1.0 - lean_.squaredNorm()));
}

bool TrianglePlates::Locate(const Vector3d& point, Foot& foot) const {
  if (rise_ <= 0.0) return false;
  const double height = (point - a_.center_m).dot(across_);
  const Vector3d normal = lean_ + std::copysign(rise_, height) * across_;
  // Back along the normal, down to the centres' plane.
  const double way = std::abs(height) / rise_;
  const Eigen::Vector2d at = shares_of_ * (point - way * normal - a_.center_m);
  if (at[0] < 0.0 || at[1] < 0.0 || at.sum() > 1.0) return false;
  foot.distance = way - a_.radius_m - growth_.dot(at);
  foot.shares = {1.0 - at.sum(), at[0], at[1]};
  foot.normal = normal;
  return true;
}

SphereMeshDistance::SphereMeshDistance(const SphereMesh& mesh)
    : edges_(mesh.edges), triangles_(mesh.triangles) {
  const auto sphere = [&](int i) { return mesh.spheres[i]; };
  if (edges_.empty()) {
    for (int i = 0; i < static_cast<int>(mesh.spheres.size()); ++i) edges_.push_back({i, i});
  }
  for (const auto& [a, b] : edges_) {
    Hull hull;
    hull.edge = static_cast<std::int32_t>(capsules_.size());
    Enclose(std::array{sphere(a), sphere(b)}, hull.middle, hull.reach);
    capsules_.emplace_back(sphere(a), sphere(b));
    hulls_.push_back(hull);
  }
  for (const auto& [a, b, c] : triangles_) {
    Hull hull;
    hull.triangle = static_cast<std::int32_t>(plates_.size());
    Enclose(std::array{sphere(a), sphere(b), sphere(c)}, hull.middle, hull.reach);
    plates_.emplace_back(sphere(a), sphere(b), sphere(c));
    hulls_.push_back(hull);
  }
}

bool SphereMeshDistance::IsNearer(const Hull& hull, const Vector3d& point, Foot& best) const {
  if (hull.is_dropped) return false;
  const double within = best.distance + hull.reach;
  if (within <= 0.0 || (point - hull.middle).squaredNorm() >= within * within) return false;
  if (hull.triangle >= 0) {
    // Its sides are edges, so that only its plates are left.
    const auto at = static_cast<std::size_t>(hull.triangle);
    Foot foot;
    if (!plates_[at].Locate(point, foot) || foot.distance >= best.distance) return false;
    foot.spheres = triangles_[at];
    best = foot;
    return true;
  }
  const auto at = static_cast<std::size_t>(hull.edge);
  if (capsules_[at].SignedDistance(point) >= best.distance) return false;
  const geometry::CapsuleDistance found = capsules_[at].Locate(point);
  best = {found.distance_m,
          {edges_[at][0], edges_[at][1], edges_[at][0]},
          {1.0 - found.axis_parameter, found.axis_parameter, 0.0},
          found.normal};
  return true;
}

Foot SphereMeshDistance::Locate(const Vector3d& point, int& hint, int without) const {
  Foot best;
  best.distance = std::numeric_limits<double>::infinity();
  if (hint != without) (void)IsNearer(hulls_[hint], point, best);
  for (int i = 0; i < hulls(); ++i) {
    if (i != without && IsNearer(hulls_[i], point, best)) hint = i;
  }
  return best;
}

}  // namespace capfit::bench
