#include "core/body/cross_section.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace capfit::body {
namespace {

using EdgeKey = std::uint64_t;

EdgeKey KeyOf(std::uint32_t a, std::uint32_t b) {
  return (static_cast<EdgeKey>(std::min(a, b)) << 32) | std::max(a, b);
}

// The piece of the section inside one triangle, from one of its edges to another.
struct Piece {
  EdgeKey from = 0;
  EdgeKey to = 0;
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d end = Eigen::Vector3d::Zero();
};

// Point of the edge on the plane; the same bits from both sides of the edge.
Eigen::Vector3d Crossing(std::span<const Eigen::Vector3d> points, const CutPlane& plane,
                         std::uint32_t a, std::uint32_t b) {
  if (a > b) std::swap(a, b);
  const double ha = plane.Height(points[a]);
  const double hb = plane.Height(points[b]);
  return points[a] + (ha / (ha - hb)) * (points[b] - points[a]);
}

std::vector<Piece> CutTriangles(std::span<const Eigen::Vector3d> points,
                                std::span<const mesh::Triangle> triangles, const CutPlane& plane) {
  std::vector<Piece> pieces;
  for (const mesh::Triangle& t : triangles) {
    const bool above[3] = {plane.Height(points[t[0]]) >= 0.0, plane.Height(points[t[1]]) >= 0.0,
                           plane.Height(points[t[2]]) >= 0.0};
    if (above[0] == above[1] && above[1] == above[2]) continue;
    Piece piece;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k];
      const std::uint32_t b = t[(k + 1) % 3];
      if (above[k] == above[(k + 1) % 3]) continue;
      // Going up along the edge leaves the section on its left: outlines run counter-clockwise.
      (above[k] ? piece.from : piece.to) = KeyOf(a, b);
      (above[k] ? piece.start : piece.end) = Crossing(points, plane, a, b);
    }
    pieces.push_back(piece);
  }
  std::sort(pieces.begin(), pieces.end(),
            [](const Piece& a, const Piece& b) { return a.from < b.from; });
  return pieces;
}

// Fan around the first point: exact for any simple outline.
void Measure(SectionLoop& loop, const Eigen::Vector3d& normal) {
  const std::size_t count = loop.outline.size();
  const Eigen::Vector3d& o = loop.outline.front();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d a = loop.outline[i] - o;
    const Eigen::Vector3d b = loop.outline[(i + 1) % count] - o;
    if (i + 1 < count || loop.is_closed) {
      const double length = (b - a).norm();
      loop.girth += length;
      mean += 0.5 * length * (a + b);
    }
    const double twice_area = normal.dot(a.cross(b));
    loop.area += 0.5 * twice_area;
    moment += twice_area / 6.0 * (a + b);
  }
  if (std::abs(loop.area) > 1e-6 * loop.girth * loop.girth && loop.is_closed) {
    loop.centroid = o + moment / loop.area;
  } else if (loop.girth > 0.0) {
    loop.centroid = o + mean / loop.girth;
  } else {
    loop.centroid = o;
  }
}

std::vector<SectionLoop> Link(const std::vector<Piece>& pieces) {
  std::vector<SectionLoop> loops;
  std::vector<char> used(pieces.size(), 0);
  const auto next_of = [&](EdgeKey edge) {
    const auto at =
        std::lower_bound(pieces.begin(), pieces.end(), edge,
                         [](const Piece& piece, EdgeKey key) { return piece.from < key; });
    const std::size_t index = static_cast<std::size_t>(std::distance(pieces.begin(), at));
    return at != pieces.end() && at->from == edge ? index : pieces.size();
  };
  for (std::size_t first = 0; first < pieces.size(); ++first) {
    if (used[first]) continue;
    SectionLoop loop;
    std::size_t at = first;
    while (at < pieces.size() && !used[at]) {
      used[at] = 1;
      loop.outline.push_back(pieces[at].start);
      at = next_of(pieces[at].to);
    }
    loop.is_closed = at == first;
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

double SectionLoop::Max(const Eigen::Vector3d& direction) const {
  double best = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p : outline) best = std::max(best, direction.dot(p));
  return best;
}

double SectionLoop::Min(const Eigen::Vector3d& direction) const { return -Max(-direction); }

std::vector<SectionLoop> CutSection(std::span<const Eigen::Vector3d> points,
                                    std::span<const mesh::Triangle> triangles,
                                    const CutPlane& plane) {
  std::vector<SectionLoop> loops = Link(CutTriangles(points, triangles, plane));
  for (SectionLoop& loop : loops) Measure(loop, plane.normal);
  std::stable_sort(loops.begin(), loops.end(), [](const SectionLoop& a, const SectionLoop& b) {
    return std::abs(a.area) > std::abs(b.area);
  });
  return loops;
}

std::optional<SectionLoop> CutLoopAt(std::span<const Eigen::Vector3d> points,
                                     std::span<const mesh::Triangle> triangles,
                                     const CutPlane& plane, double min_girth) {
  std::optional<SectionLoop> best;
  double best_distance = std::numeric_limits<double>::infinity();
  for (SectionLoop& loop : CutSection(points, triangles, plane)) {
    if (!loop.is_closed || loop.girth < min_girth) continue;
    const double distance = (loop.centroid - plane.origin).norm();
    if (distance >= best_distance) continue;
    best_distance = distance;
    best = std::move(loop);
  }
  return best;
}

}  // namespace capfit::body
