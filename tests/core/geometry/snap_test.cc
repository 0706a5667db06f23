#include "core/geometry/snap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/random.h"

namespace capfit::geometry {
namespace {

// Halves, their neighbours among doubles, and what is too large to have digits behind the point.
std::vector<double> HardCases() {
  std::vector<double> cases = {0.0, -0.0};
  for (const double near : {0.5, 1.0, 1.5, 2.5, 1e6 + 0.5, 0x1p51 + 0.5, 0x1p52 - 0.5, 0x1p53}) {
    for (const double x : {near, std::nextafter(near, 0.0), std::nextafter(near, 1e300)}) {
      cases.push_back(x);
      cases.push_back(-x);
    }
  }
  return cases;
}

TEST(SnapTest, RoundsAsTheStandardLibraryDoes) {
  for (const double x : HardCases()) EXPECT_EQ(Snap(x, 1.0), std::round(x)) << x;
  Random random(3);
  for (int i = 0; i < 100'000; ++i) {
    const double x = random.NextIn(-1e3, 1e3);
    ASSERT_EQ(Snap(x, kFineGrid), std::round(x / kFineGrid) * kFineGrid) << x;
    ASSERT_EQ(Snap(-x, kCoordinateGrid), -Snap(x, kCoordinateGrid)) << x;
  }
}

TEST(SnapTest, TakesNoiseAway) {
  Random random(4);
  int tipped = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Eigen::Vector3d p(random.NextIn(-1, 1), random.NextIn(-1, 1), random.NextIn(-1, 1));
    const Eigen::Vector3d noisy = p + Eigen::Vector3d::Constant(random.NextIn(-1e-15, 1e-15));
    if (Snap(p, kCoordinateGrid) != Snap(noisy, kCoordinateGrid)) ++tipped;
    EXPECT_LE((Snap(p, kCoordinateGrid) - p).cwiseAbs().maxCoeff(), 0.5001 * kCoordinateGrid);
  }
  EXPECT_LE(tipped, 1);
}

}  // namespace
}  // namespace capfit::geometry
