#include "core/refine/layouts/maker/enclosing_layout_search.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "core/base/random.h"
#include "core/refine/internal.h"
#include "core/refine/layouts/layout.h"
#include "core/refine/layouts/maker/hung_layout.h"
#include "core/refine/layouts/standard_layouts.h"
#include "core/refine/layouts/starting_graphs.h"
#include "core/refine/refine.h"

namespace capfit::refine {
namespace {

constexpr int kFirstSteps = 10;
constexpr int kTrialSteps = 4;
constexpr int kTakeInSteps = 2;
// A change this much worse on one body is not tried on the others; one this much worse on all
// is not settled further.
constexpr double kHopeless = 1.06;
constexpr double kPromising = 1.02;
constexpr double kFirstSlack = 0.004;  // a change may be this much worse in the beginning
constexpr double kCooling = 1.3;       // and none from 1 / this of the time on
constexpr int kMostRemovals = 3;
constexpr double kLargeShare = 0.08;  // of the graph, that a large change gives up at most,
constexpr double kLargeChance = 0.2;  // and how often there is one
constexpr int kIdle = 150;  // trials in vain, after which the present graph is settled anew
constexpr int kMostAdditions = 24;
constexpr double kRewiringShare = 0.3;
constexpr double kTieReach = 1.3;  // between centres, in sums of radii

class EnclosingLayoutSearch {
 public:
  EnclosingLayoutSearch(const LayoutTask& task, const std::vector<Subject>& subjects)
      : task_(task), subjects_(subjects), budget_(BudgetOf(task)), random_(task.seed) {}

  Graphs Run() {
    Attempt now = Start();
    Attempt best = now;
    if (!budget_.Allows(now.graphs[0].count())) best.value = std::numeric_limits<double>::max();
    int tried = 0;
    int taken = 0;
    int idle = 0;
    double said = CpuSeconds();
    while (CpuSeconds() < task_.cpu_seconds) {
      std::optional<Attempt> next = Tried(Changed(now.graphs), now);
      ++tried;
      if (CpuSeconds() > said + 60.0) {
        said = CpuSeconds();
        std::fprintf(stderr, "%5.0f s  %d tried, %d taken, %d + %d, %.4f (best %.4f)\n", said,
                     tried, taken, now.graphs[0].sphere_count(), now.graphs[0].capsule_count(),
                     now.value, best.value);
      }
      if (++idle > kIdle) {
        // What was taken may owe its place to luck: samples differ from one trial to the next.
        const bool is_best = now.value == best.value;
        now = Begun(Hung(LayoutOf(subjects_, now.graphs)));
        if (is_best) best = now;
        idle = 0;
      }
      if (!next) continue;
      const double cooling = std::max(0.0, 1.0 - kCooling * CpuSeconds() / task_.cpu_seconds);
      const double slack = kFirstSlack * now.value * cooling * random_.NextUnit();
      if (next->value >= now.value + slack) continue;
      now = *std::move(next);
      idle = 0;
      ++taken;
      if (now.value < best.value && budget_.Allows(now.graphs[0].count())) best = now;
    }
    std::fprintf(stderr, "%d tried, %d taken, %.4f\n", tried, taken, best.value);
    return best.graphs;
  }

 private:
  // Relative to the body's volume, beyond it; by body, and their mean.
  struct Attempt {
    Graphs graphs;
    std::vector<double> values;
    double value = std::numeric_limits<double>::max();
  };

  // The stored layout, a standard one, or what the search of quality tight makes of one of the
  // bodies: what serves all of them best.
  Attempt Start() {
    LayoutTask first = task_;
    if (task_.first_primitives > 0) first.primitives = task_.first_primitives;
    Graphs stored;
    for (const Subject& s : subjects_) {
      stored.push_back(StartingGraphs(FitKind::kEnclose, s.body, s.parts, BudgetOf(first),
                                      {.most_spared = 0}, alone_)
                           .front());
    }
    Attempt best = Begun(std::move(stored));
    const auto compare = [&](const std::string& name, Graphs graphs) {
      Attempt start = Begun(std::move(graphs));
      std::fprintf(stderr, "%s: %d + %d, %.4f\n", name.c_str(), start.graphs[0].sphere_count(),
                   start.graphs[0].capsule_count(), start.value);
      if (start.value < best.value) best = std::move(start);
    };
    for (const KeptLayout& layout : StandardLayouts()) {
      if (task_.full && budget_.Allows(layout.count())) compare(layout.name, Hung(layout));
    }
    for (std::size_t k = 0; k < subjects_.size(); ++k) {
      compare(absl::StrCat("searched on body ", k), Hung(SearchedOn(k)));
    }
    return best;
  }

