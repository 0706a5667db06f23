#include "core/export/solids.h"

#include <gtest/gtest.h>

namespace capfit::exports {
namespace {

using Vec3 = Eigen::Vector3d;

TEST(Solids, CapsulesComeFirstAndStandOnTheirAxis) {
  ColliderSet set;
  set.primitives.spheres = {
      {Vec3(1, 1, 0), 0.1}, {Vec3(9, 9, 9), 0.5}, {Vec3(1, -1, 0), 0.2}, {Vec3(1, 1, 0.1), 0.5}};
  set.primitives.origins.resize(4);
  set.primitives.capsules = {{0, 2}, {0, 3}};
  set.sphere_names = {"a", "lone", "b", "c"};
  const std::vector<Solid> solids = SolidsOf(set);
  ASSERT_EQ(solids.size(), 3);
  EXPECT_EQ(solids[0].name, "a__b");
  EXPECT_FALSE(solids[0].IsBall());
  EXPECT_TRUE((solids[0].Place() * Vec3(0, -1, 0)).isApprox(Vec3(1, 1, 0)));  // the first, below
  EXPECT_TRUE((solids[0].Place() * Vec3(0, 1, 0)).isApprox(Vec3(1, -1, 0)));
  EXPECT_TRUE(solids[1].IsBall());  // 0.1 apart, radii 0.4 apart
  EXPECT_EQ(solids[1].ball().radius_m, 0.5);
  EXPECT_TRUE(solids[1].Place().translation().isApprox(Vec3(1, 1, 0.1)));
  EXPECT_EQ(solids[2].name, "lone");
  EXPECT_FALSE(solids[2].capsule.has_value());
  EXPECT_TRUE(solids[2].IsBall());
  EXPECT_EQ(solids[2].joint, -1);
}

}  // namespace
}  // namespace capfit::exports
