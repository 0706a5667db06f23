#include "core/base/plain_text.h"

#include <gtest/gtest.h>

#include <string>

namespace capfit {
namespace {

TEST(PlainText, IsShortUtf8WithoutControlCharacters) {
  EXPECT_EQ(PlainText("knee: 3 cm"), "knee: 3 cm");
  EXPECT_EQ(PlainText("頭 Hüfte"), "頭 Hüfte");
  EXPECT_EQ(PlainText("a\n\x01\x7f\xC2\x9B"), "a????");
  EXPECT_EQ(PlainText("\x1b[31mred"), "?[31mred");
  EXPECT_EQ(PlainText("a\u202Eb\u2066c\u2028"), "a?b?c?");
  EXPECT_EQ(PlainText("\u2027\u202F\u2065"), "\u2027\u202F\u2065");  // beside those
  EXPECT_EQ(PlainText("a\xff"), "a\xEF\xBF\xBD");
  EXPECT_EQ(PlainText(std::string(5000, 'x')).size(), 1000U);
  // Cut before a letter, not within it; "x" shifts its bytes by one.
  std::string letters;
  for (int i = 0; i < 1000; ++i) letters += "頭";
  EXPECT_EQ(PlainText(letters), letters.substr(0, 999));
  EXPECT_EQ(PlainText("x" + letters), "x" + letters.substr(0, 999));
  EXPECT_EQ(PlainText("xx" + letters), "xx" + letters.substr(0, 996));
}

TEST(PlainText, IsCutAfterSoManyLetters) {
  EXPECT_EQ(ShortPlainText("", 3), "");
  EXPECT_EQ(ShortPlainText("abc", 3), "abc");
  EXPECT_EQ(ShortPlainText("abcd", 3), "abc...");
  EXPECT_EQ(ShortPlainText("体メッシュ", 5), "体メッシュ");
  EXPECT_EQ(ShortPlainText("体メッシュ", 4), "体メッシ...");
  EXPECT_EQ(ShortPlainText("\xff\xfe\n\xC3", 9), "\uFFFD\uFFFD?\uFFFD");
  std::string four_bytes;
  for (int i = 0; i < 100; ++i) four_bytes += "\U0001F9CD";
  EXPECT_EQ(ShortPlainText(four_bytes, 20), four_bytes.substr(0, 80) + "...");
}

TEST(PlainText, ValidUtf8ReplacesWhatIsNone) {
  EXPECT_EQ(ValidUtf8("K\xC3\xB6rper\n"), "K\xC3\xB6rper\n");
  EXPECT_EQ(ValidUtf8("a\xC3"), "a\uFFFD");
  EXPECT_EQ(ValidUtf8("\xED\xA0\x80").find('\xED'), std::string::npos);  // half of a surrogate pair
}

}  // namespace
}  // namespace capfit
