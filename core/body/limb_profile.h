// A limb as a stack of sections across its own middle line.
#ifndef CAPFIT_CORE_BODY_LIMB_PROFILE_H_
#define CAPFIT_CORE_BODY_LIMB_PROFILE_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/body/cross_section.h"
#include "core/body/extremities.h"

namespace capfit::body {

// One section. `arc` counts along the middle line from the tip.
struct Station {
  double arc = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   // centroid of the section's area
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();  // towards the trunk
  double girth = 0.0;
  double area = 0.0;
};

// Stations from the tip towards the trunk, as far as sections stay closed and of the limb's own
// size. Lengths in the unit of the points.
struct LimbProfile {
  std::vector<Station> stations;

  // Interpolated between stations; clamped to the ends.
  [[nodiscard]] Station At(double arc) const;
  // The arc at which the middle line passes nearest to `point`.
  [[nodiscard]] double NearestArc(const Eigen::Vector3d& point) const;
  // The same, but past the inner end as far on as the point is from it.
  [[nodiscard]] double ArcTo(const Eigen::Vector3d& point) const;
  // The arc of the smallest and of the greatest girth in [from, to], to a fraction of the spacing.
  [[nodiscard]] double NarrowestArc(double from, double to) const { return Extreme(from, to, 1.0); }
  [[nodiscard]] double WidestArc(double from, double to) const { return Extreme(from, to, -1.0); }
  [[nodiscard]] double MaxGirth(double from, double to) const;
  // Inner end, next to the trunk.
  [[nodiscard]] double end() const { return stations.empty() ? 0.0 : stations.back().arc; }

 private:
  [[nodiscard]] double Extreme(double from, double to, double sign) const;
};

// `stature` scales the spacing (0.8 %) and smoothing. The middle line starts as the centroids of
// the rings of equal geodesic distance and is drawn again through the sections' own centroids.
[[nodiscard]] LimbProfile MakeLimbProfile(std::span<const Eigen::Vector3d> points,
                                          std::span<const mesh::Triangle> triangles,
                                          const Extremities& extremities, const Limb& limb,
                                          double stature);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_LIMB_PROFILE_H_
