#include "core/body/working_copy.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/base/chunk_sums.h"
#include "core/body/snap.h"

namespace capfit::body {
namespace {

constexpr int kBitsPerAxis = 8;

// Spreads the low 8 bits so that two zero bits follow each.
std::uint32_t Spread(std::uint32_t x) {
  x = (x | (x << 8)) & 0x0000F00Fu;
  x = (x | (x << 4)) & 0x000C30C3u;
  return (x | (x << 2)) & 0x00249249u;
}

constexpr std::size_t kDigits = 4096;
constexpr std::size_t kSortChunk = 4 * kMeshChunk;
// Of the vertices, for each thread one; each looks at all triangles, so that more would only work
// more.
constexpr std::size_t kLeastShare = 8192;
constexpr int kMostShares = 4;

// The key of a vertex in the upper half, its index in the lower.
using KeyedVertex = std::uint64_t;

std::uint32_t KeyOf(KeyedVertex v) { return static_cast<std::uint32_t>(v >> 32); }

// One pass of a counting sort: `order` by 12 bits of the keys.
void SortByDigit(int shift, const ThreadPool& pool, std::vector<KeyedVertex>& order) {
  const auto digit = [&](KeyedVertex v) { return (KeyOf(v) >> shift) & (kDigits - 1); };
  const std::size_t chunks = (order.size() + kSortChunk - 1) / kSortChunk;
  std::vector<std::uint32_t> place(chunks * kDigits, 0);
  pool.ForChunks(order.size(), kSortChunk, [&](std::size_t begin, std::size_t end) {
    std::uint32_t* const count = place.data() + begin / kSortChunk * kDigits;
    for (std::size_t i = begin; i < end; ++i) ++count[digit(order[i])];
  });
  std::uint32_t next = 0;
  for (std::size_t d = 0; d < kDigits; ++d) {
    for (std::size_t c = 0; c < chunks; ++c) next += std::exchange(place[c * kDigits + d], next);
  }
  std::vector<KeyedVertex> sorted(order.size());
  pool.ForChunks(order.size(), kSortChunk, [&](std::size_t begin, std::size_t end) {
    std::uint32_t* const place_of = place.data() + begin / kSortChunk * kDigits;
    for (std::size_t i = begin; i < end; ++i) sorted[place_of[digit(order[i])]++] = order[i];
  });
  order.swap(sorted);
}

// Along the curve; at the same place of it by coordinates.
std::vector<std::uint32_t> SortByKey(std::vector<KeyedVertex> order,
                                     const std::vector<Eigen::Vector3d>& points,
                                     const ThreadPool& pool) {
  for (const int shift : {0, 12}) SortByDigit(shift, pool, order);
  const auto comes_first = [&](std::uint32_t a, std::uint32_t b) {
    const Eigen::Vector3d& p = points[a];
    const Eigen::Vector3d& q = points[b];
    if (p.y() != q.y()) return p.y() < q.y();
    if (p.z() != q.z()) return p.z() < q.z();
    return p.x() != q.x() ? p.x() < q.x() : a < b;
  };
  std::vector<std::uint32_t> sorted(order.size());
  pool.ForChunks(order.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; ++first) {
      // A run that began in the chunk before was sorted there.
      if (first > 0 && KeyOf(order[first - 1]) == KeyOf(order[first])) continue;
      std::size_t last = first;
      for (; last < order.size() && KeyOf(order[last]) == KeyOf(order[first]); ++last) {
        sorted[last] = static_cast<std::uint32_t>(order[last]);
      }
      std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(first),
                sorted.begin() + static_cast<std::ptrdiff_t>(last), comes_first);
    }
  });
  return sorted;
}

std::vector<KeyedVertex> CurveKeys(const std::vector<Eigen::Vector3d>& points,
                                   const ThreadPool& pool) {
  Eigen::Vector3d low = points.front();
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double cells = (1u << kBitsPerAxis) - 1;
  const double side = std::max((high - low).maxCoeff(), std::numeric_limits<double>::min());
  std::vector<KeyedVertex> keys(points.size());
  pool.ForChunks(points.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Eigen::Vector3d at = (points[v] - low) * (cells / side);
      const std::uint32_t key = Spread(static_cast<std::uint32_t>(at.x())) |
                                Spread(static_cast<std::uint32_t>(at.y())) << 1 |
                                Spread(static_cast<std::uint32_t>(at.z())) << 2;
      keys[v] = KeyedVertex{key} << 32 | v;
    }
  });
  return keys;
}

// A triangle and one of its corners in one number, quicker to take apart than a half-edge.
using TriangleCorner = std::uint32_t;

