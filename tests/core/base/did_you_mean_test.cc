#include "core/base/did_you_mean.h"

#include <gtest/gtest.h>

namespace capfit {
namespace {

TEST(DidYouMean, TheNearestIsNamed) {
  EXPECT_EQ(EditDistance("", "abc"), 3);
  EXPECT_EQ(EditDistance("aproximate", "approximate"), 1);
  EXPECT_EQ(EditDistance("rednre", "render"), 2);
  EXPECT_EQ(DidYouMean("evalaute", {"approximate", "evaluate"}), "; did you mean evaluate?");
  EXPECT_EQ(DidYouMean("--max-prim", {"--max-primitives", "--max-spheres"}),
            "; did you mean --max-primitives?");
  EXPECT_EQ(DidYouMean("dance", {"approximate", "evaluate"}), "");
}

}  // namespace
}  // namespace capfit
