#include "client/picture/raster.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace capfit::client {
namespace {

using Eigen::Vector3d;

// First and last sample whose centre lies in [low, high].
struct SampleRange {
  int first;
  int last;
};

SampleRange Samples(double low, double high, int count) {
  const double first = std::clamp(std::ceil(low - 0.5), 0.0, static_cast<double>(count));
  const double last = std::clamp(std::floor(high - 0.5), -1.0, static_cast<double>(count - 1));
  return {static_cast<int>(first), static_cast<int>(last)};
}

}  // namespace

void Raster::DrawTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, std::size_t id) {
  const double area = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
  if (!(std::abs(area) > 1e-12)) return;
  const SampleRange rows =
      Samples(std::min({a.y(), b.y(), c.y()}), std::max({a.y(), b.y(), c.y()}), height_);
  const SampleRange columns =
      Samples(std::min({a.x(), b.x(), c.x()}), std::max({a.x(), b.x(), c.x()}), width_);
  for (int j = rows.first; j <= rows.last; ++j) {
    for (int i = columns.first; i <= columns.last; ++i) {
      const double x = i + 0.5;
      const double y = j + 0.5;
      const double u = ((b.x() - x) * (c.y() - y) - (c.x() - x) * (b.y() - y)) / area;
      const double v = ((c.x() - x) * (a.y() - y) - (a.x() - x) * (c.y() - y)) / area;
      const double w = 1.0 - u - v;
      if (u < 0.0 || v < 0.0 || w < 0.0) continue;
      Put(i, j, u * a.z() + v * b.z() + w * c.z(), id);
    }
  }
}

void Raster::DrawMesh(std::span<const Vector3d> vertices, std::span<const mesh::Triangle> triangles,
                      const View& view) {
  std::vector<Vector3d> projected;
  projected.reserve(vertices.size());
  for (const Vector3d& p : vertices) projected.push_back(view.Project(p));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const mesh::Triangle& corners = triangles[t];
    DrawTriangle(projected[corners[0]], projected[corners[1]], projected[corners[2]], t);
  }
}

void Raster::DrawCapsule(const geometry::TaperedCapsule& capsule, const View& view,
                         std::size_t id) {
  const Vector3d a = view.Project(capsule.a().center_m);
  const Vector3d b = view.Project(capsule.b().center_m);
  const double ra = capsule.a().radius_m * view.pixels_per_unit();
  const double rb = capsule.b().radius_m * view.pixels_per_unit();
  const SampleRange rows =
      Samples(std::min(a.y() - ra, b.y() - rb), std::max(a.y() + ra, b.y() + rb), height_);
  const SampleRange columns =
      Samples(std::min(a.x() - ra, b.x() - rb), std::max(a.x() + ra, b.x() + rb), width_);
  for (int j = rows.first; j <= rows.last; ++j) {
    for (int i = columns.first; i <= columns.last; ++i) {
      const std::optional<geometry::Interval> inside =
          capsule.Intersect(view.PointAt(i + 0.5, j + 0.5), view.toward_eye());
      if (inside) Put(i, j, inside->end, id);
    }
  }
}

void Raster::DrawCapsules(std::span<const geometry::TaperedCapsule> capsules, const View& view) {
  for (std::size_t k = 0; k < capsules.size(); ++k) DrawCapsule(capsules[k], view, k);
}

}  // namespace capfit::client
