#include "core/refine/enclosing_objective.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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
// Of a cell's area: what a point costs at first is some cells' worth of depth, for any body.
constexpr double kLooseCellM = 0.015;
constexpr double kLoosestPenaltyM2 = 8.0 * kLooseCellM * kLooseCellM;
constexpr double kTightening = 10.0;  // from the first round to the last
constexpr double kLooseReachM = 0.015;
constexpr std::array<double, 3> kLooseness = {1.0, 2.5, 0.5};  // of the attempts
constexpr int kSmallSet = 40;                                  // spheres
constexpr int kLooseRounds = 7;
constexpr int kLooseSteps = 2;
constexpr int kEnclosingGlanceSteps = 1;
constexpr int kEnclosingTrialSteps = 4;

class EnclosingRound final : public Objective::Round {
 public:
  EnclosingRound(const CoverPoints& points, double volume_m3, const CapsuleGraph& graph)
      : points_(points),
        volume_m3_(volume_m3),
        before_(graph),
        cones_(ConesOf(graph)),
        deepest_(FindDeepest(points, cones_)) {}

  double Try(Trial trial, EditedGraph& edited) const override {
    const std::vector<char> was = Neighbourhood(before_, edited.touched_before, 1);
    const std::vector<char> active = Neighbourhood(edited.graph, edited.touched, 1);
    const CoverPoints near = PointsHeldBy(was);
    Eigen::AlignedBox3d box = ReachOf(before_, was);
    box.extend(ReachOf(edited.graph, active));
    const double old_value = ValueIn(before_, near, box);
    EnclosingOptions options;
    options.max_steps = trial == Trial::kGlance ? kEnclosingGlanceSteps : kEnclosingTrialSteps;
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

// Lets go of the tightest points, finds the shape, and takes hold of them again little by little:
// holding on to all of them from the start ends in worse sets.
void EnclosingObjective::Loosen(double looseness, CapsuleGraph& graph) const {
  EnclosingOptions options;
  options.max_steps = kLooseSteps;
  options.row_cell_m = kLooseCellM;
  for (int round = 0; round < kLooseRounds; ++round) {
    const double share = static_cast<double>(round) / (kLooseRounds - 1);
    options.reach_m = kLooseReachM * std::pow(0.5, share);
    options.penalty = kLoosestPenaltyM2 * std::pow(kTightening, share) / (looseness * volume_m3_);
    DescendEnclosing(points_, volume_m3_, options, graph);
  }
}

void EnclosingObjective::Settle(Effort effort, CapsuleGraph& graph) const {
  EnclosingOptions tight;
  tight.max_steps = effort == Effort::kTouch ? 3 : effort == Effort::kRough ? 6 : 16;
  if (effort == Effort::kRough) Loosen(1.0, graph);
  if (effort != Effort::kFinish) {
    DescendEnclosing(points_, volume_m3_, tight, graph);
    return;
  }
  // Which local minimum comes out of it is a lottery: small sets can afford several tickets.
  const int attempts = graph.sphere_count() <= kSmallSet ? 3 : 1;
  const CapsuleGraph start = graph;
  double least = std::numeric_limits<double>::max();
  for (int i = 0; i < attempts; ++i) {
    CapsuleGraph next = i == 0 ? start : graph;
    Loosen(kLooseness[U(i)], next);
    DescendEnclosing(points_, volume_m3_, tight, next);
    // Small sets may leave points far out at any price: compare what encloses.
    CloseLastGaps(points_, next);
    const double value = Value(next);
    if (value >= least) continue;
    least = value;
    graph = std::move(next);
  }
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
