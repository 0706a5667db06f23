#include "core/mannequin/girth.h"

#include <algorithm>

namespace capfit::mannequin {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double Cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Length of the lower hull of points sorted from left to right (of the upper hull from right to
// left).
template <typename Iterator>
double ChainLength(Iterator begin, Iterator end) {
  std::vector<Vector2d> chain;
  for (Iterator it = begin; it != end; ++it) {
    while (chain.size() >= 2 &&
           Cross(chain.back() - chain[chain.size() - 2], *it - chain.back()) <= 0.0) {
      chain.pop_back();
    }
    chain.push_back(*it);
  }
  double length = 0.0;
  for (std::size_t i = 1; i < chain.size(); ++i) length += (chain[i] - chain[i - 1]).norm();
  return length;
}

}  // namespace

double TapeLength(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  return ChainLength(points.begin(), points.end()) + ChainLength(points.rbegin(), points.rend());
}

double HalfBodyGirth(const std::vector<Vector3d>& vertices, const std::vector<Quad>& quads,
                     double y) {
  std::vector<Vector2d> points;
  for (const Quad& q : quads) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3d& a = vertices[q[k]];
      const Vector3d& b = vertices[q[(k + 1) % 4]];
      if ((a.y() <= y) == (b.y() <= y)) continue;
      const Vector3d p = a + (y - a.y()) / (b.y() - a.y()) * (b - a);
      points.emplace_back(p.x(), p.z());
      points.emplace_back(-p.x(), p.z());
    }
  }
  return TapeLength(std::move(points));
}

}  // namespace capfit::mannequin
