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
// How often a link of a region may be looked at, on average, in buckets. A body needs less than
// two; a row of vertices much closer than a bucket is wide would ask for more the longer it is, and
// each look from a hub may leave a vertex to be taken up again.
constexpr std::size_t kMostLooks = 4;
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
                           std::span<const mesh::HalfEdge> mates, const ThreadPool& pool,
                           const FitObserver& observer)
    : offsets_(points.size() + 1, 0) {
  for (const mesh::Triangle& t : triangles) {
    for (const std::uint32_t corner : t) ++offsets_[corner + 1];
  }
  for (std::size_t v = 1; v < offsets_.size(); ++v) offsets_[v] += offsets_[v - 1];
  region_.resize(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    region_[v] = points[v].x() < 0.0 ? 1 : 0;
    region_links_[region_[v]] += offsets_[v + 1] - offsets_[v];
  }
  if (observer.IsCancelled()) return;
  next_.resize(offsets_.back());
  links_.resize(offsets_.back());
  // Half-edge h starts at a corner; what leads over the edge after it goes out from there too.
  std::vector<std::uint32_t> slot(3 * triangles.size());
  std::vector<std::uint32_t> free_slot(offsets_.begin(), offsets_.end() - 1);
  mesh::HalfEdge h = 0;
  for (const mesh::Triangle& t : triangles) {
    for (const std::uint32_t corner : t) slot[h++] = free_slot[corner]++;
  }
  if (observer.IsCancelled()) return;
  const Surface surface = {points, triangles, mates, slot};
  const double length =
      SumOverChunks(pool, triangles.size(), 0.0, [&](std::size_t begin, std::size_t end) {
        if (observer.IsCancelled()) return 0.0;
        AddShortcuts(surface, begin, end);
        return AddEdges(surface, begin, end);
      });
  if (length > 0.0) {
    buckets_per_unit_ = static_cast<double>(next_.size()) / (kBucketShare * length);
  }
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
  struct Apex {
    std::uint32_t vertex;
    std::uint32_t slot;
    std::uint32_t next;  // the corner after it

    bool operator<(const Apex& other) const {
      return std::pair(vertex, slot) < std::pair(other.vertex, other.slot);
    }
  };
  const auto opposite = [&](std::size_t triangle, std::size_t edge) -> Apex {
    const mesh::Triangle& t = surface.triangles[triangle];
    const std::size_t k = edge == 0 ? 2 : edge - 1;
    return {t[k], surface.slot[3 * triangle + k], t[edge]};
  };
  for (std::size_t i = begin; i < end; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const mesh::HalfEdge mate = surface.mates[3 * i + k];
      if (mate == mesh::kNoMate || mate < 3 * i + k) continue;
      Apex here = opposite(i, k);
      Apex there = opposite(mate / 3, mate % 3);
      if (there < here) std::swap(here, there);
      const auto length = static_cast<float>(
          UnfoldedLength(surface.points[here.vertex], surface.points[here.next],
                         surface.points[there.next], surface.points[there.vertex]));
      links_[here.slot].across = there.vertex;
      links_[here.slot].across_length = length;
      links_[there.slot].across = here.vertex;
      links_[there.slot].across_length = length;
    }
  }
}

