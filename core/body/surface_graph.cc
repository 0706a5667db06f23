#include "core/body/surface_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace capfit::body {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kNone = std::numeric_limits<float>::infinity();

// Length of the straight line from p to q over the edge b-c once the triangles (p, b, c) and
// (q, c, b) lie flat; infinity when it would miss the edge.
double UnfoldedLength(const Eigen::Vector3d& p, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                      const Eigen::Vector3d& q) {
  const Eigen::Vector3d edge = c - b;
  const Eigen::Vector3d bp = p - b;
  const Eigen::Vector3d bq = q - b;
  const double edge_squared = edge.squaredNorm();
  if (edge_squared <= 0.0) return kInfinity;
  // Along the edge as a share of it; heights over it in the same unit.
  const double px = bp.dot(edge) / edge_squared;
  const double qx = bq.dot(edge) / edge_squared;
  const double py = std::sqrt(std::max(0.0, bp.squaredNorm() / edge_squared - px * px));
  const double qy = std::sqrt(std::max(0.0, bq.squaredNorm() / edge_squared - qx * qx));
  const double rise = py + qy;
  const double crossing = px * qy + qx * py;
  if (crossing < 0.0 || crossing > rise || rise <= 0.0) return kInfinity;
  return std::sqrt(((qx - px) * (qx - px) + rise * rise) * edge_squared);
}

}  // namespace

SurfaceGraph::SurfaceGraph(std::span<const Eigen::Vector3d> points,
                           std::span<const mesh::Triangle> triangles)
    : offsets_(points.size() + 1, 0) {
  AddEdges(points, triangles);
  AddShortcuts(points);
}

void SurfaceGraph::AddEdges(std::span<const Eigen::Vector3d> points,
                            std::span<const mesh::Triangle> triangles) {
  for (const mesh::Triangle& t : triangles) {
    for (const std::uint32_t corner : t) ++offsets_[corner + 1];
  }
  for (std::size_t v = 1; v < offsets_.size(); ++v) offsets_[v] += offsets_[v - 1];
  next_.resize(offsets_.back());
  after_.resize(offsets_.back());
  links_.resize(2 * next_.size());
  std::vector<std::uint32_t> free_slot(offsets_.begin(), offsets_.end() - 1);
  double total_length = 0.0;
  for (const mesh::Triangle& t : triangles) {
    const std::uint32_t slots[3] = {free_slot[t[0]]++, free_slot[t[1]]++, free_slot[t[2]]++};
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t to = t[(k + 1) % 3];
      const double length = (points[to] - points[t[k]]).norm();
      next_[slots[k]] = to;
      after_[slots[k]] = slots[(k + 1) % 3];
      links_[2 * slots[k]] = {to, static_cast<float>(length)};
      links_[2 * slots[k] + 1] = {t[k], -1.0f};
      total_length += length;
    }
  }
  if (total_length > 0.0) bucket_width_ = total_length / static_cast<double>(next_.size());
}

// Each shortcut is measured once, from the end that comes first, and entered at both.
void SurfaceGraph::AddShortcuts(std::span<const Eigen::Vector3d> points) {
  for (std::uint32_t v = 0; v + 1 < offsets_.size(); ++v) {
    for (std::uint32_t s = offsets_[v]; s < offsets_[v + 1]; ++s) {
      Link& shortcut = links_[2 * s + 1];
      if (shortcut.length >= 0.0f) continue;
      shortcut.length = kNone;
      const std::uint32_t b = next_[s];
      const std::uint32_t c = next_[after_[s]];
      // The triangle on the other side of b-c starts at c and goes on to b.
      std::uint32_t o = offsets_[c];
      while (o < offsets_[c + 1] && next_[o] != b) ++o;
      if (o == offsets_[c + 1]) continue;
      const std::uint32_t across = next_[after_[o]];
      const std::uint32_t opposite_slot = after_[after_[o]];
      const float length =
          static_cast<float>(UnfoldedLength(points[v], points[b], points[c], points[across]));
      shortcut = {across, length};
      links_[2 * opposite_slot + 1] = {v, length};
    }
  }
}

// A queue of buckets as wide as the mean edge. Inside a bucket the order is free and a vertex may
// come up again; what counts is that nothing can be improved when the bucket is empty.
std::vector<double> SurfaceGraph::Distances(std::span<const GeodesicSource> sources) const {
  std::vector<double> distance(vertex_count(), kInfinity);
  std::vector<std::vector<std::uint32_t>> buckets(1);
  const auto offer = [&](std::uint32_t vertex, double candidate) {
    if (candidate >= distance[vertex]) return;
    distance[vertex] = candidate;
    const std::size_t bucket = static_cast<std::size_t>(candidate / bucket_width_);
    if (bucket >= buckets.size()) buckets.resize(bucket + 1);
    buckets[bucket].push_back(vertex);
  };
  for (const GeodesicSource& source : sources) offer(source.vertex, source.distance);
  for (std::size_t k = 0; k < buckets.size(); ++k) {
    while (!buckets[k].empty()) {
      const std::uint32_t vertex = buckets[k].back();
      buckets[k].pop_back();
      const double here = distance[vertex];
      if (static_cast<std::size_t>(here / bucket_width_) != k) continue;  // went up earlier
      for (std::uint32_t s = 2 * offsets_[vertex]; s < 2 * offsets_[vertex + 1]; ++s) {
        offer(links_[s].target, here + links_[s].length);
      }
    }
  }
  return distance;
}

}  // namespace capfit::body
