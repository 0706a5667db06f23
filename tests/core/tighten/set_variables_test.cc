#include "core/tighten/set_variables.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/core/tighten/tube_body.h"

namespace capfit::tighten {
namespace {

TEST(SetVariablesTest, PairsShareVariablesAndCentredSpheresKeepX) {
  TubeBody body = MakeTubeBody(1, 0.0);
  const SetVariables variables(body.set);
  // Two centred spheres and six pairs.
  EXPECT_EQ(variables.count(), 4 * 8);
  Random random(41);
  Eigen::VectorXd change(variables.count());
  for (double& value : change) value = random.NextIn(-0.01, 0.01);
  const capsule::PrimitiveSet before = body.set;
  variables.Apply(change, body.set);
  EXPECT_TRUE(IsExactlyMirrored(body.set));
  for (int i = 0; i < static_cast<int>(body.set.spheres.size()); ++i) {
    const auto index = static_cast<std::size_t>(i);
    const SphereVariables& own = variables.of(i);
    const Eigen::Vector3d moved = body.set.spheres[index].center_m - before.spheres[index].center_m;
    EXPECT_NEAR(moved.x(), own.x_sign * change[own.first], 1e-15);
    EXPECT_NEAR(moved.z(), change[own.first + 2], 1e-15);
    EXPECT_NEAR(body.set.spheres[index].radius_m - before.spheres[index].radius_m,
                change[own.first + 3], 1e-15);
  }
  EXPECT_EQ(body.set.spheres[0].center_m.x(), 0.0);
}

TEST(SetVariablesTest, InexactImagesAreMadeExactAndOneSidedOnesAreFree) {
  TubeBody body = MakeTubeBody(2, 0.0);
  body.set.spheres[3].center_m.x() += 1e-3;  // image of sphere 2
  body.set.spheres[0].center_m.x() = 1e-4;   // centred
  body.set.origins[5].mirror = 2;            // 4 says 5, 5 says 2: neither counts
  const SetVariables variables(body.set);
  EXPECT_EQ(body.set.spheres[3].center_m.x(), -body.set.spheres[2].center_m.x());
  EXPECT_EQ(body.set.spheres[0].center_m.x(), 0.0);
  EXPECT_NE(variables.of(4).first, variables.of(5).first);
  EXPECT_EQ(variables.of(5).x_sign, 1.0);
}

TEST(SetVariablesTest, SolidsAreThoseOfTheSet) {
  TubeBody body = MakeTubeBody(3, 0.0);
  body.set.spheres.push_back({{0, 1.6, 0}, 0.1});  // a ball of its own
  body.set.origins.push_back({body::Part::kHead, -1, -1});
  const SetVariables variables(body.set);
  const std::vector<geometry::TaperedCapsule> shapes = ShapesOf(variables.solids(), body.set);
  const std::vector<geometry::TaperedCapsule> expected = capsule::Solids(body.set);
  ASSERT_EQ(shapes.size(), expected.size());
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    EXPECT_EQ(shapes[k].a().center_m, expected[k].a().center_m);
    EXPECT_EQ(shapes[k].b().radius_m, expected[k].b().radius_m);
  }
}

}  // namespace
}  // namespace capfit::tighten
