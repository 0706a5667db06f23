#include "core/tighten/sparse_points.h"

#include <array>
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

  // Its weight is shared among the eight nodes around it.
  void Add(const Eigen::Vector3d& point, double weight) {
    std::array<std::array<double, 2>, 3> part;  // by axis, for the lower and the upper nodes
    std::array<std::int64_t, 3> cell;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = point[axis] / spacing_ - low_[axis];
      const double below = std::floor(at);
      cell[axis] = static_cast<std::int64_t>(below);
      part[axis] = {1.0 - (at - below), at - below};
    }
    const std::int64_t row = counts_.x();
    const std::int64_t layer = row * counts_.y();
    const std::int64_t first = cell[2] * layer + cell[1] * row + cell[0];
    for (int corner = 0; corner < 8; ++corner) {
      const int x = corner & 1;
      const int y = corner >> 1 & 1;
      const int z = corner >> 2;
      const double share = weight * (part[0][x] * (part[1][y] * part[2][z]));
      if (share > 0.0) SumAt(first + z * layer + y * row + x) += Sum(point, share);
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
  static Eigen::Vector4d Sum(const Eigen::Vector3d& point, double share) {
    return {share * point.x(), share * point.y(), share * point.z(), share};
  }

  Eigen::Vector4d& SumAt(std::int64_t node) {
    std::int32_t& slot = slots_[static_cast<std::size_t>(node)];
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
