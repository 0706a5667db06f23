#include "core/body/surface_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace capfit::body {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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
  AddEdges(triangles);
  AddShortcuts(points);
}

void SurfaceGraph::AddEdges(std::span<const mesh::Triangle> triangles) {
  for (const mesh::Triangle& t : triangles) {
    for (const std::uint32_t corner : t) ++offsets_[corner + 1];
  }
  for (std::size_t v = 1; v < offsets_.size(); ++v) offsets_[v] += offsets_[v - 1];
  next_.resize(offsets_.back());
  third_.resize(offsets_.back());
  std::vector<std::uint32_t> slot(offsets_.begin(), offsets_.end() - 1);
  for (const mesh::Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t at = slot[t[k]]++;
      next_[at] = t[(k + 1) % 3];
      third_[at] = t[(k + 2) % 3];
    }
  }
}

void SurfaceGraph::AddShortcuts(std::span<const Eigen::Vector3d> points) {
  links_.resize(2 * next_.size());
  double total_length = 0.0;
  for (std::uint32_t v = 0; v + 1 < offsets_.size(); ++v) {
    for (std::uint32_t s = offsets_[v]; s < offsets_[v + 1]; ++s) {
      const std::uint32_t b = next_[s];
      const std::uint32_t c = third_[s];
      links_[2 * s] = {b, (points[b] - points[v]).norm()};
      links_[2 * s + 1] = {v, kInfinity};
      total_length += links_[2 * s].length;
      // The triangle on the other side of b-c starts at c and goes on to b.
      for (std::uint32_t o = offsets_[c]; o < offsets_[c + 1]; ++o) {
        if (next_[o] != b) continue;
        const std::uint32_t across = third_[o];
        links_[2 * s + 1] = {across,
                             UnfoldedLength(points[v], points[b], points[c], points[across])};
        break;
      }
    }
  }
  if (!next_.empty() && total_length > 0.0) {
    bucket_width_ = total_length / static_cast<double>(next_.size());
  }
}

// A queue of buckets as wide as the mean edge. Inside a bucket the order is free and a vertex may
// come up again; what counts is that nothing can be improved when the bucket is empty.
std::vector<double> SurfaceGraph::Distances(std::span<const GeodesicSource> sources) const {
  std::vector<double> distance(vertex_count(), kInfinity);
  std::vector<std::vector<std::uint32_t>> buckets(1);
  const auto bucket_of = [&](double d) { return static_cast<std::size_t>(d / bucket_width_); };
  for (const GeodesicSource& source : sources) {
    if (source.distance >= distance[source.vertex]) continue;
    distance[source.vertex] = source.distance;
    const std::size_t bucket = bucket_of(source.distance);
    if (bucket >= buckets.size()) buckets.resize(bucket + 1);
    buckets[bucket].push_back(source.vertex);
  }
  for (std::size_t k = 0; k < buckets.size(); ++k) {
    while (!buckets[k].empty()) {
      const std::uint32_t vertex = buckets[k].back();
      buckets[k].pop_back();
      if (bucket_of(distance[vertex]) == k) Relax(vertex, distance, buckets);
    }
  }
  return distance;
}

void SurfaceGraph::Relax(std::uint32_t vertex, std::vector<double>& distance,
                         std::vector<std::vector<std::uint32_t>>& buckets) const {
  const double here = distance[vertex];
  for (std::uint32_t s = 2 * offsets_[vertex]; s < 2 * offsets_[vertex + 1]; ++s) {
    const double candidate = here + links_[s].length;
    const std::uint32_t target = links_[s].target;
    if (candidate >= distance[target]) continue;
    distance[target] = candidate;
    const std::size_t bucket = static_cast<std::size_t>(candidate / bucket_width_);
    if (bucket >= buckets.size()) buckets.resize(bucket + 1);
    buckets[bucket].push_back(target);
  }
}

}  // namespace capfit::body
