#include "core/mesh/one_surface.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/base/chunk_sums.h"
#include "core/base/disjoint_sets.h"

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
  // One of each vertex, whichever: a ring is the same from all of its corners. By one thread: two
  // that write all over the same array are slower than one.
  std::vector<HalfEdge> corner(vertex_count, kNoMate);
  HalfEdge h = 0;
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) corner[v] = h++;
  }
  const auto walk = [&](std::size_t begin, std::size_t end) {
    std::size_t corners = 0;
    for (std::size_t v = begin; v < end; ++v) {
      if (corner[v] != kNoMate) corners += CornersInRing(mates, corner[v]);
    }
    return corners;
  };
  // A second ring at a vertex has corners that no walk meets.
  return SumOverChunks(pool, vertex_count, std::size_t{0}, walk) == mates.size();
}

// Whether edges lead from each vertex to every other; an unused vertex is a piece. First each has a
// link to its lowest neighbour, or to itself where there is no lower one.
bool HangsTogether(std::span<const Triangle> triangles, std::size_t vertex_count) {
  std::vector<std::uint32_t> link(vertex_count);
  std::iota(link.begin(), link.end(), 0u);
  for (const Triangle& t : triangles) {
    const std::uint32_t lowest = std::min({t[0], t[1], t[2]});
    for (const std::uint32_t v : t) link[v] = std::min(link[v], lowest);
  }
  std::size_t pieces = 0;
  for (std::uint32_t v = 0; v < link.size(); ++v) {
    if (link[v] == v) ++pieces;
    link[v] = link[link[v]];  // links lead down, so the lower vertex is at its end already
  }
  for (const Triangle& t : triangles) {
    if (pieces == 1) return true;
    for (const std::uint32_t v : {t[1], t[2]}) {
      if (link[v] == link[t[0]]) continue;
      const std::uint32_t a = FollowLinks(link, t[0]);
      const std::uint32_t b = FollowLinks(link, v);
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
  bool is_one_ring_each = false;
  pool.ForEach(2, [&](std::size_t half) {
    if (half == 0) hangs_together = HangsTogether(triangles, vertex_count);
    if (half == 1) is_one_ring_each = IsOneRingEach(triangles, mates, vertex_count, pool);
  });
  return hangs_together && is_one_ring_each;
}

}  // namespace capfit::mesh
