#include "core/body/inside.h"

#include <algorithm>
#include <cstddef>

namespace capfit::body {

bool IsInside(const CutSurface& surface, const Eigen::Vector3d& at) {
  int winding = 0;  // by the crossings of a ray along +X
  for (const SectionLoop& loop : surface.Cut({at, Eigen::Vector3d::UnitY()})) {
    for (std::size_t i = 0; i < loop.outline.size(); ++i) {
      const Eigen::Vector3d& a = loop.outline[i];
      const Eigen::Vector3d& b = loop.outline[(i + 1) % loop.outline.size()];
      if ((a.z() <= at.z()) == (b.z() <= at.z())) continue;
      const double x = a.x() + (at.z() - a.z()) / (b.z() - a.z()) * (b.x() - a.x());
      if (x > at.x()) winding += a.z() <= at.z() ? 1 : -1;
    }
  }
  return winding != 0;
}

bool IsInsideOrNear(const CutSurface& surface, const Eigen::Vector3d& at, double near) {
  if (IsInside(surface, at)) return true;
  return std::any_of(
      surface.points().begin(), surface.points().end(),
      [&](const Eigen::Vector3d& p) { return (p - at).squaredNorm() <= near * near; });
}

int PlacesOutside(const CutSurface& surface, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                  double near, int places) {
  int outside = 0;
  for (int i = 0; i < places; ++i) {
    const double share = (i + 0.5) / places;
    if (!IsInsideOrNear(surface, (1.0 - share) * from + share * to, near)) ++outside;
  }
  return outside;
}

}  // namespace capfit::body
