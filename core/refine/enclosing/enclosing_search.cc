#include "core/refine/enclosing/enclosing_search.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "core/base/enum_index.h"
#include "core/base/work_meter.h"
#include "core/refine/enclosing/enclosing_moves.h"
#include "core/refine/enclosing/give_up.h"
#include "core/refine/enclosing/joined_graph.h"
#include "core/refine/graph/graph_edit.h"
#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

// Steps, as few as do: topology decides more than the last digits of places.
constexpr int kGrowthSteps = 3;
constexpr int kSparingSteps = 3;
constexpr int kTrialSteps = 3;
constexpr int kJoinedSteps = 5;
constexpr int kTakeInSteps = 2;
constexpr int kStartSteps = 8;
constexpr int kLooseSteps = 2;     // that show where ties would win
constexpr double kTieShare = 0.5;  // of what growth spends, into ties and leaves
// A round of growth or sparing goes so far.
constexpr double kGrowthShare = 0.2;
constexpr int kLeastGrowth = 4;
constexpr double kSparedShare = 0.34;  // of what is too much, or if that is more
constexpr double kLeastSpared = 0.06;  // of the graph
constexpr int kUsedUp = 3;             // a graph this near to the budget is not grown
constexpr double kLeastImprovement = 1e-4;
constexpr std::size_t kTies = 8;
// Much is given up and spent anew at once, in one of these ways or another.
struct Renewal {
  double given_up;   // part of the primitives
  double tie_share;  // part of those that goes into ties and leaves
};
constexpr std::array<Renewal, 4> kRenewals = {{{0.06, 0.5}, {0.24, 0.3}, {0.12, 1.0}, {0.24, 0.6}}};

// How much of the search's time has gone by at the end of each part, as measured.
constexpr double kStarted = 0.2;
constexpr double kGrown = 0.3;
constexpr double kRenewed = 0.97;
constexpr double kTieRound = 0.5;  // of what is left of its part
constexpr int kStepsOfGrowth = kLooseSteps + kGrowthSteps + kTakeInSteps;

// Tells trials apart from each other, whatever thread they run on.
constexpr std::uint64_t kFirstSeed = 10;

// Takes away what adds no shape of its own.
void Simplify(capsule::MirroredSet& graph) {
  JoinNearPairs(graph);
  RemoveSwallowed(graph);
}

class Search {
 public:
  Search(const EnclosingTask& rough, const EnclosingTask& task, const capsule::Budget& budget,
         const RenewalPlan& plan, double until, const ThreadPool& pool, WorkMeter& meter)
      : rough_(rough),
        task_(task),
        final_budget_(budget),
        budget_(plan.BudgetOfRound(0, budget)),
        plan_(plan),
        primitives_(budget.MostPrimitives()),
        until_(until),
        pool_(pool),
        meter_(meter) {}

  std::vector<capsule::MirroredSet> Run(const std::vector<capsule::MirroredSet>& starts) {
    std::vector<Attempt> kept = BestStarts(starts);
    for (int round = 0; round < plan_.rounds && !meter_.IsCancelled(); ++round) {
      budget_ = plan_.BudgetOfRound(round, final_budget_);
      Renew(round, kept);
    }
    Spare(kept.front().graph);  // if no renewed one fits
    Tie(kept.front());
    std::vector<capsule::MirroredSet> graphs;
    for (Attempt& attempt : kept) {
      if (std::cmp_less(graphs.size(), plan_.found)) graphs.push_back(std::move(attempt.graph));
    }
    return graphs;
  }

 private:
  // A graph whose shape is found, and what it is worth with its points taken in.
  struct Attempt {
    capsule::MirroredSet graph;
    GraphValue value = {std::numeric_limits<double>::max(), {}};
  };

  Attempt Settled(capsule::MirroredSet graph, std::uint64_t seed) const {
    capsule::MirroredSet settled = graph;
    task_.TakeIn(kTakeInSteps, seed, pool_, meter_, settled);
    return {std::move(graph), task_.Value(settled, pool_)};
  }

