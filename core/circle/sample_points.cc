#include "core/circle/sample_points.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace capfit::circle {
namespace {

struct Crossing {
  double x = 0.0;
  int winding = 0;  // +1 where the outline goes up
};

std::vector<Crossing> CrossingsOfRow(std::span<const Eigen::Vector2d> vertices, double y) {
  std::vector<Crossing> crossings;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector2d& a = vertices[i];
    const Eigen::Vector2d& b = vertices[i + 1 < vertices.size() ? i + 1 : 0];
    if ((a.y() <= y) == (b.y() <= y)) continue;
    const double t = (y - a.y()) / (b.y() - a.y());
    crossings.push_back({a.x() + t * (b.x() - a.x()), b.y() > a.y() ? 1 : -1});
  }
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
  return crossings;
}

// Columns lie at (k + 1/2) * spacing, so that x and -x are both columns or both not.
void AddRow(const std::vector<Crossing>& crossings, double y, double spacing,
            std::vector<Eigen::Vector2d>& points) {
  int winding = 0;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    winding += crossings[i].winding;
    if (winding == 0) continue;
    double column = std::ceil(crossings[i].x / spacing - 0.5);
    for (; (column + 0.5) * spacing < crossings[i + 1].x; column += 1.0) {
      points.emplace_back((column + 0.5) * spacing, y);
    }
  }
}

}  // namespace

std::vector<Eigen::Vector2d> InteriorPoints(const section::Polygon& outline, int count) {
  std::vector<Eigen::Vector2d> points;
  if (count <= 0) return points;
  const std::span<const Eigen::Vector2d> vertices = outline.vertices();
  const double spacing = std::sqrt(outline.area_m2() / count);
  double low = vertices[0].y();
  double high = low;
  for (const Eigen::Vector2d& v : vertices) {
    low = std::min(low, v.y());
    high = std::max(high, v.y());
  }
  for (double y = low + 0.5 * spacing; y < high; y += spacing) {
    AddRow(CrossingsOfRow(vertices, y), y, spacing, points);
  }
  return points;
}

}  // namespace capfit::circle
