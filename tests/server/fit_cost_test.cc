#include "server/fit_cost.h"

#include <gtest/gtest.h>

namespace capfit::server {
namespace {

using pipeline::Quality;

TEST(FitCost, MoreWorkIsExpectedToTakeLonger) {
  const FitCost cost;
  const double small = cost.ExpectedSeconds({1'000, Quality::kPaper, false});
  EXPECT_GT(small, 0.0);
  EXPECT_GT(cost.ExpectedSeconds({1'000'000, Quality::kPaper, false}), small);
  EXPECT_GT(cost.ExpectedSeconds({1'000, Quality::kTight, false}), small);
  EXPECT_GT(cost.ExpectedSeconds({1'000, Quality::kPaper, true}), small);
}

TEST(FitCost, LearnsWhatFitsOfAKindTake) {
  FitCost cost;
  const FitSize large{200'000, Quality::kTight, false};
  const FitSize other{200'000, Quality::kBalanced, false};
  const double before = cost.ExpectedSeconds(other);
  for (int i = 0; i < 50; ++i) cost.Learn(large, 7.0);
  EXPECT_NEAR(cost.ExpectedSeconds(large), 7.0, 0.01);
  EXPECT_EQ(cost.ExpectedSeconds(other), before) << "another quality is another kind";
  // A fifth of the way to what is odd.
  cost.Learn(large, 17.0);
  EXPECT_NEAR(cost.ExpectedSeconds(large), 9.0, 0.01);
}

TEST(FitCost, StaysANumberWhateverItIsTold) {
  FitCost cost;
  const FitSize size{10, Quality::kPaper, false};
  for (int i = 0; i < 100; ++i) cost.Learn(size, 1e300);
  EXPECT_LT(cost.ExpectedSeconds(size), 1e4);
  for (int i = 0; i < 1000; ++i) cost.Learn(size, 0.0);
  EXPECT_GT(cost.ExpectedSeconds(size), 0.0);
  EXPECT_GT(cost.ExpectedSeconds({-5, Quality::kPaper, false}), 0.0);
}

}  // namespace
}  // namespace capfit::server
