#include "core/mesh/curve_order.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>

#include "core/base/chunk_sums.h"
#include "core/base/sort_few.h"
#include "core/mesh/surface_measures.h"

namespace capfit::mesh {
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

// The key of a vertex in the upper 24 bits, then eight of how high it lies in its cell of the
// curve, and its index in the lower half.
using KeyedVertex = std::uint64_t;

std::uint32_t KeyOf(KeyedVertex v) { return static_cast<std::uint32_t>(v >> 40); }
std::uint32_t HeightInCell(KeyedVertex v) { return static_cast<std::uint32_t>(v >> 32) & 0xFFu; }
std::uint32_t IndexOf(KeyedVertex v) { return static_cast<std::uint32_t>(v); }

// One pass of a counting sort: `order` by 12 bits of the keys.
void SortByDigit(int shift, const ThreadPool& pool, RawVector<KeyedVertex>& order) {
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
  RawVector<KeyedVertex> sorted(order.size());
  pool.ForChunks(order.size(), kSortChunk, [&](std::size_t begin, std::size_t end) {
    std::uint32_t* const place_of = place.data() + begin / kSortChunk * kDigits;
    for (std::size_t i = begin; i < end; ++i) sorted[place_of[digit(order[i])]++] = order[i];
  });
  order.swap(sorted);
}

// Along the curve; in the same cell of it by coordinates, y first.
RawVector<std::uint32_t> SortByKey(RawVector<KeyedVertex> order,
                                   std::span<const Eigen::Vector3d> points,
                                   const ThreadPool& pool) {
  for (const int shift : {0, 12}) SortByDigit(shift, pool, order);
  const auto comes_first = [&](KeyedVertex a, KeyedVertex b) {
    if (HeightInCell(a) != HeightInCell(b)) return HeightInCell(a) < HeightInCell(b);
    const Eigen::Vector3d& p = points[IndexOf(a)];
    const Eigen::Vector3d& q = points[IndexOf(b)];
    if (p.y() != q.y()) return p.y() < q.y();
    if (p.z() != q.z()) return p.z() < q.z();
    return p.x() != q.x() ? p.x() < q.x() : IndexOf(a) < IndexOf(b);
  };
  RawVector<std::uint32_t> sorted(order.size());
  pool.ForChunks(order.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
    std::vector<KeyedVertex> run;
    for (std::size_t first = begin; first < end; ++first) {
      // A run that began in the chunk before was sorted there.
      if (first > 0 && KeyOf(order[first - 1]) == KeyOf(order[first])) continue;
      std::size_t last = first + 1;
      while (last < order.size() && KeyOf(order[last]) == KeyOf(order[first])) ++last;
      run.assign(order.begin() + static_cast<std::ptrdiff_t>(first),
                 order.begin() + static_cast<std::ptrdiff_t>(last));
      std::sort(run.begin(), run.end(), comes_first);
      for (std::size_t i = 0; i < run.size(); ++i) sorted[first + i] = IndexOf(run[i]);
    }
  });
  return sorted;
}

RawVector<KeyedVertex> CurveKeys(std::span<const Eigen::Vector3d> points, const ThreadPool& pool) {
  const BoundingBox box = BoundingBoxOf(points, pool);
  const double cells = (1u << kBitsPerAxis) - 1;
  const double side = std::max((box.high - box.low).maxCoeff(), std::numeric_limits<double>::min());
  RawVector<KeyedVertex> keys(points.size());
  pool.ForChunks(points.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Eigen::Vector3d at = (points[v] - box.low) * (cells / side);
      const std::uint32_t key = Spread(static_cast<std::uint32_t>(at.x())) |
                                Spread(static_cast<std::uint32_t>(at.y())) << 1 |
                                Spread(static_cast<std::uint32_t>(at.z())) << 2;
      const auto height = static_cast<std::uint32_t>(256.0 * at.y()) & 0xFFu;
      keys[v] = KeyedVertex{key} << 40 | KeyedVertex{height} << 32 | v;
    }
  });
  return keys;
}

// The sum of two corners' numbers as a corner again.
std::uint32_t Wrapped(std::uint32_t corner) { return corner < 3 ? corner : corner - 3; }

// A triangle whose lowest corner is known: the other two, in order, in one number.
using NextCorners = std::uint64_t;

