#include "core/capsule/allocation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/core/circle/outlines.h"

namespace capfit::capsule {
namespace {

using circle::AsFeature;
using circle::Ellipse;

// A body's polygons: 5 chains with `torso`, `arm` and `leg` polygons, 10 cm apart.
std::vector<section::FeaturePolygon> Body(int torso, int arm, int leg, bool mirrored) {
  std::vector<section::FeaturePolygon> polygons;
  const auto add = [&](body::Part part, int count, int mirror_offset) {
    for (int i = 0; i < count; ++i) {
      section::FeaturePolygon polygon = AsFeature(Ellipse(0.1, 0.1, 12));
      polygon.chain = part;
      polygon.order = i;
      polygon.frame.origin_m = Eigen::Vector3d(0, 0.1 * i, 0);
      polygon.mirror = mirrored ? static_cast<int>(polygons.size()) + mirror_offset : -1;
      polygons.push_back(std::move(polygon));
    }
  };
  add(body::Part::kTorso, torso, 0);
  add(body::Part::kLeftArm, arm, arm);
  add(body::Part::kRightArm, arm, -arm);
  add(body::Part::kLeftLeg, leg, leg);
  add(body::Part::kRightLeg, leg, -leg);
  return polygons;
}

// Falls like the measured curves: the trunk's are several times those of the limbs.
double Error(int polygon, int count, int torso) {
  const double first = polygon < torso ? 0.030 + 0.002 * (polygon * 7 % 5) : 0.002;
  return first / std::pow(count, 1.3);
}

double WeightedWaste(const std::vector<section::FeaturePolygon>& polygons,
                     const std::vector<int>& counts, const circle::ErrorOf& error) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    double weight = 0.0;  // all polygons of a chain are 10 cm apart
    for (const std::size_t j : {i - 1, i + 1}) {
      if (j < polygons.size() && polygons[j].chain == polygons[i].chain) weight += 0.05;
    }
    sum += (weight == 0.0 ? 1.0 : weight) * error(static_cast<int>(i), counts[i]);
  }
  return sum;
}

TEST(CountPrimitivesTest, CountsSpheresAndConesOfNeighbours) {
  const auto polygons = Body(3, 2, 2, true);
  const std::vector<int> counts{2, 3, 1, 1, 2, 1, 2, 1, 1, 1, 1};
  const PrimitiveCount count = CountPrimitives(polygons, counts);
  EXPECT_EQ(count.spheres, 16);
  EXPECT_EQ(count.capsules, (6 + 3) + 2 + 2 + 1 + 1);
  EXPECT_EQ(count.total(), 16 + 15 - 2 + 2);
}

TEST(AllocationTest, UsesEveryBudgetAndNeverMore) {
  for (const bool mirrored : {true, false}) {
    const auto polygons = Body(6, 3, 4, mirrored);
    const circle::ErrorOf error = [](int p, int c) { return Error(p, c, 6); };
    for (int budget = 35; budget <= 350; ++budget) {
      const auto counts = AllocateUnderBudget(polygons, {budget}, 8, error);
      const int total = CountPrimitives(polygons, counts).total();
      EXPECT_LE(total, budget);
      EXPECT_GE(total, budget - 3) << "mirrored " << mirrored << " budget " << budget;
      for (std::size_t i = 0; i < counts.size() && mirrored; ++i) {
        EXPECT_EQ(counts[i], counts[polygons[i].mirror]);
      }
    }
  }
}

TEST(AllocationTest, PaperBudgetsOnSmallerLayouts) {
  // The counts of Table 1 with the layouts that can reach them.
  const circle::ErrorOf error = [](int p, int c) { return Error(p, c, 4); };
  for (const int budget : {32, 48, 64, 95, 128, 167, 207, 250}) {
    const auto polygons = Body(4, 3, 3, true);
    const auto counts = AllocateUnderBudget(polygons, {budget}, 8, error);
    EXPECT_GE(CountPrimitives(polygons, counts).total(), budget - 3) << budget;
  }
}

TEST(AllocationTest, SphereAndCapsuleLimitsHoldTogether) {
  const auto polygons = Body(3, 3, 3, true);
  const circle::ErrorOf error = [](int p, int c) { return Error(p, c, 3); };
  for (int spheres = 15; spheres <= 64; spheres += 7) {
    for (int capsules = 10; capsules <= 64; capsules += 6) {
      Budget budget;
      budget.max_spheres = spheres;
      budget.max_capsules = capsules;
      const PrimitiveCount count =
          CountPrimitives(polygons, AllocateUnderBudget(polygons, budget, 8, error));
      EXPECT_LE(count.spheres, spheres);
      EXPECT_LE(count.capsules, capsules);
    }
  }
}

