#include "core/mesh/canonical_order.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>

namespace capfit::mesh {
namespace {

struct VertexKey {
  std::uint32_t key;  // the leading bits of y, in the order of y
  std::uint32_t vertex;
};

// Unsigned numbers in the order of the doubles. (Adding 0 makes -0 and 0 one.)
std::uint64_t SortableBits(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x + 0.0);
  const std::uint64_t sign = std::uint64_t{1} << 63;
  return (bits & sign) != 0 ? ~bits : bits | sign;
}

// One pass of a radix sort over eleven bits; keeps the order of equal ones.
void SortByDigit(int shift, std::vector<VertexKey>& keys, std::vector<VertexKey>& scratch) {
  constexpr std::size_t kBuckets = 1 << 11;
  std::vector<std::uint32_t> start(kBuckets + 1, 0);
  const auto bucket = [&](const VertexKey& k) { return (k.key >> shift) & (kBuckets - 1); };
  for (const VertexKey& k : keys) ++start[bucket(k) + 1];
  for (std::size_t b = 1; b <= kBuckets; ++b) start[b] += start[b - 1];
  for (const VertexKey& k : keys) scratch[start[bucket(k)]++] = k;
  keys.swap(scratch);
}

bool ComesFirst(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  if (a.y() != b.y()) return a.y() < b.y();
  if (a.z() != b.z()) return a.z() < b.z();
  return a.x() < b.x();
}

// The vertices in their new order.
std::vector<VertexKey> SortedVertices(const std::vector<Eigen::Vector3d>& vertices) {
  std::vector<VertexKey> keys(vertices.size());
  for (std::uint32_t v = 0; v < keys.size(); ++v) {
    keys[v] = {static_cast<std::uint32_t>(SortableBits(vertices[v].y()) >> 32), v};
  }
  std::vector<VertexKey> scratch(keys.size());
  for (const int shift : {0, 11, 22}) SortByDigit(shift, keys, scratch);
  for (auto first = keys.begin(); first != keys.end();) {
    const auto last =
        std::find_if(first, keys.end(), [&](const VertexKey& k) { return k.key != first->key; });
    if (last - first > 1) {
      std::stable_sort(first, last, [&](const VertexKey& a, const VertexKey& b) {
        return ComesFirst(vertices[a.vertex], vertices[b.vertex]);
      });
    }
    first = last;
  }
  return keys;
}

void RotateLowestFirst(Triangle& t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
}

// Counting sort by the first corner, then the few that share it.
void SortTriangles(std::size_t vertex_count, std::vector<Triangle>& triangles) {
  std::vector<std::uint32_t> start(vertex_count + 1, 0);
  for (const Triangle& t : triangles) ++start[t[0] + 1];
  for (std::size_t v = 1; v <= vertex_count; ++v) start[v] += start[v - 1];
  std::vector<Triangle> sorted(triangles.size());
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (const Triangle& t : triangles) sorted[next[t[0]]++] = t;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    std::sort(sorted.begin() + start[v], sorted.begin() + start[v + 1]);
  }
  triangles = std::move(sorted);
}

}  // namespace

std::vector<std::uint32_t> PutInCanonicalOrder(std::vector<Eigen::Vector3d>& vertices,
                                               std::vector<Triangle>& triangles) {
  const std::vector<VertexKey> keys = SortedVertices(vertices);
  std::vector<Eigen::Vector3d> sorted(vertices.size());
  std::vector<std::uint32_t> new_index(vertices.size());
  for (std::uint32_t v = 0; v < keys.size(); ++v) {
    sorted[v] = vertices[keys[v].vertex];
    new_index[keys[v].vertex] = v;
  }
  vertices = std::move(sorted);
  for (Triangle& t : triangles) {
    for (std::uint32_t& corner : t) corner = new_index[corner];
    RotateLowestFirst(t);
  }
  SortTriangles(vertices.size(), triangles);
  return new_index;
}

}  // namespace capfit::mesh
