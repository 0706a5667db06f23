#include "core/section/polygon.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/status.h"

namespace capfit::section {
namespace {

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Relative to the first vertex, so that an outline far from the origin keeps its digits.
double SignedArea(const std::vector<Eigen::Vector2d>& vertices) {
  double twice_area = 0.0;
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    twice_area += Cross(vertices[i] - vertices[0], vertices[i + 1] - vertices[0]);
  }
  return 0.5 * twice_area;
}

}  // namespace

absl::StatusOr<Polygon> Polygon::Create(std::vector<Eigen::Vector2d> vertices_m) {
  if (vertices_m.size() < 3) {
    return InvalidField(ErrorReason::kOutOfRange, "polygon",
                        "has " + std::to_string(vertices_m.size()) + " vertices, needs at least 3");
  }
  for (std::size_t i = 0; i < vertices_m.size(); ++i) {
    if (!vertices_m[i].allFinite()) {
      return InvalidField(ErrorReason::kOutOfRange, "polygon[" + std::to_string(i) + "]",
                          "must be finite");
    }
  }
  const double area = SignedArea(vertices_m);
  if (!(std::abs(area) > 0.0))
    return InvalidField(ErrorReason::kOutOfRange, "polygon", "has no area");
  if (area < 0.0) std::reverse(vertices_m.begin(), vertices_m.end());
  return Polygon(std::move(vertices_m), std::abs(area));
}

Eigen::Vector2d Polygon::Centroid() const {
  const Eigen::Vector2d& base = vertices_[0];
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 1; i + 1 < vertices_.size(); ++i) {
    const Eigen::Vector2d a = vertices_[i] - base;
    const Eigen::Vector2d b = vertices_[i + 1] - base;
    sum += Cross(a, b) * (a + b);
  }
  return base + sum / (6.0 * area_m2_);
}

bool Polygon::Contains(const Eigen::Vector2d& point_m) const {
  int winding = 0;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Eigen::Vector2d& a = vertices_[i];
    const Eigen::Vector2d& b = vertices_[i + 1 < vertices_.size() ? i + 1 : 0];
    const bool a_below = a.y() <= point_m.y();
    const bool b_below = b.y() <= point_m.y();
    if (a_below == b_below) continue;
    const double side = Cross(b - a, point_m - a);
    if (a_below && side > 0.0) ++winding;
    if (b_below && side < 0.0) --winding;
  }
  return winding != 0;
}

}  // namespace capfit::section