// Dijkstra's own way: slower than buckets on bodies, but no mesh can make it look at a link twice,
// so a vertex that waits in many buckets must be taken up once.
void SurfaceGraph::FinishInOrder(std::span<const std::uint32_t> open,
                                 std::vector<double>& distance) const {
  std::vector<bool> is_queued(distance.size(), false);
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const std::uint32_t vertex : open) {
    if (is_queued[vertex]) continue;
    is_queued[vertex] = true;
    queue.emplace(distance[vertex], vertex);
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

// A queue of buckets narrower than the mean edge, for the vertices of one region. Inside a bucket
// the order is free and a vertex may come up again; what counts is that nothing can be improved
// when the bucket is empty.
class SurfaceGraph::Search {
 public:
  Search(const SurfaceGraph& graph, std::uint8_t region, const FitObserver& observer,
         std::vector<double>& distance, std::vector<char>& waits)
      : graph_(graph),
        region_(region),
        observer_(observer),
        distance_(distance),
        waits_(waits),
        looks_left_(kMostLooks * graph.region_links_[region]) {}

  void Offer(std::uint32_t vertex, double candidate) {
    if (candidate < distance_[vertex]) Improve(vertex, candidate);
  }

  // Until nothing can be improved within the region, or there were too many looks, or nobody waits.
  void Run() {
    for (std::size_t k = first_; k < buckets_.size() && !observer_.IsCancelled(); ++k) {
      while (!buckets_[k].empty()) {
        const std::uint32_t vertex = buckets_[k].back();
        const std::size_t looks = graph_.offsets_[vertex + 1] - graph_.offsets_[vertex];
        if (looks > looks_left_) return;
        looks_left_ -= looks;
        buckets_[k].pop_back();
        // It may have come up in a bucket before, or in this one when it was put there again.
        if (std::exchange(waits_[vertex], 0) != 0) LeaveFrom(vertex, distance_[vertex]);
      }
      if (buckets_[k].capacity() > 0) spare_.push_back(std::exchange(buckets_[k], {}));
    }
    first_ = buckets_.size();
  }

  // The vertices that may still improve others in the region: some only where Run gave up.
  [[nodiscard]] std::vector<std::uint32_t> Open() const {
    std::vector<std::uint32_t> open;
    for (const std::vector<std::uint32_t>& bucket : buckets_) {
      open.insert(open.end(), bucket.begin(), bucket.end());
    }
    return open;
  }

  // What Run offers to vertices of other regions since this was asked last.
  [[nodiscard]] std::vector<GeodesicSource> TakeDeparting() {
    return std::exchange(departing_, {});
  }

 private:
  void Improve(std::uint32_t vertex, double candidate) {
    distance_[vertex] = candidate;
    waits_[vertex] = 1;
    // By way of a signed number: processors have no quick way to an unsigned one.
    const auto bucket =
        static_cast<std::size_t>(static_cast<std::int64_t>(candidate * graph_.buckets_per_unit_));
    if (bucket >= buckets_.size()) buckets_.resize(bucket + 1);
    if (buckets_[bucket].capacity() == 0 && !spare_.empty()) {
      buckets_[bucket].swap(spare_.back());
      spare_.pop_back();
    }
    buckets_[bucket].push_back(vertex);
    first_ = std::min(first_, bucket);
  }

  void LeaveFrom(std::uint32_t vertex, double here) {
    const auto pass_on = [this](std::uint32_t to, double candidate) {
      if (graph_.region_[to] == region_) {
        Offer(to, candidate);
      } else {
        departing_.push_back({to, candidate});
      }
    };
    for (std::uint32_t s = graph_.offsets_[vertex]; s < graph_.offsets_[vertex + 1]; ++s) {
      pass_on(graph_.next_[s], here + graph_.links_[s].edge_length);
      pass_on(graph_.links_[s].across, here + graph_.links_[s].across_length);
    }
  }

  const SurfaceGraph& graph_;
  std::uint8_t region_;
  const FitObserver& observer_;
  std::vector<double>& distance_;  // of this region's vertices
  std::vector<char>& waits_;       // those that have not passed on how near they are
  std::size_t looks_left_;
  std::size_t first_ = 0;  // no bucket before it holds anything
  std::vector<std::vector<std::uint32_t>> buckets_;
  std::vector<std::vector<std::uint32_t>> spare_;  // memory of buckets that are done
  std::vector<GeodesicSource> departing_;
};

// The shortest paths are the same in whatever order they are found, so regions are searched side by
// side, and again with what came in over their borders until nothing does.
std::vector<double> SurfaceGraph::Distances(std::span<const GeodesicSource> sources,
                                            const ThreadPool& pool,
                                            const FitObserver& observer) const {
  std::vector<double> distance(vertex_count(), kInfinity);
  std::vector<char> waits(vertex_count(), 0);
  std::vector<Search> searches;
  for (std::uint8_t region = 0; region < kRegions; ++region) {
    searches.emplace_back(*this, region, observer, distance, waits);
  }
  std::vector<GeodesicSource> arriving(sources.begin(), sources.end());
  while (!arriving.empty()) {
    for (const GeodesicSource& s : arriving) {
      searches[region_[s.vertex]].Offer(s.vertex, s.distance);
    }
    pool.ForEach(kRegions, [&](std::size_t region) { searches[region].Run(); });
    if (observer.IsCancelled()) break;
    arriving.clear();
    std::vector<std::uint32_t> open;
    for (Search& search : searches) {
      for (const GeodesicSource& s : search.TakeDeparting()) arriving.push_back(s);
      for (const std::uint32_t vertex : search.Open()) open.push_back(vertex);
    }
    if (open.empty()) continue;
    for (const GeodesicSource& s : arriving) {
      distance[s.vertex] = std::min(distance[s.vertex], s.distance);
      open.push_back(s.vertex);
    }
    FinishInOrder(open, distance);
    break;
  }
  return distance;
}

}  // namespace capfit::body
