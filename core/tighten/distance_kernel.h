// Signed distances of many points to one solid, in vector registers: the kernels of inner loops.
//
// Two, for doubles and for floats: volumes and gaps need the digits, and trials of sets the speed
// of eight floats at a time. geometry::TaperedCapsule is the exact one, with branches.
#ifndef CAPFIT_CORE_TIGHTEN_DISTANCE_KERNEL_H_
#define CAPFIT_CORE_TIGHTEN_DISTANCE_KERNEL_H_

#include <algorithm>
#include <cmath>

#include "core/geometry/tapered_capsule.h"

namespace capfit::tighten {

// In doubles. Of a point the nearest sphere has its centre at a + t * L * u and the radius
// ra + t * dr.
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

  // Exact to 1e-7 m. Free of branches, so that a loop over it vectorises.
  [[nodiscard]] double SignedDistance(double x, double y, double z) const {
    const double dx = x - ax;
    const double dy = y - ay;
    const double dz = z - az;
    const double axial = dx * ux + dy * uy + dz * uz;
    const double rest = dx * dx + dy * dy + dz * dz - axial * axial;
    const double squared = rest > 0.0 ? rest : 0.0;
    const double radial = std::sqrt(squared);
    double t = (axial - radial * slope) * inverse_length;
    t = t > 0.0 ? t : 0.0;
    t = t < 1.0 ? t : 1.0;
    const double off = axial - t * length;
    return std::sqrt(squared + off * off) - (ra + t * dr);
  }

  double ax = 0, ay = 0, az = 0, ux = 1, uy = 0, uz = 0;
  double ra = 0, dr = 0, length = 0, inverse_length = 0, slope = 0;
};

// In floats, to 3e-7 of the largest coordinate (0.3 um at 2 m). Of a point the nearest sphere has
// its centre at a + foot * u, lowest <= foot <= highest, and the radius radius + foot *
// radius_slope.
struct FloatKernel {
  struct Place {
    float distance_m;
    float foot_m;  // of the slant's normal, along the axis from (ax, ay, az); beyond the ends too
  };

  [[nodiscard]] float SignedDistance(float x, float y, float z) const {
    return Locate(x, y, z).distance_m;
  }

  // Free of branches, so that loops over it vectorise.
  [[nodiscard]] Place Locate(float x, float y, float z) const {
    const float dx = x - ax;
    const float dy = y - ay;
    const float dz = z - az;
    const float axial = dx * ux + dy * uy + dz * uz;
    const float rest = dx * dx + dy * dy + dz * dz - axial * axial;
    const float squared = rest > 0.0f ? rest : 0.0f;
    const float slant_foot = axial - std::sqrt(squared) * foot_slope;
    float foot = slant_foot > lowest ? slant_foot : lowest;
    foot = foot < highest ? foot : highest;
    const float off = axial - foot;
    return {std::sqrt(squared + off * off) - (radius + radius_slope * foot), slant_foot};
  }

  float ax = 0, ay = 0, az = 0;  // a point of the axis
  float ux = 0, uy = 0, uz = 0;  // the axis, of length 1; 0 for a sphere
  float lowest = 0, highest = 0;
  float foot_slope = 0;  // tan of the angle by which a foot lies behind its point
  float radius = 0, radius_slope = 0;
};

// As seen from `center_m`: along the axis from the point nearest to that, so that all numbers are
// small and their digits tell (1e-6 m, 2e-7 m within some centimetres).
[[nodiscard]] inline FloatKernel KernelAround(const DistanceKernel& solid,
                                              const Eigen::Vector3d& center_m) {
  const double along = (center_m.x() - solid.ax) * solid.ux + (center_m.y() - solid.ay) * solid.uy +
                       (center_m.z() - solid.az) * solid.uz;
  const double start = std::clamp(along, 0.0, solid.length);
  const double growth = solid.dr * solid.inverse_length;
  FloatKernel kernel;
  kernel.ax = static_cast<float>(solid.ax + start * solid.ux - center_m.x());
  kernel.ay = static_cast<float>(solid.ay + start * solid.uy - center_m.y());
  kernel.az = static_cast<float>(solid.az + start * solid.uz - center_m.z());
  kernel.ux = static_cast<float>(solid.ux);
  kernel.uy = static_cast<float>(solid.uy);
  kernel.uz = static_cast<float>(solid.uz);
  kernel.lowest = static_cast<float>(-start);
  kernel.highest = static_cast<float>(solid.length - start);
  kernel.foot_slope = static_cast<float>(solid.slope);
  kernel.radius = static_cast<float>(solid.ra + growth * start);
  kernel.radius_slope = static_cast<float>(growth);
  return kernel;
}

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_DISTANCE_KERNEL_H_
