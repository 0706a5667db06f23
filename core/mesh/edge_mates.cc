#include "core/mesh/edge_mates.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/base/sort_few.h"

namespace capfit::mesh {
namespace {

// Edges are dealt to drawers by their lower vertex, so many vertices to each: what a drawer holds
// stays in the processor's cache while it is sorted, and drawers are sorted side by side. Where
// triangles are listed by their lowest corners, two half-edges of each lie in the right drawer
// as they are, and only the one across from that corner is dealt.
constexpr int kDrawerBits = 10;
constexpr std::uint32_t kDrawerVertices = 1u << kDrawerBits;
constexpr std::size_t kMatesPerChunk = 8192;

// A half-edge as its edge's lower vertex sees it: twice its index, plus one where it comes in.
struct Spoke {
  std::uint32_t lower_vertex;
  std::uint32_t other_vertex;
  std::uint32_t half_edge_and_way;
};

// The other vertex and the half-edge in one number: the order of spokes at one vertex.
using SpokeKey = std::uint64_t;

SpokeKey KeyOf(const Spoke& spoke) {
  return (SpokeKey{spoke.other_vertex} << 32) | spoke.half_edge_and_way;
}
std::uint32_t OtherVertex(SpokeKey key) { return static_cast<std::uint32_t>(key >> 32); }
HalfEdge HalfEdgeOf(SpokeKey key) { return static_cast<std::uint32_t>(key) >> 1; }
bool RunSameWay(SpokeKey a, SpokeKey b) { return ((a ^ b) & 1u) == 0; }

class MateFinder {
 public:
  MateFinder(std::span<const Triangle> triangles, std::size_t vertex_count, const ThreadPool& pool,
             std::span<const std::uint32_t> first_triangle)
      : triangles_(triangles),
        first_triangle_(first_triangle),
        pool_(pool),
        drawer_count_((vertex_count + kDrawerVertices - 1) / kDrawerVertices),
        chunk_count_((triangles.size() + kMatesPerChunk - 1) / kMatesPerChunk),
        spokes_(std::make_unique_for_overwrite<Spoke[]>((first_triangle.empty() ? 3 : 1) *
                                                        triangles.size())),
        drawers_(drawer_count_) {
    mate_.resize(3 * triangles.size());
  }

  EdgeMates Run(const FitObserver& observer) {
    if (observer.IsCancelled()) return {};
    Deal();
    if (observer.IsCancelled()) return {};
    pool_.ForChunks(drawer_count_, 1, [this](std::size_t d, std::size_t) { PairWithin(d); });
    EdgeMates mates;
    mates.mate = std::move(mate_);
    for (const EdgeMates& drawer : drawers_) {
      mates.open += drawer.open;
      mates.misdirected += drawer.misdirected;
      mates.crowded.insert(mates.crowded.end(), drawer.crowded.begin(), drawer.crowded.end());
      mates.crowded_sizes.insert(mates.crowded_sizes.end(), drawer.crowded_sizes.begin(),
                                 drawer.crowded_sizes.end());
    }
    return mates;
  }

 private:
  [[nodiscard]] bool IsSorted() const { return !first_triangle_.empty(); }

  [[nodiscard]] Spoke SpokeOf(std::size_t triangle, std::size_t corner) const {
    const std::uint32_t from = triangles_[triangle][corner];
    const std::uint32_t to = triangles_[triangle][corner == 2 ? 0 : corner + 1];
    const auto half_edge = static_cast<HalfEdge>(3 * triangle + corner);
    return {std::min(from, to), std::max(from, to), 2 * half_edge + (from > to ? 1 : 0)};
  }

  // The spokes to be dealt.
  template <typename Visit>
  void VisitChunk(std::size_t begin, std::size_t end, const Visit& visit) const {
    if (IsSorted()) {
      for (std::size_t t = begin; t < end; ++t) visit(SpokeOf(t, 1));
      return;
    }
    for (std::size_t t = begin; t < end; ++t) {
      for (std::size_t k = 0; k < 3; ++k) visit(SpokeOf(t, k));
    }
  }

  // The spokes that belong to the drawer: those dealt to it, and those that lie in it.
  template <typename Visit>
  void VisitDrawer(std::size_t d, const Visit& visit) const {
    const std::uint32_t begin = d == 0 ? 0 : drawer_ends_[d - 1];
    for (std::uint32_t i = begin; i < drawer_ends_[d]; ++i) visit(spokes_[i]);
    if (!IsSorted()) return;
    const std::size_t vertices = first_triangle_.size() - 1;
    const std::uint32_t last = first_triangle_[std::min(vertices, (d + 1) * kDrawerVertices)];
    for (std::uint32_t t = first_triangle_[d * kDrawerVertices]; t < last; ++t) {
      visit(SpokeOf(t, 0));
      visit(SpokeOf(t, 2));
    }
  }

