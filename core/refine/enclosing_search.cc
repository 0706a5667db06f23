#include "core/refine/enclosing_search.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "core/refine/graph_edit.h"
#include "core/refine/internal.h"
#include "core/refine/starting_graphs.h"

namespace capfit::refine {
namespace {

// Steps, as few as do: topology decides more than the last digits of places.
constexpr int kGrowthSteps = 6;
constexpr int kSparingSteps = 3;
constexpr int kTrialSteps = 4;
constexpr int kTakeInSteps = 2;
// How starts are settled: each in all of these ways.
struct Ticket {
  int steps;
  double looseness;
};
constexpr std::array<Ticket, 2> kTickets = {{{8, 1.0}, {10, 2.0}}};
// A round of growth or sparing goes so far.
constexpr double kGrowthShare = 0.2;
constexpr int kLeastGrowth = 4;
constexpr double kSparedShare = 0.34;
// Either half of a cut capsule is taken to be this much as loose as the whole.
constexpr double kGapOfHalf = 0.25;
// Exchanges: trials at once, and in all; fewer where each takes longer.
constexpr std::size_t kTrialsAtOnce = 4;
constexpr int kMostTrials = 16;
constexpr int kLeastTrials = 4;
constexpr int kTrialPrimitives = 1024;
constexpr double kLeastImprovement = 1e-4;
constexpr std::size_t kLeaders = 2;
constexpr std::size_t kTies = 8;
constexpr double kTieReach = 1.1;  // between centres, in sums of radii

// Tells trials apart from each other, whatever thread they run on.
constexpr std::uint64_t kTrialSeeds = 1000;

bool IsPair(const CapsuleGraph& graph, int index, int image) {
  return graph.symmetric && image != index;
}

struct Removal {
  double loss_per_primitive = 0.0;
  Edit edit;
};

// All that may go, what is least missed first.
std::vector<Removal> RemovalsOf(const CapsuleGraph& graph, const GraphWorth& worth) {
  std::vector<Removal> removals;
  for (int e = 0; e < graph.capsule_count(); ++e) {
    if (!graph.IsEdgeRepresentative(e)) continue;
    const int freed = IsPair(graph, e, graph.edges[U(e)].mirror) ? 2 : 1;
    removals.push_back({worth.edge_loss[U(e)] / freed, EditOf(EditKind::kUnlink, e)});
  }
  std::vector<int> degree(graph.nodes.size(), 0);
  for (const Edge& e : graph.edges) ++degree[U(e.a)], ++degree[U(e.b)];
  for (int v = 0; v < graph.sphere_count(); ++v) {
    if (!graph.IsNodeRepresentative(v) || degree[U(v)] > 2) continue;
    const int freed =
        (IsPair(graph, v, graph.nodes[U(v)].mirror) ? 2 : 1) * (degree[U(v)] > 0 ? 2 : 1);
    removals.push_back({worth.node_loss[U(v)] / freed, EditOf(EditKind::kDissolve, v)});
  }
  std::stable_sort(removals.begin(), removals.end(), [](const Removal& a, const Removal& b) {
    return a.loss_per_primitive < b.loss_per_primitive;
  });
  return removals;
}

// Cuts the loosest capsules in two until there are `target` primitives or nothing may be cut. The
// spheres in the middle change nothing yet.
void CutLoosest(const Spending& spending, int target, const std::vector<double>& gaps,
                CapsuleGraph& graph) {
  using Ends = std::pair<int, int>;
  std::map<Ends, double> gap_of;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    gap_of[{graph.edges[e].a, graph.edges[e].b}] = gaps[e];
  }
  Spending limits = spending;
  limits.max_primitives = std::min(limits.max_primitives, target);
  for (;;) {
    int loosest = -1;
    double most = 0.0;
    for (int e = 0; e < graph.capsule_count(); ++e) {
      const Edge& edge = graph.edges[U(e)];
      const int cost = IsPair(graph, e, edge.mirror) ? 2 : 1;
      if (!graph.IsEdgeRepresentative(e) || graph.sphere_count() + cost > limits.max_spheres ||
          graph.capsule_count() + cost > limits.max_capsules ||
          graph.primitive_count() + 2 * cost > limits.max_primitives) {
        continue;
      }
      const double gap = gap_of[{edge.a, edge.b}] / cost;
      if (gap > most) most = gap, loosest = e;
    }
    if (loosest < 0) return;
    const Edge cut = graph.edges[U(loosest)];
    const double half = kGapOfHalf * gap_of[{cut.a, cut.b}];
    const int first_new = graph.sphere_count();
    graph = Apply(graph, EditOf(EditKind::kSplit, loosest)).graph;
    for (const Edge& e : graph.edges) {
      if (e.b >= first_new) gap_of.emplace(Ends{e.a, e.b}, half);
    }
  }
}

class Search {
 public:
  Search(const EnclosingTask& task, const Spending& spending, const ThreadPool& pool,
         const FitObserver& observer)
      : task_(task),
        spending_(spending),
        primitives_(static_cast<int>(std::min<std::int64_t>(
            spending.max_primitives, std::int64_t{spending.max_spheres} + spending.max_capsules))),
        pool_(pool),
        observer_(observer) {}

