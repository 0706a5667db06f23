#include "client/picture/scale_bar.h"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace capfit::client {
namespace {

struct BarCase {
  std::string name;
  double pixels_per_mm;
  double max_pixels;
  double length_mm;
  std::string label;
  friend void PrintTo(const BarCase& c, std::ostream* os) { *os << c.name; }
};
class ScaleBarTest : public testing::TestWithParam<BarCase> {};

TEST_P(ScaleBarTest, IsTheLongestRoundLengthThatFits) {
  const ScaleBar bar = FitScaleBar(GetParam().pixels_per_mm, GetParam().max_pixels);
  EXPECT_NEAR(bar.length_mm, GetParam().length_mm, 1e-9 * GetParam().length_mm);
  EXPECT_DOUBLE_EQ(bar.pixels, bar.length_mm * GetParam().pixels_per_mm);
  EXPECT_EQ(bar.label, GetParam().label);
}
INSTANTIATE_TEST_SUITE_P(Lengths, ScaleBarTest,
                         testing::Values(BarCase{"AnAdult", 0.22, 150, 500, "50 cm"},
                                         BarCase{"AChild", 0.38, 150, 200, "20 cm"},
                                         BarCase{"JustFits", 0.3, 150, 500, "50 cm"},
                                         BarCase{"JustTooLong", 0.3, 149.9, 200, "20 cm"},
                                         BarCase{"AFinger", 20, 150, 5, "5 mm"},
                                         BarCase{"AHouse", 0.01, 150, 10'000, "10 m"},
                                         BarCase{"ATown", 1e-5, 150, 1e7, "10 km"}),
                         [](const auto& test) { return test.param.name; });

TEST(ScaleBarProperty, TakesMoreThanTwoFifthsOfTheRoomAtAnyScale) {
  for (double scale = 1e-4; scale < 1e3; scale *= 1.07) {
    const ScaleBar bar = FitScaleBar(scale, 140.0);
    EXPECT_LE(bar.pixels, 140.0 * (1.0 + 1e-12));
    EXPECT_GE(bar.pixels, 140.0 * 0.4 - 1e-9);
  }
}

TEST(ScaleBarProperty, IsDrawnAsLongAsItSays) {
  Page page;
  const ScaleBar bar = FitScaleBar(0.22, 150);
  const double width = AddScaleBar(bar, 30.0, 40.0, 16.0, page);
  ASSERT_FALSE(page.paths.empty());
  EXPECT_EQ(page.paths[0].name, "scale bar");
  EXPECT_DOUBLE_EQ((page.paths[0].points.back() - page.paths[0].points.front()).norm(), bar.pixels);
  ASSERT_EQ(page.texts.size(), 1u);
  EXPECT_EQ(page.texts[0].text, "50 cm");
  EXPECT_GT(page.texts[0].box.x, 30.0 + bar.pixels);
  EXPECT_DOUBLE_EQ(page.texts[0].box.right(), 30.0 + width);
}

}  // namespace
}  // namespace capfit::client
