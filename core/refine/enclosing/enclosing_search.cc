#include "core/refine/enclosing/enclosing_search.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "core/base/work_meter.h"
#include "core/refine/enclosing/enclosing_moves.h"
#include "core/refine/graph/graph_edit.h"
#include "core/refine/internal.h"
#include "core/refine/layouts/starting_graphs.h"

namespace capfit::refine {
namespace {

// Steps, as few as do: topology decides more than the last digits of places.
constexpr int kGrowthSteps = 4;
constexpr int kSparingSteps = 3;
constexpr int kTrialSteps = 4;
constexpr int kTakeInSteps = 2;
constexpr int kStartSteps = 8;
constexpr int kLooseSteps = 3;  // that show where ties would win
// The best graphs are grown, each so many times over, and the best of that goes on: variants that
// differ by the seeds of their samples alone end some hundredths apart. Fewer graphs where each
// takes longer.
constexpr int kGrownTimesPrimitives = 120;
constexpr int kMostGrown = 4;
constexpr std::size_t kVariantsOfFew = 2;
constexpr std::size_t kVariantsOfMany = 4;  // single exchanges no longer make up for a bad start
constexpr int kManyPrimitives = 160;
constexpr double kTieShare = 0.5;  // of what growth spends, into ties and leaves
// A round of growth or sparing goes so far.
constexpr double kGrowthShare = 0.2;
constexpr int kLeastGrowth = 4;
constexpr double kSparedShare = 0.34;
constexpr int kUsedUp = 3;  // a graph this near to the budget is not grown
// Exchanges: trials at once, and in all. Fewer where each takes longer.
constexpr std::size_t kTrialsAtOnce = 4;
constexpr int kTrialsTimesPrimitives = 960;
constexpr double kLeastImprovement = 1e-4;
constexpr std::size_t kLeaders = 2;
constexpr std::size_t kTies = 8;
// Where single exchanges take too long: much is given up and spent anew at once.
struct Renewal {
  double given_up;   // part of the primitives
  double tie_share;  // part of those that goes into ties and leaves
};
constexpr std::array<Renewal, 4> kRenewals = {{{0.06, 0.5}, {0.12, 1.0}, {0.12, 0.5}, {0.24, 1.0}}};
constexpr int kPrimitivesPerRound = 45;  // one round of renewals for each so many
constexpr int kMostRounds = 5;

// How much of the search's time has gone by at the end of each part, as measured.
constexpr double kStarted = 0.05;
constexpr double kGrown = 0.45;
constexpr double kExchanged = 0.92;
constexpr double kTieRound = 0.5;  // of what is left of its part
constexpr int kStepsOfGrowth = kLooseSteps + kGrowthSteps + kTakeInSteps;

// Tells trials apart from each other, whatever thread they run on.
constexpr std::uint64_t kTrialSeeds = 1000;

class Search {
 public:
  Search(const EnclosingTask& task, const capsule::Budget& budget, const ThreadPool& pool,
         FitObserver& observer)
      : task_(task),
        budget_(budget),
        primitives_(budget.MostPrimitives()),
        usual_(budget.UsualPrimitives()),
        variants_(usual_ < kManyPrimitives ? kVariantsOfFew : kVariantsOfMany),
        pool_(pool),
        meter_(observer) {}

  std::vector<capsule::MirroredSet> Run(const std::vector<capsule::MirroredSet>& starts) {
    Attempt best = BestStart(starts);
    if (usual_ <= kFewPrimitives) {
      Exchange(best);
    } else {
      const int rounds = std::clamp(usual_ / kPrimitivesPerRound, 1, kMostRounds);
      for (int round = 0; round < rounds; ++round) {
        Renew(kGrown + (kExchanged - kGrown) * (round + 1) / rounds, best);
      }
    }
    Tie(best);
    std::vector<capsule::MirroredSet> graphs;
    for (Attempt& attempt : leaders_) graphs.push_back(std::move(attempt.graph));
    if (graphs.empty()) graphs.push_back(std::move(best.graph));
    return graphs;
  }

