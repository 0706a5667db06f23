
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/body/body.h"

namespace capfit::body {
namespace {

// Index of the curve's piece that holds the arc length, and how far along it lies.
std::pair<std::size_t, double> Locate(const MedialCurve& curve, double arc_length_m) {
  const std::vector<double>& arc = curve.arc_length_m;
  const double wanted = std::clamp(arc_length_m, arc.front(), arc.back());
  const auto after = std::upper_bound(arc.begin() + 1, arc.end() - 1, wanted);
  const std::size_t i = static_cast<std::size_t>(std::distance(arc.begin(), after)) - 1;
  return {i, (wanted - arc[i]) / (arc[i + 1] - arc[i])};
}

}  // namespace

MedialCurve CurveThrough(const std::vector<Eigen::Vector3d>& points_m) {
  MedialCurve curve = {{points_m.front()}, {0.0}};
  for (const Eigen::Vector3d& p : points_m) {
    const double step = (p - curve.points_m.back()).norm();
    if (step <= 0.0) continue;
    curve.points_m.push_back(p);
    curve.arc_length_m.push_back(curve.arc_length_m.back() + step);
  }
  return curve;
}

Eigen::Vector3d MedialCurve::PointAt(double at_m) const {
  const auto [i, t] = Locate(*this, at_m);
  return points_m[i] + t * (points_m[i + 1] - points_m[i]);
}

Eigen::Vector3d MedialCurve::TangentAt(double at_m) const {
  // The chord over a tenth of the curve: a kink between two pieces must not turn a section.
  const double reach = 0.05 * length_m();
  const Eigen::Vector3d chord = PointAt(at_m + reach) - PointAt(at_m - reach);
  return chord.normalized();
}

double MedialCurve::Project(const Eigen::Vector3d& point_m) const {
  double best = std::numeric_limits<double>::infinity();
  double at = 0.0;
  for (std::size_t i = 0; i + 1 < points_m.size(); ++i) {
    const Eigen::Vector3d step = points_m[i + 1] - points_m[i];
    const double t = std::clamp((point_m - points_m[i]).dot(step) / step.squaredNorm(), 0.0, 1.0);
    const double distance = (points_m[i] + t * step - point_m).squaredNorm();
    if (distance >= best) continue;
    best = distance;
    at = arc_length_m[i] + t * (arc_length_m[i + 1] - arc_length_m[i]);
  }
  return at;
}

}  // namespace capfit::body
