// What a capsule would win that is added to a set with points outside.
#ifndef CAPFIT_CORE_REFINE_ENCLOSING_ADDED_CAPSULE_H_
#define CAPFIT_CORE_REFINE_ENCLOSING_ADDED_CAPSULE_H_

#include <cstddef>
#include <vector>

#include "core/tighten/distance_kernel.h"
#include "core/tighten/point_grid.h"

namespace capfit::refine {

// The points that stick out of a set, their coordinates apart.
class OutsidePoints {
 public:
  // Distances from the set are in the grid's order, areas in the caller's.
  OutsidePoints(const tighten::PointGrid& grid, const std::vector<double>& distances_m,
                const std::vector<double>& areas_m2, double allowed_m);

  // Area times the depth by which the capsule takes points in, with its image where it has one.
  [[nodiscard]] double TakenInBy(const geometry::TaperedCapsule& capsule, bool with_image) const;

 private:
  // The points of one block.
  struct Run {
    std::size_t begin, end;
    Eigen::Vector3d center;
    double reach;
    double furthest_m;  // that one of them is from the set
  };
  [[nodiscard]] double TakenIn(const Run& run, const float* distances_m) const;

  float allowed_m_;
  std::vector<float> x_, y_, z_;  // from the centre of the block
  std::vector<float> area_, out_;
  std::vector<Run> runs_;
};

// How much of the capsule between its end spheres is in none of the shapes. Sampled.
[[nodiscard]] double VolumeOutside(const geometry::TaperedCapsule& tie,
                                   const std::vector<geometry::TaperedCapsule>& shapes);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_ENCLOSING_ADDED_CAPSULE_H_
