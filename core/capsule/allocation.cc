#include "core/capsule/allocation.h"

#include <algorithm>
#include <optional>

#include "core/base/ties.h"
#include "core/capsule/allocation_search.h"

namespace capfit::capsule {
namespace {

// How far below its budget an allocation may stay where more polygons and circles would fit.
constexpr int kSlack = 3;
// Share of new cones that survives the removal of covered ones, for ranking only.
constexpr double kSurvival = 0.75;

bool SameChain(const section::FeaturePolygon& a, const section::FeaturePolygon& b) {
  return a.chain == b.chain;
}

// Length of chain that each polygon stands for: half the way to each neighbour.
std::vector<double> Weights(std::span<const section::FeaturePolygon> polygons) {
  std::vector<double> weights(polygons.size(), 0.0);
  for (std::size_t i = 0; i + 1 < polygons.size(); ++i) {
    if (!SameChain(polygons[i], polygons[i + 1])) continue;
    const double half = 0.5 * (polygons[i + 1].frame.origin_m - polygons[i].frame.origin_m).norm();
    weights[i] += half;
    weights[i + 1] += half;
  }
  for (double& weight : weights) {
    if (weight == 0.0) weight = 1.0;  // alone on its chain
  }
  return weights;
}

// Polygons that rise together: a mirrored pair, or one alone.
std::vector<std::vector<int>> Groups(std::span<const section::FeaturePolygon> polygons) {
  std::vector<std::vector<int>> groups;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const int self = static_cast<int>(i);
    const int mirror = polygons[i].mirror;
    if (mirror >= 0 && mirror < self) continue;
    groups.push_back(mirror > self ? std::vector<int>{self, mirror} : std::vector<int>{self});
  }
  return groups;
}

class Allocator {
 public:
  Allocator(std::span<const section::FeaturePolygon> polygons, const Budget& budget,
            int max_circles, const circle::ErrorOf& error)
      : polygons_(polygons),
        budget_(budget),
        max_circles_(max_circles),
        error_(error),
        weights_(Weights(polygons)),
        groups_(Groups(polygons)),
        chains_(Chains()),
        counts_(polygons.size(), 1) {}

  std::vector<int> Run() {
    if (!budget_.Allows(CountPrimitives(polygons_, counts_))) return counts_;
    Greedy();
    Polish();
    return counts_;
  }

 private:
  int GroupCount(std::size_t g) const { return counts_[groups_[g].front()]; }
  void SetGroup(std::size_t g, int count) {
    for (const int polygon : groups_[g]) counts_[polygon] = count;
  }
  double Waste(std::size_t g, int count) const {
    double waste = 0.0;
    for (const int polygon : groups_[g]) {
      waste += weights_[polygon] * error_(polygon, count);
    }
    return waste;
  }

  // Raises the group that saves most volume per primitive, until nothing fits.
  void Greedy() {
    while (true) {
      std::size_t best = groups_.size();
      int best_raise = 0;
      double highest = -1.0;
      for (std::size_t g = 0; g < groups_.size(); ++g) {
        for (int raise = 1; raise <= 2; ++raise) {
          const std::optional<double> score = Score(g, raise);
          if (!score) break;
          if (ClearlyLess(highest, *score)) {
            highest = *score;
            best = g;
            best_raise = raise;
          }
          if (*score > 0.0) break;  // two at once only to get past a plateau
        }
      }
      if (best == groups_.size()) return;
      SetGroup(best, GroupCount(best) + best_raise);
    }
  }

  // Volume saved per primitive that will survive; nothing where the raise does not fit.
  std::optional<double> Score(std::size_t g, int raise) {
    const int count = GroupCount(g);
    if (count + raise > max_circles_) return std::nullopt;
    const PrimitiveCount before = CountPrimitives(polygons_, counts_);
    SetGroup(g, count + raise);
    const PrimitiveCount after = CountPrimitives(polygons_, counts_);
    SetGroup(g, count);
    if (!budget_.Allows(after)) return std::nullopt;
    const double cost =
        (after.spheres - before.spheres) + kSurvival * (after.capsules - before.capsules);
    return (Waste(g, count) - Waste(g, count + raise)) / cost;
  }

