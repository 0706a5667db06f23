// What carries the spheres, on real bodies: a walk, and avatars posed by their own skeletons.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string>

#include "core/base/random.h"
#include "core/formats/read_mesh.h"
#include "core/mannequin/mannequin.h"
#include "core/pipeline/fit.h"
#include "tests/support/avatars.h"
#include "tests/support/bodies.h"

namespace capfit::pipeline {
namespace {

using Eigen::Vector3d;
using formats::Placing;
using formats::PolygonSoup;

FitResult FitWith(const PolygonSoup& soup, SkinningMode skinning, int spheres, Quality quality) {
  FitOptions options;
  options.skinning = skinning;
  options.max_spheres = spheres;
  options.quality = quality;
  options.parts = {true, true, true, true, true, true};
  NullObserver observer;
  auto result = Fit(soup, options, ThreadPool(2), observer);
  EXPECT_TRUE(result.ok()) << result.status();
  return *std::move(result);
}

PolygonSoup ReadFile(const std::filesystem::path& path) {
  const std::string bytes = test_support::ReadFile(path);
  auto soup = formats::ReadMesh(std::as_bytes(std::span(bytes)),
                                formats::FormatFromFileName(path.string()));
  EXPECT_TRUE(soup.ok()) << path << " " << soup.status();
  return *std::move(soup);
}

std::vector<Vector3d> CentersOf(const FitResult& result) {
  std::vector<Vector3d> centers;
  for (const geometry::Sphere& sphere : result.primitives.spheres) {
    centers.push_back(sphere.center_m);
  }
  return centers;
}

double Largest(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

class WalkTest : public testing::TestWithParam<Quality> {};

TEST_P(WalkTest, SparseCentresStayWithinTwoMillimetresOfDenseOnes) {
  CAPFIT_REQUIRE_BODIES();
  const std::filesystem::path folder = test_support::BodiesFolder() / "animation";
  const PolygonSoup soup = ReadFile(folder / "female_average_rest.obj");
  const std::string frames =
      test_support::ReadFile(folder / "female_average_walk_then_raise_arms.bin");
  const FitResult dense = FitWith(soup, SkinningMode::kDense, 64, GetParam());
  const FitResult sparse = FitWith(soup, SkinningMode::kSparse, 64, GetParam());
  ASSERT_TRUE(dense.weights && sparse.sparse_weights);
  ASSERT_EQ(CentersOf(dense), CentersOf(sparse));
  EXPECT_FALSE(sparse.weights.has_value());
  EXPECT_TRUE(sparse.sphere_joints.empty());
  EXPECT_LE(Largest(skinning::Apply(*sparse.sparse_weights, soup.positions), CentersOf(sparse)),
            1e-9);
  const std::size_t frame_bytes = soup.positions.size() * 12;
  ASSERT_EQ(frames.size(), 72 * frame_bytes);
  std::vector<float> numbers(3 * soup.positions.size());
  std::vector<Vector3d> vertices(soup.positions.size());
  double largest = 0.0;
  for (std::size_t frame = 0; frame < 72; ++frame) {
    std::memcpy(numbers.data(), frames.data() + frame * frame_bytes, frame_bytes);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      vertices[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
    }
    largest = std::max(largest, Largest(skinning::Apply(*dense.weights, vertices, ThreadPool(1)),
                                        skinning::Apply(*sparse.sparse_weights, vertices)));
  }
  EXPECT_LE(largest, 2e-3);
}
INSTANTIATE_TEST_SUITE_P(Qualities, WalkTest, testing::Values(Quality::kPaper, Quality::kTight),
                         [](const auto& of) {
                           return of.param == Quality::kPaper ? "Paper" : "Tight";
                         });

Eigen::Affine3d Full(const Placing& placing) {
  Eigen::Affine3d full = Eigen::Affine3d::Identity();
  full.matrix().topRows<3>() = placing;
  return full;
}

// Every joint turned by up to half a radian about itself, all that hangs below it with it.
std::vector<Placing> Posed(const std::vector<formats::NamedJoint>& joints, std::uint64_t seed) {
  Random random(seed);
  std::vector<Eigen::Affine3d> turns;
  for (const formats::NamedJoint& joint : joints) {
    const Vector3d axis(random.NextIn(-1, 1), random.NextIn(-1, 1), random.NextIn(-1, 1));
    Eigen::Affine3d turn = Eigen::Affine3d::Identity();
    turn.translate(joint.position)
        .rotate(Eigen::AngleAxisd(random.NextIn(-0.5, 0.5), axis.normalized()))
        .translate(-joint.position);
    turns.push_back(turn);
  }
  std::vector<Placing> posed;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    Eigen::Affine3d now = turns[j];
    for (std::int32_t above = joints[j].parent; above >= 0; above = joints[above].parent) {
      now = turns[above] * now;
    }
    posed.emplace_back((now * Full(joints[j].to_mesh)).matrix().topRows<3>());
  }
  return posed;
}

// The file's vertices by linear blend skinning. Those that no joint holds stay.
std::vector<Vector3d> Skinned(const PolygonSoup& soup, const std::vector<Placing>& joints) {
  std::vector<Eigen::Matrix4d> rest;
  std::vector<Eigen::Matrix4d> now;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Eigen::Affine3d from_bind = Full(soup.joints[j].bind).inverse();
    rest.push_back((Full(soup.joints[j].to_mesh) * from_bind).matrix());
    now.push_back((Full(joints[j]) * from_bind).matrix());
  }
  std::vector<Vector3d> moved;
  for (std::size_t v = 0; v < soup.positions.size(); ++v) {
    Eigen::Matrix4d at_rest = Eigen::Matrix4d::Zero();
    Eigen::Matrix4d at_now = Eigen::Matrix4d::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      const double weight = soup.influences[v].weight[k];
      at_rest += weight * rest[soup.influences[v].joint[k]];
      at_now += weight * now[soup.influences[v].joint[k]];
    }
    moved.push_back(
        at_rest(3, 3) < 0.5
            ? soup.positions[v]
            : Vector3d((at_now * at_rest.inverse() * soup.positions[v].homogeneous()).head<3>()));
  }
  return moved;
}

