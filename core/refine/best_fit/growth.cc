#include "core/refine/best_fit/growth.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/refine/graph/graph_edit.h"
#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

// Spheres whose surfaces come within this share of their radii are worth a capsule's trial.
constexpr double kLinkReach = 1.1;
// A round keeps edits that gain at least this share of its best one, per primitive.
constexpr double kKeepShare = 0.35;
// Of the edits glanced at no fewer than so many are tried thoroughly.
constexpr std::size_t kLeastThorough = 8;
// Capsules go together when their losses are within this ratio, or below the least, which is
// relative to the body's volume.
constexpr double kSpareShare = 2.0;
constexpr double kLeastLoss = 1e-4;
// Of what a graph has too many so much goes by one look, but for what lies beside what has just
// gone; at least so many primitives.
constexpr double kSparedAtOnce = 0.3;
constexpr int kLeastSpared = 4;
// An exchange gives up this share of all primitives.
constexpr double kExchangeShare = 0.1;
// So many exchanges in a row may fail before no more are tried.
constexpr std::size_t kMostFailures = 4;
// Of the removals glanced at, how many are tried thoroughly.
constexpr double kSpareThoroughShare = 0.3;
// A round of trials is taken for this share of what is left of the work, until it shows how far it
// went; a trial in earnest for so many glances.
constexpr double kRoundShare = 0.1;
constexpr int kGlancesPerThorough = 3;
// A round spends at least this share of what is there already.
constexpr double kLeastBatchShare = 0.05;

struct Candidate {
  Edit edit;
  EditedGraph result;
  double score = 0.0;  // gain per primitive, > 0 is good
};

// What falling into more pieces, or fewer, counts in primitives.
double PieceCost(const GrowthOptions& options, const capsule::MirroredSet& before,
                 const capsule::MirroredSet& after) {
  if (options.piece_cost == 0.0) return 0.0;
  return options.piece_cost * (ComponentCount(after) - ComponentCount(before));
}

// Primitives that the edit saves, or what they are worth beside new pieces.
double SavingOf(const GrowthOptions& options, const capsule::MirroredSet& before,
                const capsule::MirroredSet& after) {
  return before.primitive_count() - after.primitive_count() - PieceCost(options, before, after);
}

// Spheres and capsules weigh alike under one total. Under two limits each weighs what share of the
// room left it takes.
double CostOf(const capsule::Budget& budget, const GrowthOptions& options,
              const capsule::MirroredSet& before, const capsule::MirroredSet& after) {
  const double spheres =
      after.sphere_count() - before.sphere_count() + PieceCost(options, before, after);
  const double capsules = after.capsule_count() - before.capsule_count();
  if (budget.max_spheres >= capsule::kNoLimit || budget.max_capsules >= capsule::kNoLimit) {
    return std::max(0.5, spheres + capsules);
  }
  const double sphere_room = std::max(1, budget.max_spheres - before.sphere_count());
  const double capsule_room = std::max(1, budget.max_capsules - before.capsule_count());
  const double unit = 0.5 * (sphere_room + capsule_room);
  return std::max(0.5, unit * (spheres / sphere_room + capsules / capsule_room));
}

void ProposeLinks(const capsule::MirroredSet& graph, std::vector<Edit>& edits) {
  for (int i = 0; i < graph.sphere_count(); ++i) {
    for (int j = i + 1; j < graph.sphere_count(); ++j) {
      const geometry::Sphere& a = graph.sphere(i);
      const geometry::Sphere& b = graph.sphere(j);
      if (IsLaterImage(graph, i, j)) continue;
      const double reach = kLinkReach * (a.radius_m + b.radius_m);
      if ((a.center_m - b.center_m).norm() > reach || graph.HasCapsule(i, j)) continue;
      edits.push_back(EditOf(EditKind::kLink, i, j));
    }
  }
}