  // Replaces the greedy counts by the least waste among all counts near them that use the budget
  // up to kSlack; looks further away where none does.
  void Polish() {
    if (chains_.empty()) return;
    for (int reach = 1; reach <= 3; ++reach) {
      const auto counts = SearchAllocation(Choices(reach), budget_, kSlack);
      if (!counts) return;
      const std::vector<int> greedy = counts_;
      for (std::size_t c = 0; c < chains_.size(); ++c) {
        for (std::size_t p = 0; p < chains_[c].size(); ++p) {
          SetGroup(chains_[c][p], (*counts)[c][p]);
        }
      }
      const int total = CountPrimitives(polygons_, counts_).total();
      const bool only_total = budget_.max_spheres == kNoLimit && budget_.max_capsules == kNoLimit;
      if (!only_total || budget_.max_primitives - total <= kSlack) return;
      if (reach < 3) counts_ = greedy;
    }
  }

  // Counts up to `reach` above and one more below the present ones. Errors of counts up to one
  // above are known from the greedy rounds already.
  std::vector<ChainChoices> Choices(int reach) const {
    std::vector<ChainChoices> choices;
    for (const std::vector<std::size_t>& chain : chains_) {
      ChainChoices& next = choices.emplace_back();
      next.copies = static_cast<int>(groups_[chain.front()].size());
      for (const std::size_t g : chain) {
        CountChoices& counts = next.polygons.emplace_back();
        counts.lowest = std::max(1, GroupCount(g) - reach - 1);
        const int highest = std::min(max_circles_, GroupCount(g) + reach);
        for (int count = counts.lowest; count <= highest; ++count) {
          counts.waste.push_back(Waste(g, count));
        }
      }
    }
    return choices;
  }

  // Groups by chain, in order; empty where pairs and single polygons mix on a chain.
  std::vector<std::vector<std::size_t>> Chains() const {
    std::vector<std::vector<std::size_t>> chains;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const bool follows =
          g > 0 && SameChain(polygons_[groups_[g - 1].front()], polygons_[groups_[g].front()]);
      if (!follows) chains.emplace_back();
      if (follows && groups_[g].size() != groups_[g - 1].size()) return {};
      chains.back().push_back(g);
    }
    return chains;
  }

  std::span<const section::FeaturePolygon> polygons_;
  const Budget& budget_;
  int max_circles_;
  const circle::ErrorOf& error_;
  std::vector<double> weights_;
  std::vector<std::vector<int>> groups_;
  std::vector<std::vector<std::size_t>> chains_;
  std::vector<int> counts_;
};

}  // namespace

PrimitiveCount CountPrimitives(std::span<const section::FeaturePolygon> polygons,
                               std::span<const int> circle_counts) {
  PrimitiveCount count;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    count.spheres += circle_counts[i];
    if (i > 0 && SameChain(polygons[i - 1], polygons[i])) {
      count.capsules += circle_counts[i - 1] * circle_counts[i];
    }
  }
  return count;
}

std::vector<int> AllocateUnderBudget(std::span<const section::FeaturePolygon> polygons,
                                     const Budget& budget, int max_circles,
                                     const circle::ErrorOf& error_m2) {
  return Allocator(polygons, budget, max_circles, error_m2).Run();
}

std::vector<int> AllocateByThreshold(std::span<const section::FeaturePolygon> polygons,
                                     double threshold, int max_circles,
                                     const circle::ErrorOf& error_m2) {
  std::vector<int> counts(polygons.size(), 1);
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const int mirror = polygons[i].mirror;
    if (mirror >= 0 && mirror < static_cast<int>(i)) {
      counts[i] = counts[mirror];
      continue;
    }
    const double allowed = threshold * polygons[i].outline.area_m2();
    while (counts[i] < max_circles && error_m2(static_cast<int>(i), counts[i]) > allowed) {
      ++counts[i];
    }
  }
  return counts;
}

}  // namespace capfit::capsule
