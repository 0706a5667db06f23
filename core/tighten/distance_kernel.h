// Signed distances of many points to one solid, in vector registers.
#ifndef CAPFIT_CORE_TIGHTEN_DISTANCE_KERNEL_H_
#define CAPFIT_CORE_TIGHTEN_DISTANCE_KERNEL_H_

#include <cmath>

#include "core/geometry/tapered_capsule.h"

namespace capfit::tighten {

// A solid as inner loops want it: nearest sphere centre a + t * L * u, radius ra + t * dr.
struct DistanceKernel {
  explicit DistanceKernel(const geometry::TaperedCapsule& capsule) {
    const bool b_only = capsule.IsSphere() && capsule.b().radius_m > capsule.a().radius_m;
    const geometry::Sphere& first = b_only ? capsule.b() : capsule.a();
    ax = first.center_m.x();
    ay = first.center_m.y();
    az = first.center_m.z();
    ra = first.radius_m;
    ux = capsule.axis().x();
    uy = capsule.axis().y();
    uz = capsule.axis().z();
    if (capsule.IsSphere()) return;
    length = capsule.length_m();
    inverse_length = 1.0 / length;
    slope = capsule.sin_half_angle() / capsule.cos_half_angle();
    dr = capsule.b().radius_m - capsule.a().radius_m;
  }

  struct Place {
    double distance_m;  // signed, exact to 1e-7 m
    double foot_m;      // of the slant's normal, along the axis from a; beyond the ends as well
  };

  [[nodiscard]] double SignedDistance(double x, double y, double z) const {
    return Locate(x, y, z).distance_m;
  }

  // Free of branches, so that a loop over it vectorises.
  [[nodiscard]] Place Locate(double x, double y, double z) const {
    const double dx = x - ax;
    const double dy = y - ay;
    const double dz = z - az;
    const double axial = dx * ux + dy * uy + dz * uz;
    const double rest = dx * dx + dy * dy + dz * dz - axial * axial;
    const double squared = rest > 0.0 ? rest : 0.0;
    const double radial = std::sqrt(squared);
    const double foot = axial - radial * slope;
    double t = foot * inverse_length;
    t = t > 0.0 ? t : 0.0;
    t = t < 1.0 ? t : 1.0;
    const double off = axial - t * length;
    return {std::sqrt(squared + off * off) - (ra + t * dr), foot};
  }

  double ax = 0, ay = 0, az = 0, ux = 1, uy = 0, uz = 0;
  double ra = 0, dr = 0, length = 0, inverse_length = 0, slope = 0;
};

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_DISTANCE_KERNEL_H_
