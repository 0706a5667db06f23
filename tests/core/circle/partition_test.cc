#include "core/circle/partition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/circle/circle_outside_area.h"
#include "core/circle/sample_points.h"
#include "tests/core/circle/outlines.h"

namespace capfit::circle {
namespace {

// The paper's words turned into code, with an exact area for every question.
std::vector<int> BruteForce(std::span<const Eigen::Vector2d> points, std::span<const Seed> seeds,
                            const section::Polygon& outline) {
  const auto nearest = [&](std::size_t p) {
    double least = std::numeric_limits<double>::infinity();
    for (const Seed& s : seeds) least = std::min(least, (points[p] - s.center_m).norm());
    return least;
  };
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return nearest(a) < nearest(b); });
  std::vector<double> radii(seeds.size(), 0.0);
  std::vector<int> owners(points.size());
  for (const std::size_t p : order) {
    double least = std::numeric_limits<double>::infinity();
    double power = 0.0;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const double d = (points[p] - seeds[i].center_m).norm();
      const double weight = seeds[i].place == Place::kPaired ? 2.0 : 1.0;
      const double cost =
          d <= radii[i] ? -1.0
                        : weight * (CircleOutsideArea({seeds[i].center_m, d}, outline) -
                                    CircleOutsideArea({seeds[i].center_m, radii[i]}, outline));
      const double tie = cost < 0 ? d * d - radii[i] * radii[i] : d;
      if (cost < least || (cost == least && tie < power)) {
        least = cost;
        power = tie;
        owners[p] = static_cast<int>(i);
      }
    }
    const auto winner = static_cast<std::size_t>(owners[p]);
    radii[winner] = std::max(radii[winner], (points[p] - seeds[winner].center_m).norm());
  }
  return owners;
}

TEST(PartitionTest, AgreesWithExactAreasButForCloseCalls) {
  Random random(71);
  std::size_t differ = 0;
  std::size_t all = 0;
  for (int scene = 0; scene < 30; ++scene) {
    const section::Polygon outline = MirroredTrunk(random, 80, 0.15);
    std::vector<Eigen::Vector2d> points(outline.vertices().begin(), outline.vertices().end());
    const std::vector<Eigen::Vector2d> inner = InteriorPoints(outline, 100);
    points.insert(points.end(), inner.begin(), inner.end());
    std::vector<Seed> seeds;
    for (int i = 0; i < 2 + scene % 5; ++i) {
      seeds.push_back({{random.NextIn(-0.15, 0.15), random.NextIn(-0.08, 0.08)}, Place::kFree});
    }
    const std::vector<int> fast = Partition(points, seeds, outline);
    const std::vector<int> exact = BruteForce(points, seeds, outline);
    for (std::size_t p = 0; p < points.size(); ++p) differ += fast[p] != exact[p] ? 1 : 0;
    all += points.size();
  }
  EXPECT_LT(static_cast<double>(differ), 0.03 * static_cast<double>(all));
}

TEST(PartitionTest, OneSeedTakesAll) {
  const section::Polygon outline = Square(1);
  const std::vector<Seed> seeds{{{0.5, 0.5}, Place::kFree}};
  for (const int owner : Partition(outline.vertices(), seeds, outline)) EXPECT_EQ(owner, 0);
}

TEST(SamplePointsTest, GridFillsTheOutlineEvenly) {
  Random random(72);
  for (int scene = 0; scene < 20; ++scene) {
    const section::Polygon outline = RandomStar(random, 20, 0.5);
    const std::vector<Eigen::Vector2d> points = InteriorPoints(outline, 400);
    EXPECT_NEAR(static_cast<double>(points.size()), 400.0, 40.0);
    for (const Eigen::Vector2d& p : points) EXPECT_TRUE(outline.Contains(p));
  }
}

TEST(SamplePointsTest, MirroredOutlineGetsMirroredPoints) {
  Random random(73);
  const section::Polygon outline = MirroredTrunk(random, 96, 0.2);
  const std::vector<Eigen::Vector2d> points = InteriorPoints(outline, 300);
  for (const Eigen::Vector2d& p : points) {
    EXPECT_TRUE(std::any_of(points.begin(), points.end(), [&](const Eigen::Vector2d& q) {
      return q.x() == -p.x() && q.y() == p.y();
    }));
  }
}

}  // namespace
}  // namespace capfit::circle