  [[nodiscard]] Graphs Hung(const KeptLayout& layout) const {
    Graphs hung;
    for (const Subject& s : subjects_) {
      absl::StatusOr<capsule::MirroredSet> graph = HangLayout(layout, s.body);
      if (graph.ok()) hung.push_back(*std::move(graph));
    }
    return hung;
  }

  [[nodiscard]] Graphs Hung(const HungLayout& layout) const {
    Graphs hung;
    for (const Subject& s : subjects_) {
      hung.push_back(HangLayout(layout.view(), s.body, s.parts, s.body.is_symmetric));
    }
    return hung;
  }

  Attempt Begun(Graphs graphs) {
    Attempt start{std::move(graphs), {}, 0.0};
    for (std::size_t k = 0; k < subjects_.size(); ++k) {
      Settle(k, kFirstSteps, start.graphs[k]);
      start.values.push_back(ValueOf(k, start.graphs[k]));
    }
    start.value = MeanOf(start.values);
    return start;
  }

  // What quality tight finds for one of the bodies.
  HungLayout SearchedOn(std::size_t k) {
    const Subject& s = subjects_[k];
    RefineOptions options;
    options.budget = BudgetOf(task_);
    options.parts = s.parts;
    NullObserver observer;
    const capsule::PrimitiveSet set =
        RefineSet(s.body, tighten::TargetOf(s.body, s.parts), options, alone_, observer);
    return LayoutOf({&subjects_[k], 1}, {capsule::MirroredSet(set, true)});
  }

  static double MeanOf(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  }

  void Settle(std::size_t subject, int steps, capsule::MirroredSet& graph) {
    const EnclosingTask& task = *subjects_[subject].enclosing;
    const std::uint64_t seed = random_.NextBelow(1'000'000);
    task.FindShape(steps, 1.0, seed, alone_, meter_, graph);
    task.TakeIn(kTakeInSteps, seed, alone_, meter_, graph);
  }

  [[nodiscard]] double ValueOf(std::size_t subject, const capsule::MirroredSet& graph) const {
    const Subject& s = subjects_[subject];
    const double beyond = s.enclosing->Value(graph, alone_).total_m3 / s.grid.volume_m3 - 1.0;
    // A union that is smaller than the body is hollow: many spheres along the skin and none inside.
    return beyond < 0.0 ? std::numeric_limits<double>::max() : beyond;
  }

  // What the changed graphs come to, hung anew by the layout that they make: what counts is where
  // each body gets from there, not from where the search has led it. Nothing where that is
  // hopeless.
  std::optional<Attempt> Tried(Graphs graphs, const Attempt& now) {
    Attempt attempt{std::move(graphs), std::vector<double>(subjects_.size()), 0.0};
    if (!SettleAll(kTrialSteps, now, attempt)) return std::nullopt;
    if (attempt.value > kPromising * now.value) return std::nullopt;
    const HungLayout layout = LayoutOf(subjects_, attempt.graphs);
    attempt.graphs = Hung(layout);
    if (!SettleAll(kFirstSteps, now, attempt)) return std::nullopt;
    return attempt;
  }

  // False as soon as one body is much worse than now.
  bool SettleAll(int steps, const Attempt& now, Attempt& attempt) {
    const std::size_t first = random_.NextBelow(subjects_.size());
    for (std::size_t i = 0; i < subjects_.size(); ++i) {
      const std::size_t k = (first + i) % subjects_.size();
      Settle(k, steps, attempt.graphs[k]);
      attempt.values[k] = ValueOf(k, attempt.graphs[k]);
      if (attempt.values[k] > kHopeless * now.values[k]) return false;
    }
    attempt.value = MeanOf(attempt.values);
    return true;
  }

  int Below(int count) {
    return static_cast<int>(random_.NextBelow(static_cast<std::uint64_t>(count)));
  }

  // The worth of the mean body, each in its own volume.
  [[nodiscard]] GraphWorth WorthOf(const Graphs& graphs) const {
    GraphWorth sum;
    for (std::size_t k = 0; k < graphs.size(); ++k) {
      GraphWorth one = subjects_[k].enclosing->Weigh(graphs[k]);
      if (k == 0) {
        sum = std::move(one);
        continue;
      }
      const auto add = [](const std::vector<double>& from, std::vector<double>& to) {
        for (std::size_t i = 0; i < to.size(); ++i) to[i] += from[i];
      };
      add(one.edge_gap, sum.edge_gap);
      add(one.edge_loss, sum.edge_loss);
      add(one.node_loss, sum.node_loss);
    }
    return sum;
  }

  // Draws from a list in order of weight, the first ones most often; the exponent says how much.
  int Drawn(const std::vector<double>& weights, bool largest_first, double exponent) {
    std::vector<int> order(weights.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return largest_first ? weights[a] > weights[b] : weights[a] < weights[b];
    });
    const double share = std::pow(random_.NextUnit(), exponent);
    return order[static_cast<std::size_t>(share * static_cast<double>(order.size()))];
  }

