#include "core/formats/gltf_clips.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/status.h"
#include "tests/core/formats/gltf_maker.h"

namespace capfit::formats {
namespace {

using Vec3 = Eigen::Vector3d;

// Two nodes, the second below the first, and one animation that is filled by the test.
struct ClipMaker {
  GltfMaker maker;

  ClipMaker() {
    maker.gltf["nodes"] = json::parse(
        R"([{"mesh": 0}, {"name": "hip", "translation": [0, 1, 0], "children": [2]},
            {"name": "knee", "translation": [0, -0.5, 0]}])");
    maker.gltf["animations"] = json::parse(R"([{"name": "walk", "samplers": [], "channels": []}])");
  }

  json& animation() { return maker.gltf["animations"][0]; }

  void Add(std::size_t node, const std::string& path, const std::string& interpolation,
           const std::vector<float>& seconds, const std::vector<float>& values) {
    const std::string type = path == "rotation" ? "VEC4" : "VEC3";
    const std::size_t width = path == "rotation" ? 4 : 3;
    animation()["samplers"].push_back(
        {{"input", maker.AddAccessor(PackedBytes(seconds), 5126, seconds.size(), "SCALAR")},
         {"output", maker.AddAccessor(PackedBytes(values), 5126, values.size() / width, type)},
         {"interpolation", interpolation}});
    animation()["channels"].push_back({{"sampler", animation()["samplers"].size() - 1},
                                       {"target", {{"node", node}, {"path", path}}}});
  }

  [[nodiscard]] absl::StatusOr<GltfClips> Read() const {
    const std::string file = GlbOf(maker.gltf, maker.binary);
    return GltfClips::Read(std::as_bytes(std::span(file)));
  }
};

std::vector<NamedJoint> HipAndKnee() {
  std::vector<NamedJoint> joints(2);
  joints[0].node = 1;
  joints[1].node = 2;
  return joints;
}

// Where the knee is at that time.
Vec3 KneeAt(const ClipMaker& made, double seconds) {
  const auto clips = made.Read();
  EXPECT_TRUE(clips.ok()) << clips.status();
  return clips->JointsAt(0, seconds, HipAndKnee())[1].col(3);
}

TEST(GltfClips, TellsNamesAndLengths) {
  ClipMaker made;
  made.Add(1, "translation", "LINEAR", {0, 1.5F}, {0, 0, 0, 1, 0, 0});
  const auto clips = made.Read();
  ASSERT_TRUE(clips.ok()) << clips.status();
  ASSERT_EQ(clips->clips().size(), 1U);
  EXPECT_EQ(clips->clips()[0].name, "walk");
  EXPECT_DOUBLE_EQ(clips->clips()[0].seconds, 1.5);
  EXPECT_EQ(clips->Find("walk").value(), 0U);
  EXPECT_EQ(clips->Find("0").value(), 0U);
  EXPECT_EQ(FieldOf(clips->Find("run").status()), "clip");
  EXPECT_THAT(std::string(clips->Find("run").status().message()), testing::HasSubstr("walk"));
}

TEST(GltfClips, MovesBetweenKeysAndStandsStillBeyondThem) {
  ClipMaker made;
  made.Add(1, "translation", "LINEAR", {1, 3}, {0, 1, 0, 0, 2, 0});
  EXPECT_LT((KneeAt(made, 0) - Vec3(0, 0.5, 0)).norm(), 1e-6);
  EXPECT_LT((KneeAt(made, 2) - Vec3(0, 1.0, 0)).norm(), 1e-6);
  EXPECT_LT((KneeAt(made, 9) - Vec3(0, 1.5, 0)).norm(), 1e-6);
}

TEST(GltfClips, ChildrenTurnWithTheirParents) {
  const float half = std::sqrt(0.5F);
  ClipMaker made;  // a quarter turn of the hip about x, forward
  made.Add(1, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, -half, 0, 0, half});
  EXPECT_LT((KneeAt(made, 1) - Vec3(0, 1, 0.5)).norm(), 1e-6);
  // Half way the turn is half as far, whichever sign the quaternion has.
  const double s = std::sin(std::numbers::pi / 4) * 0.5;
  EXPECT_LT((KneeAt(made, 0.5) - Vec3(0, 1 - s, s)).norm(), 1e-6);
  ClipMaker other;
  other.Add(1, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, half, 0, 0, -half});
  EXPECT_LT((KneeAt(other, 0.5) - Vec3(0, 1 - s, s)).norm(), 1e-6);
}

