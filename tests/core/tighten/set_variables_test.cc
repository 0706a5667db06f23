#include "core/tighten/set_variables.h"

#include <gtest/gtest.h>

#include <set>

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

TEST(SetVariablesTest, TheImageOfASolidJoinsTheImagesOfItsEnds) {
  TubeBody body = MakeTubeBody(3, 0.0);
  const int count = static_cast<int>(body.set.spheres.size());
  for (const double x : {0.3, -0.3}) {  // two balls of their own
    body.set.spheres.push_back({{x, 1.6, 0}, 0.1});
    body.set.origins.push_back({body::Part::kHead, -1, x > 0.0 ? count + 1 : count});
  }
  const SetVariables variables(body.set);
  ASSERT_TRUE(variables.is_symmetric());
  ASSERT_EQ(variables.solids().size(), capsule::Solids(body.set).size());
  for (std::size_t k = 0; k < variables.solids().size(); ++k) {
    std::set<std::size_t> images;
    for (const int end : variables.solids()[k]) {
      images.insert(variables.image_of_sphere(static_cast<std::size_t>(end)));
    }
    const capsule::CapsuleEnds& ends = variables.solids()[variables.image_of_solid(k)];
    EXPECT_EQ(images, (std::set<std::size_t>(ends.begin(), ends.end())));
  }
}

}  // namespace
}  // namespace capfit::tighten
