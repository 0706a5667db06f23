#include "core/refine/layouts/maker/best_fit_layout_search.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/random.h"
#include "core/refine/best_fit/best_fit_descent.h"
#include "core/refine/internal.h"
#include "core/refine/layouts/layout.h"
#include "core/refine/layouts/maker/hung_layout.h"
#include "core/refine/refine.h"

namespace capfit::refine {
namespace {

// What a mean distance of one percent of the body's diagonal, left uncovered, weighs beside E_r:
// otherwise hands are the first to go.
constexpr double kDistanceWeight = 0.1;
constexpr double kDiagonalsPerHeight = 1.25;

// From joint to joint: where the search begins.
capsule::MirroredSet HangStick(const Subject& subject, const LayoutTask& task) {
  std::vector<LayoutNode> nodes = {
      {BoneId::kBelly, {0.5, 0, 0.3}, 1.2, false}, {BoneId::kChest, {0.0, 0, 0}, 1.2, false},
      {BoneId::kChest, {0.9, 0, 0}, 0.9, false},   {BoneId::kClavicle, {0.8, 0, 0}, 1.0, true},
      {BoneId::kForearm, {0.0, 0, 0}, 1.0, true},  {BoneId::kForearm, {0.95, 0, 0}, 0.8, true},
      {BoneId::kPelvis, {0.8, 0, 0}, 1.2, true},   {BoneId::kShin, {0.0, 0, 0}, 0.9, true},
      {BoneId::kShin, {0.95, 0, 0}, 0.7, true},    {BoneId::kHead, {0.6, 0, 0.2}, 1.6, false},
      {BoneId::kHand, {0.6, 0, 0}, 1.0, true},     {BoneId::kFoot, {0.6, 0, 0}, 1.0, true}};
  std::vector<LayoutEdge> edges = {{0, 1, false}, {1, 2, false},  {2, 3, false}, {3, 4, false},
                                   {4, 5, false}, {0, 6, false},  {6, 7, false}, {7, 8, false},
                                   {2, 9, false}, {5, 10, false}, {8, 11, false}};
  if (!task.full) nodes.resize(9), edges.resize(8);
  return HangLayout({nodes, edges}, subject.body, subject.parts, true);
}

class BestFitLayoutSearch {
 public:
  BestFitLayoutSearch(const LayoutTask& task, const std::vector<Subject>& subjects)
      : task_(task), subjects_(subjects), budget_(BudgetOf(task)), random_(task.seed) {}

  Graphs Run() {
    Graphs now = Start();
    double value = ValueOf(now);
    double said = CpuSeconds();
    while (CpuSeconds() < task_.cpu_seconds) {
      if (CpuSeconds() > said + 30.0) {
        said = CpuSeconds();
        std::fprintf(stderr, "%5.0f s  %d + %d, %.4f (best %.4f)\n", said, now[0].sphere_count(),
                     now[0].capsule_count(), value, best_value_);
      }
      Graphs next = Changed(now);
      Settle(40, 0.004, next);
      double next_value = ValueOf(next);
      if (next_value < 1.03 * value) {
        Settle(64, 0.002, next);
        next_value = ValueOf(next);
      }
      const bool grown = next[0].primitive_count() > now[0].primitive_count();
      // Slightly worse is taken at first, lest the search end in the nearest minimum.
      const double cooling = std::max(0.0, 1.0 - 1.3 * CpuSeconds() / task_.cpu_seconds);
      const double slack = grown ? 0.0 : 0.004 * value * cooling * random_.NextUnit();
      if (next_value >= value + slack) continue;
      now = std::move(next);
      value = next_value;
      if (value < best_value_ && budget_.Allows(now[0].count())) best_ = now, best_value_ = value;
    }
    if (best_.empty()) best_ = now;
    Settle(200, 0.002, best_);
    return best_;
  }

 private:
  // The stick, or what the search of quality tight makes of one of the bodies, if that serves
  // all of them better.
  Graphs Start() {
    Graphs best;
    for (const Subject& s : subjects_) best.push_back(HangStick(s, task_));
    double least = Begin(best);
    for (std::size_t k = 0; k < subjects_.size(); ++k) {
      const HungLayout layout = SearchedOn(k);
      Graphs hung;
      for (const Subject& s : subjects_) {
        hung.push_back(HangLayout(layout.view(), s.body, s.parts, true));
      }
      const double value = Begin(hung);
      std::fprintf(stderr, "searched on body %zu: %d, in %d pieces, %.4f\n", k,
                   hung[0].primitive_count(), ComponentCount(hung[0]), value);
      if (value < least) least = value, best = std::move(hung);
    }
    return best;
  }

  // Finds places and keeps to the budget; what that comes to.
  double Begin(Graphs& graphs) {
    Settle(100, 0.006, graphs);
    while (!budget_.Allows(graphs[0].count()) && SpareOne(graphs)) {
    }
    return ValueOf(graphs);
  }

  // What quality tight finds for one of the bodies.
  HungLayout SearchedOn(std::size_t k) {
    const Subject& s = subjects_[k];
    RefineOptions options;
    options.enclose = false;
    options.budget = budget_;
    options.parts = s.parts;
    NullObserver observer;
    const capsule::PrimitiveSet set =
        RefineSet(s.body, tighten::TargetOf(s.body, s.parts), options, alone_, observer);
    return LayoutOf({&subjects_[k], 1}, {capsule::MirroredSet(set, true)});
  }

  int Below(int count) {
    return static_cast<int>(random_.NextBelow(static_cast<std::uint64_t>(count)));
  }

