// Sets that move with their bodies, by the command line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/e2e/command_line.h"
#include "tests/support/avatars.h"

namespace capfit::e2e {
namespace {

using nlohmann::ordered_json;
using testing::HasSubstr;

// The vertices of an OBJ file at rest, and moved by (1, 2, 3).
std::string TwoFrames(const std::string& text) {
  std::string frames;
  for (const float shift : {0.0F, 1.0F}) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("v ", 0) != 0) continue;
      std::istringstream numbers(line.substr(2));
      for (const float axis : {1.0F, 2.0F, 3.0F}) {
        double value = 0.0;
        numbers >> value;
        const float moved = static_cast<float>(value) + shift * axis;
        frames.append(reinterpret_cast<const char*>(&moved), sizeof(moved));
      }
    }
  }
  return frames;
}

TEST_F(CommandLine, AnimateMovesTheCentresWithTheBody) {
  const ordered_json result = Approximate({"--local", "--skinning", "dense"});
  WriteText(Path("frames.bin"), TwoFrames(ReadText(Body())));
  const Outcome outcome = RunCapfit({"animate", Body(), Path("result.json"), "--frames",
                                     Path("frames.bin"), "-o", Path("centers.json")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto centers = ordered_json::parse(ReadText(Path("centers.json")))["frames"];
  ASSERT_EQ(centers.size(), 2U);
  for (std::size_t i = 0; i < result["spheres"].size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double rest = result["spheres"][i][axis].get<double>();
      EXPECT_NEAR(centers[0][i][axis].get<double>(), rest, 2e-6);
      EXPECT_NEAR(centers[1][i][axis].get<double>(), rest + static_cast<double>(axis + 1), 2e-6);
    }
  }
  // The same in the other form, through the standard streams; both are what render reads.
  const Outcome binary = RunCapfit(
      {"animate", Body(), Path("result.json"), "--frames", "-", "-o", "-"}, Path("frames.bin"));
  ASSERT_EQ(binary.exit_code, 0) << binary.err;
  EXPECT_EQ(binary.out.size(), 2 * 12 * result["spheres"].size());
  EXPECT_THAT(binary.err, HasSubstr("2 frames of"));
  WriteText(Path("centers.f32"), binary.out);
  std::vector<std::string> pictures;
  for (const char* const name : {"centers.json", "centers.f32"}) {
    const Outcome drawn = RunCapfit({"render", Body(), Path("result.json"), "--frames",
                                     Path("frames.bin"), "--centers", Path(name), "--show", "0",
                                     "1", "-o", "-", "--width", "400", "--height", "300"});
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    pictures.push_back(drawn.out);
  }
  EXPECT_THAT(pictures[0], testing::StartsWith("\x89PNG"));
  EXPECT_EQ(pictures[0], pictures[1]);
}

TEST_F(CommandLine, ASetThatCoversAMotionNeedsWhatCarriesIt) {
  WriteText(Path("frames.bin"), TwoFrames(ReadText(Body())));
  const std::string advice = "--skinning sparse or bones does";
  static_cast<void>(Approximate({"--local", "--cover-motion", Path("frames.bin")}));
  EXPECT_THAT(last_out_, HasSubstr("2 frames enclosed"));
  EXPECT_THAT(last_out_, HasSubstr(advice));
  static_cast<void>(
      Approximate({"--local", "--cover-motion", Path("frames.bin"), "--skinning", "sparse"}));
  EXPECT_THAT(last_out_, HasSubstr("2 frames enclosed"));
  EXPECT_THAT(last_out_, testing::Not(HasSubstr(advice)));
}

// All joints one step to the side: spheres and capsules go with them, and at rest stand as fitted.
TEST_F(CommandLine, AnimateHangsEachSphereAndCapsuleOnOneJoint) {
  CAPFIT_REQUIRE_AVATARS();
  const std::string body = (test_support::AvatarsFolder() / "skirt_woman.glb").string();
  ASSERT_EQ(RunCapfit({"approximate", body, "-o", Path("result.json"), "--local"}).exit_code, 0);
  const ordered_json result = ordered_json::parse(ReadText(Path("result.json")));
  std::string frames;
  for (const float shift : {0.0F, 1.0F}) {
    for (const ordered_json& joint : result["joints"]) {
      for (std::size_t k = 0; k < 12; ++k) {
        const float number = joint["to_mesh"][k].get<float>() + (k == 3 ? shift : 0.0F);
        frames.append(reinterpret_cast<const char*>(&number), sizeof(number));
      }
    }
  }
  WriteText(Path("joints.bin"), frames);
  const Outcome outcome =
      RunCapfit({"animate", body, Path("result.json"), "--joints", Path("joints.bin"),
                 "--one-joint", "-o", Path("c.json"), "--capsule-ends", Path("e.json")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto centers = ordered_json::parse(ReadText(Path("c.json")))["frames"];
  const auto ends = ordered_json::parse(ReadText(Path("e.json")))["frames"];
  const auto same = [&](const ordered_json& point, std::size_t sphere, double shift) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double rest = result["spheres"][sphere][axis].get<double>();
      EXPECT_NEAR(point[axis].get<double>(), rest + (axis == 0 ? shift : 0.0), 3e-6);
    }
  };
  for (std::size_t f = 0; f < 2; ++f) {
    const auto shift = static_cast<double>(f);
    ASSERT_EQ(centers[f].size(), result["spheres"].size());
    ASSERT_EQ(ends[f].size(), 2 * result["capsules"].size());
    for (std::size_t i = 0; i < centers[f].size(); ++i) same(centers[f][i], i, shift);
    for (std::size_t k = 0; k < ends[f].size(); ++k) {
      same(ends[f][k], result["capsules"][k / 2][k % 2].get<std::size_t>(), shift);
    }
  }
  // Without a skeleton there is no joint to hang on.
  static_cast<void>(Approximate({"--local"}));
  const Outcome refused = RunCapfit({"animate", Body(), Path("result.json"), "--joints",
                                     Path("joints.bin"), "--one-joint", "-o", Path("c.json")});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("came with a skeleton"));
}

}  // namespace
}  // namespace capfit::e2e
