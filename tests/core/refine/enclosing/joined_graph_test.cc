#include "core/refine/enclosing/joined_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/random.h"
#include "tests/core/capsule/mirrored.h"
#include "tests/core/refine/graphs.h"

namespace capfit::refine {
namespace {

using capsule::MirroredSet;

constexpr capsule::Budget kAny = {};

// The trunk's spheres come first, then those of hips and feet.
Donor DonorOf(const MirroredSet& graph, double trunk_cost, double leg_cost) {
  Donor donor{&graph, {}, {}};
  for (const geometry::Sphere& sphere : graph.spheres()) {
    donor.regions.push_back(sphere.center_m.y() > 0.9 ? Region::kTrunk : Region::kLeftLeg);
  }
  donor.costs[0] = trunk_cost;
  donor.costs[4] = leg_cost;
  return donor;
}

// The same legged graph, its spheres larger by `more_m`.
MirroredSet Legged(bool symmetric, double more_m) {
  MirroredSet graph = LeggedGraph(symmetric);
  for (int v = 0; v < graph.sphere_count(); ++v) graph.sphere(v).radius_m += more_m;
  return graph;
}

TEST(JoinedGraphTest, TakesEachRegionFromTheCheapest) {
  for (const bool symmetric : {true, false}) {
    const MirroredSet thin = Legged(symmetric, 0.0);
    const MirroredSet thick = Legged(symmetric, 0.01);
    const std::vector<Donor> donors = {DonorOf(thin, 3.0, 1.0), DonorOf(thick, 2.0, 2.0)};
    const std::optional<MirroredSet> joined = JoinedGraph(donors, kAny);
    ASSERT_TRUE(joined);
    EXPECT_EQ(joined->sphere_count(), thin.sphere_count());
    EXPECT_EQ(joined->capsule_count(), thin.capsule_count());
    EXPECT_EQ(capsule::IsExactlyMirrored(*joined), symmetric);
    for (int v = 0; v < joined->sphere_count(); ++v) {
      const geometry::Sphere& sphere = joined->sphere(v);
      const auto is_here = [&](const geometry::Sphere& s) {
        return s.center_m == sphere.center_m && s.radius_m == sphere.radius_m;
      };
      const MirroredSet& from = sphere.center_m.y() > 0.9 ? thick : thin;
      EXPECT_TRUE(std::any_of(from.spheres().begin(), from.spheres().end(), is_here)) << v;
    }
  }
}

// A thigh that hung on the other donor's belly hangs on the belly that is there.
TEST(JoinedGraphTest, CapsulesEndInTheMostSimilarSphere) {
  const MirroredSet thin = Legged(true, 0.0);
  const MirroredSet thick = Legged(true, 0.01);
  const std::vector<Donor> donors = {DonorOf(thin, 3.0, 1.0), DonorOf(thick, 2.0, 2.0)};
  const std::optional<MirroredSet> joined = JoinedGraph(donors, kAny);
  ASSERT_TRUE(joined);
  int thighs = 0;
  for (const capsule::CapsuleEnds& ends : joined->capsules()) {
    const double y = joined->sphere(ends[0]).center_m.y();
    const double other = joined->sphere(ends[1]).center_m.y();
    if ((y > 0.9) == (other > 0.9)) continue;
    EXPECT_EQ(std::max(y, other), 1.0);  // the belly's, not the chest's
    ++thighs;
  }
  EXPECT_EQ(thighs, 2);
}

TEST(JoinedGraphTest, NothingWhereOneIsBestOrNoneFits) {
  const MirroredSet thin = Legged(true, 0.0);
  const MirroredSet thick = Legged(true, 0.01);
  EXPECT_FALSE(JoinedGraph(std::vector{DonorOf(thin, 1.0, 1.0)}, kAny));
  EXPECT_FALSE(JoinedGraph(std::vector{DonorOf(thin, 1.0, 1.0), DonorOf(thick, 2.0, 2.0)}, kAny));
  const std::vector<Donor> donors = {DonorOf(thin, 1.0, 2.0), DonorOf(thick, 2.0, 1.0)};
  EXPECT_TRUE(JoinedGraph(donors, {thin.primitive_count(), 6, 5}));
  EXPECT_FALSE(JoinedGraph(donors, {thin.primitive_count() - 1}));
  EXPECT_FALSE(JoinedGraph(donors, {capsule::kNoLimit, 5, capsule::kNoLimit}));
}

// Spheres that are not tied: each region of each donor has its own count and cost.
struct Loose {
  MirroredSet graph;
  Donor donor;
};

Loose RandomLoose(int number, Random& random) {
  Loose loose;
  for (std::size_t r = 0; r < kRegionCount; ++r) {
    loose.donor.costs[r] = random.NextIn(0.0, 1.0);
    const int count = 1 + static_cast<int>(random.NextBelow(4));
    for (int i = 0; i < count; ++i) {
      // The place tells region and donor.
      loose.graph.AddSphere({{static_cast<double>(r), 1.0 * number, 0.1 * i}, 0.05}, false);
      loose.donor.regions.push_back(static_cast<Region>(r));
    }
  }
  return loose;
}

// By trying every choice; infinite where none fits.
double LeastCost(const std::vector<Loose>& all, const capsule::Budget& budget, std::size_t region,
                 int spheres) {
  if (!budget.Allows({spheres, 0})) return std::numeric_limits<double>::infinity();
  if (region == kRegionCount) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (const Loose& loose : all) {
    const auto own = std::count(loose.donor.regions.begin(), loose.donor.regions.end(),
                                static_cast<Region>(region));
    const double rest = LeastCost(all, budget, region + 1, spheres + static_cast<int>(own));
    least = std::min(least, loose.donor.costs[region] + rest);
  }
  return least;
}

double CostOf(const MirroredSet& joined, const std::vector<Loose>& all) {
  std::vector<int> donor_of(kRegionCount, -1);
  for (const geometry::Sphere& sphere : joined.spheres()) {
    int& donor = donor_of[std::lround(sphere.center_m.x())];
    const int own = static_cast<int>(std::lround(sphere.center_m.y()));
    EXPECT_TRUE(donor < 0 || donor == own);
    donor = own;
  }
  double cost = 0.0;
  for (std::size_t r = 0; r < kRegionCount; ++r) cost += all[donor_of[r]].donor.costs[r];
  return cost;
}

TEST(JoinedGraphTest, NoOtherChoiceThatFitsIsCheaper) {
  Random random(5);
  int joins = 0;
  for (int trial = 0; trial < 60; ++trial) {
    std::vector<Loose> all;
    for (int d = 0; d < 4; ++d) all.push_back(RandomLoose(d, random));
    std::vector<Donor> donors;
    for (Loose& loose : all) {
      donors.push_back(loose.donor);
      donors.back().graph = &loose.graph;
    }
    const capsule::Budget budget{7 + static_cast<int>(random.NextBelow(12))};
    const std::optional<MirroredSet> joined = JoinedGraph(donors, budget);
    const double least = LeastCost(all, budget, 0, 0);
    if (!joined) continue;
    ++joins;
    EXPECT_TRUE(budget.Allows(joined->count()));
    EXPECT_NEAR(CostOf(*joined, all), least, 1e-12);
  }
  EXPECT_GT(joins, 30);
}

}  // namespace
}  // namespace capfit::refine
