#include "client/picture/figure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace capfit::client {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

PictureUp LongerOfYAndZ(const std::vector<Vector3d>& positions) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
  Vector3d high = -low;
  for (const Vector3d& p : positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return high.y() - low.y() >= high.z() - low.z() ? PictureUp::kY : PictureUp::kZ;
}

Vector3d UpAxis(PictureUp up) {
  if (up == PictureUp::kX) return Vector3d::UnitX();
  return up == PictureUp::kY ? Vector3d::UnitY() : Vector3d::UnitZ();
}

// The body's left, square to `up`.
Vector3d LeftOf(const ResultSet& result, PictureUp up) {
  for (const char* const name : {"wrist", "ankle", "shoulder", "knee", "hip", "armpit"}) {
    const auto left = result.landmarks.find(std::string("left_") + name);
    const auto right = result.landmarks.find(std::string("right_") + name);
    if (left == result.landmarks.end() || right == result.landmarks.end()) continue;
    const Vector3d across = left->second - right->second;
    const Vector3d level = across - across.dot(UpAxis(up)) * UpAxis(up);
    if (level.norm() > 0.5 * across.norm() && across.norm() > 0.0) return level.normalized();
  }
  return up == PictureUp::kX ? Vector3d(0.0, -1.0, 0.0) : Vector3d(1.0, 0.0, 0.0);
}

std::vector<mesh::Triangle> Fans(const formats::PolygonSoup& soup) {
  std::vector<mesh::Triangle> triangles;
  const std::size_t faces =
      soup.face_sizes.empty() ? soup.face_vertices.size() / 3 : soup.face_sizes.size();
  std::size_t at = 0;
  for (std::size_t f = 0; f < faces; ++f) {
    const std::size_t size = soup.face_sizes.empty() ? 3 : soup.face_sizes[f];
    for (std::size_t k = 2; k < size; ++k) {
      triangles.push_back(
          {soup.face_vertices[at], soup.face_vertices[at + k - 1], soup.face_vertices[at + k]});
    }
    at += size;
  }
  return triangles;
}

// Tells neighbours apart without any order: steps of the golden ratio.
double Shade(std::size_t index) {
  const double x = 0.618033988749895 * static_cast<double>(index);
  return x - static_cast<double>(static_cast<std::int64_t>(x));
}

}  // namespace

Matrix3d TurnUpright(const std::vector<Vector3d>& positions, const ResultSet& result,
                     PictureUp up) {
  if (up == PictureUp::kAuto && result.body_from_caller) return *result.body_from_caller;
  if (up == PictureUp::kAuto) up = LongerOfYAndZ(positions);
  const Vector3d left = LeftOf(result, up);
  Matrix3d turn;
  turn.row(0) = left;
  turn.row(1) = UpAxis(up);
  turn.row(2) = left.cross(UpAxis(up));
  return turn;
}

Figure MakeFigure(const formats::PolygonSoup& soup, const ResultSet& result,
                  const std::vector<Vector3d>& positions, const std::vector<Vector3d>& centers,
                  const Matrix3d& turn) {
  Figure figure;
  for (const Vector3d& p : positions) figure.vertices.push_back(turn * p);
  figure.triangles = Fans(soup);
  const auto ball = [&](std::size_t i) {
    return geometry::Sphere{turn * centers[i], result.spheres[i].radius_m};
  };
  std::vector<bool> is_used(result.spheres.size(), false);
  const auto add = [&](std::size_t a, std::size_t b) {
    figure.solid_colors.push_back(
        PartColor(result.sphere_parts[std::max(a, b)], Shade(figure.solids.size())));
    figure.solids.emplace_back(ball(a), ball(b));
    is_used[a] = is_used[b] = true;
  };
  for (const auto& ends : result.capsules) {
    add(static_cast<std::size_t>(ends[0]), static_cast<std::size_t>(ends[1]));
  }
  for (std::size_t i = 0; i < is_used.size(); ++i) {
    if (!is_used[i]) add(i, i);
  }
  return figure;
}

std::vector<double> Gaps(const Figure& figure) {
  std::vector<double> gaps;
  gaps.reserve(figure.vertices.size());
  for (const Vector3d& p : figure.vertices) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const geometry::TaperedCapsule& solid : figure.solids) {
      nearest = std::min(nearest, solid.SignedDistance(p));
    }
    gaps.push_back(nearest);
  }
  return gaps;
}

}  // namespace capfit::client
