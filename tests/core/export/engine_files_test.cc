// What every writer of an engine's file promises, and what is its own; that engines read the same
// from them as the result has is tested in tests/readers/engines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/export/mujoco.h"
#include "core/export/nvcloth.h"
#include "core/export/physics_json.h"
#include "core/export/table.h"
#include "core/export/unity.h"
#include "core/export/unreal.h"
#include "core/export/urdf.h"

namespace capfit::exports {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Vec3 = Eigen::Vector3d;

// A tapered capsule, one with a sphere inside the other, and a lone sphere; metres, Y up.
ColliderSet Small() {
  ColliderSet set;
  set.primitives.spheres = {{Vec3(0, 1, 0), 0.1},
                            {Vec3(0, 1.5, 0), 0.2},
                            {Vec3(0.5, 0, 0.25), 0.3},
                            {Vec3(0, 1.52, 0), 0.05}};
  set.primitives.origins.resize(4);
  set.primitives.capsules = {{0, 1}, {1, 3}};
  set.sphere_names = {"waist_1", "chest_1", "left_hand_1", "chest_2"};
  set.version = "9.8.7";
  set.source = "body";
  return set;
}

ColliderSet Rigged() {
  ColliderSet set = Small();
  set.joints.resize(1);
  set.joints[0].name = "hips";
  set.sphere_joints = {0, 0, 0, 0};
  set.capsule_joints = {0, 0};
  return set;
}

// Spheres in a chain.
ColliderSet Chain(int count) {
  ColliderSet set;
  for (int i = 0; i < count; ++i) {
    set.primitives.spheres.push_back({Vec3(0, 0.1 * i, 0), 0.1});
    set.sphere_names.push_back(absl::StrCat("s", i));
    if (i > 0) set.primitives.capsules.push_back({i - 1, i});
  }
  set.primitives.origins.resize(static_cast<std::size_t>(count));
  return set;
}

struct Writer {
  std::string name;
  std::function<Exported(const ColliderSet&)> write;
  std::string frame;
  friend void PrintTo(const Writer& w, std::ostream* os) { *os << w.name; }
};

std::vector<std::string> CodesOf(const Exported& exported) {
  std::vector<std::string> codes;
  for (const Warning& warning : exported.warnings) codes.push_back(warning.code);
  return codes;
}

class EveryWriter : public testing::TestWithParam<Writer> {};

TEST_P(EveryWriter, SaysFrameProfileAndVersionInEachFile) {
  for (const ExportFile& file : GetParam().write(Rigged()).files) {
    EXPECT_THAT(file.bytes, HasSubstr("9.8.7")) << file.name;
    EXPECT_THAT(file.bytes, HasSubstr(GetParam().frame)) << file.name;
    EXPECT_THAT(file.bytes, HasSubstr("tangent_hull")) << file.name;
  }
}

TEST_P(EveryWriter, WritesTheSameBytesAgain) {
  const Exported first = GetParam().write(Rigged());
  const Exported second = GetParam().write(Rigged());
  ASSERT_EQ(first.files.size(), second.files.size());
  for (std::size_t i = 0; i < first.files.size(); ++i) {
    EXPECT_EQ(first.files[i].name, second.files[i].name);
    EXPECT_EQ(first.files[i].bytes, second.files[i].bytes);
  }
}

TEST_P(EveryWriter, TakesAnEmptySetAndOneWithoutARig) {
  EXPECT_FALSE(GetParam().write({}).files.empty());
  EXPECT_FALSE(GetParam().write(Small()).files.empty());
}

TEST_P(EveryWriter, TakesWhateverNamesThereAre) {
  ColliderSet set = Rigged();
  set.joints[0].name = "\xff'''*/\"<>&\n";
  set.source = "\xc3\x28-->]]>";
  set.sphere_names[2] = "\x01\\\"";
  for (const ExportFile& file : GetParam().write(set).files) {
    if (!file.name.ends_with(".json")) continue;
    EXPECT_FALSE(nlohmann::json::parse(file.bytes, nullptr, false).is_discarded()) << file.name;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Engines, EveryWriter,
    testing::Values(Writer{"Jolt", WriteJolt, "metres, +Y up, +Z ahead, right-handed"},
                    Writer{"Bullet", WriteBullet, "metres, +Y up, +Z ahead, right-handed"},
                    Writer{"Rapier", WriteRapier, "metres, +Y up, +Z ahead, right-handed"},
                    Writer{"NvCloth", WriteNvCloth, "metres, +Y up, +Z ahead, right-handed"},
                    Writer{"Tables", WriteTables, "metres, +Y up, +Z ahead, right-handed"},
                    Writer{"Unity", WriteUnity, "metres, +Y up, +Z ahead, left-handed"},
                    Writer{"Unreal", WriteUnreal, "centimetres, +Z up, +Y ahead, left-handed"},
                    Writer{"Mujoco", [](const ColliderSet& s) { return WriteMujoco(s).value(); },
                           "metres, +Z up, +X ahead, right-handed"},
                    Writer{"Urdf", [](const ColliderSet& s) { return WriteUrdf(s).value(); },
                           "metres, +Z up, +X ahead, right-handed"}),
    [](const auto& writer) { return writer.param.name; });

TEST(Jolt, HasTheArgumentsOfItsConstructors) {
  const Exported exported = WriteJolt(Small());
  const auto shapes = nlohmann::json::parse(exported.files[0].bytes).at("shapes");
  ASSERT_EQ(shapes.size(), 3U);
  EXPECT_EQ(shapes[0].at("shape"), "TaperedCapsule");
  EXPECT_EQ(shapes[0].at("half_height"), 0.25);
  EXPECT_EQ(shapes[0].at("top_radius"), 0.2);
  EXPECT_EQ(shapes[0].at("bottom_radius"), 0.1);
  EXPECT_EQ(shapes[0].at("position"), (nlohmann::json{0.0, 1.25, 0.0}));
  EXPECT_EQ(shapes[0].at("rotation"), (nlohmann::json{0.0, 0.0, 0.0, 1.0}));
  EXPECT_EQ(shapes[0].at("spheres"), (nlohmann::json{"waist_1", "chest_1"}));
  EXPECT_EQ(shapes[1].at("shape"), "Sphere");  // the larger of the two
  EXPECT_EQ(shapes[1].at("radius"), 0.2);
  EXPECT_EQ(shapes[2].at("name"), "left_hand_1");
  EXPECT_THAT(CodesOf(exported), ElementsAre("INNER_SPHERES"));
}

TEST(Rapier, WarnsOfHulls) {
  EXPECT_THAT(CodesOf(WriteRapier(Small())), ElementsAre("CAPSULES_REPLACED", "INNER_SPHERES"));
  EXPECT_THAT(CodesOf(WriteRapier(Chain(3))), IsEmpty());  // capsules of one radius
}

TEST(NvCloth, WarnsBeyond32) {
  EXPECT_THAT(CodesOf(WriteNvCloth(Chain(32))), IsEmpty());
  EXPECT_THAT(CodesOf(WriteNvCloth(Chain(33))), ElementsAre("COLLIDER_LIMIT"));
  EXPECT_THAT(CodesOf(WriteNvCloth(Chain(34))), ElementsAre("COLLIDER_LIMIT", "COLLIDER_LIMIT"));
  EXPECT_THAT(CodesOf(WriteNvCloth(Rigged())), ElementsAre("INNER_SPHERES"));
}

TEST(Unity, WarnsBeyond32) {
  EXPECT_THAT(CodesOf(WriteUnity(Chain(32))), IsEmpty());
  EXPECT_THAT(CodesOf(WriteUnity(Chain(33))), ElementsAre("COLLIDER_LIMIT"));
}

TEST(Unreal, WarnsWithoutARig) {
  EXPECT_THAT(CodesOf(WriteUnreal(Small())), ElementsAre("INNER_SPHERES", "NO_RIG"));
  EXPECT_THAT(CodesOf(WriteUnreal(Rigged())), ElementsAre("INNER_SPHERES"));
}

TEST(Mujoco, IsFinerWhereAskedTo) {
  const auto count = [](double overshoot_m) {
    const Exported exported = WriteMujoco(Small(), {.max_overshoot_m = overshoot_m}).value();
    return nlohmann::json(exported.warnings[0].message).dump();
  };
  EXPECT_THAT(count(0.1), HasSubstr("1 became 1 capsules"));
  EXPECT_THAT(count(0.01), HasSubstr("1 became 10 capsules"));
  EXPECT_FALSE(WriteMujoco(Small(), {.max_overshoot_m = 0.0}).ok());
  EXPECT_FALSE(WriteUrdf(Small(), {.max_overshoot_m = -1.0}).ok());
}

TEST(Urdf, WritesASphereOnceForEachLink) {
  const std::string text = WriteUrdf(Rigged())->files[0].bytes;
  const auto count = [&](const std::string& word) {
    std::size_t found = 0;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("<sphere "), 4U);
  EXPECT_EQ(count("<collision name=\"chest_1\">"), 1U);
  EXPECT_EQ(count("<link name="), 2U);
  EXPECT_EQ(count("type=\"floating\""), 1U);
}

TEST(Tables, HaveALineForEach) {
  const Exported exported = WriteTables(Small());
  ASSERT_EQ(exported.files.size(), 2U);
  EXPECT_THAT(exported.files[0].bytes,
              HasSubstr("\n2,left_hand_1,torso,,0.5,0,0.25,0.3,1,0.5,0,0.25\n"));
  EXPECT_THAT(exported.files[1].bytes,
              HasSubstr("\n0,waist_1__chest_1,torso,,0,1,0.5,0.1,0.2,0\n"));
}

}  // namespace
}  // namespace capfit::exports
