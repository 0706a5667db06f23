#include "core/capsule/allocation_search.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "core/base/ties.h"

namespace capfit::capsule {
namespace {

constexpr double kImpossible = std::numeric_limits<double>::infinity();
// Tables are joined in the square of their size; 2500 states take some 5 ms.
constexpr long kMostStates = 2500;

// Costs as table indices. Where only the total is limited, one number tells the cost; else spheres
// and capsules are kept apart, and what is unlimited counts 0.
class CostIndex {
 public:
  explicit CostIndex(const Budget& budget)
      : total_only_(budget.max_spheres == kNoLimit && budget.max_capsules == kNoLimit),
        max_total_(budget.max_primitives) {
    if (total_only_) {
      rows_ = 1;
      columns_ = Size(budget.max_primitives);
    } else {
      rows_ = Size(std::min(budget.max_spheres, budget.max_primitives));
      columns_ = Size(std::min(budget.max_capsules, budget.max_primitives));
    }
  }

  [[nodiscard]] bool total_only() const { return total_only_; }
  [[nodiscard]] bool is_small() const { return rows_ * columns_ <= kMostStates; }
  [[nodiscard]] int size() const { return static_cast<int>(rows_ * columns_); }

  // Index of the cost `from` with more added; -1 where that is beyond the budget.
  [[nodiscard]] int Add(int from, int spheres, int capsules) const {
    long row = from / columns_;
    long column = from % columns_;
    if (total_only_) {
      column += spheres + capsules;
    } else {
      if (rows_ > 1) row += spheres;
      if (columns_ > 1) column += capsules;
      if (row + column > max_total_) return -1;
    }
    return row < rows_ && column < columns_ ? static_cast<int>(row * columns_ + column) : -1;
  }
  [[nodiscard]] int Join(int a, int b) const {
    if (total_only_) return Add(a, b, 0);
    return Add(a, static_cast<int>(b / columns_), static_cast<int>(b % columns_));
  }
  [[nodiscard]] int Unused(int index) const { return size() - 1 - index; }  // total only

 private:
  static long Size(int limit) { return limit == kNoLimit ? 1 : static_cast<long>(limit) + 1; }

  bool total_only_;
  long max_total_;
  long rows_ = 1;
  long columns_ = 1;
};

// All ways through one chain: for each cost the least waste, and the way back.
class ChainTable {
 public:
  ChainTable(const ChainChoices& chain, const CostIndex& costs) : chain_(chain), costs_(costs) {
    for (std::size_t p = 0; p < chain.polygons.size(); ++p) AddPolygon(p);
    best_.assign(costs.size(), {});
    for (std::size_t choice = 0; choice < chain.polygons.back().waste.size(); ++choice) {
      for (std::size_t cost = 0; cost < best_.size(); ++cost) {
        const double waste = stages_.back()[choice][cost].waste;
        if (ClearlyLess(waste, best_[cost].waste))
          best_[cost] = {waste, static_cast<int>(choice), 0};
      }
    }
  }

  [[nodiscard]] double Waste(int cost) const { return best_[cost].waste; }

  [[nodiscard]] std::vector<int> Counts(int cost) const {
    std::vector<int> counts(chain_.polygons.size());
    int choice = best_[cost].choice;
    for (std::size_t p = counts.size(); p-- > 0;) {
      counts[p] = chain_.polygons[p].lowest + static_cast<int>(choice);
      const Cell& cell = stages_[p][choice][cost];
      choice = cell.choice;
      cost = cell.from;
    }
    return counts;
  }

 private:
  struct Cell {
    double waste = kImpossible;
    int choice = 0;  // the previous polygon's
    int from = 0;    // the cost before
  };
  using Row = std::vector<Cell>;  // by cost