// Lists triangles by their corners in a new order of the vertices.
class TriangleSorter {
 public:
  TriangleSorter(std::span<const Triangle> triangles, const ThreadPool& pool,
                 const FitObserver& observer, CurveOrder& order)
      : triangles_(triangles), pool_(pool), observer_(observer), order_(order) {}

  void Run() {
    order_.rank.resize(order_.source.size());
    ForEachOf(order_.rank.size(), [this](std::uint32_t i) { order_.rank[order_.source[i]] = i; });
    Deal();
    if (observer_.IsCancelled()) return;
    order_.triangles.resize(triangles_.size());
    pool_.ForChunks(order_.rank.size(), kMeshChunk,
                    [this](std::size_t begin, std::size_t end) { SortAround(begin, end); });
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
    const std::size_t count = triangles_.size();
    const auto lowest = std::make_unique_for_overwrite<std::uint32_t[]>(count);
    const auto renamed = std::make_unique_for_overwrite<NextCorners[]>(count);
    ForEachOf(count, [&](std::uint32_t i) { renamed[i] = Renamed(triangles_[i], lowest[i]); });
    if (observer_.IsCancelled()) return;
    std::vector<std::uint32_t>& first = order_.first_triangle;
    first.assign(order_.rank.size() + 1, 0);
    ForShares({lowest.get(), count}, [&](std::uint32_t v, std::size_t) { ++first[v]; });
    for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
    dealt_ = std::make_unique_for_overwrite<NextCorners[]>(count);
    // The ends become the starts.
    ForShares({lowest.get(), count},
              [&](std::uint32_t v, std::size_t i) { dealt_[--first[v]] = renamed[i]; });
  }

  // Calls visit(lowest[i], i) for all i: each thread for those of its share of the vertices, as
  // looking at all costs little.
  template <typename Visit>
  void ForShares(std::span<const std::uint32_t> lowest, const Visit& visit) const {
    const std::size_t vertices = order_.rank.size();
    const auto most = static_cast<std::size_t>(std::min(kMostShares, pool_.threads()));
    const std::size_t shares = std::clamp<std::size_t>(vertices / kLeastShare, 1, most);
    pool_.ForChunks(shares, 1, [&](std::size_t share, std::size_t) {
      const auto begin = static_cast<std::uint32_t>(vertices * share / shares);
      const auto end = static_cast<std::uint32_t>(vertices * (share + 1) / shares);
      for (std::size_t i = 0; i < lowest.size(); ++i) {
        if (lowest[i] - begin < end - begin) visit(lowest[i], i);
      }
    });
  }

  [[nodiscard]] NextCorners Renamed(const Triangle& t, std::uint32_t& lowest) const {
    const Triangle ranks = {order_.rank[t[0]], order_.rank[t[1]], order_.rank[t[2]]};
    lowest = std::min({ranks[0], ranks[1], ranks[2]});
    const std::uint32_t k = (ranks[1] == lowest ? 1 : 0) + (ranks[2] == lowest ? 2 : 0);
    return (NextCorners{ranks[Wrapped(k + 1)]} << 32) | ranks[Wrapped(k + 2)];
  }

  // Those at the vertices in [begin, end).
  void SortAround(std::size_t begin, std::size_t end) {
    for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v) {
      const std::uint32_t first = order_.first_triangle[v];
      const std::uint32_t last = order_.first_triangle[v + 1];
      SortFew(std::span(dealt_.get() + first, last - first));
      for (std::uint32_t i = first; i < last; ++i) {
        order_.triangles[i] = {v, static_cast<std::uint32_t>(dealt_[i] >> 32),
                               static_cast<std::uint32_t>(dealt_[i])};
      }
    }
  }

  std::span<const Triangle> triangles_;
  const ThreadPool& pool_;
  const FitObserver& observer_;
  CurveOrder& order_;
  std::unique_ptr<NextCorners[]> dealt_;
};

}  // namespace

CurveOrder OrderAlongCurve(std::span<const Eigen::Vector3d> points,
                           std::span<const Triangle> triangles, const ThreadPool& pool,
                           const FitObserver& observer) {
  CurveOrder order;
  order.source = SortByKey(CurveKeys(points, pool), points, pool);
  if (observer.IsCancelled()) return order;
  TriangleSorter(triangles, pool, observer, order).Run();
  return order;
}

}  // namespace capfit::mesh