  // The best first, as many as the plan keeps.
  std::vector<Attempt> BestStarts(const std::vector<capsule::MirroredSet>& starts) {
    std::vector<Attempt> attempts(starts.size());
    std::int64_t work = 0;
    for (const capsule::MirroredSet& start : starts) {
      work += (kStartSteps + kTakeInSteps) * start.primitive_count();
    }
    meter_.Expect(until_ * kStarted, work);
    pool_.ForEach(starts.size(), [&](std::size_t i) {
      capsule::MirroredSet graph = starts[i];
      rough_.FindShape(kStartSteps, 1.0, /*seed=*/1, pool_, meter_, graph);
      Simplify(graph);
      Spare(graph);
      attempts[i] = Settled(std::move(graph), /*seed=*/2);
    });
    // Graphs that have the budget's size already wait for what the best of the others grows to.
    const auto is_small = [this](const Attempt& a) {
      return a.graph.primitive_count() + kUsedUp < primitives_;
    };
    const auto large = std::stable_partition(attempts.begin(), attempts.end(), is_small);
    std::vector<Attempt> small(attempts.begin(), large);
    attempts.erase(attempts.begin(), large);
    Sort(small);
    if (!small.empty()) {
      Grow(small.front());
      attempts.push_back(std::move(small.front()));
    }
    KeepBest(attempts);
    return attempts;
  }

  // Of graphs that are worth the same one is enough; what is over the budget is the last resort.
  void KeepBest(std::vector<Attempt>& attempts) const {
    Sort(attempts);
    std::size_t kept = 1;
    for (std::size_t i = 1; i < attempts.size() && std::cmp_less(kept, plan_.kept); ++i) {
      if (budget_.Excess(attempts[i].graph.count()) > 0) break;
      const double least = (1.0 + kLeastImprovement) * attempts[kept - 1].value.total_m3;
      if (attempts[i].value.total_m3 > least) std::swap(attempts[kept++], attempts[i]);
    }
    attempts.resize(kept);
  }

  static std::int64_t WorkOf(std::size_t steps, const capsule::MirroredSet& graph) {
    return static_cast<std::int64_t>(steps) * graph.primitive_count();
  }

  // The best first; those that do not fit the budget last.
  void Sort(std::vector<Attempt>& attempts) const {
    std::stable_sort(attempts.begin(), attempts.end(), [this](const Attempt& a, const Attempt& b) {
      return std::tuple(budget_.Excess(a.graph.count()), a.value.total_m3) <
             std::tuple(budget_.Excess(b.graph.count()), b.value.total_m3);
    });
  }

  // In rounds, as far as the budget goes.
  void Grow(Attempt& attempt) {
    while (budget_.Allows(attempt.graph.count()) && !meter_.IsCancelled()) {
      const int before = attempt.graph.primitive_count();
      const double size = (1.0 + kGrowthShare) * before;
      const double share = kStarted + (kGrown - kStarted) * std::min(1.0, size / primitives_);
      meter_.Expect(until_ * share, WorkOf(kStepsOfGrowth, attempt.graph));
      const int growth = std::max(kLeastGrowth, static_cast<int>(kGrowthShare * before));
      capsule::MirroredSet graph = attempt.graph;
      const std::uint64_t seed = seed_++;
      Extend(before + growth, static_cast<int>(kTieShare * growth), seed, graph);
      if (graph.primitive_count() <= before) return;
      attempt = Settled(std::move(graph), seed);
    }
  }

  // Until the graph fits the budget.
  void Spare(capsule::MirroredSet& graph) const {
    while (!budget_.Allows(graph.count()) && !meter_.IsCancelled()) {
      const int excess = budget_.Excess(graph.count());
      const int spared =
          static_cast<int>(std::max(kSparedShare * excess, kLeastSpared * graph.primitive_count()));
      const int target = std::max(0, excess - std::max(1, spared));
      if (!GiveUpExcess(rough_, budget_, target, graph)) return;
      rough_.FindShape(kSparingSteps, 1.0, /*seed=*/3, pool_, meter_, graph);
      Simplify(graph);
    }
  }

  // Spends up to a number of primitives, the first `ties` of them on ties and leaves, the rest on
  // cuts, and finds the shape of it.
  void Extend(int target, int ties, std::uint64_t seed, capsule::MirroredSet& graph) const {
    TieBest(std::min({target, graph.primitive_count() + ties, budget_.max_primitives}), seed,
            graph);
    CutLoosest(budget_, target, task_.Weigh(graph).edge_gap, graph);
    task_.FindShape(kGrowthSteps, 1.0, seed, pool_, meter_, graph);
    Simplify(graph);
  }

