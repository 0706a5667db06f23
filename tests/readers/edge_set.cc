#include "tests/readers/edge_set.h"

#include <Eigen/Geometry>

namespace capfit::readers {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr char kHostileName[] = "a\"b'''*/-->]]>\\ <&>\n,\xc3\xa9{0}%s";

formats::NamedJoint Joint(const char* name, const Vec3& position, std::int32_t parent,
                          const Eigen::Matrix3d& turn, double scale) {
  formats::NamedJoint joint;
  joint.name = name;
  joint.position = position;
  joint.parent = parent;
  joint.to_mesh << scale * turn, position;
  return joint;
}

}  // namespace

exports::ColliderSet EdgeSet() {
  exports::ColliderSet set;
  set.primitives.spheres = {
      {Vec3(0, 0, 100), 12.0},  {Vec3(0, 0, 130), 15.0},  {Vec3(30, 0, 130), 5.0},
      {Vec3(-30, 0, 130), 5.0}, {Vec3(10, 0, 60), 7.0},   {Vec3(10, 0, 20), 7.0},
      {Vec3(-10, 0, 60), 9.0},  {Vec3(-10, 20, 60), 3.0}, {Vec3(-10, 22.5, 61), 0.5},
      {Vec3(-10, 0, 63), 4.0},  {Vec3(0, 0, 165), 11.0},  {Vec3(12, -3, 61), 0.75},
  };
  set.primitives.origins.resize(set.primitives.spheres.size());
  set.primitives.capsules = {{0, 1}, {1, 2}, {1, 3}, {4, 5}, {0, 4},
                             {6, 7}, {7, 8}, {6, 9}, {0, 6}, {4, 11}};
  set.sphere_names = {"waist_1",      "chest_1",     "left_arm_1",    "right_arm_1",
                      "left_thigh_1", "left_calf_1", "right_thigh_1", "right_calf_1",
                      "right_calf_2", "right_inner", "head_1",        kHostileName};
  // Z up in centimetres, facing -Y.
  set.body_from_mesh.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  set.body_from_mesh.scale = 0.01;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(2.0, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  set.joints = {
      Joint("hips", Vec3(0, 0, 95), -1, Eigen::Matrix3d::Identity(), 1.0),
      Joint(kHostileName, Vec3(10, 0, 90), 0, turn, 0.01),
      Joint("leg", Vec3(-10, 0, 90), 0, turn.transpose(), 1.0),
      Joint("leg", Vec3(10, 0, 50), 1, turn * turn, 1.0),
      Joint("spine", Vec3(0, 0, 120), 0, Eigen::Matrix3d::Identity(), 100.0),
  };
  set.sphere_joints = {0, 4, 4, 4, 1, 3, 2, 2, 2, 2, 4, 1};
  set.capsule_joints = {0, 4, 4, 3, 1, 2, 2, 2, 2, 1};
  set.source = kHostileName;
  set.version = "0.0.0-test";
  return set;
}

}  // namespace capfit::readers
