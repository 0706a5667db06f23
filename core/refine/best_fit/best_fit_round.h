// Trials of many edits of the same graph, judged by how the best fit's objective falls.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_BEST_FIT_ROUND_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_BEST_FIT_ROUND_H_

#include <cstdint>
#include <vector>

#include "core/capsule/mirrored_set.h"
#include "core/refine/best_fit/best_fit_descent.h"
#include "core/refine/best_fit/far_misses.h"
#include "core/refine/best_fit/fill_error.h"
#include "core/refine/best_fit/occupancy_grid.h"
#include "core/refine/graph/graph_edit.h"

namespace capfit::refine {

// A glance costs a third of a thorough trial and tells which edits are worth one.
enum class Trial { kGlance, kThorough };

// What the trials share: made once per round. Immutable; may be asked from several threads.
class BestFitRound {
 public:
  // Grids, points and their groups must outlive the round. `coarse`: CoarserGrid of `grid`.
  BestFitRound(const OccupancyGrid& grid, const OccupancyGrid& coarse, const SurfacePoints& points,
               const PointGroups& groups, std::uint64_t seed, const capsule::MirroredSet& graph,
               const ThreadPool& pool);

  // Settles the surroundings of the edit within edited.graph, a little or as far as pays; returns
  // by how much the objective falls against the graph without the edit.
  double Try(Trial trial, EditedGraph& edited) const;

 private:
  [[nodiscard]] BestFitOptions OptionsOf(bool glance, const std::vector<char>& active) const;
  [[nodiscard]] double Gain(Trial trial, const capsule::MirroredSet& after, const Box& cells) const;

  const OccupancyGrid& grid_;
  const OccupancyGrid& coarse_;
  const SurfacePoints& points_;
  const PointGroups& groups_;
  ThreadPool alone_{1};  // trials run side by side, each by itself
  std::uint64_t seed_;
  capsule::MirroredSet before_;
  bool is_of_few_;
  FillErrorMap errors_before_;
  PointGroups::Misses misses_before_;
};

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_BEST_FIT_ROUND_H_