TEST(GltfClips, StepsHoldUntilTheNextKey) {
  ClipMaker made;
  made.Add(2, "translation", "STEP", {0, 1}, {0, -1, 0, 0, -2, 0});
  EXPECT_LT((KneeAt(made, 0.99) - Vec3(0, 0, 0)).norm(), 1e-6);
  EXPECT_LT((KneeAt(made, 1.0) - Vec3(0, -1, 0)).norm(), 1e-6);
}

// A cubic that glTF's splines can hold exactly: y = t^3, whose tangents are 3 t^2.
TEST(GltfClips, SplinesAreCubic) {
  ClipMaker made;
  made.Add(1, "translation", "CUBICSPLINE", {0, 2},
           {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 12, 0, 0, 8, 0, 0, 12, 0});
  for (const double t : {0.0, 0.5, 1.0, 1.7, 2.0}) {
    EXPECT_NEAR(KneeAt(made, t).y(), t * t * t - 0.5, 1e-6) << t;
  }
}

TEST(GltfClips, ScalesWhatIsBelow) {
  ClipMaker made;
  made.Add(1, "scale", "LINEAR", {0, 1}, {1, 1, 1, 2, 2, 2});
  EXPECT_LT((KneeAt(made, 1) - Vec3(0, 0, 0)).norm(), 1e-6);
}

TEST(GltfClips, NodesThatStandStillStandWhereTheFileSays) {
  ClipMaker made;
  made.Add(2, "translation", "LINEAR", {0}, {0, -0.25F, 0});
  const auto clips = made.Read();
  ASSERT_TRUE(clips.ok());
  std::vector<NamedJoint> joints = HipAndKnee();
  joints.emplace_back().to_mesh.col(3) = Vec3(7, 8, 9);  // of no file's node
  const std::vector<Placing> placings = clips->JointsAt(0, 0.0, joints);
  EXPECT_LT((placings[0].col(3) - Vec3(0, 1, 0)).norm(), 1e-6);
  EXPECT_LT((placings[1].col(3) - Vec3(0, 0.75, 0)).norm(), 1e-6);
  EXPECT_EQ(Vec3(placings[2].col(3)), Vec3(7, 8, 9));
}

TEST(GltfClips, LeavesOutMorphsAndForeignTargets) {
  ClipMaker made;
  made.Add(1, "weights", "LINEAR", {0}, {1, 1, 1});
  made.Add(99, "translation", "LINEAR", {0}, {1, 1, 1});
  const auto clips = made.Read();
  ASSERT_TRUE(clips.ok()) << clips.status();
  EXPECT_TRUE(clips->clips()[0].channels.empty());
  EXPECT_DOUBLE_EQ(clips->clips()[0].seconds, 0.0);
}

TEST(GltfClips, NamesWhatIsWrong) {
  const auto told = [](auto change) {
    ClipMaker made;
    made.Add(1, "translation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0});
    change(made);
    return std::string(made.Read().status().message());
  };
  EXPECT_THAT(told([](ClipMaker& m) {
                m.Add(2, "translation", "LINEAR", {1, 0}, {0, 0, 0, 1, 0, 0});
              }),
              testing::HasSubstr("animation 0 channel 1"));
  EXPECT_THAT(told([](ClipMaker& m) {
                m.Add(2, "translation", "CUBICSPLINE", {0, 1}, {0, 0, 0, 1, 0, 0});
              }),
              testing::HasSubstr("3 for each key"));
  EXPECT_THAT(told([](ClipMaker& m) {
                m.Add(2, "scale", "LINEAR", {0}, {std::numeric_limits<float>::infinity(), 1, 1});
              }),
              testing::HasSubstr("finite"));
  EXPECT_THAT(told([](ClipMaker& m) { m.animation()["channels"][0]["sampler"] = 5; }),
              testing::HasSubstr("sampler"));
  EXPECT_THAT(told([](ClipMaker& m) { m.animation()["samplers"][0]["interpolation"] = "ODD"; }),
              testing::HasSubstr("CUBICSPLINE"));
  EXPECT_THAT(told([](ClipMaker& m) { m.animation()["samplers"][0]["output"] = 77; }),
              testing::HasSubstr("output"));
}

TEST(GltfClips, FilesWithoutAnimationsHaveNone) {
  const auto clips = [] {
    const std::string file = GlbOf(TetrahedronGltf(), kTetrahedronBytes);
    return GltfClips::Read(std::as_bytes(std::span(file)));
  }();
  ASSERT_TRUE(clips.ok()) << clips.status();
  EXPECT_TRUE(clips->clips().empty());
}

}  // namespace
}  // namespace capfit::formats
