#include "core/refine/enclosing/enclosing_search.h"

#include <gtest/gtest.h>

#include "core/base/fit_observer.h"
#include "tests/core/refine/enclosing/tube.h"
#include "tests/core/refine/graphs.h"

namespace capfit::refine {
namespace {

std::vector<capsule::MirroredSet> Find(const capsule::Budget& budget,
                                       const std::vector<capsule::MirroredSet>& starts,
                                       int threads) {
  const ThreadPool pool(threads);
  NullObserver observer;
  return FindEnclosingGraphs(TubeTask(), budget, starts, pool, observer);
}

TEST(EnclosingSearchTest, KeepsToEveryLimit) {
  constexpr int kNo = capsule::kNoLimit;
  for (const capsule::Budget& budget : {capsule::Budget{3, kNo, kNo}, capsule::Budget{8, kNo, kNo},
                                        capsule::Budget{kNo, 4, 2}, capsule::Budget{kNo, 3, 10}}) {
    // One start below and one above it.
    for (const capsule::MirroredSet& graph : Find(budget, {Chain(2), Chain(7)}, 1)) {
      EXPECT_TRUE(budget.Allows(graph.count()));
      EXPECT_GT(graph.sphere_count(), 0);
    }
  }
}

TEST(EnclosingSearchTest, IsNoWorseThanItsStartAndBestComesFirst) {
  const ThreadPool alone(1);
  NullObserver observer;
  WorkMeter meter(observer);
  capsule::MirroredSet start = Chain(3);
  TubeTask().FindShape(8, 1.0, /*seed=*/1, alone, meter, start);
  const std::vector<capsule::MirroredSet> found =
      Find({5, capsule::kNoLimit, capsule::kNoLimit}, {Chain(3)}, 1);
  ASSERT_FALSE(found.empty());
  const auto taken_in = [&](capsule::MirroredSet graph) {
    TubeTask().TakeIn(4, /*seed=*/5, alone, meter, graph);
    return TubeTask().Value(graph, alone);
  };
  EXPECT_LT(taken_in(found.front()), 1.01 * taken_in(start));
}

TEST(EnclosingSearchTest, SameBitsForAnyNumberOfThreads) {
  const capsule::Budget budget{9, capsule::kNoLimit, capsule::kNoLimit};
  const auto one = Find(budget, {Chain(2)}, 1);
  const auto three = Find(budget, {Chain(2)}, 3);
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    ASSERT_EQ(one[k].capsules(), three[k].capsules());
    for (int v = 0; v < one[k].sphere_count(); ++v) {
      EXPECT_EQ(one[k].sphere(v).center_m, three[k].sphere(v).center_m);
      EXPECT_EQ(one[k].sphere(v).radius_m, three[k].sphere(v).radius_m);
    }
  }
}

}  // namespace
}  // namespace capfit::refine
