// BEST_FIT: the smallest E_r, with no part of the surface left far outside.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_BEST_FIT_OBJECTIVE_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_BEST_FIT_OBJECTIVE_H_

#include <cstdint>
#include <memory>
#include <vector>

#include "core/refine/best_fit/cover_points.h"
#include "core/refine/best_fit/objective.h"
#include "core/refine/best_fit/occupancy_grid.h"

namespace capfit::refine {

class BestFitObjective final : public Objective {
 public:
  // `points` are those of the fitted surface (folded like the grid): new spheres are tried where
  // they stick out furthest.
  BestFitObjective(OccupancyGrid grid, CoverPoints points, std::uint64_t seed);

  void Settle(Effort effort, capsule::MirroredSet& graph) const override;
  [[nodiscard]] double Value(const capsule::MirroredSet& graph) const override;
  [[nodiscard]] std::unique_ptr<Round> StartRound(const capsule::MirroredSet& graph) const override;
  [[nodiscard]] std::vector<Eigen::Vector3d> WorstPoints(const capsule::MirroredSet& graph,
                                                         int count) const override;

 private:
  OccupancyGrid grid_;
  OccupancyGrid coarse_;
  CoverPoints points_;
  std::uint64_t seed_;
};

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_BEST_FIT_OBJECTIVE_H_
