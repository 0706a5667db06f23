#include "core/refine/best_fit/respend.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "core/capsule/cut_capsules.h"
#include "core/refine/best_fit/fill_error.h"
#include "core/refine/graph/cone.h"
#include "core/refine/graph/graph_edit.h"

namespace capfit::refine {
namespace {

constexpr int kMostLastRounds = 4;  // that only spend what is left
// What is given up is worth less than this share of the error beside what is cut for it, as cuts
// take only part of that; half of it where a round won nothing, down to the least.
constexpr double kShareGivenUp = 0.45;
constexpr double kLeastShareGivenUp = 0.1;
// A round gives up no more than this share of all primitives.
constexpr double kMostGivenUp = 0.2;
// A round is taken for this share of the work that is left.
constexpr double kRespendShare = 0.3;
// What a removal saves counts at least so many primitives, however many pieces it makes.
constexpr double kLeastSaving = 0.25;

// A capsule with its image, or a sphere without one.
struct Removal {
  std::size_t cone = 0;
  int saved = 0;  // primitives
  double score = 0.0;
};

// Marks by cone, as ConesOf.
using Marks = std::vector<char>;

// What may go in a round.
struct Price {
  double share = kShareGivenUp;  // of what is won, that may be lost
  // What would be missed by far counts as a loss too: more than it is, as what stays is drawn
  // there, so only where a round without it won nothing.
  bool counts_misses = false;
};

// One round: what goes.
class RespendRound {
 public:
  RespendRound(const BestFitObjective& objective, const capsule::Budget& budget, double piece_cost,
               const Price& price, const ThreadPool& pool, const capsule::MirroredSet& graph)
      : budget_(budget),
        piece_cost_(piece_cost),
        share_(price.share),
        pool_(pool),
        graph_(graph),
        cones_(ConesOf(graph)),
        images_(ImagesOfCones(graph)),
        errors_(objective.ErrorsByCapsule(graph, pool)) {
    if (!price.counts_misses) return;
    const std::vector<double> missed = objective.MissedWithout(graph, pool);
    for (std::size_t i = 0; i < missed.size(); ++i) errors_.loss_m3[i] += missed[i];
  }

  // Without what is worth less than the price's share of the cuts that it pays for.
  [[nodiscard]] capsule::MirroredSet GiveUp() const {
    const std::vector<double> cuts = WorthOfCuts();
    Marks gone(cones_.size(), 0), locked(cones_.size(), 0);
    int freed = budget_.Unused(graph_.count());
    const int most = freed + static_cast<int>(kMostGivenUp * graph_.primitive_count());
    for (const Removal& removal : Ranked()) {
      const auto next = static_cast<std::size_t>(freed / kCostOfCut);
      if (next >= cuts.size() || removal.score > share_ * cuts[next] || freed >= most) break;
      if (locked[removal.cone]) continue;
      Mark(removal.cone, gone);
      LockAround(removal.cone, locked);
      freed += removal.saved;
    }
    return Without(gone);
  }

 private:
  // Of a mirrored pair; of one on the plane half of it.
  static constexpr int kCostOfCut = 4;

  // One of each pair.
  [[nodiscard]] bool IsRepresentative(std::size_t cone) const {
    return static_cast<std::size_t>(images_[cone]) >= cone;
  }

  // The cone and its image.
  void Mark(std::size_t cone, Marks& marks) const { marks[cone] = marks[images_[cone]] = 1; }

  // Spheres of which nothing is left go too.
  [[nodiscard]] capsule::MirroredSet Without(const Marks& gone) const {
    std::vector<char> spheres(graph_.spheres().size(), 0);
    std::vector<char> capsules(graph_.capsules().size(), 0);
    for (std::size_t i = 0; i < cones_.size(); ++i) {
      if (gone[i]) continue;
      spheres[cones_[i].node_a] = spheres[cones_[i].node_b] = 1;
      if (i < capsules.size()) capsules[i] = 1;
    }
    capsule::MirroredSet rest = graph_;
    rest.KeepOnly(spheres, capsules);
    return rest;
  }

  // Least error for each primitive first.
  [[nodiscard]] std::vector<Removal> Ranked() const {
    std::vector<Removal> removals;
    for (std::size_t i = 0; i < cones_.size(); ++i) {
      if (IsRepresentative(i)) removals.push_back({i});
    }
    const int pieces = ComponentCount(graph_);
    pool_.ForEach(removals.size(), [&](std::size_t i) {
      Removal& removal = removals[i];
      Marks gone(cones_.size(), 0);
      Mark(removal.cone, gone);
      const capsule::MirroredSet rest = Without(gone);
      removal.saved = graph_.primitive_count() - rest.primitive_count();
      const double worth = removal.saved - piece_cost_ * (ComponentCount(rest) - pieces);
      removal.score = errors_.loss_m3[removal.cone] / std::max(kLeastSaving, worth);
    });
    std::stable_sort(removals.begin(), removals.end(),
                     [](const Removal& a, const Removal& b) { return a.score < b.score; });
    return removals;
  }

