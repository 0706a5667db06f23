#include "core/base/random.h"

#include <gtest/gtest.h>

#include <array>

namespace capfit {
namespace {

TEST(Random, FirstWordsAreThoseOfTheReferenceGenerator) {
  Random random(1234567);  // reference values of SplitMix64 for this seed
  EXPECT_EQ(random.NextWord(), 6457827717110365317ull);
  EXPECT_EQ(random.NextWord(), 3203168211198807973ull);
  EXPECT_EQ(random.NextWord(), 9817491932198370423ull);
}

TEST(Random, UnitIsUniform) {
  Random random(7);
  std::array<int, 10> bins{};
  for (int i = 0; i < 100'000; ++i) ++bins[static_cast<std::size_t>(random.NextUnit() * 10)];
  for (const int bin : bins) EXPECT_NEAR(bin, 10'000, 500);  // 5 standard deviations
}

TEST(Random, BelowStaysBelowAndReachesAll) {
  Random random(7);
  std::array<int, 3> bins{};
  for (int i = 0; i < 300; ++i) ++bins.at(random.NextBelow(3));
  for (const int bin : bins) EXPECT_GT(bin, 60);
}

}  // namespace
}  // namespace capfit