TEST(AllocationTest, OneCircleEachWhenEvenThatIsTooMuch) {
  const auto polygons = Body(6, 3, 4, true);
  const circle::ErrorOf error = [](int p, int c) { return Error(p, c, 6); };
  const auto counts = AllocateUnderBudget(polygons, {20}, 8, error);
  EXPECT_EQ(counts, std::vector<int>(20, 1));
}

// All allocations of a small body: the answer wastes no more than the best of them.
TEST(AllocationTest, BruteForceOnSmallBodies) {
  Random random(81);
  for (int scene = 0; scene < 30; ++scene) {
    const auto polygons = Body(3, 1, 2, true);  // groups: 3 + 1 + 2
    std::vector<double> scale(polygons.size());
    std::vector<double> power(polygons.size());
    for (std::size_t i = 0; i < polygons.size(); ++i) {
      const auto mirror = static_cast<std::size_t>(polygons[i].mirror);
      scale[i] = mirror < i ? scale[mirror] : random.NextIn(0.001, 0.05);
      power[i] = mirror < i ? power[mirror] : random.NextIn(0.5, 2.0);
    }
    const circle::ErrorOf error = [&](int p, int c) {
      const auto i = static_cast<std::size_t>(p);
      return scale[i] / std::pow(c, power[i]);
    };
    const int budget = 20 + scene;
    const int kMost = 4;
    double least = std::numeric_limits<double>::infinity();
    for (int code = 0; code < 4096; ++code) {
      std::vector<int> counts(9);
      int rest = code;
      for (const auto& group :
           std::vector<std::vector<std::size_t>>{{0}, {1}, {2}, {3, 4}, {5, 7}, {6, 8}}) {
        for (const std::size_t i : group) counts[i] = 1 + rest % kMost;
        rest /= kMost;
      }
      const int total = CountPrimitives(polygons, counts).total();
      if (total > budget || total < budget - 3) continue;
      least = std::min(least, WeightedWaste(polygons, counts, error));
    }
    const auto counts = AllocateUnderBudget(polygons, {budget}, kMost, error);
    const int total = CountPrimitives(polygons, counts).total();
    if (least == std::numeric_limits<double>::infinity()) continue;  // no allocation gets there
    EXPECT_GE(total, budget - 3) << scene;
    // Near the greedy answer is not everywhere: within 5 % of the best there is.
    EXPECT_LE(WeightedWaste(polygons, counts, error), 1.05 * least) << scene;
  }
}

TEST(AllocationTest, StepsOverPlateaus) {
  const auto polygons = Body(2, 1, 1, true);
  // The trunk gains nothing from a second circle and everything from a third.
  const circle::ErrorOf error = [](int p, int c) { return p < 2 && c < 3 ? 1.0 : 0.001 / c; };
  const auto counts = AllocateUnderBudget(polygons, {40}, 4, error);
  EXPECT_GE(counts[0], 3);
  EXPECT_GE(counts[1], 3);
}

TEST(AllocationTest, AsksOnlyForWhatItNeeds) {
  const auto polygons = Body(6, 3, 4, true);
  int highest = 0;
  const circle::ErrorOf error = [&](int p, int c) {
    highest = std::max(highest, c);
    return Error(p, c, 6);
  };
  (void)AllocateUnderBudget(polygons, {50}, 8, error);
  EXPECT_LE(highest, 4);
}

TEST(AllocateByThresholdTest, TakesTheFewestCirclesThatReachIt) {
  const auto polygons = Body(6, 3, 4, true);
  const double area = polygons[0].outline.area_m2();
  const circle::ErrorOf error = [&](int p, int c) { return area * (p == 0 ? 0.6 : 0.2) / c; };
  for (const double threshold : {0.01, 0.1, 0.15, 0.25, 2.0}) {
    const auto counts = AllocateByThreshold(polygons, threshold, 8, error);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const int p = static_cast<int>(i);
      EXPECT_TRUE(counts[i] == 8 || error(p, counts[i]) <= threshold * area);
      EXPECT_TRUE(counts[i] == 1 || error(p, counts[i] - 1) > threshold * area);
    }
  }
}

}  // namespace
}  // namespace capfit::capsule
