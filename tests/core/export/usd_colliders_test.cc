#include "core/export/usd_colliders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/status.h"
#include "tests/core/export/rigged_sample.h"

namespace capfit::exports {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string Written(const ColliderSet& set, UsdOptions options = {}) {
  const auto exported = WriteUsd(set, options);
  EXPECT_TRUE(exported.ok()) << exported.status();
  return exported.ok() ? exported->files[0].bytes : "";
}

std::size_t CountOf(const std::string& word, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++count;
  }
  return count;
}

TEST(UsdColliders, HaveOnePrimForEachSolidBelowItsJoint) {
  ColliderSet set = SetOn(GlbOf(RiggedGltf()), {1, 2});
  set.joints[1].name = "joint_0";  // two of one name
  const std::string usd = Written(set);
  EXPECT_EQ(CountOf("def Capsule_1 ", usd), 2);
  EXPECT_EQ(CountOf("def Sphere ", usd), 2);
  EXPECT_EQ(CountOf("PhysicsCollisionAPI", usd), 4);
  EXPECT_THAT(usd, HasSubstr("def Xform \"joint_0_2\""));
  EXPECT_EQ(CountOf("{", usd), CountOf("}", usd));
  EXPECT_EQ(CountOf("(", usd), CountOf(")", usd));
}

TEST(UsdColliders, NamesCannotBreakOutOfTheText) {
  ColliderSet set = SetOn(GlbOf(RiggedGltf()), {1});
  set.joints[0].name = "a\"\n}\ndef Xform \"b";
  set.sphere_names[2] = "lone\" { }";
  set.source = "\\\"";
  const std::string usd = Written(set);
  EXPECT_THAT(usd, HasSubstr("def Sphere \"lone_____\" ("));
  EXPECT_THAT(usd, HasSubstr("string source = \"\\\\\\\"\""));
  EXPECT_THAT(usd, Not(HasSubstr("\n}\ndef Xform \"b")));
}

TEST(UsdColliders, WithoutTaperedOnesCapsulesBecomePieces) {
  const ColliderSet set = SetOn(GlbOf(RiggedGltf()), {1});
  const auto exported = WriteUsd(set, {.is_tapered = false, .max_overshoot_m = 0.01});
  ASSERT_TRUE(exported.ok());
  const std::string& usd = exported->files[0].bytes;
  EXPECT_THAT(usd, Not(HasSubstr("Capsule_1")));
  EXPECT_EQ(CountOf("def Capsule ", usd), 5);  // radii 0.1 and 0.15 at steps of 0.01
  EXPECT_THAT(usd, HasSubstr("\"a0__b0_5\""));
  EXPECT_EQ(exported->warnings[0].code, "CAPSULES_REPLACED");
}

TEST(UsdColliders, WithoutARigHangOnOneBody) {
  ColliderSet set = SetOn(GlbOf(RiggedGltf()), {1});
  set.joints.clear();
  set.sphere_joints.clear();
  set.capsule_joints.clear();
  EXPECT_THAT(Written(set), HasSubstr("def Xform \"body\""));
}

TEST(UsdColliders, RefuseOptionsOutOfRange) {
  const ColliderSet set = SetOn(GlbOf(RiggedGltf()), {1});
  EXPECT_EQ(FieldOf(WriteUsd(set, {.max_overshoot_m = 1.0}).status()), "max_overshoot_m");
}

}  // namespace
}  // namespace capfit::exports
