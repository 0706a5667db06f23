#include "core/body/surface_graph.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "core/base/chunk_sums.h"

namespace capfit::body {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// How often a link may be looked at, on average, in buckets. A body needs less than two; a row of
// vertices much closer than a bucket is wide would ask for more the longer it is.
constexpr std::size_t kMostLooks = 6;
// Width of a bucket as a share of the mean edge: wider ones take vertices up again more often.
constexpr double kBucketShare = 1.0 / 3.0;

// Length of the straight line from p to q over the edge b-c once the triangles (p, b, c) and
// (q, c, b) lie flat; infinity when it would miss the edge.
double UnfoldedLength(const Eigen::Vector3d& p, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                      const Eigen::Vector3d& q) {
  const Eigen::Vector3d edge = c - b;
  const Eigen::Vector3d bp = p - b;
  const Eigen::Vector3d bq = q - b;
  const double edge_squared = edge.squaredNorm();
  // Along the edge and over it, times the edge's length.
  const double px = bp.dot(edge);
  const double qx = bq.dot(edge);
  const double py = std::sqrt(std::max(0.0, bp.squaredNorm() * edge_squared - px * px));
  const double qy = std::sqrt(std::max(0.0, bq.squaredNorm() * edge_squared - qx * qx));
  const double rise = py + qy;
  const double crossing = px * qy + qx * py;
  const double length = std::sqrt(((qx - px) * (qx - px) + rise * rise) / edge_squared);
  const bool is_over_the_edge =
      (crossing >= 0.0) & (crossing <= rise * edge_squared) & (rise > 0.0);
  return is_over_the_edge ? length : kInfinity;
}

}  // namespace

SurfaceGraph::SurfaceGraph(std::span<const Eigen::Vector3d> points,
                           std::span<const mesh::Triangle> triangles,
                           std::span<const mesh::HalfEdge> mates, const ThreadPool& pool)
    : offsets_(points.size() + 1, 0) {
  for (const mesh::Triangle& t : triangles) {
    for (const std::uint32_t corner : t) ++offsets_[corner + 1];
  }
  for (std::size_t v = 1; v < offsets_.size(); ++v) offsets_[v] += offsets_[v - 1];
  next_.resize(offsets_.back());
  links_.resize(offsets_.back());
  // Half-edge h starts at a corner; what leads over the edge after it goes out from there too.
  std::vector<std::uint32_t> slot(3 * triangles.size());
  std::vector<std::uint32_t> free_slot(offsets_.begin(), offsets_.end() - 1);
  mesh::HalfEdge h = 0;
  for (const mesh::Triangle& t : triangles) {
    for (const std::uint32_t corner : t) slot[h++] = free_slot[corner]++;
  }
  const Surface surface = {points, triangles, mates, slot};
  const double length =
      SumOverChunks(pool, triangles.size(), 0.0, [&](std::size_t begin, std::size_t end) {
        AddShortcuts(surface, 3 * begin, 3 * end);
        return AddEdges(surface, begin, end);
      });
  if (length > 0.0) bucket_width_ = kBucketShare * length / static_cast<double>(next_.size());
}

double SurfaceGraph::AddEdges(const Surface& surface, std::size_t begin, std::size_t end) {
  double total = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    const mesh::Triangle& t = surface.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t to = t[k == 2 ? 0 : k + 1];
      const std::uint32_t slot = surface.slot[3 * i + k];
      const double length = (surface.points[to] - surface.points[t[k]]).norm();
      next_[slot] = to;
      links_[slot].edge_length = static_cast<float>(length);
      total += length;
    }
  }
  return total;
}

