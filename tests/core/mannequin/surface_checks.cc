#include "tests/core/mannequin/surface_checks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace capfit::test_support {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Triangle = std::array<std::uint32_t, 3>;

bool SegmentCutsTriangle(const Vector3d& p, const Vector3d& q, const Vector3d& a, const Vector3d& b,
                         const Vector3d& c) {
  const Vector3d direction = q - p;
  const Vector3d ab = b - a;
  const Vector3d ac = c - a;
  const Vector3d h = direction.cross(ac);
  const double det = ab.dot(h);
  if (std::abs(det) < 1e-18) return false;
  const Vector3d s = p - a;
  const double u = s.dot(h) / det;
  const Vector3d k = s.cross(ab);
  const double v = direction.dot(k) / det;
  const double t = ac.dot(k) / det;
  return u > 0 && v > 0 && u + v < 1 && t > 0 && t < 1;
}

bool Cut(const std::vector<Vector3d>& p, const Triangle& s, const Triangle& t) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (SegmentCutsTriangle(p[s[k]], p[s[(k + 1) % 3]], p[t[0]], p[t[1]], p[t[2]])) return true;
    if (SegmentCutsTriangle(p[t[k]], p[t[(k + 1) % 3]], p[s[0]], p[s[1]], p[s[2]])) return true;
  }
  return false;
}

bool ShareCorner(const Triangle& s, const Triangle& t) {
  return std::any_of(s.begin(), s.end(),
                     [&](std::uint32_t v) { return std::count(t.begin(), t.end(), v) > 0; });
}

using Cell = std::array<int, 3>;

template <typename Visit>
void ForEachCell(const std::vector<Vector3d>& p, const Triangle& t, double size,
                 const Visit& visit) {
  const Eigen::Array3i low =
      (p[t[0]].cwiseMin(p[t[1]]).cwiseMin(p[t[2]]) / size).array().floor().cast<int>();
  const Eigen::Array3i high =
      (p[t[0]].cwiseMax(p[t[1]]).cwiseMax(p[t[2]]) / size).array().floor().cast<int>();
  for (int x = low.x(); x <= high.x(); ++x) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int z = low.z(); z <= high.z(); ++z) visit(Cell{x, y, z});
    }
  }
}

double HullLength(std::vector<Vector2d> points) {
  // Gift wrapping: slow and simple.
  const auto start = std::min_element(points.begin(), points.end(),
                                      [](const auto& a, const auto& b) { return a.x() < b.x(); });
  Vector2d at = *start;
  double length = 0.0;
  for (std::size_t step = 0; step < points.size(); ++step) {
    Vector2d next = at;
    for (const Vector2d& p : points) {
      const double turn = (next - at).x() * (p - at).y() - (next - at).y() * (p - at).x();
      const bool is_further = (p - at).norm() > (next - at).norm();
      if (next == at || turn < 0 || (turn == 0 && is_further)) next = p;
    }
    length += (next - at).norm();
    at = next;
    if (at == *start) break;
  }
  return length;
}

using MeshEdge = std::pair<std::uint32_t, std::uint32_t>;

std::size_t Root(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i];
  return i;
}

}  // namespace

std::vector<Corners> Faces(const formats::PolygonSoup& soup) {
  std::vector<Corners> faces;
  std::size_t at = 0;
  while (at < soup.face_vertices.size()) {
    const std::size_t size = soup.face_sizes.empty() ? 3 : soup.face_sizes[faces.size()];
    faces.emplace_back(soup.face_vertices.begin() + static_cast<std::ptrdiff_t>(at),
                       soup.face_vertices.begin() + static_cast<std::ptrdiff_t>(at + size));
    at += size;
  }
  return faces;
}

std::vector<Triangle> Triangles(const formats::PolygonSoup& soup) {
  std::vector<Triangle> triangles;
  for (const Corners& face : Faces(soup)) {
    for (std::size_t k = 2; k < face.size(); ++k) {
      triangles.push_back({face[0], face[k - 1], face[k]});
    }
  }
  return triangles;
}

SurfaceFacts Examine(const formats::PolygonSoup& soup) {
  SurfaceFacts facts;
  std::map<MeshEdge, int> runs;
  std::vector<bool> is_used(soup.positions.size(), false);
  const std::vector<Corners> faces = Faces(soup);
  for (const Corners& face : faces) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      ++runs[{face[k], face[(k + 1) % face.size()]}];
      is_used[face[k]] = true;
    }
  }
  for (const auto& [edge, count] : runs) {
    const auto back = runs.find({edge.second, edge.first});
    if (count != 1 || back == runs.end() || back->second != 1) ++facts.unmatched_edges;
  }
  for (const Triangle& t : Triangles(soup)) {
    facts.volume +=
        soup.positions[t[0]].dot(soup.positions[t[1]].cross(soup.positions[t[2]])) / 6.0;
  }
  facts.euler_number = static_cast<int>(soup.positions.size()) - static_cast<int>(runs.size() / 2) +
                       static_cast<int>(faces.size());
  facts.unused_vertices = static_cast<int>(std::count(is_used.begin(), is_used.end(), false));
  return facts;
}

int CountSelfIntersections(const formats::PolygonSoup& soup) {
  constexpr double kCellSize = 0.02;
  const std::vector<Triangle> triangles = Triangles(soup);
  std::map<Cell, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    ForEachCell(soup.positions, triangles[i], kCellSize,
                [&](const Cell& cell) { cells[cell].push_back(i); });
  }
  std::vector<MeshEdge> pairs;
  for (const auto& [cell, members] : cells) {
    for (std::size_t a = 0; a < members.size(); ++a) {
      for (std::size_t b = a + 1; b < members.size(); ++b) {
        const Triangle& s = triangles[members[a]];
        const Triangle& t = triangles[members[b]];
        if (ShareCorner(s, t) || !Cut(soup.positions, s, t)) continue;
        pairs.emplace_back(members[a], members[b]);
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return static_cast<int>(pairs.size());
}

double TapeAt(const formats::PolygonSoup& soup, double y) {
  std::map<MeshEdge, std::size_t> ids;
  std::vector<Vector2d> points;
  std::vector<std::size_t> parent;
  for (const Triangle& t : Triangles(soup)) {
    std::vector<std::size_t> cut;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
      const Vector3d& a = soup.positions[low];
      const Vector3d& b = soup.positions[high];
      if ((a.y() <= y) == (b.y() <= y)) continue;
      const auto [it, is_new] = ids.try_emplace({low, high}, points.size());
      if (is_new) {
        const Vector3d p = a + (y - a.y()) / (b.y() - a.y()) * (b - a);
        points.emplace_back(p.x(), p.z());
        parent.push_back(parent.size());
      }
      cut.push_back(it->second);
    }
    if (cut.size() == 2) parent[Root(parent, cut[0])] = Root(parent, cut[1]);
  }
  std::map<std::size_t, std::vector<Vector2d>> curves;
  for (std::size_t i = 0; i < points.size(); ++i) curves[Root(parent, i)].push_back(points[i]);
  for (const auto& [root, curve] : curves) {
    const auto [left, right] = std::minmax_element(
        curve.begin(), curve.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
    if (left->x() < 0 && right->x() > 0) return HullLength(curve);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace capfit::test_support