  void AddPolygon(std::size_t p) {
    const CountChoices& choices = chain_.polygons[p];
    std::vector<Row> stage(choices.waste.size(), Row(costs_.size()));
    for (std::size_t choice = 0; choice < choices.waste.size(); ++choice) {
      const int count = choices.lowest + static_cast<int>(choice);
      if (p == 0) {
        const int cost = costs_.Add(0, chain_.copies * count, 0);
        if (cost >= 0) stage[choice][cost] = {choices.waste[choice], 0, 0};
        continue;
      }
      for (std::size_t before = 0; before < stages_.back().size(); ++before) {
        const int previous = chain_.polygons[p - 1].lowest + static_cast<int>(before);
        Extend(stages_.back()[before], static_cast<int>(before), count, previous * count,
               choices.waste[choice], stage[choice]);
      }
    }
    stages_.push_back(std::move(stage));
  }

  void Extend(const Row& from, int before, int spheres, int capsules, double waste, Row& to) const {
    for (std::size_t cost = 0; cost < from.size(); ++cost) {
      if (from[cost].waste == kImpossible) continue;
      const int next =
          costs_.Add(static_cast<int>(cost), chain_.copies * spheres, chain_.copies * capsules);
      if (next < 0) continue;
      Cell& cell = to[next];
      const double sum = from[cost].waste + waste;
      if (ClearlyLess(sum, cell.waste)) cell = {sum, before, static_cast<int>(cost)};
    }
  }

  const ChainChoices& chain_;
  const CostIndex& costs_;
  std::vector<std::vector<Row>> stages_;  // by polygon, then choice
  Row best_;
};

// Chains put together one after the other.
class Joined {
 public:
  Joined(const std::vector<ChainTable>& tables, const CostIndex& costs)
      : tables_(tables), costs_(costs) {
    std::vector<Cell> start(costs.size());
    start[0].waste = 0.0;
    stages_.push_back(std::move(start));
    for (const ChainTable& table : tables) Join(table);
  }

  [[nodiscard]] int BestCost(int slack) const {
    const std::vector<Cell>& last = stages_.back();
    int best = -1;
    for (int cost = costs_.size() - 1; cost >= 0; --cost) {
      const double waste = last[cost].waste;
      if (waste == kImpossible) continue;
      // From the dearest down: past the slack only the first one counts.
      if (costs_.total_only() && best >= 0 && costs_.Unused(cost) > slack) break;
      if (best < 0 || ClearlyLess(waste, last[best].waste)) best = cost;
    }
    return best;
  }

  [[nodiscard]] std::vector<std::vector<int>> Counts(int cost) const {
    std::vector<std::vector<int>> counts(tables_.size());
    for (std::size_t t = tables_.size(); t-- > 0;) {
      const Cell& cell = stages_[t + 1][cost];
      counts[t] = tables_[t].Counts(cell.chain_cost);
      cost = cell.from;
    }
    return counts;
  }

 private:
  struct Cell {
    double waste = kImpossible;
    int chain_cost = 0;
    int from = 0;
  };

  void Join(const ChainTable& table) {
    const std::vector<Cell>& before = stages_.back();
    std::vector<Cell> after(before.size());
    for (int a = 0; a < costs_.size(); ++a) {
      const double waste = before[a].waste;
      if (waste == kImpossible) continue;
      for (int b = 0; b < costs_.size(); ++b) {
        if (table.Waste(b) == kImpossible) continue;
        const int cost = costs_.Join(a, b);
        if (cost < 0) continue;
        Cell& cell = after[cost];
        const double sum = waste + table.Waste(b);
        if (ClearlyLess(sum, cell.waste)) cell = {sum, b, a};
      }
    }
    stages_.push_back(std::move(after));
  }

  const std::vector<ChainTable>& tables_;
  const CostIndex& costs_;
  std::vector<std::vector<Cell>> stages_;
};

}  // namespace

std::optional<std::vector<std::vector<int>>> SearchAllocation(
    const std::vector<ChainChoices>& chains, const Budget& budget, int slack) {
  const CostIndex costs(budget);
  if (!costs.is_small()) return std::nullopt;
  std::vector<ChainTable> tables;
  tables.reserve(chains.size());
  for (const ChainChoices& chain : chains) tables.emplace_back(chain, costs);
  const Joined joined(tables, costs);
  const int cost = joined.BestCost(slack);
  if (cost < 0) return std::nullopt;
  return joined.Counts(cost);
}

}  // namespace capfit::capsule