TriangleCorner CornerOf(std::uint32_t triangle, std::uint32_t corner) {
  return 4 * triangle + corner;
}
// The sum of two corners' numbers as a corner again.
std::uint32_t Wrapped(std::uint32_t corner) { return corner < 3 ? corner : corner - 3; }

// A triangle of the working copy whose lowest corner is known: the next two in one number, and the
// mesh's corner that comes first.
struct RenamedTriangle {
  std::uint64_t next_corners;
  TriangleCorner source;
};

// Triangles of vertices in a new order, sorted by their corners in it, and their mates.
class TriangleSorter {
 public:
  TriangleSorter(const mesh::BodyMesh& mesh, const ThreadPool& pool, const FitObserver& observer,
                 WorkingCopy& copy)
      : mesh_(mesh), pool_(pool), observer_(observer), copy_(copy) {}

  void Run() {
    const std::size_t count = mesh_.triangles().size();
    Deal();
    if (observer_.IsCancelled()) return;
    copy_.triangles.resize(count);
    gone_to_.resize(count);
    pool_.ForChunks(rank_.size(), kMeshChunk,
                    [this](std::size_t begin, std::size_t end) { SortAround(begin, end); });
    if (observer_.IsCancelled()) return;
    copy_.mates.resize(3 * count);
    ForEachOf(count, [this](std::uint32_t i) { CopyMates(i); });
  }

 private:
  template <typename Visit>
  void ForEachOf(std::size_t count, const Visit& visit) const {
    pool_.ForChunks(count, kMeshChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) visit(static_cast<std::uint32_t>(i));
    });
  }

  // Deals the triangles to their lowest corners: those of vertex v are
  // dealt_[first_triangle[v]] up to that of v + 1.
  void Deal() {
    const std::size_t count = mesh_.triangles().size();
    rank_.resize(copy_.mesh_vertex.size());
    ForEachOf(rank_.size(), [this](std::uint32_t i) { rank_[copy_.mesh_vertex[i]] = i; });
    std::vector<std::uint32_t> lowest(count);
    std::vector<RenamedTriangle> renamed(count);
    ForEachOf(count, [&](std::uint32_t i) { renamed[i] = Renamed(i, lowest[i]); });
    if (observer_.IsCancelled()) return;
    std::vector<std::uint32_t>& first = copy_.first_triangle;
    first.assign(rank_.size() + 1, 0);
    ForShares(lowest, [&](std::uint32_t v, std::size_t) { ++first[v]; });
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    dealt_.resize(count);
    // The ends become the starts.
    ForShares(lowest, [&](std::uint32_t v, std::size_t i) { dealt_[--first[v]] = renamed[i]; });
  }

  // Calls visit(lowest[i], i) for all i: each thread for those of its share of the vertices, as
  // looking at all costs little.
  template <typename Visit>
  void ForShares(std::span<const std::uint32_t> lowest, const Visit& visit) const {
    const auto most = static_cast<std::size_t>(std::min(kMostShares, pool_.threads()));
    const std::size_t shares = std::clamp<std::size_t>(rank_.size() / kLeastShare, 1, most);
    pool_.ForChunks(shares, 1, [&](std::size_t share, std::size_t) {
      const auto begin = static_cast<std::uint32_t>(rank_.size() * share / shares);
      const auto end = static_cast<std::uint32_t>(rank_.size() * (share + 1) / shares);
      for (std::size_t i = 0; i < lowest.size(); ++i) {
        if (lowest[i] - begin < end - begin) visit(lowest[i], i);
      }
    });
  }

  [[nodiscard]] RenamedTriangle Renamed(std::uint32_t triangle, std::uint32_t& lowest) const {
    const mesh::Triangle& t = mesh_.triangles()[triangle];
    const mesh::Triangle ranks = {rank_[t[0]], rank_[t[1]], rank_[t[2]]};
    lowest = std::min({ranks[0], ranks[1], ranks[2]});
    const std::uint32_t k = (ranks[1] == lowest ? 1 : 0) + (ranks[2] == lowest ? 2 : 0);
    return {(std::uint64_t{ranks[Wrapped(k + 1)]} << 32) | ranks[Wrapped(k + 2)],
            CornerOf(triangle, k)};
  }

  // Those at the vertices in [begin, end).
  void SortAround(std::size_t begin, std::size_t end) {
    const auto comes_first = [](const RenamedTriangle& a, const RenamedTriangle& b) {
      return a.next_corners < b.next_corners;
    };
    for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v) {
      const std::uint32_t first = copy_.first_triangle[v];
      const std::uint32_t last = copy_.first_triangle[v + 1];
      std::sort(dealt_.begin() + first, dealt_.begin() + last, comes_first);
      for (std::uint32_t i = first; i < last; ++i) {
        const RenamedTriangle& t = dealt_[i];
        copy_.triangles[i] = {v, static_cast<std::uint32_t>(t.next_corners >> 32),
                              static_cast<std::uint32_t>(t.next_corners)};
        gone_to_[t.source / 4] = CornerOf(i, Wrapped(3 - t.source % 4));
      }
    }
  }

  void CopyMates(std::uint32_t i) {
    const TriangleCorner source = dealt_[i].source;
    const mesh::HalfEdge* const mates = mesh_.mates().data() + 3 * std::size_t{source / 4};
    for (std::uint32_t k = 0; k < 3; ++k) {
      const mesh::HalfEdge mate = mates[Wrapped(source % 4 + k)];
      const TriangleCorner first = mate == mesh::kNoMate ? 0 : gone_to_[mate / 3];
      const mesh::HalfEdge here = 3 * (first / 4) + Wrapped(first % 4 + mate % 3);
      copy_.mates[3 * i + k] = mate == mesh::kNoMate ? mate : here;
    }
  }

  const mesh::BodyMesh& mesh_;
  const ThreadPool& pool_;
  const FitObserver& observer_;
  WorkingCopy& copy_;
  std::vector<std::uint32_t> rank_;  // of the mesh's vertices
  std::vector<RenamedTriangle> dealt_;
  // Where the first corner of each of the mesh's triangles has gone; the others follow it round.
  std::vector<TriangleCorner> gone_to_;
};