 private:
  // A graph whose shape is found, and what it is worth with its points taken in.
  struct Attempt {
    capsule::MirroredSet graph;
    double value = std::numeric_limits<double>::max();
  };

  Attempt Settled(capsule::MirroredSet graph, std::uint64_t seed) const {
    capsule::MirroredSet settled = graph;
    task_.TakeIn(kTakeInSteps, seed, alone_, meter_, settled);
    return {std::move(graph), task_.Value(settled, alone_)};
  }

  Attempt BestStart(const std::vector<capsule::MirroredSet>& starts) {
    std::vector<Attempt> attempts(starts.size());
    std::int64_t work = 0;
    for (const capsule::MirroredSet& start : starts) {
      work += (kStartSteps + kTakeInSteps) * start.primitive_count();
    }
    meter_.Expect(kStarted, work);
    pool_.ForEach(starts.size(), [&](std::size_t i) {
      capsule::MirroredSet graph = starts[i];
      task_.FindShape(kStartSteps, 1.0, /*seed=*/1, alone_, meter_, graph);
      RemoveSwallowed(graph);
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
    for (std::uint64_t seed = 10; Grow(seed, small) && !meter_.IsCancelled();) {
      seed += kMostGrown * variants_;
    }
    attempts.insert(attempts.end(), small.begin(), small.end());
    Sort(attempts);
    Lead(attempts);
    return attempts.front();
  }

  static std::int64_t WorkOf(std::size_t steps, const capsule::MirroredSet& graph) {
    return static_cast<std::int64_t>(steps) * graph.primitive_count();
  }

  // The best first; those that do not fit the budget last.
  void Sort(std::vector<Attempt>& attempts) const {
    std::stable_sort(attempts.begin(), attempts.end(), [this](const Attempt& a, const Attempt& b) {
      return std::tuple(budget_.Excess(a.graph.count()), a.value) <
             std::tuple(budget_.Excess(b.graph.count()), b.value);
    });
  }

  // One round of growth from the best of the attempts; whether there was any.
  bool Grow(std::uint64_t seed, std::vector<Attempt>& attempts) {
    // Of so few primitives no layout is smaller than the budget; of standard layouts none is.
    if (attempts.empty()) return false;
    const int most = std::clamp(kGrownTimesPrimitives / std::max(1, usual_), 1, kMostGrown);
    attempts.resize(std::min(attempts.size(), static_cast<std::size_t>(most)));
    std::vector<Attempt> grown(attempts.size() * variants_);
    const double size = (1.0 + kGrowthShare) * attempts.front().graph.primitive_count();
    meter_.Expect(kStarted + (kGrown - kStarted) * std::min(1.0, size / primitives_),
                  WorkOf(kStepsOfGrowth * grown.size(), attempts.front().graph));
    pool_.ForEach(grown.size(), [&](std::size_t i) {
      capsule::MirroredSet graph = attempts[i / variants_].graph;
      if (!budget_.Allows(graph.count())) return;
      const int before = graph.primitive_count();
      const int growth = std::max(kLeastGrowth, static_cast<int>(kGrowthShare * before));
      Extend(before + growth, static_cast<int>(kTieShare * growth), seed + i, graph);
      if (graph.primitive_count() > before) grown[i] = Settled(std::move(graph), seed + i);
    });
    std::erase_if(grown, [](const Attempt& a) { return a.graph.spheres().empty(); });
    if (grown.empty()) return false;
    attempts = std::move(grown);
    Sort(attempts);
    return true;
  }

  // Remembers the best of all attempts.
  void Lead(const std::vector<Attempt>& attempts) {
    for (const Attempt& attempt : attempts) {
      if (attempt.graph.spheres().empty() || !budget_.Allows(attempt.graph.count())) continue;
      leaders_.push_back(attempt);
    }
    std::stable_sort(leaders_.begin(), leaders_.end(),
                     [](const Attempt& a, const Attempt& b) { return a.value < b.value; });
    leaders_.resize(std::min(leaders_.size(), kLeaders));
  }

  // Until the graph fits the budget.
  void Spare(capsule::MirroredSet& graph) const {
    while (!budget_.Allows(graph.count()) && !meter_.IsCancelled()) {
      const int excess = budget_.Excess(graph.count());
      const int target =
          excess - std::max(1, static_cast<int>(kSparedShare * static_cast<double>(excess)));
      do {
        const bool only_spheres = graph.primitive_count() <= budget_.max_primitives &&
                                  graph.capsule_count() <= budget_.max_capsules;
        if (!SpareOne(only_spheres, graph)) return;
      } while (budget_.Excess(graph.count()) > target);
      task_.FindShape(kSparingSteps, 1.0, /*seed=*/3, alone_, meter_, graph);
      RemoveSwallowed(graph);
    }
  }

  // `only_spheres`: capsules may stay as they are.
  bool SpareOne(bool only_spheres, capsule::MirroredSet& graph) const {
    std::optional<capsule::MirroredSet> last_resort;
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

  // Spends up to a number of primitives, the first `ties` of them on ties and leaves, the rest on
  // cuts, and finds the shape of it.
  void Extend(int target, int ties, std::uint64_t seed, capsule::MirroredSet& graph) const {
    TieBest(std::min(target, graph.primitive_count() + ties), seed, graph);
    CutLoosest(budget_, target, task_.Weigh(graph).edge_gap, graph);
    task_.FindShape(kGrowthSteps, 1.0, seed, alone_, meter_, graph);
    RemoveSwallowed(graph);
  }

  // Adds the best ties and leaves, no more than one to a sphere, until there are `target`
  // primitives.
  void TieBest(int target, std::uint64_t seed, capsule::MirroredSet& graph) const {
    task_.Loosen(kLooseSteps, seed, alone_, meter_, graph);
    std::vector<char> is_tied(graph.spheres().size(), 0);
    for (const Edit& tie : RankedAdditions(task_, graph, alone_)) {
      const bool is_leaf = tie.kind == EditKind::kLeaf;
      if (is_tied[U(tie.first)] || (!is_leaf && is_tied[U(tie.second)])) continue;
      EditedGraph edited = Apply(graph, tie);
      if (!edited.possible || edited.graph.primitive_count() > target ||
          !budget_.Allows(edited.graph.count())) {
        break;
      }
      graph = std::move(edited.graph);
      for (const int v : {tie.first, is_leaf ? tie.first : tie.second}) {
        is_tied[U(v)] = 1;
        if (graph.is_mirrored()) is_tied[U(graph.ImageOf(v))] = 1;
      }
    }
  }

  // What each edit leads to, the budget used up again.
  Attempt Try(const capsule::MirroredSet& graph, const Edit& edit, std::uint64_t seed) const {
    EditedGraph edited = Apply(graph, edit);
    if (!edited.possible || meter_.IsCancelled()) return {};
    RemoveSwallowed(edited.graph);
    // What is given up is spent on ties as well as on cuts, by turns.
    if (seed % 2 == 1) TieBest(primitives_, seed, edited.graph);
    CutLoosest(budget_, primitives_, task_.Weigh(edited.graph).edge_gap, edited.graph);
    task_.FindShape(kTrialSteps, 1.0, seed, alone_, meter_, edited.graph);
    RemoveSwallowed(edited.graph);
    if (!budget_.Allows(edited.graph.count())) return {};
    return Settled(std::move(edited.graph), seed);
  }

  // Tries some edits in parallel, work up to `part` of the search; whether the best of them was
  // taken.
  bool TryAll(const std::vector<Edit>& edits, double part, Attempt& best) {
    std::vector<Attempt> attempts(edits.size());
    meter_.Expect(part, WorkOf((kTrialSteps + kTakeInSteps) * edits.size(), best.graph));
    pool_.ForEach(edits.size(),
                  [&](std::size_t i) { attempts[i] = Try(best.graph, edits[i], seed_ + i); });
    seed_ += edits.size();
    Lead(attempts);
    const auto found =
        std::min_element(attempts.begin(), attempts.end(),
                         [](const Attempt& a, const Attempt& b) { return a.value < b.value; });
    if (found == attempts.end() || meter_.IsCancelled() ||
        found->value >= (1.0 - kLeastImprovement) * best.value) {
      return false;
    }
    best = std::move(*found);
    return true;
  }

  // Gives up a share of the primitives, what is least missed, and spends it anew.
  Attempt Renewed(const capsule::MirroredSet& from, const Renewal& renewal,
                  std::uint64_t seed) const {
    capsule::MirroredSet graph = from;
    const int kept =
        graph.primitive_count() - static_cast<int>(renewal.given_up * graph.primitive_count());
    while (graph.primitive_count() > kept && SpareOne(/*only_spheres=*/false, graph)) {
    }
    const double ties = renewal.tie_share * (primitives_ - graph.primitive_count());
    Extend(primitives_, static_cast<int>(ties), seed, graph);
    if (!budget_.Allows(graph.count())) return {};
    return Settled(std::move(graph), seed);
  }

  void Renew(double part, Attempt& best) {
    if (meter_.IsCancelled()) return;
    std::vector<Attempt> attempts(kRenewals.size());
    meter_.Expect(part, WorkOf(kStepsOfGrowth * attempts.size(), best.graph));
    pool_.ForEach(attempts.size(), [&](std::size_t i) {
      attempts[i] = Renewed(best.graph, kRenewals[i], seed_ + i);
    });
    seed_ += attempts.size();
    Lead(attempts);
    for (Attempt& attempt : attempts) {
      if (attempt.value < best.value) best = std::move(attempt);
    }
  }

  void Exchange(Attempt& best) {
    std::vector<Removal> removals = RemovalsOf(best.graph, task_.Weigh(best.graph));
    std::size_t next = 0;
    for (int trials = 0; trials * usual_ < kTrialsTimesPrimitives && next < removals.size() &&
                         !meter_.IsCancelled();) {
      std::vector<Edit> edits;
      for (; edits.size() < kTrialsAtOnce && next < removals.size(); ++next) {
        edits.push_back(removals[next].edit);
      }
      trials += static_cast<int>(edits.size());
      const double share = static_cast<double>(trials) * usual_ / kTrialsTimesPrimitives;
      if (!TryAll(edits, kGrown + share * (kExchanged - kGrown), best)) continue;
      removals = RemovalsOf(best.graph, task_.Weigh(best.graph));
      next = 0;
    }
  }

  void Tie(Attempt& best) {
    while (best.graph.primitive_count() < primitives_ && !meter_.IsCancelled()) {
      capsule::MirroredSet loose = best.graph;
      task_.Loosen(kLooseSteps, seed_, pool_, meter_, loose);
      std::vector<Edit> ties = RankedAdditions(task_, loose, pool_);
      ties.resize(std::min(ties.size(), kTies));
      if (!TryAll(ties, meter_.until() + kTieRound * (1.0 - meter_.until()), best)) return;
    }
  }

  const EnclosingTask& task_;
  const capsule::Budget& budget_;
  int primitives_;  // at most
  int usual_;       // about so many where only spheres or only capsules are limited
  std::size_t variants_;
  const ThreadPool& pool_;
  const ThreadPool alone_{1};  // inside what runs in parallel already
  WorkMeter meter_;
  std::uint64_t seed_ = kTrialSeeds;
  std::vector<Attempt> leaders_;
};

}  // namespace

std::vector<capsule::MirroredSet> FindEnclosingGraphs(
    const EnclosingTask& task, const capsule::Budget& budget,
    const std::vector<capsule::MirroredSet>& starts, const ThreadPool& pool,
    FitObserver& observer) {
  return Search(task, budget, pool, observer).Run(starts);
}

}  // namespace capfit::refine
