#include "core/export/sphere_chain.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace capfit::exports {
namespace {

std::vector<geometry::Sphere> EvenSpheres(const geometry::TaperedCapsule& hull, int gaps,
                                          double overshoot_m) {
  std::vector<geometry::Sphere> spheres;
  for (int k = 0; k <= gaps; ++k) {
    const double t = static_cast<double>(k) / gaps;
    spheres.push_back({(1.0 - t) * hull.a().center_m + t * hull.b().center_m,
                       (1.0 - t) * hull.a().radius_m + t * hull.b().radius_m + overshoot_m});
  }
  return spheres;
}

// How far along a straight line of the cone, from where that touches the ball it was, a sphere
// reaches that is larger by the overshoot.
double Reach(const geometry::Sphere& grown, double overshoot_m) {
  const double touching_m = grown.radius_m - overshoot_m;
  return std::sqrt(overshoot_m * (2.0 * touching_m + overshoot_m));
}

// Two neighbours hold all of the hull between them if they hold such a line: what lies under it is
// nearer to the axis, and so to their centres.
bool HoldsBetween(const std::vector<geometry::Sphere>& spheres, double line_m, double overshoot_m) {
  for (std::size_t k = 0; k + 1 < spheres.size(); ++k) {
    if (Reach(spheres[k], overshoot_m) + Reach(spheres[k + 1], overshoot_m) < line_m) return false;
  }
  return true;
}

}  // namespace

std::vector<geometry::Sphere> SphereChain(const geometry::TaperedCapsule& hull,
                                          double overshoot_m) {
  if (hull.IsSphere()) {
    return {hull.a().radius_m >= hull.b().radius_m ? hull.a() : hull.b()};
  }
  const double line_m = hull.length_m() * hull.cos_half_angle();
  const double widest_m =
      2.0 * Reach({{}, std::max(hull.a().radius_m, hull.b().radius_m) + overshoot_m}, overshoot_m);
  for (int gaps = std::max(1, static_cast<int>(line_m / widest_m));; ++gaps) {
    std::vector<geometry::Sphere> spheres = EvenSpheres(hull, gaps, overshoot_m);
    if (HoldsBetween(spheres, line_m / gaps, overshoot_m)) return spheres;
  }
}

}  // namespace capfit::exports
