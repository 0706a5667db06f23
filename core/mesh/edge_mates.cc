#include "core/mesh/edge_mates.h"

#include <algorithm>

namespace capfit::mesh {
namespace {

// A half-edge as its edge's lower vertex sees it.
struct Spoke {
  std::uint32_t other_vertex;
  HalfEdge half_edge;
};

bool HasLowerEnd(const Spoke& a, const Spoke& b) {
  return a.other_vertex != b.other_vertex ? a.other_vertex < b.other_vertex
                                          : a.half_edge < b.half_edge;
}

// Spokes sorted by lower vertex: those of vertex v are [first[v], first[v + 1]). A counting sort:
// several times faster than hashing or sorting whole edges, and the same on every platform.
struct SpokesOfVertices {
  std::vector<std::uint32_t> first;
  std::vector<Spoke> spokes;
};

SpokesOfVertices SortSpokes(std::span<const Triangle> triangles, std::size_t vertex_count) {
  SpokesOfVertices sorted;
  sorted.first.assign(vertex_count + 2, 0);
  for (const Triangle& t : triangles) {
    ++sorted.first[std::min(t[0], t[1]) + 2];
    ++sorted.first[std::min(t[1], t[2]) + 2];
    ++sorted.first[std::min(t[2], t[0]) + 2];
  }
  for (std::size_t v = 2; v < sorted.first.size(); ++v) sorted.first[v] += sorted.first[v - 1];
  sorted.spokes.resize(3 * triangles.size());
  HalfEdge h = 0;
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k, ++h) {
      const std::uint32_t a = t[k];
      const std::uint32_t b = t[k == 2 ? 0 : k + 1];
      // first[v + 1] serves as the write position of v and ends as the start of v + 1.
      sorted.spokes[sorted.first[std::min(a, b) + 1]++] = {std::max(a, b), h};
    }
  }
  return sorted;
}

void RecordEdge(std::span<const Triangle> triangles, std::span<const Spoke> edge,
                EdgeMates& mates) {
  if (edge.size() == 1) {
    ++mates.open;
  } else if (edge.size() == 2) {
    const HalfEdge a = edge[0].half_edge;
    const HalfEdge b = edge[1].half_edge;
    mates.mate[a] = b;
    mates.mate[b] = a;
    if (StartOf(triangles, a) == StartOf(triangles, b)) ++mates.misdirected;
  } else {
    for (const Spoke& spoke : edge) mates.crowded.push_back(spoke.half_edge);
    mates.crowded_sizes.push_back(static_cast<std::uint32_t>(edge.size()));
  }
}

// The usual handful of spokes is sorted by insertion; a vertex with thousands needs better.
void SortByOtherVertex(std::span<Spoke> spokes) {
  if (spokes.size() > 24) {
    std::sort(spokes.begin(), spokes.end(), HasLowerEnd);
    return;
  }
  for (std::size_t i = 1; i < spokes.size(); ++i) {
    const Spoke moving = spokes[i];
    std::size_t k = i;
    for (; k > 0 && HasLowerEnd(moving, spokes[k - 1]); --k) spokes[k] = spokes[k - 1];
    spokes[k] = moving;
  }
}

}  // namespace

EdgeMates FindEdgeMates(std::span<const Triangle> triangles, std::size_t vertex_count) {
  SpokesOfVertices sorted = SortSpokes(triangles, vertex_count);
  EdgeMates mates;
  mates.mate.assign(3 * triangles.size(), kNoMate);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const std::span<Spoke> spokes =
        std::span(sorted.spokes).subspan(sorted.first[v], sorted.first[v + 1] - sorted.first[v]);
    SortByOtherVertex(spokes);
    for (std::size_t begin = 0, end = 0; begin < spokes.size(); begin = end) {
      while (end < spokes.size() && spokes[end].other_vertex == spokes[begin].other_vertex) ++end;
      RecordEdge(triangles, spokes.subspan(begin, end - begin), mates);
    }
  }
  return mates;
}

}  // namespace capfit::mesh