  // Adds the best ties and leaves, no more than one to a sphere, until there are `target`
  // primitives.
  void TieBest(int target, std::uint64_t seed, capsule::MirroredSet& graph) const {
    task_.Loosen(kLooseSteps, seed, pool_, meter_, graph);
    std::vector<char> is_tied(graph.spheres().size(), 0);
    for (const Edit& tie : RankedAdditions(task_, graph, pool_)) {
      const bool is_leaf = tie.kind == EditKind::kLeaf;
      if (is_tied[tie.first] || (!is_leaf && is_tied[tie.second])) continue;
      EditedGraph edited = Apply(graph, tie);
      if (!edited.possible || edited.graph.primitive_count() > target) break;
      // Where the spheres are used up, later ones may be ties.
      if (!budget_.Allows(edited.graph.count())) continue;
      graph = std::move(edited.graph);
      for (const int v : {tie.first, is_leaf ? tie.first : tie.second}) {
        is_tied[v] = 1;
        if (graph.is_mirrored()) is_tied[graph.ImageOf(v)] = 1;
      }
    }
  }

  // Gives up a share of the primitives, what is least missed, and spends it anew.
  Attempt Renewed(const capsule::MirroredSet& from, const Renewal& renewal,
                  std::uint64_t seed) const {
    capsule::MirroredSet graph = from;
    const auto given_up = static_cast<int>(renewal.given_up * from.primitive_count());
    GiveUpExcess(task_, budget_, 0, graph);  // `from` may be of a round that was less bound
    GiveUpTo(task_, from.primitive_count() - given_up, graph);
    Extend(primitives_, static_cast<int>(renewal.tie_share * given_up), seed, graph);
    if (!budget_.Allows(graph.count())) return {};
    return Settled(std::move(graph), seed);
  }

  // Each of the kept graphs in one way, in the next one next time; one alone in all ways. The best
  // of the old and the new ones are kept.
  void Renew(int round, std::vector<Attempt>& kept) {
    const std::size_t ways = kRenewals.size();
    std::vector<Attempt> attempts(plan_.kept > 1 ? plan_.kept : ways);
    const bool joins = plan_.Joins(round);
    meter_.Expect(until_ * (kGrown + (kRenewed - kGrown) * (round + 1) / plan_.rounds),
                  WorkOf(kStepsOfGrowth * attempts.size(), kept.front().graph) +
                      (joins ? WorkOfJoins(kept.front().graph) : 0));
    pool_.ForEach(attempts.size(), [&](std::size_t i) {
      const Renewal& way = kRenewals[(i + round) % ways];
      attempts[i] = Renewed(kept[i % kept.size()].graph, way, seed_ + i);
    });
    seed_ += attempts.size();
    if (meter_.IsCancelled()) return;
    MoveFound(attempts, kept);
    if (joins) Join(kept);
    KeepBest(kept);
  }

  static void MoveFound(std::vector<Attempt>& attempts, std::vector<Attempt>& to) {
    for (Attempt& attempt : attempts) {
      if (!attempt.graph.spheres().empty()) to.push_back(std::move(attempt));
    }
  }

  // Adds graphs that take each region of the body from whichever attempt is best there: no renewal
  // is lucky everywhere, and what a region costs hardly depends on the others.
  void Join(std::vector<Attempt>& attempts) {
    std::vector<Attempt> joined(kDivisions.size());
    pool_.ForEach(joined.size(),
                  [&](std::size_t i) { joined[i] = Joined(attempts, kDivisions[i]); });
    ++seed_;
    if (!meter_.IsCancelled()) MoveFound(joined, attempts);
  }

  [[nodiscard]] Attempt Joined(const std::vector<Attempt>& attempts,
                               const RegionGroups& groups) const {
    std::vector<Donor> donors;
    for (const Attempt& attempt : attempts) donors.push_back(DonorOf(attempt, groups));
    std::optional<capsule::MirroredSet> graph = JoinedGraph(donors, budget_);
    if (!graph) return {};
    Simplify(*graph);
    CutLoosest(budget_, primitives_, task_.Weigh(*graph).edge_gap, *graph);
    task_.FindShape(kJoinedSteps, 1.0, seed_, pool_, meter_, *graph);
    Simplify(*graph);
    return Settled(*std::move(graph), seed_);
  }

