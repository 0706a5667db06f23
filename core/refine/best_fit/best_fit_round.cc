#include "core/refine/best_fit/best_fit_round.h"

#include <algorithm>
#include <limits>

#include "core/refine/best_fit/far_misses.h"
#include "core/refine/graph/cone.h"
#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

// Further than this no sphere moves in a trial.
constexpr double kDriftM = 0.05;
// Edits of larger graphs gain so little that coarse cells do not tell.
constexpr int kMostJudgedCoarsely = 100;
constexpr double kTrialSpacingM = 0.03;
constexpr int kBestFitGlanceSteps = 8;
constexpr int kBestFitTrialSteps = 18;

// Calls take(index) for the points in the box.
template <class Take>
void ForPointsIn(const tighten::PointGrid& grid, const Box& box, const Take& take) {
  const Eigen::AlignedBox3d reach(box[0], box[1]);
  for (const tighten::PointGrid::Block& block : grid.blocks()) {
    if (reach.squaredExteriorDistance(block.center) > block.reach * block.reach) continue;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      if (reach.contains(grid.point(i))) take(i);
    }
  }
}

// How much further out than kFarMissM the point is. `near`: the cone that is tried first, and in
// the end the one that has the point; neighbours mostly have the same.
double FarMissOf(const Eigen::Vector3d& point_m, double allowed_m, const std::vector<Cone>& cones,
                 std::size_t& near) {
  const Eigen::Vector3f p = point_m.cast<float>();
  const auto excess = [&](const Cone& cone) {
    return cone.SignedDistance(p.x(), p.y(), p.z()) - allowed_m;
  };
  if (near < cones.size() && excess(cones[near]) <= kFarMissM) return 0.0;
  double least = std::numeric_limits<double>::max();
  for (std::size_t k = 0; k < cones.size(); ++k) {
    least = std::min(least, excess(cones[k]));
    if (least > kFarMissM) continue;
    near = k;
    return 0.0;
  }
  return least - kFarMissM;
}

}  // namespace

BestFitRound::BestFitRound(const OccupancyGrid& grid, const OccupancyGrid& coarse,
                           const SurfacePoints& points, std::uint64_t seed,
                           const capsule::MirroredSet& graph)
    : grid_(grid),
      coarse_(coarse),
      points_(points),
      seed_(seed),
      before_(graph),
      errors_before_(coarse, before_),
      misses_before_m_(FarMisses(points, before_)) {}

double BestFitRound::Try(Trial trial, EditedGraph& edited) const {
  const bool glance = trial == Trial::kGlance;
  const int radius = glance ? 0 : 1;
  const std::vector<char> active = Neighbourhood(edited.graph, edited.touched, radius);
  Eigen::AlignedBox3d box = ReachOf(edited.graph, active);
  box.extend(ReachOf(before_, Neighbourhood(before_, edited.touched_before, radius)));
  const Eigen::Vector3d drift = Eigen::Vector3d::Constant(kDriftM);
  const Eigen::AlignedBox3d widest(box.min() - drift, box.max() + drift);
  LocalGraph local = LocalGraphIn(edited.graph, widest);
  std::vector<char> local_active;
  for (const int v : local.nodes) local_active.push_back(active[U(v)]);
  // Who tries many looks between them: one is over in less than a millisecond.
  DescendBestFit(grid_, OptionsOf(glance, local_active), NullObserver(), local.graph);
  for (std::size_t v = 0; v < local.nodes.size(); ++v) {
    geometry::Sphere& node = edited.graph.sphere(local.nodes[v]);
    node.center_m = local.graph.spheres()[v].center_m;
    node.radius_m = local.graph.spheres()[v].radius_m;
  }
  box.extend(ReachOf(local.graph, local_active));
  box = box.intersection(widest);
  return Gain(!glance && before_.primitive_count() > kMostJudgedCoarsely, local.graph,
              {box.min(), box.max()});
}

BestFitOptions BestFitRound::OptionsOf(bool glance, const std::vector<char>& active) const {
  BestFitOptions options;
  options.steps = glance ? kBestFitGlanceSteps : kBestFitTrialSteps;
  options.first_rate_m = glance ? 0.005 : 0.004;
  options.last_rate_m = glance ? 0.002 : 0.0003;
  options.spacing_m = kTrialSpacingM;
  options.seed = seed_;
  options.active = &active;
  return options;
}

double BestFitRound::Gain(bool fine, const capsule::MirroredSet& after, const Box& cells) const {
  const double less_error = fine ? FillError(grid_, before_, cells) - FillError(grid_, after, cells)
                                 : errors_before_.Over(cells) - FillError(coarse_, after, cells);
  const std::vector<Cone> cones = ConesOf(after);
  double less_missed_m = 0.0;
  std::size_t near = 0;
  ForPointsIn(points_.grid, cells, [&](std::size_t i) {
    less_missed_m +=
        misses_before_m_[i] - FarMissOf(points_.grid.point(i), points_.allowed_m, cones, near);
  });
  return less_error / grid_.volume_m3 + MissPenalty(points_, less_missed_m);
}

}  // namespace capfit::refine
