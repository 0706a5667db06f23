#include "core/body/cross_section.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace capfit::body {
namespace {

using EdgeKey = std::uint64_t;

constexpr std::size_t kGroupSize = 8;
// Rounding must not lose a triangle that just touches the plane.
constexpr double kBoxSlack = 1.000001;
constexpr double kRounding = 1e-12;

EdgeKey KeyOf(std::uint32_t a, std::uint32_t b) {
  return (static_cast<EdgeKey>(std::min(a, b)) << 32) | std::max(a, b);
}

// The piece of the section inside one triangle, from one of its edges to another.
struct Piece {
  EdgeKey from = 0;
  EdgeKey to = 0;
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
};

void CutTriangle(std::span<const Eigen::Vector3d> points, const mesh::Triangle& t,
                 const CutPlane& plane, std::vector<Piece>& pieces) {
  const double height[3] = {plane.Height(points[t[0]]), plane.Height(points[t[1]]),
                            plane.Height(points[t[2]])};
  const bool above[3] = {height[0] >= 0.0, height[1] >= 0.0, height[2] >= 0.0};
  if (above[0] == above[1] && above[1] == above[2]) return;
  Piece piece;
  for (int k = 0; k < 3; ++k) {
    int a = k;
    int b = (k + 1) % 3;
    if (above[a] == above[b]) continue;
    // Outward normals: the outline comes in where the triangle's edge goes down.
    const bool comes_in = above[k];
    // From the lower index, so that both triangles at the edge get the same bits.
    if (t[a] > t[b]) std::swap(a, b);
    const Eigen::Vector3d crossing =
        points[t[a]] + (height[a] / (height[a] - height[b])) * (points[t[b]] - points[t[a]]);
    (comes_in ? piece.from : piece.to) = KeyOf(t[a], t[b]);
    if (comes_in) piece.start = crossing;
  }
  pieces.push_back(piece);
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

CutSurface::CutSurface(std::span<const Eigen::Vector3d> points,
                       std::span<const mesh::Triangle> triangles)
    : points_(points), triangles_(triangles) {
  groups_.reserve(triangles.size() / kGroupSize + 1);
  for (std::size_t first = 0; first < triangles.size(); first += kGroupSize) {
    const std::size_t last = std::min(first + kGroupSize, triangles.size());
    Eigen::Vector3d low = points[triangles[first][0]];
    Eigen::Vector3d high = low;
    for (std::size_t i = first; i < last; ++i) {
      for (const std::uint32_t v : triangles[i]) {
        low = low.cwiseMin(points[v]);
        high = high.cwiseMax(points[v]);
      }
    }
    groups_.push_back({0.5 * (low + high), 0.5 * (high - low)});
  }
  for (std::size_t first = 0; first < groups_.size(); first += kGroupSize) {
    const std::size_t last = std::min(first + kGroupSize, groups_.size());
    Eigen::Vector3d low = groups_[first].center - groups_[first].half;
    Eigen::Vector3d high = groups_[first].center + groups_[first].half;
    for (std::size_t i = first + 1; i < last; ++i) {
      low = low.cwiseMin(groups_[i].center - groups_[i].half);
      high = high.cwiseMax(groups_[i].center + groups_[i].half);
    }
    clans_.push_back({0.5 * (low + high), 0.5 * (high - low)});
  }
}

std::vector<SectionLoop> CutSurface::Cut(const CutPlane& plane) const {
  std::vector<Piece> pieces;
  const Eigen::Vector3d steepness = kBoxSlack * plane.normal.cwiseAbs();
  const double offset = plane.normal.dot(plane.origin);
  const auto touches = [&](const Box& box) {
    return std::abs(plane.normal.dot(box.center) - offset) <= steepness.dot(box.half) + kRounding;
  };
  for (std::size_t c = 0; c < clans_.size(); ++c) {
    if (!touches(clans_[c])) continue;
    const std::size_t last_group = std::min((c + 1) * kGroupSize, groups_.size());
    for (std::size_t g = c * kGroupSize; g < last_group; ++g) {
      if (!touches(groups_[g])) continue;
      const std::size_t last = std::min((g + 1) * kGroupSize, triangles_.size());
      for (std::size_t i = g * kGroupSize; i < last; ++i) {
        CutTriangle(points_, triangles_[i], plane, pieces);
      }
    }
  }
  std::sort(pieces.begin(), pieces.end(),
            [](const Piece& a, const Piece& b) { return a.from < b.from; });
  std::vector<SectionLoop> loops = Link(pieces);
  for (SectionLoop& loop : loops) Measure(loop, plane.normal);
  std::stable_sort(loops.begin(), loops.end(), [](const SectionLoop& a, const SectionLoop& b) {
    return std::abs(a.area) > std::abs(b.area);
  });
  return loops;
}

std::optional<SectionLoop> CutSurface::CutNearest(const CutPlane& plane, double min_girth) const {
  std::optional<SectionLoop> best;
  double best_distance = std::numeric_limits<double>::infinity();
  for (SectionLoop& loop : Cut(plane)) {
    if (!loop.is_closed || loop.girth < min_girth) continue;
    const double distance = (loop.centroid - plane.origin).norm();
    if (distance >= best_distance) continue;
    best_distance = distance;
    best = std::move(loop);
  }
  return best;
}

}  // namespace capfit::body
