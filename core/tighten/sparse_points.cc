#include "core/tighten/sparse_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace capfit::tighten {
namespace {

// A bound on memory: nodes of the grid.
constexpr double kMaxNodes = 4e6;

// Sums over the nodes that have points near them; the grid itself only holds their numbers.
class NodeSums {
 public:
  NodeSums(std::span<const Eigen::Vector3d> points_m, double spacing_m) : spacing_(spacing_m) {
    Eigen::Array3d low = points_m[0];
    Eigen::Array3d high = points_m[0];
    for (const Eigen::Vector3d& p : points_m) {
      low = low.min(p.array());
      high = high.max(p.array());
    }
    while (((high - low) / spacing_ + 3.0).prod() > kMaxNodes) spacing_ *= 1.25;
    // Nodes at multiples of the spacing: images of each other in the planes of the frame.
    low_ = (low / spacing_).floor();
    counts_ = ((high / spacing_).floor() - low_).cast<std::int64_t>() + 2;
    slots_.assign(static_cast<std::size_t>(counts_.prod()), -1);
  }

  void Add(const Eigen::Vector3d& point, double weight) {
    const Eigen::Array3d at = point.array() / spacing_ - low_;
    const Eigen::Array3d cell = at.floor();
    const Eigen::Array3d part = at - cell;
    const Eigen::Array3d rest = 1.0 - part;
    const Eigen::Array<std::int64_t, 3, 1> first = cell.cast<std::int64_t>();
    const std::int64_t node = (first.z() * counts_.y() + first.y()) * counts_.x() + first.x();
    const Eigen::Vector4d sum(point.x(), point.y(), point.z(), 1.0);
    for (const bool z : {false, true}) {
      for (const bool y : {false, true}) {
        const std::int64_t row = node + ((z ? counts_.y() : 0) + (y ? 1 : 0)) * counts_.x();
        for (const bool x : {false, true}) {
          const double share = weight * ((x ? part.x() : rest.x()) * (y ? part.y() : rest.y()) *
                                         (z ? part.z() : rest.z()));
          if (share > 0.0) SumAt(static_cast<std::size_t>(row + (x ? 1 : 0))) += share * sum;
        }
      }
    }
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
      sums_.push_back(Eigen::Vector4d::Zero());
    }
    return sums_[static_cast<std::size_t>(slot)];
  }

  double spacing_;
  Eigen::Array3d low_;
  Eigen::Array<std::int64_t, 3, 1> counts_;
  std::vector<std::int32_t> slots_;
  std::vector<Eigen::Vector4d> sums_;
};

}  // namespace

SparsePoints MakeSparse(std::span<const Eigen::Vector3d> points_m, std::span<const double> weights,
                        double spacing_m) {
  if (points_m.empty()) return {};
  NodeSums sums(points_m, spacing_m);
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    if (weights[i] > 0.0) sums.Add(points_m[i], weights[i]);
  }
  return sums.Means();
}

}  // namespace capfit::tighten
