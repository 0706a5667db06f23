#include "core/refine/best_fit/best_fit_round.h"

#include <algorithm>

#include "core/refine/graph/cone.h"
#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

// Further than this no sphere moves in a trial.
constexpr double kDriftM = 0.05;
// Of few primitives, which are large, a look at fewer samples and a glance of fewer steps at one
// layer of cells in so many tells as much.
constexpr double kTrialSpacingM = 0.03;
constexpr double kTrialSpacingOfFewM = 0.04;
constexpr int kGlanceStepsOfFew = 4;
constexpr int kGlanceLayersOfFew = 2;
constexpr int kBestFitGlanceSteps = 8;
constexpr int kBestFitTrialSteps = 18;

}  // namespace

BestFitRound::BestFitRound(const OccupancyGrid& grid, const OccupancyGrid& coarse,
                           const SurfacePoints& points, const PointGroups& groups,
                           std::uint64_t seed, const capsule::MirroredSet& graph,
                           const ThreadPool& pool)
    : grid_(grid),
      coarse_(coarse),
      points_(points),
      groups_(groups),
      seed_(seed),
      before_(graph),
      is_of_few_(graph.primitive_count() <= kFewPrimitives),
      errors_before_(coarse, ConesOf(before_), pool),
      misses_before_(groups.Group(FarMisses(points, before_, pool))) {}

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
  for (const int v : local.nodes) local_active.push_back(active[v]);
  // Who tries many looks between them: one is over in less than a millisecond.
  DescendBestFit(grid_, OptionsOf(glance, local_active), alone_, NullObserver(), local.graph);
  for (std::size_t v = 0; v < local.nodes.size(); ++v) {
    geometry::Sphere& node = edited.graph.sphere(local.nodes[v]);
    node.center_m = local.graph.spheres()[v].center_m;
    node.radius_m = local.graph.spheres()[v].radius_m;
  }
  box.extend(ReachOf(local.graph, local_active));
  box = box.intersection(widest);
  return Gain(trial, local.graph, {box.min(), box.max()});
}

BestFitOptions BestFitRound::OptionsOf(bool glance, const std::vector<char>& active) const {
  BestFitOptions options;
  const int glance_steps = is_of_few_ ? kGlanceStepsOfFew : kBestFitGlanceSteps;
  options.steps = glance ? glance_steps : kBestFitTrialSteps;
  options.first_rate_m = glance ? 0.005 : 0.004;
  options.last_rate_m = glance ? 0.002 : 0.0003;
  options.spacing_m = is_of_few_ ? kTrialSpacingOfFewM : kTrialSpacingM;
  options.seed = seed_;
  options.active = &active;
  return options;
}

double BestFitRound::Gain(Trial trial, const capsule::MirroredSet& after, const Box& cells) const {
  const std::vector<Cone> cones = ConesOf(after);
  const int every = trial == Trial::kGlance && is_of_few_ ? kGlanceLayersOfFew : 1;
  const double less_error =
      errors_before_.Over(cells, every) - FillError(coarse_, cones, cells, every);
  const double less_missed_m = groups_.LessMissed(misses_before_, cells, cones);
  return less_error / grid_.volume_m3 + MissPenalty(points_, less_missed_m);
}

}  // namespace capfit::refine
