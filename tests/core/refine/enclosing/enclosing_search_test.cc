#include "core/refine/enclosing/enclosing_search.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "core/base/fit_observer.h"
#include "tests/core/refine/enclosing/tube.h"
#include "tests/core/refine/graphs.h"

namespace capfit::refine {
namespace {

constexpr RenewalPlan kNone = {.rounds = 0};
constexpr RenewalPlan kOfOne = {.rounds = 4};
constexpr RenewalPlan kOfSeveral = {.rounds = 3, .kept = 5, .found = 4};
constexpr RenewalPlan kFreeAtFirst = {.rounds = 3, .kept = 5, .found = 2, .free_rounds = 1};
constexpr RenewalPlan kFreeToTheEnd = {.rounds = 2, .free_rounds = 2};

std::vector<capsule::MirroredSet> FindAll(const capsule::Budget& budget,
                                          const std::vector<capsule::MirroredSet>& starts,
                                          int threads, const RenewalPlan& plan) {
  const ThreadPool pool(threads);
  NullObserver observer;
  WorkMeter meter(observer);
  return FindEnclosingGraphs(TubeTask(), TubeTask(), budget, plan, starts, /*until=*/1.0, pool,
                             meter);
}

capsule::MirroredSet Find(const capsule::Budget& budget,
                          const std::vector<capsule::MirroredSet>& starts, int threads,
                          const RenewalPlan& plan = kOfOne) {
  return FindAll(budget, starts, threads, plan).front();
}

double TakenIn(capsule::MirroredSet graph) {
  const ThreadPool alone(1);
  NullObserver observer;
  const WorkMeter meter(observer);
  TubeTask().TakeIn(4, /*seed=*/5, alone, meter, graph);
  return TubeTask().Value(graph, alone).total_m3;
}

TEST(EnclosingSearchTest, KeepsToEveryLimit) {
  constexpr int kNo = capsule::kNoLimit;
  for (const capsule::Budget& budget :
       {capsule::Budget{3, kNo, kNo}, capsule::Budget{8, kNo, kNo}, capsule::Budget{kNo, 4, 2},
        capsule::Budget{kNo, 3, 10}, capsule::Budget{kNo, 3, 3}, capsule::Budget{kNo, 4, 3}}) {
    // One start below and one above it.
    for (const RenewalPlan& plan : {kNone, kOfOne, kOfSeveral, kFreeAtFirst, kFreeToTheEnd}) {
      const capsule::MirroredSet graph = Find(budget, {Chain(2), Chain(7)}, 1, plan);
      EXPECT_TRUE(budget.Allows(graph.count()));
      EXPECT_GT(graph.sphere_count(), 0);
    }
  }
}

TEST(EnclosingSearchTest, GivesTheBestAsManyAsAskedFor) {
  const capsule::Budget budget{9, capsule::kNoLimit, capsule::kNoLimit};
  EXPECT_EQ(FindAll(budget, {Chain(2), Chain(5)}, 2, kOfOne).size(), 1u);
  const auto several = FindAll(budget, {Chain(2), Chain(5)}, 2, kOfSeveral);
  ASSERT_GT(several.size(), 1u);
  ASSERT_LE(several.size(), static_cast<std::size_t>(kOfSeveral.found));
  for (const capsule::MirroredSet& graph : several) {
    EXPECT_TRUE(budget.Allows(graph.count()));
    EXPECT_LE(TakenIn(several.front()), 1.02 * TakenIn(graph));
  }
}

TEST(EnclosingSearchTest, IsNoWorseThanItsStart) {
  const ThreadPool alone(1);
  NullObserver observer;
  WorkMeter meter(observer);
  capsule::MirroredSet start = Chain(3);
  TubeTask().FindShape(8, 1.0, /*seed=*/1, alone, meter, start);
  const capsule::MirroredSet found = Find({5, capsule::kNoLimit, capsule::kNoLimit}, {Chain(3)}, 1);
  EXPECT_LT(TakenIn(found), 1.01 * TakenIn(start));
}

TEST(EnclosingSearchTest, RoundsAreNotWorseThanNone) {
  for (const int budget : {5, 9, 13}) {
    const capsule::Budget limit{budget, capsule::kNoLimit, capsule::kNoLimit};
    const double none = TakenIn(Find(limit, {Chain(2), Chain(7)}, 2, kNone));
    for (const RenewalPlan& plan : {kOfOne, kOfSeveral}) {
      EXPECT_LE(TakenIn(Find(limit, {Chain(2), Chain(7)}, 2, plan)), 1.01 * none) << budget;
    }
  }
}

TEST(EnclosingSearchTest, SameBitsForAnyNumberOfThreads) {
  const capsule::Budget budget{9, capsule::kNoLimit, capsule::kNoLimit};
  for (const RenewalPlan& plan : {kOfOne, kOfSeveral}) {
    const auto one = Find(budget, {Chain(2), Chain(5)}, 1, plan);
    const auto three = Find(budget, {Chain(2), Chain(5)}, 3, plan);
    ASSERT_EQ(one.capsules(), three.capsules());
    for (int v = 0; v < one.sphere_count(); ++v) {
      EXPECT_EQ(one.sphere(v).center_m, three.sphere(v).center_m);
      EXPECT_EQ(one.sphere(v).radius_m, three.sphere(v).radius_m);
    }
  }
}

}  // namespace
}  // namespace capfit::refine
