#include "core/refine/enclosing_objective.h"

#include <algorithm>
#include <utility>

#include "core/refine/cone.h"
#include "core/refine/enclosing_descent.h"
#include "core/refine/internal.h"
#include "core/refine/occupancy_grid.h"

namespace capfit::refine {
namespace {

constexpr double kPenalty = 12.0;                 // body volumes per metre outside
constexpr double kVolumeCellM = 0.008;            // when volumes are compared
constexpr double kEnclosingLeafDistanceM = 0.03;  // between the points where leaves are tried
constexpr int kEnclosingTrialSteps = 4;

class EnclosingRound final : public Objective::Round {
 public:
  EnclosingRound(const CoverPoints& points, double volume_m3, const CapsuleGraph& graph)
      : points_(points),
        volume_m3_(volume_m3),
        before_(graph),
        cones_(ConesOf(graph)),
        deepest_(FindDeepest(points, cones_)) {}

  double Try(EditedGraph& edited) const override {
    const std::vector<char> was = Neighbourhood(before_, edited.touched_before, 1);
    const std::vector<char> active = Neighbourhood(edited.graph, edited.touched, 1);
    const CoverPoints near = PointsHeldBy(was);
    Eigen::AlignedBox3d box = ReachOf(before_, was);
    box.extend(ReachOf(edited.graph, active));
    const double old_value = ValueIn(before_, near, box);
    EnclosingOptions options;
    options.max_steps = kEnclosingTrialSteps;
    options.reach_m = 0.006;
    options.row_cell_m = 0.018;
    options.gap_share = 0.03;
    options.active = &active;
    DescendEnclosing(near, volume_m3_, options, edited.graph);
    return old_value - ValueIn(edited.graph, near, box);
  }

 private:
  // The points whose deepest capsule ends at one of the nodes.
  [[nodiscard]] CoverPoints PointsHeldBy(const std::vector<char>& nodes) const {
    std::vector<char> holds(cones_.size(), 0);
    for (std::size_t j = 0; j < cones_.size(); ++j) {
      holds[j] = nodes[U(cones_[j].node_a)] || nodes[U(cones_[j].node_b)];
    }
    std::vector<CoverPoint> held;
    for (int i = 0; i < points_.size(); ++i) {
      if (holds[U(deepest_.cone[U(i)])]) held.push_back(points_.At(i));
    }
    return MakeCoverPoints(std::move(held));
  }

  [[nodiscard]] double ValueIn(const CapsuleGraph& graph, const CoverPoints& points,
                               const Eigen::AlignedBox3d& box) const {
    const double volume = UnionVolume(graph, {box.min(), box.max()}, kVolumeCellM);
    return volume / volume_m3_ + kPenalty * FindDeepest(points, ConesOf(graph)).SumOutside();
  }

  const CoverPoints& points_;
  double volume_m3_;
  CapsuleGraph before_;
  std::vector<Cone> cones_;
  Deepest deepest_;
};

}  // namespace

EnclosingObjective::EnclosingObjective(CoverPoints points, double volume_m3)
    : points_(std::move(points)), volume_m3_(volume_m3) {}

void EnclosingObjective::Settle(Effort effort, CapsuleGraph& graph) const {
  EnclosingOptions options;
  if (effort == Effort::kRough) {
    options.reach_m = 0.01;
    options.max_steps = 4;
    for (const double penalty : {0.1, 0.3}) {
      options.penalty = penalty;
      DescendEnclosing(points_, volume_m3_, options, graph);
    }
  }
  options = {};
  options.max_steps = effort == Effort::kTouch ? 3 : effort == Effort::kRough ? 6 : 16;
  DescendEnclosing(points_, volume_m3_, options, graph);
}

double EnclosingObjective::Value(const CapsuleGraph& graph) const {
  const Box box = BoundsOf(graph, kVolumeCellM);
  return UnionVolume(graph, box, kVolumeCellM) / volume_m3_ - 1.0 +
         kPenalty * FindDeepest(points_, ConesOf(graph)).SumOutside();
}

std::unique_ptr<Objective::Round> EnclosingObjective::StartRound(const CapsuleGraph& graph) const {
  return std::make_unique<EnclosingRound>(points_, volume_m3_, graph);
}

std::vector<Eigen::Vector3d> EnclosingObjective::WorstPoints(const CapsuleGraph& graph,
                                                             int count) const {
  const std::vector<float> prices = PointPrices(points_, volume_m3_, graph);
  std::vector<Eigen::Vector3d> positions;
  std::vector<double> scores;
  for (int i = 0; i < points_.size(); ++i) {
    if (prices[U(i)] < 1e-3f) continue;
    positions.push_back(points_.At(i).position_m.cast<double>());
    scores.push_back(prices[U(i)]);
  }
  return BestApart(positions, scores, kEnclosingLeafDistanceM, count);
}

}  // namespace capfit::refine
