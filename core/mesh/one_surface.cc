#include "core/mesh/one_surface.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "core/base/chunk_sums.h"
#include "core/base/disjoint_sets.h"
#include "core/base/raw_vector.h"

namespace capfit::mesh {
namespace {

// How many triangles the ring around a corner has.
std::size_t CornersInRing(std::span<const HalfEdge> mates, HalfEdge corner) {
  std::size_t corners = 0;
  HalfEdge h = corner;
  do {
    ++corners;
    h = mates[PreviousInTriangle(h)];
  } while (h != corner);
  return corners;
}

// Whether the triangles at each vertex are one ring.
bool IsOneRingEach(std::span<const Triangle> triangles, std::span<const HalfEdge> mates,
                   std::size_t vertex_count, const ThreadPool& pool) {
  // One of each vertex, whichever: a ring is the same from all of its corners.
  std::vector<HalfEdge> corner(vertex_count, kNoMate);
  HalfEdge h = 0;
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) corner[v] = h++;
  }
  const auto walk = [&](std::size_t begin, std::size_t end) {
    std::size_t corners = 0;
    for (std::size_t v = begin; v < end; ++v) corners += CornersInRing(mates, corner[v]);
    return corners;
  };
  // A second ring at a vertex has corners that no walk meets.
  return SumOverChunks(pool, vertex_count, std::size_t{0}, walk) == mates.size();
}

bool UsesAllVertices(std::span<const Triangle> triangles, std::size_t vertex_count,
                     const ThreadPool& pool) {
  std::vector<char> is_used(vertex_count, 0);
  pool.ForChunks(triangles.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
    for (const Triangle& t : triangles.subspan(begin, end - begin)) {
      // Several threads may say so of one vertex.
      for (const std::uint32_t v : t) {
        std::atomic_ref(is_used[v]).store(1, std::memory_order_relaxed);
      }
    }
  });
  return std::find(is_used.begin(), is_used.end(), 0) == is_used.end();
}

// Two triangles at an edge.
struct Neighbours {
  std::uint32_t a;
  std::uint32_t b;
};

// Whether steps over edges lead from each triangle to every other. First each has a link to the
// lowest beside it, or to itself where there is no lower one: that leaves few edges between pieces.
bool HangsTogether(std::span<const HalfEdge> mates, const ThreadPool& pool) {
  RawVector<std::uint32_t> link(mates.size() / 3);
  pool.ForChunks(link.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const HalfEdge lowest = std::min({mates[3 * t], mates[3 * t + 1], mates[3 * t + 2]});
      link[t] = std::min(static_cast<std::uint32_t>(t), lowest / 3);
    }
  });
  std::size_t pieces = 0;
  for (std::uint32_t t = 0; t < link.size(); ++t) {
    if (link[t] == t) ++pieces;
    link[t] = link[link[t]];  // links lead down, so the lower triangle is at its end already
  }
  std::vector<RawVector<Neighbours>> borders((link.size() + kMeshChunk - 1) / kMeshChunk);
  pool.ForChunks(link.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
    RawVector<Neighbours> met(3 * (end - begin) + 1);
    std::size_t found = 0;
    for (std::size_t t = begin; t < end; ++t) {
      for (std::size_t h = 3 * t; h < 3 * t + 3; ++h) {
        met[found] = {link[t], link[mates[h] / 3]};
        found += met[found].b < met[found].a ? 1 : 0;
      }
    }
    // Only what was found is kept: room for all would be as much as the mates take.
    borders[begin / kMeshChunk].assign(met.begin(),
                                       met.begin() + static_cast<std::ptrdiff_t>(found));
  });
  for (const RawVector<Neighbours>& some : borders) {
    for (const Neighbours& border : some) {
      const std::uint32_t a = FollowLinks(link, border.a);
      const std::uint32_t b = FollowLinks(link, border.b);
      if (a == b) continue;
      link[std::max(a, b)] = std::min(a, b);
      --pieces;
    }
  }
  return pieces == 1;
}

}  // namespace

bool IsOneSurface(std::span<const Triangle> triangles, std::span<const HalfEdge> mates,
                  std::size_t vertex_count, const ThreadPool& pool) {
  bool hangs_together = false;
  bool uses_all = false;
  pool.ForEach(2, [&](std::size_t half) {
    if (half == 0) hangs_together = HangsTogether(mates, pool);
    if (half == 1) uses_all = UsesAllVertices(triangles, vertex_count, pool);
  });
  if (!hangs_together || !uses_all) return false;
  // By Euler's formula one surface has rings - triangles / 2 = 2 - 2 * handles, and as all vertices
  // are used there are no fewer rings than those. Without handles, no vertex has a second one.
  return 2 * vertex_count == triangles.size() + 4 ||
         IsOneRingEach(triangles, mates, vertex_count, pool);
}

}  // namespace capfit::mesh
