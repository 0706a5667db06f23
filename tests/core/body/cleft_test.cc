#include "core/body/cleft.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/mesh/edge_mates.h"

namespace capfit::body {
namespace {

constexpr int kEnd = 5;   // columns from -kEnd to kEnd
constexpr int kRows = 3;  // across
constexpr double kDepth = 3.0;

std::uint32_t At(int column, int row) {
  return static_cast<std::uint32_t>((column + kEnd) * kRows + row);
}

// A strip along X that goes down to kDepth, there runs level for some columns, and comes up again;
// outermost are the two ends. With a pit: a place as deep beside the way down.
class Strip {
 public:
  Strip(int level_columns, bool has_pit) {
    for (int x = -kEnd; x <= kEnd; ++x) {
      const double slope = kDepth / (kEnd - level_columns);
      const double y = std::max(-kDepth, (std::abs(x) - kEnd) * slope);
      for (int row = 0; row < kRows; ++row) points_.emplace_back(x, y, row);
    }
    for (int x = -kEnd; x < kEnd; ++x) {
      for (int row = 0; row + 1 < kRows; ++row) {
        triangles_.push_back({At(x, row), At(x + 1, row), At(x, row + 1)});
        triangles_.push_back({At(x + 1, row), At(x + 1, row + 1), At(x, row + 1)});
      }
    }
    if (!has_pit) return;
    const auto pit = static_cast<std::uint32_t>(points_.size());
    points_.emplace_back(-kEnd + 0.5, -kDepth, -1);
    triangles_.push_back({At(-kEnd + 1, 0), At(-kEnd, 0), pit});
  }

  // From the middle of one end to that of the other.
  [[nodiscard]] std::optional<Eigen::Vector3d> Cleft(const Eigen::Vector3d& outward) const {
    const mesh::EdgeMates edges = mesh::FindEdgeMates(triangles_, points_.size());
    const SurfaceGraph graph(points_, triangles_, edges.mate);
    Shape shape;
    shape.points = shape.vertices = points_;
    shape.graph = &graph;
    return FindCleft(shape, At(-kEnd, 1), At(kEnd, 1), outward,
                     {Eigen::Vector3d::Zero(), 10.0 * kEnd});
  }

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<mesh::Triangle> triangles_;
};

TEST(CleftTest, IsTheInnermostPlaceOnTheWay) {
  const auto cleft = Strip(0, false).Cleft(Eigen::Vector3d::UnitY());
  ASSERT_TRUE(cleft.has_value());
  EXPECT_EQ(cleft->x(), 0.0);
  EXPECT_EQ(cleft->y(), -kDepth);
}

TEST(CleftTest, APitBesideTheWayIsNotIt) {
  const auto cleft = Strip(2, true).Cleft(Eigen::Vector3d::UnitY());
  ASSERT_TRUE(cleft.has_value());
  EXPECT_LE(std::abs(cleft->x()), 2.0);
  EXPECT_EQ(cleft->y(), -kDepth);
}

TEST(CleftTest, IsNotWhereOneOfTheTwoLiesInnermost) {
  EXPECT_FALSE(Strip(2, true).Cleft(-Eigen::Vector3d::UnitY()).has_value());
  EXPECT_FALSE(Strip(2, true).Cleft(Eigen::Vector3d::Zero()).has_value());
}

}  // namespace
}  // namespace capfit::body
