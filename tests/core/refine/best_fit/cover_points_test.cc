#include "core/refine/best_fit/cover_points.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/core/refine/graphs.h"

namespace capfit::refine {
namespace {

std::vector<CoverPoint> RandomPoints(int count) {
  Random random(17);
  std::vector<CoverPoint> points;
  for (int i = 0; i < count; ++i) {
    points.push_back({RandomPoint(random).cast<float>(), 0.001f * static_cast<float>(i % 3)});
  }
  return points;
}

TEST(CoverPointsTest, FindDeepestAgreesWithTryingEveryCone) {
  const capsule::MirroredSet graph = LeggedGraph(true);
  const std::vector<Cone> cones = ConesOf(graph);
  const CoverPoints points = MakeCoverPoints(RandomPoints(3000));
  ASSERT_EQ(points.size(), 3000);
  const Deepest deepest = FindDeepest(points, cones);
  for (int i = 0; i < points.size(); ++i) {
    const CoverPoint p = points.At(i);
    const float expected = UnionDistance(graph, p.position_m.cast<double>()) - p.allowed_m;
    EXPECT_EQ(deepest.excess_m[static_cast<std::size_t>(i)], expected);
  }
}

TEST(CoverPointsTest, ThinningKeepsTheOutermostOfEveryAxis) {
  const std::vector<CoverPoint> all = RandomPoints(5000);
  const std::vector<CoverPoint> kept = ThinOut(all, 0.5);
  EXPECT_LT(kept.size(), all.size() / 4);
  for (int k = 0; k < 3; ++k) {
    const auto further = [k](const CoverPoint& a, const CoverPoint& b) {
      return a.position_m[k] < b.position_m[k];
    };
    EXPECT_EQ(std::max_element(kept.begin(), kept.end(), further)->position_m[k],
              std::max_element(all.begin(), all.end(), further)->position_m[k]);
  }
}

TEST(CoverPointsTest, NoPointsAreFine) {
  const CoverPoints points = MakeCoverPoints({});
  EXPECT_EQ(FindDeepest(points, ConesOf(LeggedGraph(true))).SumOutside(), 0.0);
}

}  // namespace
}  // namespace capfit::refine
