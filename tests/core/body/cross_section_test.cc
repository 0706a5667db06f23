#include "core/body/cross_section.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/base/random.h"

namespace capfit::body {
namespace {

// A closed ball around `center`, or with its top cut off.
struct Ball {
  std::vector<Eigen::Vector3d> points;
  std::vector<mesh::Triangle> triangles;

  Ball(const Eigen::Vector3d& center, double radius, bool is_open = false) {
    constexpr int kRings = 60, kAround = 120;
    points.push_back(center + Eigen::Vector3d(0, radius, 0));
    for (int i = 1; i < kRings; ++i) {
      const double polar = std::numbers::pi * i / kRings;
      for (int k = 0; k < kAround; ++k) {
        const double around = 2.0 * std::numbers::pi * k / kAround;
        points.push_back(center + radius * Eigen::Vector3d(std::sin(polar) * std::sin(around),
                                                           std::cos(polar),
                                                           std::sin(polar) * std::cos(around)));
      }
    }
    points.push_back(center - Eigen::Vector3d(0, radius, 0));
    const auto at = [](int ring, int k) {
      return static_cast<std::uint32_t>(1 + (ring - 1) * kAround + k % kAround);
    };
    const auto last = static_cast<std::uint32_t>(points.size() - 1);
    for (int k = 0; k < kAround; ++k) {
      if (!is_open) triangles.push_back({0, at(1, k), at(1, k + 1)});
      triangles.push_back({last, at(kRings - 1, k + 1), at(kRings - 1, k)});
      for (int i = 1; i + 1 < kRings; ++i) {
        triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
        triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
      }
    }
  }
};

TEST(CrossSectionTest, OfABallIsACircle) {
  const Eigen::Vector3d center(0.3, 1.0, -0.2);
  const Ball ball(center, 0.5);
  const CutSurface surface(ball.points, ball.triangles);
  Random random(1);
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector3d normal =
        Eigen::Vector3d(random.NextIn(-1, 1), random.NextIn(-1, 1), random.NextIn(0.1, 1))
            .normalized();
    const double height = random.NextIn(-0.4, 0.4);
    const std::vector<SectionLoop> loops = surface.Cut({center + height * normal, normal});
    ASSERT_EQ(loops.size(), 1U);
    const double r = std::sqrt(0.25 - height * height);
    EXPECT_TRUE(loops[0].is_closed);
    EXPECT_NEAR(loops[0].area, std::numbers::pi * r * r, 0.005 * std::numbers::pi * r * r);
    EXPECT_NEAR(loops[0].girth, 2.0 * std::numbers::pi * r, 0.005 * 2.0 * std::numbers::pi * r);
    EXPECT_LT((loops[0].centroid - (center + height * normal)).norm(), 2e-3);
    const Eigen::Vector3d aside = normal.unitOrthogonal();
    EXPECT_NEAR(loops[0].Max(aside) - loops[0].Min(aside), 2.0 * r, 0.01);
  }
}

TEST(CrossSectionTest, BesideItThereIsNothing) {
  const Ball ball({0, 0, 0}, 0.5);
  const CutSurface surface(ball.points, ball.triangles);
  EXPECT_TRUE(surface.Cut({{0, 0.51, 0}, Eigen::Vector3d::UnitY()}).empty());
}

TEST(CrossSectionTest, OpenWhereTheSurfaceEnds) {
  const Ball ball({0, 0, 0}, 0.5, /*is_open=*/true);
  const CutSurface surface(ball.points, ball.triangles);
  const std::vector<SectionLoop> upright = surface.Cut({{0, 0, 0}, Eigen::Vector3d::UnitX()});
  ASSERT_FALSE(upright.empty());
  for (const SectionLoop& piece : upright) EXPECT_FALSE(piece.is_closed);
  EXPECT_TRUE(surface.Cut({{0, 0, 0}, Eigen::Vector3d::UnitY()})[0].is_closed);
}

TEST(CrossSectionTest, ManyPlanesAreCutAsOneByOneAndTheNearestLoopIsFound) {
  Ball two({0, 0, 0}, 0.3);
  const Ball other({1, 0, 0}, 0.4);
  const auto offset = static_cast<std::uint32_t>(two.points.size());
  two.points.insert(two.points.end(), other.points.begin(), other.points.end());
  for (const mesh::Triangle& t : other.triangles) {
    two.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  const ThreadPool pool(3);
  const CutSurface surface(two.points, two.triangles, pool);
  std::vector<CutPlane> planes;
  for (int i = 0; i < 9; ++i) planes.push_back({{0, 0.07 * i - 0.3, 0}, Eigen::Vector3d::UnitY()});
  const auto all = surface.CutAll(planes, pool);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const std::vector<SectionLoop> alone = surface.Cut(planes[i]);
    ASSERT_EQ(all[i].size(), alone.size());
    for (std::size_t k = 0; k < alone.size(); ++k) {
      EXPECT_EQ(all[i][k].outline, alone[k].outline);
      EXPECT_LE(alone[k].area, alone[k > 0 ? k - 1 : 0].area);
    }
  }
  const CutPlane level = {{0.1, 0.02, 0}, Eigen::Vector3d::UnitY()};
  const auto nearest = surface.CutNearest(level, 0.0);
  ASSERT_TRUE(nearest.has_value());
  EXPECT_LT(nearest->centroid.head<1>().norm(), 0.01);
  const auto large = surface.CutNearest(level, 2.0 * std::numbers::pi * 0.35);
  ASSERT_TRUE(large.has_value());
  EXPECT_NEAR(large->centroid.x(), 1.0, 0.01);
  EXPECT_FALSE(surface.CutNearest(level, 10.0).has_value());
}

}  // namespace
}  // namespace capfit::body