  [[nodiscard]] double ValueOf(const Graphs& graphs) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < graphs.size(); ++k) {
      const Subject& s = subjects_[k];
      sum += s.objective->Value(graphs[k], alone_);
      double sum_m = 0.0;
      for (const double excess : ExcessOf(s.points, graphs[k], alone_))
        sum_m += std::max(0.0, excess);
      const double mean_m = sum_m / static_cast<double>(s.points.grid.size());
      // About half of the surface lies outside of a best fit.
      sum += kDistanceWeight * 100.0 * 2.0 * mean_m / (kDiagonalsPerHeight * s.body.height_m);
    }
    return sum / static_cast<double>(graphs.size());
  }

  void Settle(int steps, double rate_m, Graphs& graphs) {
    for (std::size_t k = 0; k < graphs.size(); ++k) {
      const Subject& s = subjects_[k];
      BestFitOptions options;
      options.steps = steps;
      options.first_rate_m = rate_m;
      options.seed = random_.NextBelow(1'000'000);
      DescendBestFit(s.grid, options, alone_, NullObserver(), graphs[k]);
    }
  }

  // Without falling into more pieces.
  static bool ApplyLinked(const Edit& edit, Graphs& graphs) {
    Graphs next = graphs;
    if (!ApplyToAll(edit, next)) return false;
    for (std::size_t k = 0; k < next.size(); ++k) {
      if (ComponentCount(next[k]) > ComponentCount(graphs[k])) return false;
    }
    graphs = std::move(next);
    return true;
  }

  bool SpareOne(Graphs& graphs) {
    Graphs best;
    double least = std::numeric_limits<double>::max();
    const int edges = graphs[0].capsule_count();
    for (int i = 0; i < edges + graphs[0].sphere_count(); ++i) {
      Graphs next = graphs;
      const bool is_edge = i < edges;
      if (is_edge ? !graphs[0].IsCapsuleRepresentative(i)
                  : !graphs[0].IsRepresentative(i - edges)) {
        continue;
      }
      if (!ApplyLinked(
              EditOf(is_edge ? EditKind::kUnlink : EditKind::kDissolve, is_edge ? i : i - edges),
              next)) {
        continue;
      }
      Settle(24, 0.004, next);
      const double value = ValueOf(next);
      if (value < least) least = value, best = std::move(next);
    }
    if (best.empty()) return false;
    graphs = std::move(best);
    return true;
  }

  // Up to three removals where the budget is used up, then additions until it is again.
  Graphs Changed(const Graphs& graphs) {
    constexpr int kMostTries = 24;
    Graphs next = graphs;
    const bool used_up = graphs[0].primitive_count() >= task_.primitives - 1;
    for (int left = used_up ? 1 + Below(3) : 0; left > 0;) {
      const capsule::MirroredSet& graph = next[0];
      const bool edge = graph.capsule_count() > 0 && random_.NextUnit() < 0.5;
      const int i = Below(edge ? graph.capsule_count() : graph.sphere_count());
      if (edge ? !graph.IsCapsuleRepresentative(i) : !graph.IsRepresentative(i)) continue;
      ApplyLinked(EditOf(edge ? EditKind::kUnlink : EditKind::kDissolve, i), next);
      --left;
    }
    const std::vector<Eigen::Vector3d> worst =
        subjects_[0].objective->WorstPoints(next[0], 24, alone_);
    int added = 0;
    for (int i = 0; i < kMostTries; ++i) {
      const int room = task_.primitives - next[0].primitive_count();
      if (used_up ? room <= (i > kMostTries / 2 ? 1 : 0) : added >= 2) break;
      const std::optional<Edit> edit = RandomAddition(next[0], worst);
      if (!edit) continue;
      Graphs tried = next;
      if (!ApplyLinked(*edit, tried) || !budget_.Allows(tried[0].count())) continue;
      next = std::move(tried);
      ++added;
    }
    return next;
  }

  std::optional<Edit> RandomAddition(const capsule::MirroredSet& graph,
                                     const std::vector<Eigen::Vector3d>& worst) {
    const double lot = random_.NextUnit();
    if (lot < 0.35) {
      if (graph.capsule_count() == 0) return std::nullopt;
      return EditOf(EditKind::kSplit, Below(graph.capsule_count()));
    }
    if (lot < 0.7) {
      const int i = Below(graph.sphere_count()), j = Below(graph.sphere_count());
      const geometry::Sphere& a = graph.sphere(i);
      const geometry::Sphere& b = graph.sphere(j);
      const double apart_m = (a.center_m - b.center_m).norm();
      if (i == j || apart_m > 1.3 * (a.radius_m + b.radius_m)) return std::nullopt;
      return EditOf(EditKind::kLink, i, j);
    }
    if (lot < 0.93) {
      if (worst.empty()) return std::nullopt;
      const int at = Below(static_cast<int>(worst.size()));
      std::vector<Edit> leaves = LeavesAt(graph, worst[at]);
      if (leaves.empty()) return std::nullopt;
      return leaves[random_.NextBelow(leaves.size())];
    }
    const int v = Below(graph.sphere_count());
    if (!graph.IsOnPlane(v)) return std::nullopt;
    return EditOf(EditKind::kPart, v, Below(2));
  }

  const LayoutTask& task_;
  const std::vector<Subject>& subjects_;
  capsule::Budget budget_;
  ThreadPool alone_{1};
  Random random_;
  Graphs best_;
  double best_value_ = std::numeric_limits<double>::max();
};

}  // namespace

Graphs SearchBestFitLayout(const LayoutTask& task, const std::vector<Subject>& subjects) {
  return BestFitLayoutSearch(task, subjects).Run();
}

}  // namespace capfit::refine
