// E_r as the grid sees it: what a set fills outside the body and leaves out within.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_FILL_ERROR_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_FILL_ERROR_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/best_fit/occupancy_grid.h"
#include "core/refine/graph/cone.h"

namespace capfit::refine {

// Lower and upper corner.
using Box = std::array<Eigen::Vector3d, 2>;

// Volume outside the body plus volume of the fitted parts left uncovered by the union of `cones`,
// over the cells within `box`, whole registers of them along z (a folded grid counts x >= 0 twice),
// in cubic metres. Surfaces are softened over one cell, which leaves flat ones exact. `every`: only
// one layer of cells along y in so many is looked at, for all of them.
[[nodiscard]] double FillError(const OccupancyGrid& grid, const std::vector<Cone>& cones,
                               const Box& box, int every = 1);

// FillError of one set over many boxes: a pass over the whole grid once, a sum for each box.
class FillErrorMap {
 public:
  // The grid must outlive the map.
  FillErrorMap(const OccupancyGrid& grid, const std::vector<Cone>& cones, const ThreadPool& pool);
  [[nodiscard]] double Over(const Box& box, int every = 1) const;

 private:
  const OccupancyGrid& grid_;
  std::vector<float> errors_;  // by cell, in cells
};

// What each capsule of a set, and each sphere without one, has to do with its error; by index as
// ConesOf. Of a pair of images both have what the two have together. In cubic metres.
struct CapsuleErrors {
  std::vector<double> beside_m3;  // error in the cells nearest to it
  std::vector<double> loss_m3;    // by how much the error rises if it goes and all else stays
};
// One pass over the grid.
[[nodiscard]] CapsuleErrors ErrorsByCapsule(const OccupancyGrid& grid,
                                            const capsule::MirroredSet& graph,
                                            const ThreadPool& pool);

// Outside + uncovered, relative to the volume.
[[nodiscard]] double GridError(const OccupancyGrid& grid, const capsule::MirroredSet& graph,
                               const ThreadPool& pool);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_FILL_ERROR_H_
