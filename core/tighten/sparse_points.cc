#include "core/tighten/sparse_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace capfit::tighten {
namespace {

// A bound on memory: nodes of the grid.
constexpr double kMaxNodes = 4e6;
// Points are summed in parts of so many at least, each into numbers of its own for all nodes: hence
// no more parts than these, however many points there are.
constexpr std::size_t kLeastPart = 16'384;
constexpr std::size_t kMostParts = 4;

// Nodes at multiples of the spacing: images of each other in the planes of the frame.
class NodeGrid {
 public:
  NodeGrid(std::span<const Eigen::Vector3d> points_m, double spacing_m) : spacing_(spacing_m) {
    Eigen::Array3d low = points_m[0];
    Eigen::Array3d high = points_m[0];
    for (const Eigen::Vector3d& p : points_m) {
      low = low.min(p.array());
      high = high.max(p.array());
    }
    while (((high - low) / spacing_ + 3.0).prod() > kMaxNodes) spacing_ *= 1.25;
    low_ = (low / spacing_).floor();
    counts_ = ((high / spacing_).floor() - low_).cast<std::int64_t>() + 2;
  }

  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(counts_.prod()); }

  // Calls visit(node, share) for each node around the point; the shares add up to 1.
  template <typename Visit>
  void VisitAround(const Eigen::Vector3d& point, const Visit& visit) const {
    const Eigen::Array3d at = point.array() / spacing_ - low_;
    const Eigen::Array3d cell = at.floor();
    const Eigen::Array3d part = at - cell;
    const Eigen::Array3d rest = 1.0 - part;
    const Eigen::Array<std::int64_t, 3, 1> first = cell.cast<std::int64_t>();
    const std::int64_t node = (first.z() * counts_.y() + first.y()) * counts_.x() + first.x();
    for (const bool z : {false, true}) {
      for (const bool y : {false, true}) {
        const std::int64_t row = node + ((z ? counts_.y() : 0) + (y ? 1 : 0)) * counts_.x();
        for (const bool x : {false, true}) {
          const double share =
              (x ? part.x() : rest.x()) * (y ? part.y() : rest.y()) * (z ? part.z() : rest.z());
          if (share > 0.0) visit(static_cast<std::size_t>(row + (x ? 1 : 0)), share);
        }
      }
    }
  }

 private:
  double spacing_;
  Eigen::Array3d low_;
  Eigen::Array<std::int64_t, 3, 1> counts_;
};

// Sums over the nodes that have points near them; one number for each node says where they are.
class NodeSums {
 public:
  explicit NodeSums(std::size_t nodes) : slots_(nodes, -1) {}

  void Add(std::size_t node, const Eigen::Vector4d& sum) { SumAt(node) += sum; }
  void Add(const NodeSums& more) {
    for (std::size_t i = 0; i < more.nodes_.size(); ++i) Add(more.nodes_[i], more.sums_[i]);
  }

  SparsePoints Means() const {
    SparsePoints result;
    for (const Eigen::Vector4d& sum : sums_) {
      result.points_m.push_back(sum.head<3>() / sum.w());
      result.weights.push_back(sum.w());
    }
    return result;
  }

 private:
  Eigen::Vector4d& SumAt(std::size_t node) {
    std::int32_t& slot = slots_[node];
    if (slot < 0) {
      slot = static_cast<std::int32_t>(sums_.size());
      nodes_.push_back(node);
      sums_.push_back(Eigen::Vector4d::Zero());
    }
    return sums_[slot];
  }

  std::vector<std::int32_t> slots_;  // by node; -1: none yet
  std::vector<std::size_t> nodes_;   // by slot
  std::vector<Eigen::Vector4d> sums_;
};

}  // namespace

SparsePoints MakeSparse(std::span<const Eigen::Vector3d> points_m, std::span<const double> weights,
                        double spacing_m, const ThreadPool& pool) {
  if (points_m.empty()) return {};
  const NodeGrid grid(points_m, spacing_m);
  const std::size_t part = std::max(kLeastPart, (points_m.size() + kMostParts - 1) / kMostParts);
  const std::size_t count = (points_m.size() + part - 1) / part;
  std::vector<NodeSums> chunks(count, NodeSums(grid.size()));
  pool.ForChunks(points_m.size(), part, [&](std::size_t begin, std::size_t end) {
    NodeSums& sums = chunks[begin / part];
    for (std::size_t i = begin; i < end; ++i) {
      if (!(weights[i] > 0.0)) continue;
      const Eigen::Vector4d sum = weights[i] * points_m[i].homogeneous();
      grid.VisitAround(points_m[i],
                       [&](std::size_t node, double share) { sums.Add(node, share * sum); });
    }
  });
  for (std::size_t c = 1; c < count; ++c) chunks[0].Add(chunks[c]);
  return chunks[0].Means();
}

}  // namespace capfit::tighten
