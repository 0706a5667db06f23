#include "core/refine/best_fit_objective.h"

#include <algorithm>
#include <utility>

#include "core/refine/best_fit_descent.h"
#include "core/refine/cone.h"
#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

constexpr double kBestFitLeafDistanceM = 0.04;  // between the points where leaves are tried
constexpr double kLeastMissM = 0.002;           // points nearer to the set than this need no leaf
constexpr int kBestFitGlanceSteps = 8;
constexpr int kBestFitTrialSteps = 18;

class BestFitRound final : public Objective::Round {
 public:
  BestFitRound(const OccupancyGrid& grid, std::uint64_t seed, const CapsuleGraph& graph)
      : grid_(grid), seed_(seed), before_(graph), errors_before_(grid, graph) {}

  double Try(Trial trial, EditedGraph& edited) const override {
    const std::vector<char> active = Neighbourhood(edited.graph, edited.touched, 1);
    BestFitOptions options;
    const bool glance = trial == Trial::kGlance;
    options.steps = glance ? kBestFitGlanceSteps : kBestFitTrialSteps;
    options.first_rate_m = glance ? 0.005 : 0.004;
    options.last_rate_m = glance ? 0.002 : 0.0003;
    options.seed = seed_;
    options.active = &active;
    Eigen::AlignedBox3d box = ReachOf(edited.graph, active);
    box.extend(ReachOf(before_, Neighbourhood(before_, edited.touched_before, 1)));
    DescendBestFit(grid_, options, edited.graph);
    box.extend(ReachOf(edited.graph, active));
    const Box cells = {box.min(), box.max()};
    return (errors_before_.Over(cells) - FillError(grid_, edited.graph, cells)) / grid_.volume_m3;
  }

 private:
  const OccupancyGrid& grid_;
  std::uint64_t seed_;
  CapsuleGraph before_;
  FillErrorMap errors_before_;
};

}  // namespace

BestFitObjective::BestFitObjective(OccupancyGrid grid, CoverPoints points, std::uint64_t seed)
    : grid_(std::move(grid)), points_(std::move(points)), seed_(seed) {}

void BestFitObjective::Settle(Effort effort, CapsuleGraph& graph) const {
  BestFitOptions options;
  options.seed = seed_;
  options.steps = effort == Effort::kTouch ? 30 : effort == Effort::kRough ? 80 : 120;
  options.first_rate_m = effort == Effort::kRough ? 0.008 : 0.003;
  DescendBestFit(grid_, options, graph);
}

double BestFitObjective::Value(const CapsuleGraph& graph) const { return GridError(grid_, graph); }

std::unique_ptr<Objective::Round> BestFitObjective::StartRound(const CapsuleGraph& graph) const {
  return std::make_unique<BestFitRound>(grid_, seed_, graph);
}

std::vector<Eigen::Vector3d> BestFitObjective::WorstPoints(const CapsuleGraph& graph,
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
