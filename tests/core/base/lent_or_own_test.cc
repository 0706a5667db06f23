#include "core/base/lent_or_own.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace capfit {
namespace {

TEST(LentOrOwnTest, WhatIsLentIsNotCopied) {
  const std::vector<int> array = {3, 1, 4};
  const auto lent = LentOrOwn<int>::Lent(array);
  const LentOrOwn<int> copy = lent;
  EXPECT_EQ(lent.view().data(), array.data());
  EXPECT_EQ(copy.view().data(), array.data());
  EXPECT_EQ(lent.size(), 3u);
  EXPECT_EQ(lent[2], 4);
  EXPECT_TRUE(LentOrOwn<int>::Lent({}).empty());
}

TEST(LentOrOwnTest, CopiesOfItsOwnStandForThemselves) {
  LentOrOwn<int> own;
  own.own() = {3, 1};
  LentOrOwn<int> copy = own;
  own.own().push_back(4);
  EXPECT_EQ(own.size(), 3u);
  EXPECT_EQ(copy.size(), 2u);
  copy = std::move(own);
  EXPECT_EQ(std::vector<int>(copy.begin(), copy.end()), (std::vector<int>{3, 1, 4}));
}

}  // namespace
}  // namespace capfit
