// What an enclosing search asks of coverage: settle a graph roughly, and tell what it is worth.
#ifndef CAPFIT_CORE_REFINE_ENCLOSING_ENCLOSING_TASK_H_
#define CAPFIT_CORE_REFINE_ENCLOSING_ENCLOSING_TASK_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/base/work_meter.h"
#include "core/capsule/mirrored_set.h"
#include "core/capsule/primitive_set.h"
#include "core/refine/enclosing/body_regions.h"
#include "core/refine/enclosing/graph_worth.h"
#include "core/refine/enclosing/thinned_points.h"
#include "core/refine/graph/graph_edit.h"
#include "core/tighten/cover_target.h"
#include "core/tighten/full_cells.h"
#include "core/tighten/point_grid.h"
#include "core/tighten/tighten.h"

namespace capfit::refine {

struct GraphValue {
  double total_m3 = 0.0;
  // Roughly what each region has part in it: the room between body and set, and points outside.
  ByRegion<double> of_region_m3{};
};

// The body's points, thinned, those of a symmetric body folded to x >= 0; where vertices are
// further apart than the spacing, points of the triangles between them too. Immutable; may be asked
// from several threads.
class EnclosingTask {
 public:
  // `spacing`: between points, relative to the body's size (the square root of its surface area).
  // `full`: what must not be left empty (see tighten::UnionVolumeGradient), or nullptr; must
  // outlive the task, and may be filled in after it is made. `regions`: what graphs are told apart
  // by beside their whole.
  EnclosingTask(const tighten::CoverTarget& target, bool symmetric, double tolerance_m,
                double spacing, const tighten::FullCells* full = nullptr,
                const BodyRegions& regions = {});

  // Moves and grows all spheres for the least volume, with points left out at a price that rises:
  // finds the shape of a set whose spheres are guesses. Small
  // changes may lead to another shape; `looseness` around 1 is how cheap it begins.
  void FindShape(int steps, double looseness, std::uint64_t seed, const ThreadPool& pool,
                 const WorkMeter& meter, capsule::MirroredSet& graph) const;
  // The same with hardly anything left out.
  void TakeIn(int steps, std::uint64_t seed, const ThreadPool& pool, const WorkMeter& meter,
              capsule::MirroredSet& graph) const;

  // Settles at one low price of points outside, so that those which cost most to take in show.
  void Loosen(int steps, std::uint64_t seed, const ThreadPool& pool, const WorkMeter& meter,
              capsule::MirroredSet& graph) const;
  // The points that stick out furthest, some way from each other; body frame.
  [[nodiscard]] std::vector<Eigen::Vector3d> WorstPoints(const capsule::MirroredSet& graph,
                                                         int count, const ThreadPool& pool) const;
  // What each tie (kLink) or leaf (kLeaf) would win at once in a loosened graph: the price of what
  // it takes in less the volume that it adds. Cubic metres; of a mirrored pair both together.
  [[nodiscard]] std::vector<double> GainsOf(const capsule::MirroredSet& graph,
                                            const std::vector<Edit>& additions,
                                            const ThreadPool& pool) const;

  // In all the union's volume and that of hollows (see the constructor), to some thousandths, and
  // what the points outside will still cost.
  [[nodiscard]] GraphValue Value(const capsule::MirroredSet& graph, const ThreadPool& pool) const;
  // Of each sphere; images alike.
  [[nodiscard]] std::vector<Region> RegionsOf(const capsule::MirroredSet& graph) const;

  [[nodiscard]] GraphWorth Weigh(const capsule::MirroredSet& graph) const;

 private:
  EnclosingTask(ThinnedPoints thinned, double tolerance_m, const tighten::FullCells* full,
                const BodyRegions& regions);
  void Settle(const tighten::TightenPhase& phase, std::uint64_t seed, const ThreadPool& pool,
              const WorkMeter& meter, capsule::MirroredSet& graph) const;

  double size_m_ = 0.0;           // of the body, the square root of its surface area
  std::vector<double> areas_m2_;  // that each point stands for, both halves
  double tolerance_m_ = 0.0;      // how far each may stick out
  const tighten::FullCells* full_;
  tighten::PointGrid grid_;
  BodyRegions regions_;
  std::vector<Region> point_regions_;  // in the grid's order
};

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_ENCLOSING_ENCLOSING_TASK_H_
