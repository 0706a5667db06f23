#include "core/formats/gltf_clips.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/core/formats/gltf_maker.h"

namespace capfit::formats {
namespace {

using testing::HasSubstr;

// The tetrahedron on a chain of two joints, a metre apart, and what is animated.
class Animated {
 public:
  Animated() {
    gltf_["nodes"] = json::parse(R"([{"mesh": 0, "skin": 0}, {"name": "root", "children": [2]},
        {"name": "tip", "translation": [0, 1, 0]}])");
    gltf_["scenes"][0]["nodes"] = {0, 1};
    gltf_["skins"] = json::parse(R"([{"joints": [2, 1]}])");
    gltf_["animations"] = json::array({{{"name", "wave"}}});
  }

  // A channel of the first animation.
  Animated& Channel(std::size_t node, const std::string& path, const std::string& interpolation,
                    const std::vector<float>& times, const std::vector<float>& values) {
    json& animation = gltf_["animations"][0];
    const std::size_t sampler = animation["samplers"].size();
    const bool is_rotation = path == "rotation";
    const std::size_t input = Accessor(times, "SCALAR", times.size());
    const std::size_t output =
        Accessor(values, is_rotation ? "VEC4" : "VEC3", values.size() / (is_rotation ? 4 : 3));
    animation["samplers"].push_back(
        {{"input", input}, {"output", output}, {"interpolation", interpolation}});
    animation["channels"].push_back(
        {{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
    return *this;
  }

  [[nodiscard]] json& gltf() { return gltf_; }
  [[nodiscard]] std::string Bytes() const { return GlbOf(gltf_, binary_); }
  [[nodiscard]] absl::StatusOr<GltfClips> Read() const {
    const std::string bytes = Bytes();
    return GltfClips::Read(std::as_bytes(std::span(bytes)));
  }
  [[nodiscard]] std::string Error() const { return Read().status().ToString(); }

 private:
  std::size_t Accessor(const std::vector<float>& numbers, const std::string& type,
                       std::size_t count) {
    gltf_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", 4 * numbers.size()}});
    binary_ += PackedBytes(numbers);
    gltf_["buffers"][0]["byteLength"] = binary_.size();
    gltf_["accessors"].push_back({{"bufferView", gltf_["bufferViews"].size() - 1},
                                  {"componentType", 5126},
                                  {"count", count},
                                  {"type", type}});
    return gltf_["accessors"].size() - 1;
  }

  json gltf_ = TetrahedronGltf();
  std::string binary_ = kTetrahedronBytes;
};

Eigen::Vector3d TipAt(const GltfClips& clips, double time_s) {
  return clips.JointsAt(0, time_s)[0].col(3);
}

TEST(GltfClipsTest, WithoutAChannelAllStandsAsInTheFile) {
  Animated file;
  const auto clips = file.Read();
  ASSERT_TRUE(clips.ok()) << clips.status();
  ASSERT_EQ(clips->clips().size(), 1u);
  EXPECT_EQ(clips->clips()[0].name, "wave");
  EXPECT_EQ(clips->clips()[0].length_s, 0.0);
  const std::string bytes = file.Bytes();
  const auto soup = ReadGlb(std::as_bytes(std::span(bytes)), {});
  ASSERT_TRUE(soup.ok()) << soup.status();
  const std::vector<Placing> joints = clips->JointsAt(0, 0.5);
  ASSERT_EQ(joints.size(), soup->joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) EXPECT_EQ(joints[j], soup->joints[j].to_mesh);
}

TEST(GltfClipsTest, LinearTranslationIsStraightAndStandsStillOutside) {
  const auto clips =
      Animated().Channel(1, "translation", "LINEAR", {1, 3}, {0, 0, 0, 4, 2, 0}).Read();
  ASSERT_TRUE(clips.ok()) << clips.status();
  EXPECT_EQ(clips->clips()[0].length_s, 3.0);
  EXPECT_EQ(TipAt(*clips, 0.0), Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(TipAt(*clips, 1.5), Eigen::Vector3d(1, 1.5, 0));
  EXPECT_EQ(TipAt(*clips, 3.0), Eigen::Vector3d(4, 3, 0));
  EXPECT_EQ(TipAt(*clips, 9.0), Eigen::Vector3d(4, 3, 0));
}

TEST(GltfClipsTest, StepKeepsTheValueUntilTheNextKey) {
  const auto clips =
      Animated().Channel(1, "translation", "STEP", {0, 1, 2}, {1, 0, 0, 2, 0, 0, 3, 0, 0}).Read();
  ASSERT_TRUE(clips.ok()) << clips.status();
  EXPECT_EQ(TipAt(*clips, 0.99).x(), 1.0);
  EXPECT_EQ(TipAt(*clips, 1.0).x(), 2.0);
  EXPECT_EQ(TipAt(*clips, 1.99).x(), 2.0);
}

// Hermite's spline with these tangents is t^3 itself.
TEST(GltfClipsTest, CubicSplineFollowsItsTangents) {
  const auto clips = Animated()
                         .Channel(1, "translation", "CUBICSPLINE", {0, 2},
                                  {9, 9, 9, 0, 0, 0, 0, 0, 0, 12, 0, 0, 8, 0, 0, 9, 9, 9})
                         .Read();
  ASSERT_TRUE(clips.ok()) << clips.status();
  for (const double t : {0.0, 0.3, 1.0, 1.7, 2.0}) {
    EXPECT_NEAR(TipAt(*clips, t).x(), t * t * t, 1e-12) << t;
  }
}

TEST(GltfClipsTest, RotationsTurnWhatHangsBelowAlongTheShorterArc) {
  // From none to minus a quarter turn about z, written as its negative: the same turn.
  const auto half = static_cast<float>(std::numbers::sqrt2 / 2);
  const auto clips =
      Animated().Channel(1, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, 0, half, -half}).Read();
  ASSERT_TRUE(clips.ok()) << clips.status();
  for (const double t : {0.0, 0.25, 0.5, 1.0}) {
    const double angle = t * std::numbers::pi / 2;
    EXPECT_LE((TipAt(*clips, t) - Eigen::Vector3d(std::sin(angle), std::cos(angle), 0)).norm(),
              1e-7)
        << t;
  }
}

TEST(GltfClipsTest, ScalesAndSeveralChannelsOfANodeWorkTogether) {
  const auto clips = Animated()
                         .Channel(1, "scale", "LINEAR", {0, 1}, {1, 1, 1, 1, 3, 1})
                         .Channel(1, "translation", "STEP", {0}, {5, 0, 0})
                         .Read();
  ASSERT_TRUE(clips.ok()) << clips.status();
  EXPECT_EQ(TipAt(*clips, 0.5), Eigen::Vector3d(5, 2, 0));
}

TEST(GltfClipsTest, LeavesOutWhatMovesNoNode) {
  Animated file;
  file.Channel(1, "translation", "STEP", {0}, {5, 0, 0});
  json& channels = file.gltf()["animations"][0]["channels"];
  channels.push_back({{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}});
  channels.push_back({{"sampler", 0}, {"target", {{"path", "pointer"}}}});
  const auto clips = file.Read();
  ASSERT_TRUE(clips.ok()) << clips.status();
  EXPECT_EQ(TipAt(*clips, 0.0), Eigen::Vector3d(5, 1, 0));
}

TEST(GltfClipsTest, NamesWhatIsWrong) {
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(Animated().Channel(7, "scale", "LINEAR", {0}, {1, 1, 1}).Error(),
              HasSubstr("animation 0 channel row 0"));
  EXPECT_THAT(Animated().Channel(1, "scale", "LINEAR", {1, 0}, {1, 1, 1, 1, 1, 1}).Error(),
              HasSubstr("its key 1 is at 0 s, must not be before 1 s"));
  EXPECT_THAT(Animated().Channel(1, "scale", "LINEAR", {nan}, {1, 1, 1}).Error(),
              HasSubstr("its key 0"));
  EXPECT_THAT(Animated().Channel(1, "scale", "LINEAR", {0, 1}, {1, 1, 1}).Error(),
              HasSubstr("has 1 values for 2 keys, must have 2"));
  EXPECT_THAT(Animated().Channel(1, "scale", "CUBICSPLINE", {0}, {1, 1, 1}).Error(),
              HasSubstr("must have 3"));
  EXPECT_THAT(Animated().Channel(1, "scale", "LINEAR", {0}, {1, nan, 1}).Error(),
              HasSubstr("its value 0 must be finite"));
  EXPECT_THAT(Animated().Channel(1, "scale", "WAVY", {0}, {1, 1, 1}).Error(),
              HasSubstr("none of STEP, LINEAR, CUBICSPLINE"));
  Animated empty;
  empty.Channel(1, "scale", "LINEAR", {}, {});
  EXPECT_THAT(empty.Error(), HasSubstr("has no keys"));
  Animated missing;
  missing.Channel(1, "scale", "LINEAR", {0}, {1, 1, 1});
  missing.gltf()["animations"][0]["channels"][0]["sampler"] = 3;
  EXPECT_THAT(missing.Error(), HasSubstr("sampler"));
}

TEST(GltfClipsTest, RefusesAFewBytesThatAskForMuch) {
  Animated file;
  file.Channel(1, "scale", "STEP", {0}, {1, 1, 1});
  json& animation = file.gltf()["animations"][0];
  json& accessors = file.gltf()["accessors"];
  for (const char* const which : {"input", "output"}) {
    json& accessor = accessors[animation["samplers"][0][which].get<std::size_t>()];
    accessor.erase("bufferView");  // zeros, as many as one likes
    accessor["count"] = 3'000'000;
  }
  EXPECT_THAT(file.Error(), HasSubstr("must have at most"));
}

}  // namespace
}  // namespace capfit::formats
