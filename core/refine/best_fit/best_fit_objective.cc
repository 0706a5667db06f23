#include "core/refine/best_fit/best_fit_objective.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/refine/best_fit/best_fit_descent.h"
#include "core/refine/best_fit/occupancy_grid.h"
#include "core/refine/graph/cone.h"
#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

constexpr double kBestFitLeafDistanceM = 0.04;  // between the points where leaves are tried
constexpr double kLeastMissM = 0.002;           // points nearer to the set than this need no leaf
// What is left out further than this counts beside E_r, so that a body keeps its forearms and
// hands: a mean miss of 1 cm over the surface as much as a tenth of the volume.
constexpr float kFarMissM = 0.04f;
constexpr double kMissWeightPerM = 10.0;
// Further than this no sphere moves in a trial.
constexpr double kDriftM = 0.05;
// Edits of larger graphs gain so little that coarse cells do not tell.
constexpr int kMostJudgedCoarsely = 100;
constexpr double kTrialSpacingM = 0.03;
constexpr int kBestFitGlanceSteps = 8;
constexpr int kBestFitTrialSteps = 18;

// Calls take(index) for the points in the box.
template <class Take>
void ForPointsIn(const CoverPoints& points, const Box& box, const Take& take) {
  const Eigen::AlignedBox3f reach(box[0].cast<float>(), box[1].cast<float>());
  for (const CoverPoints::Block& block : points.blocks) {
    if (reach.squaredExteriorDistance(block.center_m) > block.radius_m * block.radius_m) continue;
    for (int i = block.begin; i < block.end; ++i) {
      if (reach.contains(Eigen::Vector3f(points.x[U(i)], points.y[U(i)], points.z[U(i)]))) take(i);
    }
  }
}

// How much further out than kFarMissM the point is. `near`: the cone that is tried first, and in
// the end the one that has the point; neighbours mostly have the same.
float FarMissOf(const CoverPoints& points, int i, const std::vector<Cone>& cones,
                std::size_t& near) {
  const auto distance = [&](const Cone& cone) {
    return SignedDistance(cone, points.x[U(i)], points.y[U(i)], points.z[U(i)]);
  };
  if (near < cones.size() && distance(cones[near]) <= kFarMissM) return 0.0f;
  float least = std::numeric_limits<float>::max();
  for (std::size_t k = 0; k < cones.size(); ++k) {
    least = std::min(least, distance(cones[k]));
    if (least > kFarMissM) continue;
    near = k;
    return 0.0f;
  }
  return least - kFarMissM;
}

// The penalty for a sum of misses.
double MissPenalty(const CoverPoints& points, double miss_m) {
  return kMissWeightPerM * miss_m / std::max(1, points.size());
}

class BestFitRound final : public Objective::Round {
 public:
  BestFitRound(const OccupancyGrid& grid, const OccupancyGrid& coarse, const CoverPoints& points,
               std::uint64_t seed, const capsule::MirroredSet& graph)
      : grid_(grid),
        coarse_(coarse),
        points_(points),
        seed_(seed),
        before_(graph),
        errors_before_(coarse, before_) {
    const Deepest deepest = FindDeepest(points, ConesOf(before_));
    for (const float excess : deepest.excess_m) {
      misses_before_m_.push_back(std::max(0.0f, excess - kFarMissM));
    }
  }

  double Try(Trial trial, EditedGraph& edited) const override {
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
    DescendBestFit(grid_, OptionsOf(glance, local_active), local.graph);
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

 private:
  [[nodiscard]] BestFitOptions OptionsOf(bool glance, const std::vector<char>& active) const {
    BestFitOptions options;
    options.steps = glance ? kBestFitGlanceSteps : kBestFitTrialSteps;
    options.first_rate_m = glance ? 0.005 : 0.004;
    options.last_rate_m = glance ? 0.002 : 0.0003;
    options.spacing_m = kTrialSpacingM;
    options.seed = seed_;
    options.active = &active;
    return options;
  }

  [[nodiscard]] double Gain(bool fine, const capsule::MirroredSet& after, const Box& cells) const {
    const double less_error =
        fine ? FillError(grid_, before_, cells) - FillError(grid_, after, cells)
             : errors_before_.Over(cells) - FillError(coarse_, after, cells);
    const std::vector<Cone> cones = ConesOf(after);
    double less_missed_m = 0.0;
    std::size_t near = 0;
    ForPointsIn(points_, cells, [&](int i) {
      less_missed_m += misses_before_m_[U(i)] - FarMissOf(points_, i, cones, near);
    });
    return less_error / grid_.volume_m3 + MissPenalty(points_, less_missed_m);
  }

  const OccupancyGrid& grid_;
  const OccupancyGrid& coarse_;
  const CoverPoints& points_;
  std::uint64_t seed_;
  capsule::MirroredSet before_;
  FillErrorMap errors_before_;
  std::vector<float> misses_before_m_;  // by point, beyond kFarMissM
};

int StepsOf(Effort effort, int primitives) {
  switch (effort) {
    case Effort::kTouch:
      return 30;
    case Effort::kTighten:
      return 60;
    case Effort::kRough:
      return 80;
    case Effort::kFinish:
      return 120 + std::max(0, primitives - 64);
  }
  return 0;
}

}  // namespace

BestFitObjective::BestFitObjective(OccupancyGrid grid, CoverPoints points, std::uint64_t seed)
    : grid_(std::move(grid)),
      coarse_(CoarserGrid(grid_)),
      points_(std::move(points)),
      seed_(seed) {}

void BestFitObjective::Settle(Effort effort, capsule::MirroredSet& graph) const {
  BestFitOptions options;
  options.seed = seed_;
  options.steps = StepsOf(effort, graph.primitive_count());
  options.first_rate_m = effort == Effort::kRough ? 0.008 : 0.003;
  DescendBestFit(grid_, options, graph);
}

double BestFitObjective::Value(const capsule::MirroredSet& graph) const {
  const Deepest deepest = FindDeepest(points_, ConesOf(graph));
  double missed_m = 0.0;
  for (const float excess : deepest.excess_m) missed_m += std::max(0.0f, excess - kFarMissM);
  return GridError(grid_, graph) + MissPenalty(points_, missed_m);
}

std::unique_ptr<Objective::Round> BestFitObjective::StartRound(
    const capsule::MirroredSet& graph) const {
  return std::make_unique<BestFitRound>(grid_, coarse_, points_, seed_, graph);
}

std::vector<Eigen::Vector3d> BestFitObjective::WorstPoints(const capsule::MirroredSet& graph,
                                                           int count) const {
  const Deepest deepest = FindDeepest(points_, ConesOf(graph));
  std::vector<Eigen::Vector3d> positions;
  std::vector<double> scores;
  for (int i = 0; i < points_.size(); ++i) {
    if (deepest.excess_m[U(i)] < kLeastMissM) continue;
    positions.push_back(points_.At(i).position_m.cast<double>());
    scores.push_back(deepest.excess_m[U(i)]);
  }
  return BestApart(positions, scores, kBestFitLeafDistanceM, count);
}

}  // namespace capfit::refine
