#include "core/export/lathe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace capfit::exports {
namespace {

constexpr double kQuarter = std::numbers::pi / 2.0;

// A point of the outline that is turned about +Y: distance from the axis, height, and the angle of
// the solid's normal above the horizontal.
struct OutlinePoint {
  double radius = 0.0;
  double height = 0.0;
  double angle_rad = 0.0;
};

// An arc of the outline about a point of the axis, from one angle above the horizontal to another.
struct Arc {
  double center = 0.0;
  double radius = 0.0;
  double from_rad = 0.0;
  double to_rad = 0.0;
};

OutlinePoint At(const Arc& arc, double angle_rad, double radius) {
  return {radius * std::cos(angle_rad), arc.center + radius * std::sin(angle_rad), angle_rad};
}

// The points of an arc without the poles: on it where it is cut in equal steps, or where the
// tangents there meet.
void Append(const Arc& arc, int segments, LatheKind kind, std::vector<OutlinePoint>& outline) {
  const double angle = arc.to_rad - arc.from_rad;
  const int steps =
      std::max(1, static_cast<int>(std::ceil(angle * segments / (2.0 * std::numbers::pi) - 1e-9)));
  const double step = angle / steps;
  if (kind == LatheKind::kEnclosing) {
    for (int k = 0; k < steps; ++k) {
      outline.push_back(At(arc, arc.from_rad + (k + 0.5) * step, arc.radius / std::cos(step / 2)));
    }
    return;
  }
  for (int k = 0; k <= steps; ++k) {
    const double angle_rad = k == steps ? arc.to_rad : arc.from_rad + k * step;
    if (kQuarter - std::abs(angle_rad) > 1e-9) outline.push_back(At(arc, angle_rad, arc.radius));
  }
}

// The outline from the lower to the upper pole, without them.
std::vector<OutlinePoint> OutlineOf(const Solid& solid, int segments, LatheKind kind) {
  std::vector<OutlinePoint> outline;
  if (solid.IsBall()) {
    Append({0.0, solid.ball().radius_m, -kQuarter, kQuarter}, segments, kind, outline);
    return outline;
  }
  const double half = 0.5 * solid.hull.length_m();
  const double slant = std::asin(std::clamp(solid.hull.sin_half_angle(), -1.0, 1.0));
  Append({-half, solid.hull.a().radius_m, -kQuarter, slant}, segments, kind, outline);
  Append({half, solid.hull.b().radius_m, slant, kQuarter}, segments, kind, outline);
  return outline;
}

class Turner {
 public:
  Turner(int segments, double widening) : segments_(segments), widening_(widening) {}

  LatheMesh Run(const std::vector<OutlinePoint>& outline, double low, double high) {
    const std::uint32_t bottom = AddPole(low, -1.0);
    for (const OutlinePoint& point : outline) AddRing(point);
    const std::uint32_t top = AddPole(high, 1.0);
    const auto rings = static_cast<std::uint32_t>(outline.size());
    for (std::uint32_t s = 0; s < Segments(); ++s) {
      mesh_.triangles.push_back({bottom, Corner(0, s), Corner(0, s + 1)});
      for (std::uint32_t r = 0; r + 1 < rings; ++r) AddQuad(r, s);
      mesh_.triangles.push_back({top, Corner(rings - 1, s + 1), Corner(rings - 1, s)});
    }
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] std::uint32_t Segments() const { return static_cast<std::uint32_t>(segments_); }
  [[nodiscard]] std::uint32_t Corner(std::uint32_t ring, std::uint32_t segment) const {
    return 1 + ring * Segments() + segment % Segments();
  }

  std::uint32_t AddPole(double height, double up) {
    mesh_.vertices.emplace_back(0.0, height, 0.0);
    mesh_.normals.emplace_back(0.0, up, 0.0);
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }

  // From +X towards +Z.
  void AddRing(const OutlinePoint& point) {
    for (int s = 0; s < segments_; ++s) {
      const double turn = 2.0 * std::numbers::pi * s / segments_;
      const Eigen::Vector3d out(std::cos(turn), 0.0, std::sin(turn));
      mesh_.vertices.push_back(widening_ * point.radius * out +
                               point.height * Eigen::Vector3d::UnitY());
      mesh_.normals.push_back(std::cos(point.angle_rad) * out +
                              std::sin(point.angle_rad) * Eigen::Vector3d::UnitY());
    }
  }

  void AddQuad(std::uint32_t ring, std::uint32_t segment) {
    const std::uint32_t a = Corner(ring, segment);
    const std::uint32_t b = Corner(ring, segment + 1);
    const std::uint32_t c = Corner(ring + 1, segment + 1);
    const std::uint32_t d = Corner(ring + 1, segment);
    mesh_.triangles.push_back({a, d, c});
    mesh_.triangles.push_back({a, c, b});
  }

  int segments_;
  double widening_;
  LatheMesh mesh_;
};

}  // namespace

LatheMesh Lathe(const Solid& solid, int segments, LatheKind kind) {
  const std::vector<OutlinePoint> outline = OutlineOf(solid, segments, kind);
  const double widening =
      kind == LatheKind::kEnclosing ? 1.0 / std::cos(std::numbers::pi / segments) : 1.0;
  const double half = solid.IsBall() ? 0.0 : 0.5 * solid.hull.length_m();
  const double low = solid.IsBall() ? solid.ball().radius_m : solid.hull.a().radius_m;
  const double high = solid.IsBall() ? solid.ball().radius_m : solid.hull.b().radius_m;
  return Turner(segments, widening).Run(outline, -half - low, half + high);
}

double LatheDeviation(int segments) {
  const double cosine = std::cos(std::numbers::pi / segments);
  return 1.0 / (cosine * cosine) - 1.0;
}

}  // namespace capfit::exports
