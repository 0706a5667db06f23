#include "core/export/collider_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/base/status.h"

namespace capfit::exports {
namespace {

using Vec3 = Eigen::Vector3d;

// Two spheres with a capsule, one without, on one joint.
ColliderSet Small() {
  ColliderSet set;
  set.primitives.spheres = {{Vec3(0, 1, 0), 0.1}, {Vec3(0, 2, 0), 0.2}, {Vec3(1, 0, 0), 0.3}};
  set.primitives.origins.resize(3);
  set.primitives.capsules = {{0, 1}};
  set.sphere_names = {"waist_1", "chest_1", "left_hand_1"};
  set.joints.resize(1);
  set.sphere_joints = {0, 0, 0};
  set.capsule_joints = {0};
  return set;
}

void ExpectRefused(const ColliderSet& set, const std::string& field) {
  const absl::Status status = CheckColliderSet(set);
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << field;
  EXPECT_EQ(FieldOf(status).value_or(""), field) << status;
}

TEST(ColliderSet, ASoundOnePasses) {
  EXPECT_TRUE(CheckColliderSet(Small()).ok());
  EXPECT_TRUE(CheckColliderSet({}).ok());
}

TEST(ColliderSet, NamesWhatIsWrong) {
  const auto with = [](auto change) {
    ColliderSet set = Small();
    change(set);
    return set;
  };
  ExpectRefused(with([](ColliderSet& s) { s.sphere_names.pop_back(); }), "sphere_names");
  ExpectRefused(with([](ColliderSet& s) { s.primitives.origins.pop_back(); }), "origins");
  ExpectRefused(with([](ColliderSet& s) { s.primitives.spheres[1].radius_m = 0; }),
                "spheres[1].radius");
  ExpectRefused(with([](ColliderSet& s) {
                  s.primitives.spheres[1].center_m.y() = std::numeric_limits<double>::quiet_NaN();
                }),
                "spheres[1]");
  ExpectRefused(with([](ColliderSet& s) { s.primitives.capsules[0] = {0, 3}; }), "capsules[0][1]");
  ExpectRefused(with([](ColliderSet& s) { s.primitives.capsules[0] = {1, 1}; }), "capsules[0][0]");
  ExpectRefused(with([](ColliderSet& s) { s.sphere_joints[2] = 1; }), "sphere_joints[2]");
  ExpectRefused(with([](ColliderSet& s) { s.sphere_joints.pop_back(); }), "sphere_joints");
  ExpectRefused(with([](ColliderSet& s) { s.capsule_joints.clear(); }), "capsule_joints");
  ExpectRefused(with([](ColliderSet& s) { s.joints[0].parent = 1; }), "joints[0].parent");
}

TEST(ColliderSet, TellsCapsulesAndLoneSpheres) {
  EXPECT_THAT(CapsuleNames(Small()), testing::ElementsAre("waist_1__chest_1"));
  EXPECT_THAT(LoneSpheres(Small()), testing::ElementsAre(2));
}

}  // namespace
}  // namespace capfit::exports
