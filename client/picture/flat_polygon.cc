#include "client/picture/flat_polygon.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace capfit::client {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kRimPoints = 72;

Vector3d Middle(const ResultPolygon& polygon) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : polygon.outline) sum += p;
  return sum / static_cast<double>(polygon.outline.size());
}

// Square to the outline, as long as twice its area (Newell).
Vector3d AreaNormal(const ResultPolygon& polygon) {
  const Vector3d middle = Middle(polygon);
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < polygon.outline.size(); ++i) {
    const Vector3d& next = polygon.outline[(i + 1) % polygon.outline.size()];
    sum += (polygon.outline[i] - middle).cross(next - middle);
  }
  return sum;
}

// Towards the upper end of the part, were it to hang straight down, in the picture's frame.
Vector3d Upward(const std::vector<ResultPolygon>& polygons, std::size_t at,
                const Eigen::Matrix3d& turn) {
  const std::string& part = polygons[at].part;
  const bool is_torso = part == "torso" || part == "head";
  std::size_t first = at;
  std::size_t last = at;
  if (at > 0 && polygons[at - 1].part == part) first = at - 1;
  if (at + 1 < polygons.size() && polygons[at + 1].part == part) last = at + 1;
  const Vector3d onward = turn * (Middle(polygons[last]) - Middle(polygons[first]));
  if (onward.norm() > 0.0) return is_torso ? onward : Vector3d(-onward);
  // A single cut of an arm: arms point away from the body before they point up.
  if (part == "left_arm") return {-1.0, 0.5, 0.0};
  if (part == "right_arm") return {1.0, 0.5, 0.0};
  return Vector3d::UnitY();
}

geometry::PlaneFrame FrameOf(const std::vector<ResultPolygon>& polygons, std::size_t at,
                             const Eigen::Matrix3d& turn) {
  const Vector3d upward = Upward(polygons, at, turn);
  Vector3d normal = turn * AreaNormal(polygons[at]);
  if (!(normal.norm() > 0.0)) normal = upward;
  if (normal.dot(upward) < 0.0) normal = -normal;
  const Eigen::Quaterniond swing =
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitY(), normal.normalized());
  return {turn * Middle(polygons[at]), swing * Vector3d::UnitX(), swing * Vector3d(0, 0, -1)};
}

FlatPolygon FlattenOne(const ResultPolygon& polygon, const geometry::PlaneFrame& frame,
                       const Eigen::Matrix3d& turn) {
  FlatPolygon flat{polygon.name, polygon.part, polygon.outside_area_ratio, frame, {}, {}};
  for (const Vector3d& p : polygon.outline) flat.outline.push_back(frame.ToPlane(turn * p));
  for (const geometry::Sphere& circle : polygon.circles) {
    flat.circles.push_back({frame.ToPlane(turn * circle.center_m), circle.radius_m});
  }
  return flat;
}

FigureCurve CurveOf(const FlatPolygon& polygon, const std::vector<Vector2d>& points,
                    const Vector2d& middle) {
  FigureCurve curve;
  curve.name = polygon.name;
  curve.color = PartColor(polygon.part, 0.5);
  curve.middle = polygon.frame.ToSpace(middle);
  for (const Vector2d& p : points) curve.points.push_back(polygon.frame.ToSpace(p));
  return curve;
}

}  // namespace

std::vector<FlatPolygon> Flatten(const std::vector<ResultPolygon>& polygons,
                                 const Eigen::Matrix3d& turn) {
  std::vector<FlatPolygon> flat;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    flat.push_back(FlattenOne(polygons[i], FrameOf(polygons, i, turn), turn));
  }
  return flat;
}

std::vector<FigureCurve> CurvesOf(const std::vector<FlatPolygon>& polygons) {
  std::vector<FigureCurve> curves;
  for (const FlatPolygon& polygon : polygons) {
    for (const FlatCircle& circle : polygon.circles) {
      curves.push_back(CurveOf(polygon, RimOf(circle), circle.center));
    }
    curves.push_back(CurveOf(polygon, polygon.outline, Vector2d::Zero()));
    curves.back().is_outline = true;
    curves.back().color = kInk;
  }
  return curves;
}

std::vector<Vector2d> RimOf(const FlatCircle& circle) {
  std::vector<Vector2d> rim;
  for (int i = 0; i < kRimPoints; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kRimPoints;
    rim.push_back(circle.center +
                  circle.radius * Vector2d(std::cos(angle_rad), std::sin(angle_rad)));
  }
  return rim;
}

}  // namespace capfit::client
