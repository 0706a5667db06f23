#include "core/export/vrm_springs.h"

#include <gtest/gtest.h>

#include "tests/core/export/rigged_sample.h"

namespace capfit::exports {
namespace {

using nlohmann::json;
using Vec3 = Eigen::Vector3d;

// Nodes 0 to 3 in a row, 1 apart, along x; node 4 beside node 3.
GltfDocument Row() {
  json nodes = json::array();
  for (int n = 0; n < 4; ++n) {
    nodes.push_back({{"translation", {n == 0 ? 0 : 1, 0, 0}}, {"children", {n + 1}}});
  }
  nodes[2]["children"].push_back(4);
  nodes[3].erase("children");
  nodes.push_back({{"translation", {0, 2, 0}}});
  const std::string glb = GlbOf({{"asset", {{"version", "2.0"}}}, {"nodes", nodes}});
  return GltfDocument::Open(BytesOf(glb)).value();
}

TEST(VrmSprings, EachJointButTheFirstHasTheRadiusOfTheOneBefore) {
  const json spring = json::parse(R"({"joints": [{"node": 0, "hitRadius": 0.1}, {"node": 1},
                                                 {"node": 99}, "no joint", {"node": 3}]})");
  const std::vector<SpringPoint> points = SpringPoints(Row(), spring);
  ASSERT_EQ(points.size(), 2);
  EXPECT_EQ(points[0].position, Vec3(1, 0, 0));
  EXPECT_EQ(points[0].radius, 0.1);
  EXPECT_EQ(points[1].position, Vec3(3, 0, 0));
  EXPECT_EQ(points[1].radius, 0.0);
}

TEST(VrmSprings, ABoneGroupMovesAllBelowItsBones) {
  const json group = json::parse(R"({"bones": [1, 1, 77], "hitRadius": 0.2})");
  const std::vector<SpringPoint> points = BoneGroupPoints(Row(), group);
  std::vector<double> xs;
  for (const SpringPoint& point : points) {
    EXPECT_EQ(point.radius, 0.2);
    xs.push_back(point.position.x());
  }
  // Node 1 moves node 2, node 2 its first child 3; 3 and 4 have 7 cm beyond them.
  std::sort(xs.begin(), xs.end());
  ASSERT_EQ(xs.size(), 4);
  EXPECT_DOUBLE_EQ(xs[0], 2.0);
  EXPECT_DOUBLE_EQ(xs[1], 2.0);  // node 4, and up
  EXPECT_DOUBLE_EQ(xs[2], 3.0);
  EXPECT_DOUBLE_EQ(xs[3], 3.07);
}

}  // namespace
}  // namespace capfit::exports
