// The distance of points to the union of a set's solids.
#ifndef CAPFIT_CORE_METRICS_UNION_DISTANCE_H_
#define CAPFIT_CORE_METRICS_UNION_DISTANCE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/geometry/tapered_capsule.h"

namespace capfit::metrics {

// The solids with a grid over a box that keeps, for each cell, those that can be nearest to a point
// in it. Distances are 1-Lipschitz, so a solid further from the cell's middle than the nearest one
// by more than the cell's diagonal never is.
class UnionDistance {
 public:
  // The least of the solids' signed distances and the solid that has it. Outside the union that is
  // the distance to it; inside, no boundary is nearer than the absolute value (but it may be
  // further, where other solids hide that surface). No solids: infinity and -1.
  struct Nearest {
    double distance_m = 0.0;
    std::int32_t solid = -1;
  };

  // `cells` along the longest side of `box`. O(cells^3) distances, culled block by block.
  UnionDistance(std::vector<geometry::TaperedCapsule> solids, const Eigen::AlignedBox3d& box,
                int cells, const ThreadPool& pool);

  [[nodiscard]] std::span<const geometry::TaperedCapsule> solids() const& { return solids_; }
  std::span<const geometry::TaperedCapsule> solids() && = delete;

  // Exact for any point; fast for points in the box. On a tie the solid with the lowest index.
  [[nodiscard]] Nearest At(const Eigen::Vector3d& point_m) const {
    return At(point_m, -std::numeric_limits<double>::infinity());
  }
  // The same where the least distance is not below `enough_m`; where it is, any solid that is that
  // near, which is found sooner.
  [[nodiscard]] Nearest At(const Eigen::Vector3d& point_m, double enough_m) const;

 private:
  using Candidates = std::vector<std::int32_t>;

  // Those of `from` that can be nearest somewhere within `reach` of `middle`, with the nearest to
  // `middle` in front.
  [[nodiscard]] Candidates Near(const Candidates& from, const Eigen::Vector3d& middle,
                                double reach) const;
  void FillBlock(std::size_t block, std::vector<Candidates>& cells) const;
  [[nodiscard]] std::size_t CellIndex(const std::array<std::size_t, 3>& cell) const {
    return (cell[2] * counts_[1] + cell[1]) * counts_[0] + cell[0];
  }

  std::vector<geometry::TaperedCapsule> solids_;
  Candidates all_;
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero();
  double cell_m_ = 1.0;
  std::array<std::size_t, 3> counts_{1, 1, 1};
  // Candidates of cell i: candidates_[begin_[i]] up to begin_[i + 1].
  std::vector<std::uint32_t> begin_;
  Candidates candidates_;
};

}  // namespace capfit::metrics

#endif  // CAPFIT_CORE_METRICS_UNION_DISTANCE_H_