  Graphs Changed(const Graphs& graphs) {
    Graphs next = graphs;
    const bool used_up = graphs[0].primitive_count() >= task_.primitives - 1 ||
                         graphs[0].sphere_count() >= budget_.max_spheres;
    if (used_up && random_.NextUnit() < kRewiringShare) {
      Rewire(next);
    } else {
      Remove(used_up ? RemovalsOf(graphs[0]) : Below(2), next);
    }
    Add(used_up, next);
    return next;
  }

  int RemovalsOf(const capsule::MirroredSet& graph) {
    const bool large = random_.NextUnit() < kLargeChance;
    const int most = large ? static_cast<int>(kLargeShare * graph.primitive_count()) : 0;
    return 1 + Below(std::max(kMostRemovals, most));
  }

  void Remove(int count, Graphs& graphs) {
    for (int tries = 0; count > 0 && tries < kMostAdditions; ++tries) {
      const GraphWorth worth = WorthOf(graphs);
      const capsule::MirroredSet& graph = graphs[0];
      const bool edge = graph.capsule_count() > 0 && random_.NextUnit() < 0.5;
      const int i = Drawn(edge ? worth.edge_loss : worth.node_loss, false, 2.5);
      if (ApplyToAll(EditOf(edge ? EditKind::kUnlink : EditKind::kDissolve, i), graphs)) --count;
    }
  }

  // One capsule gets another end.
  void Rewire(Graphs& graphs) {
    const capsule::MirroredSet& graph = graphs[0];
    if (graph.capsule_count() == 0) return;
    const int index = Below(graph.capsule_count());
    const capsule::CapsuleEnds& edge = graph.ends(index);
    const int kept = Below(2) == 0 ? edge[0] : edge[1];
    const std::optional<int> other = NearTo(graph, kept);
    if (!other) return;
    Graphs next = graphs;
    if (!ApplyToAll(EditOf(EditKind::kUnlink, index), next)) return;
    if (!ApplyToAll(EditOf(EditKind::kLink, kept, *other), next)) return;
    graphs = std::move(next);
  }

  std::optional<int> NearTo(const capsule::MirroredSet& graph, int v) {
    std::vector<int> near;
    const geometry::Sphere& a = graph.sphere(v);
    for (int j = 0; j < graph.sphere_count(); ++j) {
      const geometry::Sphere& b = graph.sphere(j);
      const double apart_m = (a.center_m - b.center_m).norm();
      if (j != v && apart_m < kTieReach * (a.radius_m + b.radius_m)) near.push_back(j);
    }
    if (near.empty()) return std::nullopt;
    return near[Below(static_cast<int>(near.size()))];
  }

  void Add(bool used_up, Graphs& graphs) {
    int added = 0;
    for (int i = 0; i < kMostAdditions; ++i) {
      const int room = task_.primitives - graphs[0].primitive_count();
      if (used_up ? room <= (i > kMostAdditions / 2 ? 1 : 0) : added >= 2) break;
      const std::optional<Edit> edit = Addition(graphs);
      if (!edit) continue;
      Graphs tried = graphs;
      if (!ApplyToAll(*edit, tried) || !budget_.Allows(tried[0].count())) continue;
      graphs = std::move(tried);
      ++added;
    }
  }

  std::optional<Edit> Addition(const Graphs& graphs) {
    const capsule::MirroredSet& graph = graphs[0];
    const double lot = random_.NextUnit();
    if (lot < 0.35) {
      if (graph.capsule_count() == 0) return std::nullopt;
      return EditOf(EditKind::kSplit, Drawn(WorthOf(graphs).edge_gap, true, 1.5));
    }
    const int v = Below(graph.sphere_count());
    if (lot < 0.8) {
      const std::optional<int> other = NearTo(graph, v);
      if (!other) return std::nullopt;
      return EditOf(EditKind::kLink, v, *other);
    }
    if (lot < 0.93) {
      const auto vertices = subjects_[0].body.mesh.vertices();
      const Eigen::Vector3d& point = vertices[random_.NextBelow(vertices.size())];
      std::vector<Edit> leaves = LeavesAt(graph, point);
      if (leaves.empty()) return std::nullopt;
      return leaves[random_.NextBelow(leaves.size())];
    }
    if (!graph.IsOnPlane(v)) return std::nullopt;
    return EditOf(EditKind::kPart, v, Below(2));
  }

  const LayoutTask& task_;
  const std::vector<Subject>& subjects_;
  capsule::Budget budget_;
  Random random_;
  const ThreadPool alone_{1};
  NullObserver observer_;
  WorkMeter meter_{observer_};
};

}  // namespace

Graphs SearchEnclosingLayout(const LayoutTask& task, const std::vector<Subject>& subjects) {
  return EnclosingLayoutSearch(task, subjects).Run();
}

}  // namespace capfit::refine