std::vector<Edit> Additions(const BestFitObjective& objective, const GrowthOptions& options,
                            const ThreadPool& pool, const capsule::MirroredSet& graph) {
  std::vector<Edit> edits;
  for (int e = 0; e < graph.capsule_count(); ++e) {
    if (graph.IsCapsuleRepresentative(e)) edits.push_back(EditOf(EditKind::kSplit, e));
  }
  ProposeLinks(graph, edits);
  for (int v = 0; v < graph.sphere_count(); ++v) {
    if (!graph.IsOnPlane(v)) continue;
    edits.push_back(EditOf(EditKind::kPart, v, 0));
    edits.push_back(EditOf(EditKind::kPart, v, 1));
  }
  for (const Eigen::Vector3d& p : objective.WorstPoints(graph, options.worst_points, pool)) {
    const std::vector<Edit> leaves = LeavesAt(graph, p);
    edits.insert(edits.end(), leaves.begin(), leaves.end());
    if (!leaves.empty()) {
      Edit ball = leaves.front();
      ball.kind = EditKind::kBall;
      edits.push_back(ball);
    }
  }
  return edits;
}

std::vector<Edit> Removals(const capsule::MirroredSet& graph) {
  std::vector<Edit> edits;
  for (int e = 0; e < graph.capsule_count(); ++e) {
    if (graph.IsCapsuleRepresentative(e)) edits.push_back(EditOf(EditKind::kUnlink, e));
  }
  for (int v = 0; v < graph.sphere_count(); ++v) {
    if (graph.IsRepresentative(v)) edits.push_back(EditOf(EditKind::kDissolve, v));
  }
  return edits;
}

void SortByScore(std::vector<Candidate>& candidates) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
}

// Applies and settles all edits in parallel: a glance at each, then the better ones in earnest.
// `score` turns a gain into a score. Best first.
template <class Admit, class Score>
std::vector<Candidate> TryAll(const BestFitObjective& objective, const capsule::MirroredSet& graph,
                              const std::vector<Edit>& edits, const ThreadPool& pool,
                              WorkMeter& meter, double until, double thorough_share,
                              const Admit& admit, const Score& score) {
  const BestFitRound round = objective.StartRound(graph, pool);
  std::vector<Candidate> candidates(edits.size());
  const auto attempt = [&](Trial trial) {
    pool.ForEach(candidates.size(), [&](std::size_t i) {
      Candidate& c = candidates[i];
      if (meter.IsCancelled()) {
        c.result.possible = false;
        return;
      }
      if (trial == Trial::kGlance) {
        c.edit = edits[i];
        c.result = Apply(graph, edits[i]);
        c.result.possible = c.result.possible && admit(c.result.graph);
      }
      if (c.result.possible) c.score = score(c.result.graph, round.Try(trial, c.result));
      meter.Add(trial == Trial::kGlance ? 1 : kGlancesPerThorough);
    });
    std::erase_if(candidates, [](const Candidate& c) { return !c.result.possible; });
    SortByScore(candidates);
  };
  const auto kept = static_cast<std::size_t>(thorough_share * static_cast<double>(edits.size()));
  meter.ExpectShare(kRoundShare, until,
                    static_cast<std::int64_t>(edits.size() + kGlancesPerThorough * kept));
  attempt(Trial::kGlance);
  candidates.resize(std::min(candidates.size(), std::max(kLeastThorough, kept)));
  attempt(Trial::kThorough);
  return candidates;
}

// Whether the edit's surroundings are still as they were tried; locks them if so.
bool LockSurroundings(const capsule::MirroredSet& graph, const Candidate& c,
                      std::vector<char>& locked) {
  const std::vector<char> around = Neighbourhood(graph, c.result.touched_before, 0);
  for (std::size_t v = 0; v < around.size(); ++v) {
    if (around[v] && locked[v]) return false;
  }
  for (std::size_t v = 0; v < around.size(); ++v) locked[v] |= around[v];
  return true;
}

// The edit again on a graph that has grown by other edits meanwhile, with the places that were
// found in the trial. Only for edits that add: they keep all indices of nodes.
std::optional<capsule::MirroredSet> Replay(const capsule::MirroredSet& base, const Candidate& c,
                                           const capsule::MirroredSet& grown) {
  Edit edit = c.edit;
  if (edit.kind == EditKind::kSplit) {
    const capsule::CapsuleEnds& wanted = base.ends(edit.first);
    edit.first = -1;
    for (int e = 0; e < grown.capsule_count(); ++e) {
      if (grown.ends(e)[0] == wanted[0] && grown.ends(e)[1] == wanted[1]) edit.first = e;
    }
    if (edit.first < 0) return std::nullopt;
  }
  EditedGraph again = Apply(grown, edit);
  if (!again.possible) return std::nullopt;
  const int shift = grown.sphere_count() - base.sphere_count();
  for (const int v : c.result.touched) {
    const int image = c.result.graph.is_mirrored() ? c.result.graph.ImageOf(v) : v;
    for (const int from : {v, image}) {
      geometry::Sphere& to = again.graph.sphere(from < base.sphere_count() ? from : from + shift);
      to.center_m = c.result.graph.sphere(from).center_m;
      to.radius_m = c.result.graph.sphere(from).radius_m;
    }
  }
  return again.graph;
}

