#include "core/character/surrounding.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/mesh/soups.h"

namespace capfit::character {
namespace {

using body::LandmarkId;

TEST(WindingNumbersTest, AreOneInsideAndNothingOutsideOfEachShell) {
  const Shells shells = FindShells(
      mesh::Together(mesh::Ball(48, 24), mesh::Moved(mesh::Ball(48, 24), {4.0, 0.0, 0.0})));
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {4, 0.5, 0}, {2, 0, 0}, {0.9, 0, 0}};
  const auto one = WindingNumbers(shells, points, ThreadPool(1));
  const float expected[2][4] = {{1, 0, 0, 1}, {0, 1, 0, 0}};
  for (std::size_t s = 0; s < 2; ++s) {
    for (std::size_t p = 0; p < 4; ++p) EXPECT_NEAR(one[s][p], expected[s][p], 0.03) << s << p;
  }
  EXPECT_EQ(one, WindingNumbers(shells, points, ThreadPool(3)));
}

TEST(WindingNumbersTest, OfAHalfBallIsAHalfFromItsMiddleWhicheverWayItFaces) {
  formats::PolygonSoup half = mesh::Ball(48, 24);
  std::vector<char> is_upper;
  std::size_t at = 0;
  for (std::size_t face = 0; face < half.face_count(); ++face) {
    const std::size_t size = half.face_sizes.empty() ? 3 : half.face_sizes[face];
    double z = 0.0;
    for (std::size_t k = 0; k < size; ++k) z += half.positions[half.face_vertices[at + k]].z();
    is_upper.push_back(z > 0.0 ? 1 : 0);
    at += size;
  }
  formats::PolygonSoup upper = formats::WithFaces(half, is_upper, 1);
  upper.positions = half.positions;
  for (const bool is_turned : {false, true}) {
    if (is_turned) std::reverse(upper.face_vertices.begin(), upper.face_vertices.end());
    if (is_turned) std::reverse(upper.face_sizes.begin(), upper.face_sizes.end());
    const auto winding = WindingNumbers(FindShells(upper), {{0, 0, 0}}, ThreadPool(1));
    EXPECT_NEAR(winding[0][0], 0.5, 0.06);
  }
}

TEST(InnerPointsTest, NeedHipsAndNeck) {
  EXPECT_FALSE(InnerPointsOf({}).has_value());
  EXPECT_FALSE(InnerPointsOf({{LandmarkId::kLeftHip, {0.1, 0.9, 0.0}},
                              {LandmarkId::kRightHip, {-0.1, 0.9, 0.0}}})
                   .has_value());
}

TEST(InnerPointsTest, KnowUpAndHeightAndLeaveOutLimbsThatAreNotTold) {
  const auto points = InnerPointsOf({{LandmarkId::kLeftHip, {0.1, 0.0, 0.9}},
                                     {LandmarkId::kRightHip, {-0.1, 0.0, 0.9}},
                                     {LandmarkId::kNeck, {0.0, 0.0, 1.45}}});
  ASSERT_TRUE(points.has_value());
  EXPECT_NEAR((points->up - Eigen::Vector3d::UnitZ()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(points->height, 1.67, 0.01);
  EXPECT_TRUE(points->limbs.empty());
  EXPECT_TRUE(points->between_legs.empty());
  for (const Eigen::Vector3d& p : points->head) EXPECT_GT(p.z(), 1.45);
}

}  // namespace
}  // namespace capfit::character