class RigTest : public testing::TestWithParam<std::string> {};

TEST_P(RigTest, BonesCarryTheCentresAsThePosedVerticesDo) {
  CAPFIT_REQUIRE_AVATARS();
  const PolygonSoup soup = ReadFile(test_support::AvatarsFolder() / (GetParam() + ".glb"));
  const FitResult bones = FitWith(soup, SkinningMode::kBones, 32, Quality::kPaper);
  const FitResult sparse = FitWith(soup, SkinningMode::kSparse, 32, Quality::kPaper);
  const FitResult dense = FitWith(soup, SkinningMode::kDense, 32, Quality::kPaper);
  ASSERT_TRUE(bones.bone_weights && sparse.sparse_weights && dense.weights);
  const double metre = 1.0 / bones.body_from_caller.scale;
  std::vector<Placing> rest;
  for (const formats::NamedJoint& joint : soup.joints) rest.push_back(joint.to_mesh);
  EXPECT_LE(Largest(skinning::Apply(*bones.bone_weights, rest), CentersOf(bones)), 1e-9 * metre);
  double to_sparse = 0.0;
  double to_dense = 0.0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const std::vector<Placing> joints = Posed(soup.joints, seed);
    const std::vector<Vector3d> vertices = Skinned(soup, joints);
    const std::vector<Vector3d> of_bones = skinning::Apply(*bones.bone_weights, joints);
    to_sparse = std::max(
        to_sparse, Largest(of_bones, skinning::Apply(*sparse.sparse_weights, vertices)) / metre);
    to_dense = std::max(
        to_dense,
        Largest(of_bones, skinning::Apply(*dense.weights, vertices, ThreadPool(1))) / metre);
  }
  RecordProperty("to_sparse_um", static_cast<int>(1e6 * to_sparse));
  RecordProperty("to_dense_um", static_cast<int>(1e6 * to_dense));
  std::printf("%s: bones to sparse %.3f mm, to dense %.2f mm\n", GetParam().c_str(),
              1e3 * to_sparse, 1e3 * to_dense);
  // What joints below a thousandth would have done; most for balls far out in a hand.
  EXPECT_LE(to_sparse, 2.5e-3);
}

TEST_P(RigTest, EachSphereAndCapsuleHangsOnOneJoint) {
  CAPFIT_REQUIRE_AVATARS();
  const PolygonSoup soup = ReadFile(test_support::AvatarsFolder() / (GetParam() + ".glb"));
  const FitResult result = FitWith(soup, SkinningMode::kNone, 32, Quality::kPaper);
  EXPECT_FALSE(result.weights || result.sparse_weights || result.bone_weights);
  ASSERT_EQ(result.joints.size(), soup.joints.size());
  ASSERT_EQ(result.sphere_joints.size(), result.primitives.spheres.size());
  ASSERT_EQ(result.sphere_joint_drift_m.size(), result.primitives.spheres.size());
  ASSERT_EQ(result.capsule_joints.size(), result.primitives.capsules.size());
  for (std::size_t i = 0; i < result.sphere_joints.size(); ++i) {
    EXPECT_GE(result.sphere_joints[i], 0);
    EXPECT_LT(result.sphere_joints[i], static_cast<std::int32_t>(soup.joints.size()));
    EXPECT_GE(result.sphere_joint_drift_m[i], 0.0);
    EXPECT_LE(result.sphere_joint_drift_m[i], 0.15);
  }
}
INSTANTIATE_TEST_SUITE_P(Avatars, RigTest,
                         testing::Values("dressed_deleted_man", "dressed_deleted_woman",
                                         "dressed_full_woman", "robot_like", "armour_man",
                                         "dressed_deleted_quantised"),
                         [](const auto& of) { return of.param; });

TEST(BonesTest, AreRefusedWithoutASkeleton) {
  const auto soup = mannequin::MakeMannequin({});
  ASSERT_TRUE(soup.ok());
  FitOptions options;
  options.skinning = SkinningMode::kBones;
  NullObserver observer;
  const absl::Status status = Fit(*soup, options, ThreadPool(1), observer).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(status.ToString(), testing::HasSubstr("no skeleton"));
}

}  // namespace
}  // namespace capfit::pipeline
