#include "client/approximate_flags.h"

#include <gtest/gtest.h>

#include "core/base/status.h"

namespace capfit::client {
namespace {

// Parses as `capfit approximate` does; nothing where CLI11 refuses.
std::optional<FitFlags> Parse(const std::string& words) {
  CLI::App app;
  FitFlags flags;
  std::string body;
  app.add_option("BODY", body);
  AddFitFlags(app, flags);
  try {
    app.parse(words);
  } catch (const CLI::ParseError&) {
    return std::nullopt;
  }
  return flags;
}

TEST(ApproximateFlags, NoneGiveTheDefaults) {
  const auto flags = Parse("");
  ASSERT_TRUE(flags);
  const auto options = OptionsOf(*flags);
  ASSERT_TRUE(options.ok()) << options.status();
  EXPECT_TRUE(options->parts.torso && options->parts.arms && options->parts.legs);
  EXPECT_FALSE(options->parts.head || options->parts.hands || options->parts.feet);
  EXPECT_EQ(options->max_primitives, std::nullopt);
  EXPECT_EQ(options->skinning, pipeline::SkinningMode::kNone);
}

TEST(ApproximateFlags, AreTaken) {
  const auto flags = Parse(
      "--max-spheres 32 --max-capsules 31 --parts head,arms body.obj --fit Best-Fit --quality "
      "TIGHT "
      "--skinning dense --sex male --unit cm --up z --seed 18446744073709551615 "
      "--engine jolt --tolerance-mm 2.5 --require-parts head,legs --heat-map");
  ASSERT_TRUE(flags);
  const auto options = OptionsOf(*flags);
  ASSERT_TRUE(options.ok());
  EXPECT_EQ(options->max_spheres, 32);
  EXPECT_EQ(options->max_capsules, 31);
  EXPECT_TRUE(options->parts.head && options->parts.arms);
  EXPECT_FALSE(options->parts.torso || options->parts.legs);
  EXPECT_EQ(options->fit, pipeline::FitMode::kBestFit);
  EXPECT_EQ(options->quality, pipeline::Quality::kTight);
  EXPECT_EQ(options->skinning, pipeline::SkinningMode::kDense);
  EXPECT_EQ(options->sex, section::Sex::kMale);
  EXPECT_EQ(options->unit, body::Unit::kCentimetre);
  EXPECT_EQ(options->up, body::UpAxis::kZ);
  EXPECT_EQ(options->seed, 18446744073709551615U);
  EXPECT_EQ(options->engine, "jolt");
  EXPECT_TRUE(options->require_parts.head && options->require_parts.legs);
  EXPECT_FALSE(options->require_parts.torso || options->require_parts.arms);
  EXPECT_TRUE(options->want_vertex_gaps);
  EXPECT_DOUBLE_EQ(options->tolerance_m, 0.0025);
}

TEST(ApproximateFlags, AllMeansAllSix) {
  const body::PartSelection parts = PartsOf({"all"});
  EXPECT_TRUE(parts.torso && parts.arms && parts.legs && parts.head && parts.hands && parts.feet);
}

TEST(ApproximateFlags, WrongWordsAndTwoBudgetsAreRefused) {
  for (const char* const words :
       {"--fit loose", "--parts wings", "--unit furlong", "--max-primitives many",
        "--max-primitives 9 --polygon-error 0.1", "--max-primitives 9 --max-spheres 9",
        "--polygon-error 0.1 --max-capsules 9", "--skinning bent",
        "--layout standard-32 --max-primitives 64", "--export fbx"}) {
    EXPECT_FALSE(Parse(words)) << words;
  }
}

TEST(ApproximateFlags, AMissingLandmarksFileIsAFileProblem) {
  const auto flags = Parse("--landmarks there-is-no-such-file.json");
  ASSERT_TRUE(flags);
  EXPECT_EQ(OptionsOf(*flags).status().code(), absl::StatusCode::kNotFound);
}

}  // namespace
}  // namespace capfit::client
