#include "core/mesh/one_surface.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/base/chunk_sums.h"
#include "core/base/disjoint_sets.h"

namespace capfit::mesh {
namespace {

// The ring of triangles around a corner: their number, and the lowest vertex on it.
struct Ring {
  std::size_t corners = 0;
  std::uint32_t lowest = 0;
};

Ring WalkRing(std::span<const Triangle> triangles, std::span<const HalfEdge> mates,
              HalfEdge corner) {
  Ring ring = {0, StartOf(triangles, corner)};
  HalfEdge h = corner;
  do {
    ++ring.corners;
    const HalfEdge before = PreviousInTriangle(h);
    ring.lowest = std::min(ring.lowest, StartOf(triangles, before));
    h = mates[before];
  } while (h != corner);
  return ring;
}

}  // namespace

std::optional<std::vector<std::uint32_t>> LowestInRings(std::span<const Triangle> triangles,
                                                        std::span<const HalfEdge> mates,
                                                        std::size_t vertex_count,
                                                        const ThreadPool& pool) {
  // One of each vertex, whichever: a ring is the same from all of its corners. By one thread: two
  // that write all over the same array are slower than one.
  std::vector<HalfEdge> corner(vertex_count, kNoMate);
  HalfEdge h = 0;
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) corner[v] = h++;
  }
  std::vector<std::uint32_t> lowest_around(vertex_count);
  const auto walk = [&](std::size_t begin, std::size_t end) {
    std::size_t corners = 0;
    for (std::size_t v = begin; v < end; ++v) {
      lowest_around[v] = static_cast<std::uint32_t>(v);
      if (corner[v] == kNoMate) continue;
      const Ring ring = WalkRing(triangles, mates, corner[v]);
      lowest_around[v] = ring.lowest;
      corners += ring.corners;
    }
    return corners;
  };
  // A second ring at a vertex has corners that no walk meets.
  if (SumOverChunks(pool, vertex_count, std::size_t{0}, walk) != mates.size()) return std::nullopt;
  return lowest_around;
}

// The link of each vertex leads to its lowest neighbour, or to itself where there is no lower one
// (an unused vertex is a piece).
bool HangsTogether(std::span<const Triangle> triangles, std::vector<std::uint32_t> link) {
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

bool IsOneSurface(std::span<const Triangle> triangles, std::span<const HalfEdge> mates,
                  std::size_t vertex_count, const ThreadPool& pool) {
  std::optional<std::vector<std::uint32_t>> lowest =
      LowestInRings(triangles, mates, vertex_count, pool);
  return lowest && HangsTogether(triangles, *std::move(lowest));
}

}  // namespace capfit::mesh