// Keeps the best candidates that do not touch each other.
capsule::MirroredSet KeepBest(const capsule::MirroredSet& graph,
                              const std::vector<Candidate>& candidates,
                              const capsule::Budget& budget, double room_to_spend) {
  std::vector<char> locked(graph.spheres().size(), 0);
  capsule::MirroredSet grown = graph;
  const int start = graph.primitive_count();
  for (const Candidate& c : candidates) {
    if (c.score < kKeepShare * candidates.front().score || c.score <= 0.0) break;
    if (grown.primitive_count() > start && grown.primitive_count() - start >= room_to_spend) break;
    // Parting a mid-plane sphere re-ties its neighbours: only ever alone.
    const bool parts = c.edit.kind == EditKind::kPart;
    if (parts && grown.primitive_count() > start) continue;
    if (!LockSurroundings(graph, c, locked)) continue;
    std::optional<capsule::MirroredSet> next = Replay(graph, c, grown);
    if (!next || !budget.Allows(next->count())) continue;
    grown = *std::move(next);
    if (parts) break;
  }
  return grown;
}

bool GrowOnce(const BestFitObjective& objective, const capsule::Budget& budget,
              const GrowthOptions& options, const ThreadPool& pool, WorkMeter& meter,
              capsule::MirroredSet& graph) {
  const std::vector<Candidate> candidates = TryAll(
      objective, graph, Additions(objective, options, pool, graph), pool, meter, options.until,
      options.thorough_share,
      [&](const capsule::MirroredSet& after) { return budget.Allows(after.count()); },
      [&](const capsule::MirroredSet& after, double gain) {
        return gain / CostOf(budget, options, graph, after);
      });
  if (candidates.empty() || candidates.front().score <= 0.0) return false;
  capsule::MirroredSet grown = KeepBest(graph, candidates, budget,
                                        std::max(options.batch_share * budget.Unused(graph.count()),
                                                 kLeastBatchShare * graph.primitive_count()));
  if (grown.primitive_count() == graph.primitive_count()) return false;
  objective.Settle(Effort::kTouch, pool, meter.observer(), grown);
  if (options.piece_cost > 0.0) MergeSwallowed(grown);
  RemoveSwallowed(grown);
  const bool grew = grown.primitive_count() > graph.primitive_count();
  graph = std::move(grown);
  return grew;
}

// Capsules and spheres that could go, least loss first.
std::vector<Candidate> RankRemovals(const BestFitObjective& objective, const GrowthOptions& options,
                                    const ThreadPool& pool, WorkMeter& meter,
                                    const capsule::MirroredSet& graph) {
  return TryAll(
      objective, graph, Removals(graph), pool, meter, options.until, kSpareThoroughShare,
      [&](const capsule::MirroredSet& after) { return SavingOf(options, graph, after) > 0.0; },
      [&](const capsule::MirroredSet& after, double gain) {
        return gain / std::max(0.5, SavingOf(options, graph, after));
      });
}

// The removal again on a graph that others have left smaller meanwhile. `index`: of each sphere of
// `base` there; -1: gone.
std::optional<EditedGraph> RemoveToo(const capsule::MirroredSet& base, const Edit& removal,
                                     const std::vector<int>& index,
                                     const capsule::MirroredSet& spared) {
  Edit edit = removal;
  if (edit.kind == EditKind::kUnlink) {
    const auto [a, b] = base.ends(edit.first);
    edit.first = spared.IndexOfCapsule(index[a], index[b]);
  } else {
    edit.first = index[edit.first];
  }
  if (edit.first < 0) return std::nullopt;
  EditedGraph result = Apply(spared, edit);
  if (!result.possible) return std::nullopt;
  return result;
}