  std::vector<CapsuleGraph> Run(const std::vector<CapsuleGraph>& starts) {
    Attempt best = BestStart(starts);
    Exchange(best);
    Tie(best);
    std::vector<CapsuleGraph> graphs;
    for (Attempt& attempt : leaders_) graphs.push_back(std::move(attempt.graph));
    if (graphs.empty()) graphs.push_back(std::move(best.graph));
    return graphs;
  }

 private:
  // A graph whose shape is found, and what it is worth with its points taken in.
  struct Attempt {
    CapsuleGraph graph;
    double value = std::numeric_limits<double>::max();
  };

  Attempt Settled(CapsuleGraph graph, std::uint64_t seed) const {
    CapsuleGraph settled = graph;
    task_.TakeIn(kTakeInSteps, seed, alone_, observer_, settled);
    return {std::move(graph), task_.Value(settled, alone_)};
  }

  Attempt BestStart(const std::vector<CapsuleGraph>& starts) {
    std::vector<Attempt> attempts(starts.size() * kTickets.size());
    pool_.ForEach(attempts.size(), [&](std::size_t i) {
      const Ticket& ticket = kTickets[i % kTickets.size()];
      CapsuleGraph graph = starts[i / kTickets.size()];
      task_.FindShape(ticket.steps, ticket.looseness, /*seed=*/1, alone_, observer_, graph);
      RemoveSwallowed(graph);
      Spare(graph);
      Grow(graph);
      attempts[i] = Settled(std::move(graph), /*seed=*/2);
    });
    Lead(attempts);
    const auto excess = [this](const Attempt& a) { return Excess(spending_, a.graph); };
    return *std::min_element(
        attempts.begin(), attempts.end(), [&](const Attempt& a, const Attempt& b) {
          return std::tuple(excess(a), a.value) < std::tuple(excess(b), b.value);
        });
  }

  // Remembers the best of all attempts.
  void Lead(const std::vector<Attempt>& attempts) {
    for (const Attempt& attempt : attempts) {
      if (attempt.graph.nodes.empty() || !spending_.Allows(attempt.graph)) continue;
      leaders_.push_back(attempt);
    }
    std::stable_sort(leaders_.begin(), leaders_.end(),
                     [](const Attempt& a, const Attempt& b) { return a.value < b.value; });
    leaders_.resize(std::min(leaders_.size(), kLeaders));
  }

  // Until the graph fits the spending.
  void Spare(CapsuleGraph& graph) const {
    while (!spending_.Allows(graph) && !observer_.IsCancelled()) {
      const int excess = Excess(spending_, graph);
      const int target =
          excess - std::max(1, static_cast<int>(kSparedShare * static_cast<double>(excess)));
      do {
        if (!SpareOne(graph)) return;
      } while (Excess(spending_, graph) > target);
      task_.FindShape(kSparingSteps, 1.0, /*seed=*/3, alone_, observer_, graph);
      RemoveSwallowed(graph);
    }
  }

  bool SpareOne(CapsuleGraph& graph) const {
    const bool only_spheres = graph.primitive_count() <= spending_.max_primitives &&
                              graph.capsule_count() <= spending_.max_capsules;
    std::optional<CapsuleGraph> last_resort;
    for (const Removal& removal : RemovalsOf(graph, task_.Weigh(graph))) {
      EditedGraph edited = Apply(graph, removal.edit);
      if (!edited.possible) continue;
      if (only_spheres && removal.edit.kind == EditKind::kUnlink) {
        if (!last_resort) last_resort = std::move(edited.graph);
        continue;
      }
      graph = std::move(edited.graph);
      return true;
    }
    if (!last_resort) return false;
    graph = *std::move(last_resort);
    return true;
  }

  // Until the spending is used up.
  void Grow(CapsuleGraph& graph) const {
    for (std::uint64_t seed = 10; spending_.Allows(graph) && !observer_.IsCancelled(); ++seed) {
      const int before = graph.primitive_count();
      const int more = std::max(kLeastGrowth, static_cast<int>(kGrowthShare * before));
      CutLoosest(spending_, before + more, task_.Weigh(graph).edge_gap, graph);
      if (graph.primitive_count() == before) return;
      task_.FindShape(kGrowthSteps, 1.0, seed, alone_, observer_, graph);
      RemoveSwallowed(graph);
      if (graph.primitive_count() <= before) return;
    }
  }

