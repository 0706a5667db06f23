#include "client/text_width.h"

#include <gtest/gtest.h>

namespace capfit::client {
namespace {

TEST(TextWidth, CountsColumnsNotBytes) {
  EXPECT_EQ(TextWidth(""), 0U);
  EXPECT_EQ(TextWidth("Body_01"), 7U);
  EXPECT_EQ(TextWidth("Körper"), 6U);
  EXPECT_EQ(TextWidth("左足首"), 6U);      // two columns each
  EXPECT_EQ(TextWidth("e\xCC\x81"), 1U);   // an accent that is set on the e
  EXPECT_EQ(TextWidth("a\xFF\xFEz"), 4U);  // no UTF-8
  EXPECT_EQ(TextWidth("\xE5\xB7"), 2U);    // broken off
  EXPECT_EQ(TextWidth(std::string("a\0b", 3)), 3U);
}

}  // namespace
}  // namespace capfit::client