// Without the candidate `first`, and without others elsewhere that cost no more than `worst`, up to
// `most` primitives or a little beyond.
capsule::MirroredSet TakeAway(const std::vector<Candidate>& candidates, std::size_t first, int most,
                              double worst, const GrowthOptions& options,
                              const capsule::MirroredSet& graph) {
  const Candidate& chosen = candidates[first];
  capsule::MirroredSet spared = chosen.result.graph;
  std::vector<int> index = chosen.result.new_index;
  std::vector<char> locked(graph.spheres().size(), 0);
  LockSurroundings(graph, chosen, locked);
  for (const Candidate& c : candidates) {
    if (graph.primitive_count() - spared.primitive_count() >= most || c.score < worst) break;
    if (!LockSurroundings(graph, c, locked)) continue;
    const std::optional<EditedGraph> less = RemoveToo(graph, c.edit, index, spared);
    if (!less || SavingOf(options, spared, less->graph) <= 0.0) continue;
    spared = less->graph;
    for (int& v : index) v = v < 0 ? -1 : less->new_index[v];
  }
  return spared;
}

// What costs hardly more than the candidate.
double HardlyWorseThan(const Candidate& candidate) {
  return kSpareShare * std::min(-kLeastLoss, candidate.score);
}

void Fill(const BestFitObjective& objective, const capsule::Budget& budget,
          const GrowthOptions& options, const ThreadPool& pool, WorkMeter& meter,
          capsule::MirroredSet& graph) {
  const int room = budget.Unused(graph.count());
  const double begin = meter.until();
  for (int i = 0; i < 4 + room && budget.Unused(graph.count()) > 0; ++i) {
    const double left = static_cast<double>(budget.Unused(graph.count())) / room;
    meter.Expect(begin + std::min(1.0, 1.0 - left) * (options.until - begin), 1);
    if (meter.IsCancelled()) return;
    if (!GrowOnce(objective, budget, options, pool, meter, graph)) return;
  }
}

// Gives up the least and spends it elsewhere, as long as that pays. Where it does not, the next
// least is given up instead.
void Exchange(const BestFitObjective& objective, const capsule::Budget& budget,
              const GrowthOptions& options, const ThreadPool& pool, WorkMeter& meter,
              capsule::MirroredSet& graph) {
  if (meter.IsCancelled()) return;
  objective.Settle(Effort::kTighten, pool, meter.observer(), graph);
  double value = objective.Value(graph, pool);
  std::vector<Candidate> removals;
  std::size_t failures = 0;
  const double begin = meter.until();
  GrowthOptions refill = options;
  for (int i = 0; i < options.exchanges && !meter.IsCancelled(); ++i) {
    if (failures == 0) removals = RankRemovals(objective, options, pool, meter, graph);
    if (failures >= removals.size()) return;
    const int most = std::max(2, static_cast<int>(kExchangeShare * graph.primitive_count()));
    capsule::MirroredSet other =
        TakeAway(removals, failures, most, HardlyWorseThan(removals[failures]), options, graph);
    objective.Settle(Effort::kTouch, pool, meter.observer(), other);
    refill.until = begin + (i + 1.0) / options.exchanges * (options.until - begin);
    Fill(objective, budget, refill, pool, meter, other);
    const double other_value = objective.Value(other, pool);
    if (other_value < value) {
      graph = std::move(other);
      value = other_value;
      failures = 0;
    } else if (++failures == kMostFailures) {
      return;
    }
  }
}

}  // namespace

void Spare(const BestFitObjective& objective, const capsule::Budget& budget,
           const GrowthOptions& options, const ThreadPool& pool, WorkMeter& meter,
           capsule::MirroredSet& graph) {
  while (!budget.Allows(graph.count()) && !meter.IsCancelled()) {
    const int excess = budget.Excess(graph.count());
    const std::vector<Candidate> removals = RankRemovals(objective, options, pool, meter, graph);
    if (removals.empty()) return;
    const int most = std::max(kLeastSpared, static_cast<int>(kSparedAtOnce * excess));
    graph = TakeAway(removals, 0, std::min(most, excess), -std::numeric_limits<double>::max(),
                     options, graph);
    objective.Settle(Effort::kTouch, pool, meter.observer(), graph);
  }
}

void Grow(const BestFitObjective& objective, const capsule::Budget& budget,
          const GrowthOptions& options, const ThreadPool& pool, WorkMeter& meter,
          capsule::MirroredSet& graph) {
  Fill(objective, budget, options, pool, meter, graph);
  if (options.exchanges > 0) Exchange(objective, budget, options, pool, meter, graph);
}

}  // namespace capfit::refine