  [[nodiscard]] Donor DonorOf(const Attempt& attempt, const RegionGroups& groups) const {
    Donor donor{&attempt.graph, task_.RegionsOf(attempt.graph), {}};
    for (Region& region : donor.regions) region = groups[Index(region)];
    for (std::size_t r = 0; r < kRegionCount; ++r) {
      donor.costs[Index(groups[r])] += attempt.value.of_region_m3[r];
    }
    return donor;
  }

  static std::int64_t WorkOfJoins(const capsule::MirroredSet& graph) {
    return WorkOf(kDivisions.size() * (kJoinedSteps + kTakeInSteps), graph);
  }

  // The best of the attempts takes the place of `best`, if it is better; whether it was.
  bool TakeBest(std::span<Attempt> attempts, Attempt& best) {
    seed_ += attempts.size();
    const auto found = std::min_element(
        attempts.begin(), attempts.end(),
        [](const Attempt& a, const Attempt& b) { return a.value.total_m3 < b.value.total_m3; });
    if (found == attempts.end() || meter_.IsCancelled() ||
        found->value.total_m3 >= (1.0 - kLeastImprovement) * best.value.total_m3) {
      return false;
    }
    best = std::move(*found);
    return true;
  }

  // With a tie or leaf more, if the budget has room for it.
  Attempt Tied(const capsule::MirroredSet& graph, const Edit& tie, std::uint64_t seed) const {
    EditedGraph edited = Apply(graph, tie);
    if (!edited.possible) return {};
    Simplify(edited.graph);
    CutLoosest(budget_, primitives_, task_.Weigh(edited.graph).edge_gap, edited.graph);
    task_.FindShape(kTrialSteps, 1.0, seed, pool_, meter_, edited.graph);
    Simplify(edited.graph);
    if (!budget_.Allows(edited.graph.count())) return {};
    return Settled(std::move(edited.graph), seed);
  }

  // Spends what is left, too little for a cut.
  void Tie(Attempt& best) {
    while (best.graph.primitive_count() < primitives_ && !meter_.IsCancelled()) {
      capsule::MirroredSet loose = best.graph;
      task_.Loosen(kLooseSteps, seed_, pool_, meter_, loose);
      std::vector<Edit> ties = RankedAdditions(task_, loose, pool_);
      // What wins most may all be of the kind that is used up. (Where only the sum is limited, one
      // or two are left at most, and what they are spent on wins nothing in the end.)
      if (!budget_.IsOfAnyKind()) {
        std::erase_if(ties,
                      [&](const Edit& tie) { return !budget_.Allows(CountWith(loose, tie)); });
      }
      ties.resize(std::min(ties.size(), kTies));
      std::vector<Attempt> attempts(ties.size());
      meter_.ExpectShare(kTieRound, until_,
                         WorkOf((kTrialSteps + kTakeInSteps) * ties.size(), best.graph));
      pool_.ForEach(ties.size(),
                    [&](std::size_t i) { attempts[i] = Tied(best.graph, ties[i], seed_ + i); });
      if (!TakeBest(attempts, best)) return;
    }
  }

  const EnclosingTask& rough_;  // to begin with
  const EnclosingTask& task_;
  const capsule::Budget& final_budget_;
  capsule::Budget budget_;  // of the rounds at hand
  const RenewalPlan& plan_;
  int primitives_;  // at most
  double until_;    // what the meter shows at the end
  const ThreadPool& pool_;
  WorkMeter& meter_;
  std::uint64_t seed_ = kFirstSeed;
};

}  // namespace

std::vector<capsule::MirroredSet> FindEnclosingGraphs(
    const EnclosingTask& rough, const EnclosingTask& task, const capsule::Budget& budget,
    const RenewalPlan& plan, const std::vector<capsule::MirroredSet>& starts, double until,
    const ThreadPool& pool, WorkMeter& meter) {
  return Search(rough, task, budget, plan, until, pool, meter).Run(starts);
}

}  // namespace capfit::refine
