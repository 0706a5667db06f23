#include "core/refine/best_fit/thin_out.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"
#include "tests/core/refine/graphs.h"

namespace capfit::refine {
namespace {

std::vector<Eigen::Vector3f> RandomPoints(int count) {
  Random random(17);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i) points.push_back(RandomPoint(random).cast<float>());
  return points;
}

TEST(ThinOutTest, KeepsTheOutermostOfEveryAxis) {
  const std::vector<Eigen::Vector3f> all = RandomPoints(5000);
  const std::vector<Eigen::Vector3f> kept = ThinOut(all, 0.5);
  EXPECT_LT(kept.size(), all.size() / 4);
  for (int k = 0; k < 3; ++k) {
    const auto further = [k](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
      return a[k] < b[k];
    };
    EXPECT_EQ((*std::max_element(kept.begin(), kept.end(), further))[k],
              (*std::max_element(all.begin(), all.end(), further))[k]);
  }
}

TEST(ThinOutTest, KeepsOnlyWhatCameAndNothingOfNothing) {
  const std::vector<Eigen::Vector3f> all = RandomPoints(200);
  for (const Eigen::Vector3f& p : ThinOut(all, 0.3)) {
    EXPECT_NE(std::find(all.begin(), all.end(), p), all.end());
  }
  EXPECT_TRUE(ThinOut({}, 0.3).empty());
}

}  // namespace
}  // namespace capfit::refine