// Adds up term(point).
template <typename Sum, typename Term>
Sum SumOf(std::span<const Eigen::Vector3d> points, const ThreadPool& pool, const Sum& zero,
          const Term& term) {
  return SumOverChunks(pool, points.size(), zero, [&](std::size_t begin, std::size_t end) {
    Sum sum = zero;
    for (const Eigen::Vector3d& p : points.subspan(begin, end - begin)) sum += term(p);
    return sum;
  });
}

// Rows: the directions in which the points spread most, second most and least; right-handed. The
// first and the more lopsided of the others point to where the points reach out farther.
Eigen::Matrix3d PrincipalAxes(std::span<const Eigen::Vector3d> points, const ThreadPool& pool) {
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  const Eigen::Vector3d mean =
      SumOf(points, pool, zero, [](const Eigen::Vector3d& p) { return p; }) /
      static_cast<double>(points.size());
  const Eigen::Matrix3d no_products = Eigen::Matrix3d::Zero();
  const Eigen::Matrix3d products =
      SumOf(points, pool, no_products, [&](const Eigen::Vector3d& p) -> Eigen::Matrix3d {
        return (p - mean) * (p - mean).transpose();
      });
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(products);
  Eigen::Matrix3d axes = solver.eigenvectors().rowwise().reverse().transpose();
  const Eigen::Vector3d cubes =
      SumOf(points, pool, zero, [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
        const Eigen::Vector3d at = axes * (p - mean);
        return at.cwiseProduct(at).cwiseProduct(at);
      });
  const int lopsided = std::abs(cubes[1]) >= std::abs(cubes[2]) ? 1 : 2;
  for (const int k : {0, lopsided}) {
    if (cubes[k] < 0.0) axes.row(k) = -axes.row(k);
  }
  if (axes.determinant() < 0.0) axes.row(3 - lopsided) = -axes.row(3 - lopsided);
  return axes;
}

}  // namespace

WorkingCopy MakeWorkingCopy(const mesh::BodyMesh& mesh, const ThreadPool& pool,
                            const FitObserver& observer) {
  WorkingCopy copy;
  copy.centroid = mesh.centroid();
  copy.unit = std::sqrt(mesh.area());
  const std::size_t count = mesh.vertices().size();
  std::vector<Eigen::Vector3d> points(count);
  const auto for_each_vertex = [&](const auto& visit) {
    pool.ForChunks(count, kMeshChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) visit(v);
    });
  };
  for_each_vertex(
      [&](std::size_t v) { points[v] = (mesh.vertices()[v] - copy.centroid) / copy.unit; });
  copy.axes = PrincipalAxes(points, pool);
  for_each_vertex([&](std::size_t v) { points[v] = Snap(copy.axes * points[v], kCoordinateGrid); });
  if (observer.IsCancelled()) return copy;
  copy.mesh_vertex = SortByKey(CurveKeys(points, pool), points, pool);
  if (observer.IsCancelled()) return copy;
  TriangleSorter(mesh, pool, observer, copy).Run();
  if (observer.IsCancelled()) return copy;
  copy.points.resize(count);
  for_each_vertex([&](std::size_t v) { copy.points[v] = points[copy.mesh_vertex[v]]; });
  return copy;
}

}  // namespace capfit::body