  // Chunk by chunk within each drawer, so that the order is that of the triangles.
  void Deal() {
    std::vector<std::uint32_t> place(chunk_count_ * drawer_count_, 0);
    const auto places_of = [&](std::size_t begin) {
      return place.data() + begin / kMatesPerChunk * drawer_count_;
    };
    pool_.ForChunks(triangles_.size(), kMatesPerChunk, [&](std::size_t begin, std::size_t end) {
      std::uint32_t* const count = places_of(begin);
      VisitChunk(begin, end, [&](const Spoke& s) { ++count[s.lower_vertex >> kDrawerBits]; });
    });
    std::uint32_t next = 0;
    for (std::size_t d = 0; d < drawer_count_; ++d) {
      for (std::size_t c = 0; c < chunk_count_; ++c) {
        next += std::exchange(place[c * drawer_count_ + d], next);
      }
      drawer_ends_.push_back(next);
    }
    pool_.ForChunks(triangles_.size(), kMatesPerChunk, [&](std::size_t begin, std::size_t end) {
      std::uint32_t* const next_of = places_of(begin);
      VisitChunk(begin, end,
                 [&](const Spoke& s) { spokes_[next_of[s.lower_vertex >> kDrawerBits]++] = s; });
    });
  }

  // A counting sort by lower vertex: faster than hashing, and the same on every platform.
  void PairWithin(std::size_t d) {
    std::array<std::uint32_t, kDrawerVertices + 2> first{};
    VisitDrawer(d, [&](const Spoke& s) { ++first[s.lower_vertex % kDrawerVertices + 2]; });
    for (std::size_t v = 2; v < first.size(); ++v) first[v] += first[v - 1];
    const auto sorted = std::make_unique_for_overwrite<SpokeKey[]>(first.back());
    // first[v + 1] serves as the write position of v and ends as the start of v + 1.
    VisitDrawer(d, [&](const Spoke& s) {
      sorted[first[s.lower_vertex % kDrawerVertices + 1]++] = KeyOf(s);
    });
    for (std::size_t v = 0; v < kDrawerVertices; ++v) {
      PairAtVertex({sorted.get() + first[v], first[v + 1] - first[v]}, drawers_[d]);
    }
  }

  void PairAtVertex(std::span<SpokeKey> spokes, EdgeMates& found) {
    SortFew(spokes);
    for (std::size_t begin = 0, end = 0; begin < spokes.size(); begin = end) {
      while (end < spokes.size() && OtherVertex(spokes[end]) == OtherVertex(spokes[begin])) ++end;
      RecordEdge(spokes.subspan(begin, end - begin), found);
    }
  }

  void RecordEdge(std::span<const SpokeKey> edge, EdgeMates& found) {
    if (edge.size() != 2) {
      for (const SpokeKey spoke : edge) mate_[HalfEdgeOf(spoke)] = kNoMate;
    }
    if (edge.size() == 1) {
      ++found.open;
    } else if (edge.size() == 2) {
      const HalfEdge a = HalfEdgeOf(edge[0]);
      const HalfEdge b = HalfEdgeOf(edge[1]);
      mate_[a] = b;
      mate_[b] = a;
      if (RunSameWay(edge[0], edge[1])) ++found.misdirected;
    } else {
      for (const SpokeKey spoke : edge) found.crowded.push_back(HalfEdgeOf(spoke));
      found.crowded_sizes.push_back(static_cast<std::uint32_t>(edge.size()));
    }
  }

  std::span<const Triangle> triangles_;
  std::span<const std::uint32_t> first_triangle_;
  const ThreadPool& pool_;
  std::size_t drawer_count_;
  std::size_t chunk_count_;
  std::unique_ptr<Spoke[]> spokes_;
  std::vector<std::uint32_t> drawer_ends_;
  std::vector<EdgeMates> drawers_;  // without mates
  RawVector<HalfEdge> mate_;        // each half-edge is in one edge, which fills its place
};

}  // namespace

EdgeMates FindEdgeMates(std::span<const Triangle> triangles, std::size_t vertex_count,
                        const ThreadPool& pool, const FitObserver& observer,
                        std::span<const std::uint32_t> first_triangle) {
  return MateFinder(triangles, vertex_count, pool, first_triangle).Run(observer);
}

}  // namespace capfit::mesh
