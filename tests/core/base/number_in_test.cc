#include "core/base/number_in.h"

#include <gtest/gtest.h>

#include "absl/strings/str_cat.h"

namespace capfit {
namespace {

TEST(NumberInTest, TakesTheBoundsAndWhatIsBetween) {
  const auto check = NumberIn(0.01, 60.0);
  for (const char* const text : {"0.01", "1", "6e1", "60.0"}) EXPECT_EQ(check(text), "") << text;
}

TEST(NumberInTest, SaysWhatIsWrongAndTheLimits) {
  const auto check = NumberIn(0.01, 60.0);
  for (const char* const text : {"nan", "-nan", "inf", "0", "60.1", "-1", "", "1s", "one"}) {
    EXPECT_EQ(check(text), absl::StrCat("'", text, "' must be a number in [0.01, 60]"));
  }
}

TEST(NumberInTest, SeedsAreWholeNumbersOf64Bits) {
  const auto check = SeedCheck();
  for (const char* const text : {"0", "18446744073709551615"}) EXPECT_EQ(check(text), "") << text;
  for (const char* const text : {"-1", "18446744073709551616", "1.5", "nan", ""}) {
    EXPECT_EQ(check(text),
              absl::StrCat("'", text, "' must be a whole number in [0, 18446744073709551615]"));
  }
}

}  // namespace
}  // namespace capfit
