#include "core/body/cross_section.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace capfit::body {
namespace {

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
    loop.outline.reserve(linked.pieces.size());
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

std::vector<SectionLoop> CutSurface::Cut(const CutPlane& plane) const {
  std::vector<SectionLoop> loops = LoopsOf(cutter_->Cut(plane.origin, plane.normal));
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
