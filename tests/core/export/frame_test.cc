#include "core/export/frame.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace capfit::exports {
namespace {

using Vec3 = Eigen::Vector3d;

ColliderSet OneSphere(const geometry::Similarity& body_from_mesh) {
  ColliderSet set;
  set.primitives.spheres = {{Vec3(1, 2, 3), 0.5}};
  set.primitives.origins.resize(1);
  set.sphere_names = {"head_1"};
  set.body_from_mesh = body_from_mesh;
  return set;
}

TEST(Frame, SaysHandednessByItsDeterminant) {
  for (const Frame* frame : {&YUpFrame(), &ZUpFrame(), &UnityFrame(), &UnrealFrame()}) {
    const bool is_left = frame->name.find("left-handed") != std::string_view::npos;
    EXPECT_NEAR(frame->from_upright.determinant(), is_left ? -1.0 : 1.0, 1e-15) << frame->name;
  }
}

TEST(Frame, TheBodysUpIsTheEnginesUp) {
  EXPECT_EQ(YUpFrame().Point(Vec3::UnitY()), Vec3::UnitY());
  EXPECT_EQ(ZUpFrame().Point(Vec3::UnitY()), Vec3::UnitZ());
  EXPECT_EQ(ZUpFrame().Point(Vec3::UnitX()), Vec3::UnitY());  // the left
  EXPECT_EQ(UnityFrame().Point(Vec3::UnitY()), Vec3::UnitY());
  EXPECT_EQ(UnrealFrame().Point(Vec3::UnitY()), 100.0 * Vec3::UnitZ());
  EXPECT_EQ(UnrealFrame().Point(Vec3::UnitZ()), 100.0 * Vec3::UnitY());
}

TEST(Frame, StandsAMeshUpByWholeQuarterTurns) {
  geometry::Similarity body;  // Z up in centimetres, facing -Y, and leaning a little
  body.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  body.rotation = Eigen::AngleAxisd(0.2, Vec3::UnitX()).toRotationMatrix() * body.rotation;
  body.scale = 0.01;
  body.translation = {5, 6, 7};
  const ColliderSet upright = Upright(OneSphere(body));
  EXPECT_TRUE(upright.primitives.spheres[0].center_m.isApprox(Vec3(0.01, 0.03, -0.02), 1e-12));
  EXPECT_DOUBLE_EQ(upright.primitives.spheres[0].radius_m, 0.005);
  // The way to the body's frame is still the way there.
  EXPECT_TRUE(upright.body_from_mesh.Apply(upright.primitives.spheres[0].center_m)
                  .isApprox(body.Apply(Vec3(1, 2, 3)), 1e-12));
}

TEST(Frame, StandingUpTwiceIsStandingUpOnce) {
  geometry::Similarity body;
  body.rotation = Eigen::AngleAxisd(2.0, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  body.scale = 0.0254;
  const ColliderSet once = Upright(OneSphere(body));
  const ColliderSet twice = Upright(once);
  EXPECT_TRUE(twice.primitives.spheres[0].center_m.isApprox(once.primitives.spheres[0].center_m));
}

TEST(Frame, JointsStandWithTheMesh) {
  geometry::Similarity body;
  body.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  body.scale = 0.01;
  ColliderSet set = OneSphere(body);
  formats::NamedJoint& joint = set.joints.emplace_back();
  joint.to_mesh.col(3) = joint.position = Vec3(0, 0, 100);
  const ColliderSet upright = Upright(set);
  EXPECT_TRUE(upright.joints[0].position.isApprox(Vec3(0, 1, 0)));
  // A point of the joint's frame comes out where the mesh's frame had it, stood up.
  const Vec3 in_mesh = joint.to_mesh * Vec3(1, 2, 3).homogeneous();
  EXPECT_TRUE((upright.joints[0].to_mesh * Vec3(1, 2, 3).homogeneous())
                  .isApprox(UprightFromMesh(set).Apply(in_mesh)));
}

}  // namespace
}  // namespace capfit::exports
