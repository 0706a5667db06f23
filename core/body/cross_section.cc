#include "core/body/cross_section.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/mesh/plane_cut.h"

namespace capfit::body {
namespace {

constexpr std::size_t kGroupSize = 8;
constexpr std::size_t kBlocksPerTask = 64;
constexpr std::size_t kUsualPieces = 256;
// Rounding must not lose a triangle that just touches the plane.
constexpr double kBoxSlack = 1.000001;
constexpr double kRounding = 1e-12;

struct Bounds {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;

  void Add(const Eigen::Vector3d& least, const Eigen::Vector3d& most) {
    low = low.cwiseMin(least);
    high = high.cwiseMax(most);
  }
};

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

std::vector<SectionLoop> LoopsOf(const std::vector<mesh::CutPiece>& pieces) {
  std::vector<SectionLoop> loops;
  for (const mesh::CutLoop& linked : mesh::LinkPieces(pieces)) {
    SectionLoop& loop = loops.emplace_back();
    loop.is_closed = linked.is_closed;
    for (const std::uint32_t piece : linked.pieces) loop.outline.push_back(pieces[piece].start);
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
                       std::span<const mesh::Triangle> triangles, const ThreadPool& pool)
    : points_(points), triangles_(triangles) {
  groups_.resize((triangles.size() + kGroupSize - 1) / kGroupSize);
  blocks_.resize((groups_.size() + kGroupSize - 1) / kGroupSize);
  pool.ForChunks(blocks_.size(), kBlocksPerTask, [this](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      Bounds block;
      for (std::size_t g = b * kGroupSize; g < std::min((b + 1) * kGroupSize, groups_.size());
           ++g) {
        Bounds group;
        for (std::size_t i = g * kGroupSize; i < std::min((g + 1) * kGroupSize, triangles_.size());
             ++i) {
          for (const std::uint32_t v : triangles_[i]) group.Add(points_[v], points_[v]);
        }
        groups_[g] = {0.5 * (group.low + group.high), 0.5 * (group.high - group.low)};
        block.Add(groups_[g].center - groups_[g].half, groups_[g].center + groups_[g].half);
      }
      blocks_[b] = {0.5 * (block.low + block.high), 0.5 * (block.high - block.low)};
    }
  });
}

std::vector<SectionLoop> CutSurface::Cut(const CutPlane& plane) const {
  std::vector<mesh::CutPiece> pieces;
  pieces.reserve(kUsualPieces);
  const Eigen::Vector3d steepness = kBoxSlack * plane.normal.cwiseAbs();
  const double offset = plane.normal.dot(plane.origin);
  const auto touches = [&](const Box& box) {
    return std::abs(plane.normal.dot(box.center) - offset) <= steepness.dot(box.half) + kRounding;
  };
  const auto height = [&](std::uint32_t v) { return plane.Height(points_[v]); };
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (!touches(blocks_[b])) continue;
    const std::size_t last_group = std::min((b + 1) * kGroupSize, groups_.size());
    for (std::size_t g = b * kGroupSize; g < last_group; ++g) {
      if (!touches(groups_[g])) continue;
      const std::size_t last = std::min((g + 1) * kGroupSize, triangles_.size());
      for (std::size_t i = g * kGroupSize; i < last; ++i) {
        const mesh::Triangle& t = triangles_[i];
        mesh::CutTriangle(points_, t, {height(t[0]), height(t[1]), height(t[2])}, pieces);
      }
    }
  }
  std::vector<SectionLoop> loops = LoopsOf(pieces);
  for (SectionLoop& loop : loops) Measure(loop, plane.normal);
  std::stable_sort(loops.begin(), loops.end(), [](const SectionLoop& a, const SectionLoop& b) {
    return std::abs(a.area) > std::abs(b.area);
  });
  return loops;
}

std::vector<std::vector<SectionLoop>> CutSurface::CutAll(std::span<const CutPlane> planes,
                                                         const ThreadPool& pool) const {
  std::vector<std::vector<SectionLoop>> sections(planes.size());
  pool.ForEach(planes.size(), [&](std::size_t i) { sections[i] = Cut(planes[i]); });
  return sections;
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