  // What each edit leads to, the budget used up again.
  Attempt Try(const CapsuleGraph& graph, const Edit& edit, std::uint64_t seed) const {
    EditedGraph edited = Apply(graph, edit);
    if (!edited.possible || observer_.IsCancelled()) return {};
    RemoveSwallowed(edited.graph);
    CutLoosest(spending_, primitives_, task_.Weigh(edited.graph).edge_gap, edited.graph);
    task_.FindShape(kTrialSteps, 1.0, seed, alone_, observer_, edited.graph);
    RemoveSwallowed(edited.graph);
    if (!spending_.Allows(edited.graph)) return {};
    return Settled(std::move(edited.graph), seed);
  }

  // Tries some edits in parallel; whether the best of them was taken.
  bool TryAll(const std::vector<Edit>& edits, Attempt& best) {
    std::vector<Attempt> attempts(edits.size());
    pool_.ForEach(edits.size(),
                  [&](std::size_t i) { attempts[i] = Try(best.graph, edits[i], seed_ + i); });
    seed_ += edits.size();
    Lead(attempts);
    const auto found =
        std::min_element(attempts.begin(), attempts.end(),
                         [](const Attempt& a, const Attempt& b) { return a.value < b.value; });
    if (found == attempts.end() || observer_.IsCancelled() ||
        found->value >= (1.0 - kLeastImprovement) * best.value) {
      return false;
    }
    best = std::move(*found);
    return true;
  }

  void Exchange(Attempt& best) {
    const int most = std::clamp(kTrialPrimitives / std::max(1, best.graph.primitive_count()),
                                kLeastTrials, kMostTrials);
    std::vector<Removal> removals = RemovalsOf(best.graph, task_.Weigh(best.graph));
    std::size_t next = 0;
    for (int trials = 0; trials < most && next < removals.size() && !observer_.IsCancelled();) {
      std::vector<Edit> edits;
      for (; edits.size() < kTrialsAtOnce && next < removals.size(); ++next) {
        edits.push_back(removals[next].edit);
      }
      trials += static_cast<int>(edits.size());
      if (!TryAll(edits, best)) continue;
      removals = RemovalsOf(best.graph, task_.Weigh(best.graph));
      next = 0;
    }
  }

  // Ties between near spheres, those with the loosest capsules around them first.
  [[nodiscard]] std::vector<Edit> TiesOf(const CapsuleGraph& graph) const {
    const std::vector<double> gaps = task_.Weigh(graph).edge_gap;
    std::vector<double> around(graph.nodes.size(), 0.0);
    for (std::size_t e = 0; e < gaps.size(); ++e) {
      around[U(graph.edges[e].a)] += gaps[e];
      around[U(graph.edges[e].b)] += gaps[e];
    }
    std::vector<std::pair<double, Edit>> ties;
    for (int i = 0; i < graph.sphere_count(); ++i) {
      for (int j = i + 1; j < graph.sphere_count(); ++j) {
        const Node& a = graph.nodes[U(i)];
        const Node& b = graph.nodes[U(j)];
        if (graph.symmetric && std::minmax(a.mirror, b.mirror) < std::minmax(i, j)) continue;
        if ((a.center_m - b.center_m).norm() > kTieReach * (a.radius_m + b.radius_m)) continue;
        const Edit tie = EditOf(EditKind::kLink, i, j);
        const EditedGraph edited = Apply(graph, tie);
        if (!edited.possible || !spending_.Allows(edited.graph)) continue;
        ties.emplace_back(around[U(i)] + around[U(j)], tie);
      }
    }
    std::stable_sort(ties.begin(), ties.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Edit> edits;
    for (const auto& [gap, tie] : ties) edits.push_back(tie);
    edits.resize(std::min(edits.size(), kTies));
    return edits;
  }

  void Tie(Attempt& best) {
    while (best.graph.primitive_count() < primitives_ && !observer_.IsCancelled()) {
      if (!TryAll(TiesOf(best.graph), best)) return;
    }
  }

  const EnclosingTask& task_;
  const Spending& spending_;
  int primitives_;
  const ThreadPool& pool_;
  const ThreadPool alone_{1};  // inside what runs in parallel already
  const FitObserver& observer_;
  std::uint64_t seed_ = kTrialSeeds;
  std::vector<Attempt> leaders_;
};

}  // namespace

std::vector<CapsuleGraph> FindEnclosingGraphs(const EnclosingTask& task, const Spending& spending,
                                              const std::vector<CapsuleGraph>& starts,
                                              const ThreadPool& pool, const FitObserver& observer) {
  return Search(task, spending, pool, observer).Run(starts);
}

}  // namespace capfit::refine
