#include "core/refine/enclosing_descent.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/refine/boundary_integral.h"
#include "core/refine/cone.h"
#include "core/refine/interior_point.h"
#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

constexpr double kMaxReachM = 0.02;    // linearisation is worthless beyond
constexpr double kLeastReachM = 2e-4;  // the end
constexpr double kRowReach = 2.0;      // points deeper than this many reaches cannot get out
constexpr int kMaxInnerIterations = 25;

// A set with what its gradient and its points say.
struct State {
  CapsuleGraph graph;
  std::vector<Cone> cones;
  BoundaryIntegral boundary;
  Deepest deepest;
};

class Descent {
 public:
  Descent(const CoverPoints& points, double volume_m3, const EnclosingOptions& options,
          const CapsuleGraph& graph)
      : points_(points), volume_m3_(volume_m3), options_(options), reach_m_(options.reach_m) {
    block_.assign(graph.nodes.size(), -1);
    for (int v = 0; v < graph.sphere_count(); ++v) {
      const bool moves = options.active == nullptr || (*options.active)[U(v)];
      if (moves && graph.IsNodeRepresentative(v)) block_[U(v)] = blocks_++;
    }
    now_ = Evaluate(graph);
  }

  void Run() {
    if (blocks_ == 0 || points_.size() == 0) return;
    for (int i = 0; i < options_.max_steps && Step(); ++i) {
    }
  }

  [[nodiscard]] const CapsuleGraph& graph() const { return now_.graph; }

  std::vector<float> Prices() {
    std::vector<float> prices(U(points_.size()), 0.0f);
    const std::vector<int> chosen = ChooseRows();
    const StepSolution solution =
        SolveStep(BuildProblem(chosen), options_.gap_share, kMaxInnerIterations);
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      prices[U(chosen[k])] = static_cast<float>(solution.prices[static_cast<Eigen::Index>(k)]);
    }
    return prices;
  }

 private:
  State Evaluate(const CapsuleGraph& graph) {
    State state;
    state.graph = graph;
    state.cones = ConesOf(graph);
    // Multiples of an irrational: every step sees other samples.
    const double phase = Fraction(0.5 + 0.7548776662466927 * evaluations_++);
    state.boundary = IntegrateBoundary(graph, state.cones,
                                       {options_.spacing_m, phase, nullptr, options_.active});
    state.deepest = FindDeepest(points_, state.cones);
    return state;
  }

  // Takes one step where it pays, and adapts the reach. False when there is nothing left to gain.
  bool Step() {
    const std::vector<int> chosen = ChooseRows();
    const StepProblem problem = BuildProblem(chosen);
    const StepSolution solution = SolveStep(problem, options_.gap_share, kMaxInnerIterations);
    State next = Evaluate(Moved(solution.step));
    const double change = ChangeOfVolume(next, solution.step) +
                          options_.penalty * (Outside(next, chosen) - Outside(now_, chosen));
    const double ratio = change / std::min(-1e-12, solution.predicted_change);
    if (change < 0.0) {
      now_ = std::move(next);
      if (ratio > 0.6) reach_m_ = std::min(kMaxReachM, 1.6 * reach_m_);
      if (ratio < 0.25) reach_m_ *= 0.5;
    } else {
      reach_m_ *= 0.4;
    }
    const bool all_inside = options_.penalty * now_.deepest.SumOutside() < options_.least_gain;
    const bool settled = -solution.predicted_change < options_.least_gain && all_inside;
    return reach_m_ > kLeastReachM && !settled;
  }

  // In each cell, of the points of one capsule, the one that is furthest out.
  [[nodiscard]] std::vector<int> ChooseRows() const {
    struct Candidate {
      std::uint64_t cell;
      int cone;
      float excess;
      int point;
    };
    const double cell_m = std::min(options_.row_cell_m, 1.5 * reach_m_);
    const auto part = [cell_m](float v) {
      return static_cast<std::uint64_t>((v + 8.0) / cell_m) & 0x1fffff;
    };
    std::vector<Candidate> candidates;
    for (int i = 0; i < points_.size(); ++i) {
      const float excess = now_.deepest.excess_m[U(i)];
      if (excess < -kRowReach * reach_m_) continue;
      const std::uint64_t cell =
          part(points_.x[U(i)]) << 42 | part(points_.y[U(i)]) << 21 | part(points_.z[U(i)]);
      candidates.push_back({cell, now_.deepest.cone[U(i)], excess, i});
    }
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
      if (a.cone != b.cone) return a.cone < b.cone;
      if (a.cell != b.cell) return a.cell < b.cell;
      return a.excess != b.excess ? a.excess > b.excess : a.point < b.point;
    });
    std::vector<int> chosen;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const bool first = i == 0 || candidates[i].cell != candidates[i - 1].cell ||
                         candidates[i].cone != candidates[i - 1].cone;
      if (first) chosen.push_back(candidates[i].point);
    }
    return chosen;
  }

  [[nodiscard]] StepProblem BuildProblem(const std::vector<int>& chosen) const {
    StepProblem problem;
    problem.penalty = options_.penalty;
    problem.gradient.resize(4 * blocks_);
    problem.curvature.resize(4 * blocks_);
    problem.low.resize(4 * blocks_);
    problem.high.setConstant(4 * blocks_, reach_m_);
    for (std::size_t v = 0; v < block_.size(); ++v) {
      if (block_[v] < 0) continue;
      const double radius = now_.graph.nodes[v].radius_m;
      const int at = 4 * block_[v];
      problem.gradient.segment<4>(at) = now_.boundary.gradient_m2[v] / volume_m3_;
      problem.curvature.segment<4>(at).setConstant(
          0.5 * now_.boundary.area_m2[v] / (volume_m3_ * radius) + 1e-3);
      problem.low.segment<4>(at).setConstant(-reach_m_);
      problem.low[at + 3] = std::min(-1e-6, std::max(-reach_m_, kLeastRadiusM - radius));
    }
    AddRows(chosen, problem);
    return problem;
  }

  void AddRows(const std::vector<int>& chosen, StepProblem& problem) const {
    const int rows = static_cast<int>(chosen.size());
    problem.coefficients.resize(rows, 8);
    problem.offsets.resize(rows);
    for (int row = 0; row < rows; ++row) {
      const int cone = now_.deepest.cone[U(chosen[U(row)])];
      if (row == 0 || cone != now_.deepest.cone[U(chosen[U(row - 1)])]) {
        problem.groups.push_back(
            {row, row, BlockOf(now_.cones[U(cone)].node_a), BlockOf(now_.cones[U(cone)].node_b)});
      }
      problem.groups.back().end = row + 1;
      SetRow(chosen[U(row)], now_.cones[U(cone)], row, problem);
    }
  }

  [[nodiscard]] int BlockOf(int v) const { return block_[U(now_.graph.Representative(v))]; }

  void SetRow(int point, const Cone& cone, int row, StepProblem& problem) const {
    const Eigen::Vector3d p = points_.At(point).position_m.cast<double>();
    const ConeFoot foot = Locate(cone, p);
    problem.offsets[row] = now_.deepest.excess_m[U(point)];
    for (int end = 0; end < 2; ++end) {
      const int v = end == 0 ? cone.node_a : cone.node_b;
      const double share = end == 0 ? 1.0 - foot.share_b : foot.share_b;
      auto slots = problem.coefficients.row(row).segment<4>(4 * end);
      if (BlockOf(v) < 0) {
        slots.setZero();
        continue;
      }
      Eigen::Vector3d n = foot.normal;
      if (now_.graph.Representative(v) != v) n.x() = -n.x();
      if (now_.graph.IsOnPlane(v)) n.x() = 0.0;
      slots << -share * n.x(), -share * n.y(), -share * n.z(), -share;
    }
  }

  [[nodiscard]] CapsuleGraph Moved(const Eigen::VectorXd& step) const {
    CapsuleGraph graph = now_.graph;
    for (std::size_t v = 0; v < block_.size(); ++v) {
      if (block_[v] < 0) continue;
      graph.nodes[v].center_m += step.segment<3>(4 * block_[v]);
      graph.nodes[v].radius_m += step[4 * block_[v] + 3];
    }
    graph.CopyToImages();
    return graph;
  }

  // By the trapezoid rule on the gradients at both ends: less noisy than a difference of volumes.
  [[nodiscard]] double ChangeOfVolume(const State& next, const Eigen::VectorXd& step) const {
    double change = 0.0;
    for (std::size_t v = 0; v < block_.size(); ++v) {
      if (block_[v] < 0) continue;
      change += 0.5 * step.segment<4>(4 * block_[v])
                          .dot(now_.boundary.gradient_m2[v] + next.boundary.gradient_m2[v]);
    }
    return change / volume_m3_;
  }

  static double Outside(const State& state, const std::vector<int>& chosen) {
    double sum = 0.0;
    for (const int i : chosen) sum += std::max(0.0f, state.deepest.excess_m[U(i)]);
    return sum;
  }

  const CoverPoints& points_;
  double volume_m3_;
  const EnclosingOptions& options_;
  double reach_m_;
  std::vector<int> block_;  // by node; -1: does not move
  int blocks_ = 0;
  int evaluations_ = 0;
  State now_;
};

}  // namespace

