// BEST_FIT: the smallest E_r, with no part of the surface left far outside.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_BEST_FIT_OBJECTIVE_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_BEST_FIT_OBJECTIVE_H_

#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/refine/best_fit/best_fit_round.h"
#include "core/refine/best_fit/far_misses.h"
#include "core/refine/best_fit/fill_error.h"
#include "core/refine/best_fit/occupancy_grid.h"

namespace capfit::refine {

enum class Effort {
  kRough,    // from a start whose places and radii are guesses
  kTouch,    // a few steps after edits
  kTighten,  // from a set that is finished but for what has been added to the task since
  kRound,    // after many edits at once, before further ones
  kFinish,   // until nothing is left to gain
};

// What growing asks: settle a set, judge it, and try edits. All values are relative to the volume
// of the fitted parts; lower is better. Immutable; may be asked from several threads.
class BestFitObjective {
 public:
  // `points` are folded like the grid: new spheres are tried where they stick out furthest.
  BestFitObjective(OccupancyGrid grid, SurfacePoints points, std::uint64_t seed);

  // Moves and grows all spheres, until the observer cancels.
  void Settle(Effort effort, const ThreadPool& pool, const FitObserver& observer,
              capsule::MirroredSet& graph) const;
  // E_r, plus what is left out by far (MissPenalty).
  [[nodiscard]] double Value(const capsule::MirroredSet& graph, const ThreadPool& pool) const;
  // The objective must outlive the round.
  [[nodiscard]] BestFitRound StartRound(const capsule::MirroredSet& graph,
                                        const ThreadPool& pool) const;
  // As the grid of it tells.
  [[nodiscard]] CapsuleErrors ErrorsByCapsule(const capsule::MirroredSet& graph,
                                              const ThreadPool& pool) const {
    return refine::ErrorsByCapsule(grid_, graph, pool);
  }
  // By cone, as ConesOf: by how much MissPenalty rises if it and its image go and all else stays;
  // in cubic metres, as the losses of ErrorsByCapsule.
  [[nodiscard]] std::vector<double> MissedWithout(const capsule::MirroredSet& graph,
                                                  const ThreadPool& pool) const;
  // Points of the surface where a new sphere would help most, best first, apart from each other.
  [[nodiscard]] std::vector<Eigen::Vector3d> WorstPoints(const capsule::MirroredSet& graph,
                                                         int count, const ThreadPool& pool) const;

 private:
  OccupancyGrid grid_;
  OccupancyGrid coarse_;
  std::unique_ptr<const SurfacePoints> points_;
  PointGroups groups_;
  std::uint64_t seed_;
};

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_BEST_FIT_OBJECTIVE_H_
