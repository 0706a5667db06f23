#include "core/formats/recover_decimals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace capfit::formats {
namespace {

using Points = std::vector<Eigen::Vector3d>;

// Points in a box of human size whose coordinates are multiples of 10^-digits.
Points RandomDecimals(int digits, double scale = 1.0) {
  Random random(7);
  const double power = std::pow(10.0, digits);
  Points points(200);
  for (Eigen::Vector3d& p : points) {
    for (double& x : p) x = std::nearbyint(scale * random.NextIn(-1.0, 1.0) * power) / power;
  }
  return points;
}

Points AsFloats(Points points) {
  for (Eigen::Vector3d& p : points) {
    for (double& x : p) x = static_cast<double>(static_cast<float>(x));
  }
  return points;
}

TEST(RecoverDecimalsTest, FindsTheDoublesThatTheTextMeant) {
  for (const int digits : {2, 3, 4, 5, 6}) {
    const Points text = RandomDecimals(digits);
    EXPECT_EQ(RecoverDecimalsOfFloats(AsFloats(text)), text) << digits;
  }
  const Points millimetres = RandomDecimals(2, 1800.0);
  EXPECT_EQ(RecoverDecimalsOfFloats(AsFloats(millimetres)), millimetres);
}

TEST(RecoverDecimalsTest, SeesThroughTransformsOfFloats) {
  const Points text = RandomDecimals(5);
  Points moved = AsFloats(RandomDecimals(5));
  for (Eigen::Vector3d& p : moved) {
    for (double& x : p) x = 0.01 * static_cast<double>(static_cast<float>(100.0 * x));
  }
  EXPECT_EQ(RecoverDecimals(moved, 1e-7), text);
}

TEST(RecoverDecimalsTest, LeavesEverythingElse) {
  Random random(3);
  Points any(500);
  for (Eigen::Vector3d& p : any) {
    for (double& x : p) x = random.NextIn(-1.0, 1.0);
  }
  EXPECT_TRUE(RecoverDecimalsOfFloats(any).empty()) << "doubles";
  EXPECT_TRUE(RecoverDecimalsOfFloats(AsFloats(any)).empty()) << "floats that use all their bits";
  Points few = AsFloats(RandomDecimals(5));
  few.resize(4);
  EXPECT_TRUE(RecoverDecimalsOfFloats(few).empty()) << "too few to tell";
  EXPECT_TRUE(RecoverDecimals({}).empty());
  EXPECT_TRUE(RecoverDecimals(Points(100, Eigen::Vector3d::Zero())).empty());
  EXPECT_TRUE(RecoverDecimals(Points(100, Eigen::Vector3d::Constant(NAN))).empty());
}

// With one vertex between, the grid becomes finer, or there is none; nobody moves by more than a
// float's rounding.
TEST(RecoverDecimalsTest, MovesNothingFurtherThanAFloatCanTell) {
  Points one_off = RandomDecimals(4);
  one_off[77].y() += 3.14159265e-6;
  const Points floats = AsFloats(one_off);
  const Points recovered = RecoverDecimalsOfFloats(floats);
  for (std::size_t i = 0; i < recovered.size(); ++i) {
    EXPECT_LE((recovered[i] - floats[i]).cwiseAbs().maxCoeff(), 0x1p-24) << i;
  }
}

}  // namespace
}  // namespace capfit::formats