void DescendEnclosing(const CoverPoints& points, double volume_m3, const EnclosingOptions& options,
                      CapsuleGraph& graph) {
  Descent descent(points, volume_m3, options, graph);
  descent.Run();
  graph = descent.graph();
}

std::vector<float> PointPrices(const CoverPoints& points, double volume_m3,
                               const CapsuleGraph& graph) {
  EnclosingOptions options;
  options.reach_m = 0.002;
  return Descent(points, volume_m3, options, graph).Prices();
}

void CloseLastGaps(const CoverPoints& points, CapsuleGraph& graph) {
  constexpr int kMaxRounds = 20;
  constexpr double kExtra = 1.01;
  for (int round = 0; round < kMaxRounds; ++round) {
    const std::vector<Cone> cones = ConesOf(graph);
    const Deepest deepest = FindDeepest(points, cones);
    std::vector<double> growth(graph.nodes.size(), 0.0);
    bool any = false;
    for (int i = 0; i < points.size(); ++i) {
      const double excess = deepest.excess_m[U(i)];
      if (excess <= 0.0) continue;
      any = true;
      const Cone& cone = cones[U(deepest.cone[U(i)])];
      // A swallowed capsule is its larger end alone.
      for (const int v : {cone.node_a, cone.is_sphere ? cone.node_a : cone.node_b}) {
        double& g = growth[U(graph.Representative(v))];
        g = std::max(g, kExtra * excess + 1e-7);
      }
    }
    if (!any) return;
    for (std::size_t v = 0; v < growth.size(); ++v) graph.nodes[v].radius_m += growth[v];
    graph.CopyToImages();
  }
}

}  // namespace capfit::refine