// Each shortcut is measured once, from the end that comes first, and entered at both.
void SurfaceGraph::AddShortcuts(const Surface& surface, std::size_t begin, std::size_t end) {
  std::vector<mesh::HalfEdge> crossed(end - begin + 1);  // each edge once
  std::size_t count = 0;
  for (std::size_t h = begin; h < end; ++h) {
    crossed[count] = static_cast<mesh::HalfEdge>(h);
    count += surface.mates[h] != mesh::kNoMate && h < surface.mates[h] ? 1 : 0;
  }
  for (const mesh::HalfEdge h : std::span(crossed).first(count)) {
    mesh::HalfEdge here = mesh::PreviousInTriangle(h);
    mesh::HalfEdge there = mesh::PreviousInTriangle(surface.mates[h]);
    const auto key = [&](mesh::HalfEdge apex) {
      return std::pair(mesh::StartOf(surface.triangles, apex), surface.slot[apex]);
    };
    if (key(there) < key(here)) std::swap(here, there);
    const std::uint32_t p = mesh::StartOf(surface.triangles, here);
    const std::uint32_t q = mesh::StartOf(surface.triangles, there);
    const auto length = static_cast<float>(
        UnfoldedLength(surface.points[p], surface.points[mesh::EndOf(surface.triangles, here)],
                       surface.points[mesh::EndOf(surface.triangles, there)], surface.points[q]));
    links_[surface.slot[here]].across = q;
    links_[surface.slot[here]].across_length = length;
    links_[surface.slot[there]].across = p;
    links_[surface.slot[there]].across_length = length;
  }
}

// Dijkstra's own way: slower than buckets on bodies, but no mesh can make it look at a link twice.
void SurfaceGraph::FinishInOrder(const std::vector<std::vector<std::uint32_t>>& open,
                                 std::vector<double>& distance) const {
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const std::vector<std::uint32_t>& bucket : open) {
    for (const std::uint32_t vertex : bucket) queue.emplace(distance[vertex], vertex);
  }
  const auto offer = [&](std::uint32_t vertex, double candidate) {
    if (candidate >= distance[vertex]) return;
    distance[vertex] = candidate;
    queue.emplace(candidate, vertex);
  };
  while (!queue.empty()) {
    const auto [here, vertex] = queue.top();
    queue.pop();
    if (here > distance[vertex]) continue;
    for (std::uint32_t s = offsets_[vertex]; s < offsets_[vertex + 1]; ++s) {
      offer(next_[s], here + links_[s].edge_length);
      offer(links_[s].across, here + links_[s].across_length);
    }
  }
}

// A queue of buckets narrower than the mean edge. Inside a bucket the order is free and a vertex
// may come up again; what counts is that nothing can be improved when the bucket is empty.
std::vector<double> SurfaceGraph::Distances(std::span<const GeodesicSource> sources) const {
  std::vector<double> distance(vertex_count(), kInfinity);
  std::vector<std::vector<std::uint32_t>> buckets(1);
  const double buckets_per_unit = 1.0 / bucket_width_;
  std::size_t looks_left = kMostLooks * links_.size();
  const auto offer = [&](std::uint32_t vertex, double candidate) {
    if (candidate >= distance[vertex]) return;
    distance[vertex] = candidate;
    const std::size_t bucket = static_cast<std::size_t>(candidate * buckets_per_unit);
    if (bucket >= buckets.size()) buckets.resize(bucket + 1);
    buckets[bucket].push_back(vertex);
  };
  for (const GeodesicSource& source : sources) offer(source.vertex, source.distance);
  for (std::size_t k = 0; k < buckets.size(); ++k) {
    while (!buckets[k].empty()) {
      const std::uint32_t vertex = buckets[k].back();
      buckets[k].pop_back();
      const double here = distance[vertex];
      if (static_cast<std::size_t>(here * buckets_per_unit) != k) continue;  // went up earlier
      const std::size_t looks = offsets_[vertex + 1] - offsets_[vertex];
      if (looks > looks_left) {
        buckets[k].push_back(vertex);
        FinishInOrder(buckets, distance);
        return distance;
      }
      looks_left -= looks;
      for (std::uint32_t s = offsets_[vertex]; s < offsets_[vertex + 1]; ++s) {
        offer(next_[s], here + links_[s].edge_length);
        offer(links_[s].across, here + links_[s].across_length);
      }
    }
  }
  return distance;
}

}  // namespace capfit::body
