#include "core/character/callers_word.h"

#include <gtest/gtest.h>

#include <string>

namespace capfit::character {
namespace {

TEST(MatchesNameTest, StarsStandForAnythingAndQuestionMarksForOne) {
  EXPECT_TRUE(MatchesName("hat", "Hat"));
  EXPECT_FALSE(MatchesName("hat", "Hats"));
  EXPECT_TRUE(MatchesName("*", ""));
  EXPECT_TRUE(MatchesName("hat*", "hat"));
  EXPECT_TRUE(MatchesName("*_CLOTH", "Skirt_01_Cloth"));
  EXPECT_TRUE(MatchesName("s*t*h", "Skirt_01_Cloth"));
  EXPECT_FALSE(MatchesName("s*t*x", "Skirt_01_Cloth"));
  EXPECT_TRUE(MatchesName("eye?", "EyeL"));
  EXPECT_FALSE(MatchesName("eye?", "Eye"));
  EXPECT_FALSE(MatchesName("", "Eye"));
  EXPECT_TRUE(MatchesName("", ""));
  EXPECT_TRUE(MatchesName("a[b]", "A[B]"));
}

// What takes others for ever.
TEST(MatchesNameTest, ManyStarsTakeNoTime) {
  std::string pattern;
  for (int i = 0; i < 100; ++i) pattern += "a*";
  EXPECT_FALSE(MatchesName(pattern + "b", std::string(256, 'a')));
}

}  // namespace
}  // namespace capfit::character
