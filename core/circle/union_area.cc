#include "core/circle/union_area.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace capfit::circle {
namespace {

constexpr double kWholeTurn = 2.0 * std::numbers::pi;

struct Span {
  double begin = 0.0;
  double end = 0.0;
};

// What [low, high] has outside all of `covered`, in order.
std::vector<Span> Gaps(std::vector<Span> covered, double low, double high) {
  std::sort(covered.begin(), covered.end(), [](const Span& a, const Span& b) {
    return a.begin != b.begin ? a.begin < b.begin : a.end < b.end;
  });
  std::vector<Span> gaps;
  double reached = low;
  for (const Span& span : covered) {
    if (span.begin > reached) gaps.push_back({reached, std::min(span.begin, high)});
    reached = std::max(reached, span.end);
    if (reached >= high) return gaps;
  }
  gaps.push_back({reached, high});
  return gaps;
}

// Adds [begin, end] of the circle's angles, cut where it passes 2 pi.
void AddAngles(double begin, double end, std::vector<Span>& spans) {
  begin = std::fmod(std::fmod(begin, kWholeTurn) + kWholeTurn, kWholeTurn);
  end = std::fmod(std::fmod(end, kWholeTurn) + kWholeTurn, kWholeTurn);
  if (begin <= end) {
    spans.push_back({begin, end});
  } else {
    spans.push_back({0.0, end});
    spans.push_back({begin, kWholeTurn});
  }
}

// Arcs of circle i that are in no other circle. Of equal circles the first one keeps its arcs.
std::vector<Span> ExposedArcs(std::span<const Circle> circles, std::size_t i) {
  const Circle& circle = circles[i];
  std::vector<Span> covered;
  for (std::size_t j = 0; j < circles.size(); ++j) {
    if (j == i) continue;
    const Eigen::Vector2d to_other = circles[j].center_m - circle.center_m;
    const double distance = to_other.norm();
    const double r = circle.radius_m;
    const double other_r = circles[j].radius_m;
    if (distance >= r + other_r) continue;
    if (distance + r <= other_r) {  // wholly inside the other
      const bool equal = distance == 0.0 && r == other_r;
      if (!equal || j < i) return {};
      continue;
    }
    if (distance + other_r <= r) continue;
    const double cosine = (distance * distance + r * r - other_r * other_r) / (2.0 * distance * r);
    const double half = std::acos(std::clamp(cosine, -1.0, 1.0));
    const double middle = std::atan2(to_other.y(), to_other.x());
    AddAngles(middle - half, middle + half, covered);
  }
  return Gaps(std::move(covered), 0.0, kWholeTurn);
}

// Half the integral of x dy - y dx along an arc.
double ArcIntegral(const Circle& circle, const Span& arc) {
  const double r = circle.radius_m;
  const double sines = std::sin(arc.end) - std::sin(arc.begin);
  const double cosines = std::cos(arc.end) - std::cos(arc.begin);
  return 0.5 * r *
         (r * (arc.end - arc.begin) + circle.center_m.x() * sines - circle.center_m.y() * cosines);
}

// The stretch of parameters in which p + t e lies in the circle, cut to [0, 1]; empty if none.
Span Inside(const Circle& circle, const Eigen::Vector2d& p, const Eigen::Vector2d& e) {
  const Eigen::Vector2d u = p - circle.center_m;
  const double a = e.squaredNorm();
  const double half_b = u.dot(e);
  const double root2 = half_b * half_b - a * (u.squaredNorm() - circle.radius_m * circle.radius_m);
  if (root2 <= 0.0 || a == 0.0) return {};
  const double root = std::sqrt(root2);
  return {std::clamp((-half_b - root) / a, 0.0, 1.0), std::clamp((-half_b + root) / a, 0.0, 1.0)};
}

double EdgesInsideIntegral(std::span<const Circle> circles, const section::Polygon& outline) {
  const std::span<const Eigen::Vector2d> vertices = outline.vertices();
  double sum = 0.0;
  std::vector<Span> inside;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const Eigen::Vector2d& p = vertices[k];
    const Eigen::Vector2d e = vertices[k + 1 < vertices.size() ? k + 1 : 0] - p;
    inside.clear();
    for (const Circle& circle : circles) {
      const Span span = Inside(circle, p, e);
      if (span.end > span.begin) inside.push_back(span);
    }
    double length = 1.0;
    for (const Span& gap : Gaps(inside, 0.0, 1.0)) length -= gap.end - gap.begin;
    // p x e is the same for every stretch of the edge.
    sum += 0.5 * length * (p.x() * e.y() - p.y() * e.x());
  }
  return sum;
}

// Angles at which the outline crosses the circle.
std::vector<double> Crossings(const Circle& circle, const section::Polygon& outline) {
  const std::span<const Eigen::Vector2d> vertices = outline.vertices();
  std::vector<double> angles;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const Eigen::Vector2d& p = vertices[k];
    const Eigen::Vector2d e = vertices[k + 1 < vertices.size() ? k + 1 : 0] - p;
    const Span span = Inside(circle, p, e);
    for (const double t : {span.begin, span.end}) {
      if (!(t > 0.0 && t < 1.0)) continue;
      const Eigen::Vector2d at = p + t * e - circle.center_m;
      const double angle = std::atan2(at.y(), at.x());
      angles.push_back(angle < 0.0 ? angle + kWholeTurn : angle);
    }
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

double ArcsInsideIntegral(std::span<const Circle> circles, const section::Polygon& outline) {
  double sum = 0.0;
  for (std::size_t i = 0; i < circles.size(); ++i) {
    const std::vector<Span> arcs = ExposedArcs(circles, i);
    if (arcs.empty()) continue;
    const std::vector<double> cuts = Crossings(circles[i], outline);
    for (const Span& arc : arcs) {
      double begin = arc.begin;
      const auto piece = [&](double end) {
        const double middle = 0.5 * (begin + end);
        const Eigen::Vector2d at =
            circles[i].center_m +
            circles[i].radius_m * Eigen::Vector2d(std::cos(middle), std::sin(middle));
        if (end > begin && outline.Contains(at)) sum += ArcIntegral(circles[i], {begin, end});
        begin = end;
      };
      for (const double cut : cuts) {
        if (cut > begin && cut < arc.end) piece(cut);
      }
      piece(arc.end);
    }
  }
  return sum;
}

}  // namespace

double UnionArea(std::span<const Circle> circles) {
  double sum = 0.0;
  for (std::size_t i = 0; i < circles.size(); ++i) {
    for (const Span& arc : ExposedArcs(circles, i)) sum += ArcIntegral(circles[i], arc);
  }
  return sum;
}

double UnionOutsideArea(std::span<const Circle> circles, const section::Polygon& outline) {
  // The common part of union and outline is bounded by the outline's edges inside the union and by
  // the exposed arcs inside the outline.
  const double common =
      EdgesInsideIntegral(circles, outline) + ArcsInsideIntegral(circles, outline);
  return std::max(0.0, UnionArea(circles) - common);
}

std::vector<double> OverlapRatios(std::span<const Circle> circles) {
  const double whole = UnionArea(circles);
  std::vector<double> ratios;
  for (std::size_t i = 0; i < circles.size(); ++i) {
    std::vector<Circle> others(circles.begin(), circles.end());
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const double area = std::numbers::pi * circles[i].radius_m * circles[i].radius_m;
    const double alone = whole - UnionArea(others);
    ratios.push_back(area > 0.0 ? std::clamp(1.0 - alone / area, 0.0, 1.0) : 1.0);
  }
  return ratios;
}

}  // namespace capfit::circle
