// Many points against many capsules: the distance of each point to their union, fast.
#ifndef CAPFIT_CORE_TIGHTEN_POINT_GRID_H_
#define CAPFIT_CORE_TIGHTEN_POINT_GRID_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/geometry/tapered_capsule.h"
#include "core/tighten/distance_kernel.h"

namespace capfit::tighten {

// Where each point stands: signed distance to the union of the solids as far as one solid tells
// (the least over the solids), and the solid that gives it.
struct UnionDistances {
  std::vector<double> distance_m;
  std::vector<std::int32_t> solid;
};

// Points sorted into blocks of neighbours, coordinates apart, so that a block meets only the few
// solids that can be its nearest and the inner loop runs over points in vector registers.
class PointGrid {
 public:
  // How points are laid down: as they are, or at |x|, for sets that are their own mirror image
  // (whose distance is the same there).
  enum class Fold { kNone, kToPositiveX };

  // O(n).
  explicit PointGrid(std::span<const Eigen::Vector3d> points_m, Fold fold = Fold::kNone);

  // All results are in this grid's order of the points; this is the caller's index of each.
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }
  [[nodiscard]] std::size_t size() const { return order_.size(); }
  [[nodiscard]] const Eigen::Vector3d& point(std::size_t i) const { return points_m_[i]; }
  [[nodiscard]] std::span<const Eigen::Vector3d> points_m() const { return points_m_; }

  // Points [begin, end) of each block, kMaxBlock at most.
  static constexpr std::uint32_t kMaxBlock = 128;
  struct Block {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    double reach = 0.0;  // no point of the block is further from its centre
  };
  [[nodiscard]] const std::vector<Block>& blocks() const { return blocks_; }

  // O(blocks * solids + points * (solids near each)). In floats from the block's centre: exact to
  // 1e-6 m, to 2e-7 m where blocks are some centimetres wide, deep inside beside a solid's axis to
  // 3e-5 m; on a tie the lower index. Where a
  // whole block is deeper than `ignore_below_m` its points get a bound that is too, with the solid
  // that gives it. No solids: infinity and -1.
  [[nodiscard]] UnionDistances DistancesTo(const std::vector<geometry::TaperedCapsule>& solids,
                                           double ignore_below_m, const ThreadPool& pool) const;

  // The same after some solids have grown, each containing what it was: `distances` as they were
  // before, all exact, are lowered to what they are. O(blocks * grown + points * (grown near
  // each)).
  void Lower(const std::vector<geometry::TaperedCapsule>& solids,
             std::span<const std::int32_t> grown, UnionDistances& distances,
             const ThreadPool& pool) const;

  // The distances of one block's points to one solid, as exact, to distance_m[0, block's size).
  void BlockDistances(const Block& block, const geometry::TaperedCapsule& solid,
                      float* distance_m) const;

 private:
  void MakeBlocks(const std::vector<std::uint32_t>& cell_ends);
  // Lowers `best` and sets `index`, both of the block's points, where this solid is nearer.
  void LowerBlock(const Block& block, const DistanceKernel& solid, std::int32_t own_index,
                  float* best, std::int32_t* index) const;

  std::vector<std::uint32_t> order_;
  std::vector<Eigen::Vector3d> points_m_;
  std::vector<float> x_m_, y_m_, z_m_;  // from the centre of each point's block
  std::vector<Block> blocks_;
};

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_POINT_GRID_H_