  // Of one primitive, most first.
  [[nodiscard]] std::vector<double> WorthOfCuts() const {
    std::vector<double> cuts;
    for (std::size_t e = 0; e < graph_.capsules().size(); ++e) {
      if (!IsRepresentative(e)) continue;
      cuts.push_back(errors_.beside_m3[e] / (images_[e] == static_cast<int>(e) ? 2 : 4));
    }
    std::sort(cuts.begin(), cuts.end(), std::greater<>());
    return cuts;
  }

  // What may have to fill what the cone has filled: what overlaps it or its image.
  void LockAround(std::size_t cone, Marks& locked) const {
    Marks own(cones_.size(), 0);
    Mark(cone, own);
    for (std::size_t i = 0; i < cones_.size(); ++i) {
      if (!own[i]) continue;
      for (std::size_t other = 0; other < cones_.size(); ++other) {
        if (Overlap(cones_[i], cones_[other])) Mark(other, locked);
      }
    }
  }

  static bool Overlap(const Cone& a, const Cone& b) { return HasAxisIn(a, b) || HasAxisIn(b, a); }

  static bool HasAxisIn(const Cone& a, const Cone& b) {
    for (const float t : {0.0f, 0.5f, 1.0f}) {
      const float along = t * a.highest;
      if (b.SignedDistance(a.ax + along * a.ux, a.ay + along * a.uy, a.az + along * a.uz) < 0.0f) {
        return true;
      }
    }
    return false;
  }

  const capsule::Budget& budget_;
  double piece_cost_, share_;
  const ThreadPool& pool_;
  const capsule::MirroredSet& graph_;
  std::vector<Cone> cones_;
  std::vector<int> images_;
  CapsuleErrors errors_;
};

bool IsSame(const capsule::MirroredSet& a, const capsule::MirroredSet& b) {
  return a.spheres() == b.spheres() && a.capsules() == b.capsules();
}

// What the rounds share, and the best set so far.
class Respender {
 public:
  Respender(const BestFitObjective& objective, const capsule::Budget& budget,
            const RespendOptions& options, const ThreadPool& pool, WorkMeter& meter,
            capsule::MirroredSet& graph)
      : objective_(objective),
        budget_(budget),
        options_(options),
        pool_(pool),
        meter_(meter),
        graph_(graph),
        value_(objective.Value(graph, pool)) {}

  void Run() {
    bool has_won = false;
    for (int round = 0; round < options_.rounds + kMostLastRounds && !meter_.IsCancelled();
         ++round) {
      const bool only_spends = round >= options_.rounds;
      if (only_spends) price_.share = 0.0;
      capsule::MirroredSet other =
          RespendRound(objective_, budget_, options_.piece_cost, price_, pool_, graph_).GiveUp();
      if (!Cut(other)) break;
      if (Wins(std::move(other), options_.effort)) {
        has_won = true;
      } else if (only_spends) {
        break;
      } else if (!AsksLess()) {
        round = options_.rounds - 1;  // the next one is the first that only spends
      }
    }
    if (has_won && options_.effort != Effort::kFinish && !meter_.IsCancelled()) {
      Wins(graph_, Effort::kFinish);
    }
  }

 private:
  // Spends what the budget has left; false where there is nothing to cut.
  bool Cut(capsule::MirroredSet& other) const {
    const int left = other.primitive_count();
    std::vector<double> worth = objective_.ErrorsByCapsule(other, pool_).beside_m3;
    worth.resize(other.capsules().size());
    capsule::CutWorthiest(budget_, std::move(worth), capsule::QuarterOfWhole, other);
    return other.primitive_count() != left;
  }

  // Settles a set and takes it if it is better. What was refused once is not settled again: a lower
  // price often gives up the same.
  bool Wins(capsule::MirroredSet other, Effort effort) {
    if (IsSame(other, refused_)) return false;
    meter_.ExpectShare(kRespendShare, options_.until, 1);
    capsule::MirroredSet unsettled = other;
    objective_.Settle(effort, pool_, meter_.observer(), other);
    // Not MergeSwallowed: nothing may settle the set any more.
    RemoveSwallowed(other);
    const double value = objective_.Value(other, pool_);
    if (value < value_) {
      graph_ = std::move(other);
      value_ = value;
      return true;
    }
    refused_ = std::move(unsettled);
    return false;
  }

  // After a round that won nothing; false where that leaves nothing worth asking.
  bool AsksLess() {
    if (!price_.counts_misses) return price_.counts_misses = true;
    return (price_.share *= 0.5) >= kLeastShareGivenUp;
  }

  const BestFitObjective& objective_;
  const capsule::Budget& budget_;
  const RespendOptions& options_;
  const ThreadPool& pool_;
  WorkMeter& meter_;
  capsule::MirroredSet& graph_;
  double value_;
  capsule::MirroredSet refused_;  // the last one, before it was settled
  Price price_;
};

}  // namespace

void Respend(const BestFitObjective& objective, const capsule::Budget& budget,
             const RespendOptions& options, const ThreadPool& pool, WorkMeter& meter,
             capsule::MirroredSet& graph) {
  Respender(objective, budget, options, pool, meter, graph).Run();
  meter.Expect(options.until, 1);
}

}  // namespace capfit::refine
