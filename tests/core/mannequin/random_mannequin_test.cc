#include "tests/support/random_mannequin.h"

#include <gtest/gtest.h>

#include "tests/core/mannequin/surface_checks.h"

namespace capfit::mannequin {
namespace {

constexpr int kCount = 120;

TEST(RandomMannequinTest, EveryOneIsAClosedSurfaceThatDoesNotCutItself) {
  for (std::uint64_t seed = 0; seed < kCount; ++seed) {
    const MannequinOptions options = RandomMannequin(seed, {2'000, 3'000});
    const auto soup = MakeMannequin(options);
    ASSERT_TRUE(soup.ok()) << "seed " << seed << ": " << soup.status();
    const test_support::SurfaceFacts facts = test_support::Examine(*soup);
    EXPECT_EQ(facts.unmatched_edges, 0) << "seed " << seed;
    EXPECT_EQ(facts.euler_number, 2) << "seed " << seed;
    EXPECT_GT(facts.volume, 0.0) << "seed " << seed;
    if (seed % 6 == 0) {
      EXPECT_EQ(test_support::CountSelfIntersections(*soup), 0) << "seed " << seed;
    }
  }
}

TEST(RandomMannequinTest, GirthsComeOutAsDrawn) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const MannequinOptions options = RandomMannequin(seed, {2'000, 6'000});
    const auto soup = MakeMannequin(options);
    ASSERT_TRUE(soup.ok());
    const double height_m = options.height_m;
    EXPECT_NEAR(test_support::TapeAt(*soup, kBustLevel * height_m) / *options.bust_m, 1.0, 0.01)
        << "seed " << seed;
    EXPECT_NEAR(test_support::TapeAt(*soup, kWaistLevel * height_m) / *options.waist_m, 1.0, 0.01)
        << "seed " << seed;
    EXPECT_NEAR(test_support::TapeAt(*soup, kHipLevel * height_m) / *options.hip_m, 1.0, 0.01)
        << "seed " << seed;
  }
}

TEST(RandomMannequinTest, DrawsAllKindsAndTheSameAgain) {
  int male = 0;
  int quads = 0;
  int cut = 0;
  int angles = 0;
  for (std::uint64_t seed = 0; seed < kCount; ++seed) {
    const MannequinOptions options = RandomMannequin(seed);
    male += options.sex == MannequinSex::kMale;
    quads += options.quads;
    cut += !options.with_head;
    angles += options.arm_angle_rad.has_value();
    const MannequinOptions again = RandomMannequin(seed);
    EXPECT_EQ(options.height_m, again.height_m);
    EXPECT_EQ(options.hip_m, again.hip_m);
    EXPECT_EQ(options.faces, again.faces);
  }
  EXPECT_NEAR(male, kCount / 2, 22);
  EXPECT_NEAR(quads, kCount / 2, 22);
  EXPECT_NEAR(cut, kCount / 4, 18);
  EXPECT_NEAR(angles, kCount / 2, 22);
}

}  // namespace
}  // namespace capfit::mannequin
