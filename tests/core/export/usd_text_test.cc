#include "core/export/usd_text.h"

#include <gtest/gtest.h>

namespace capfit::exports {
namespace {

TEST(UsdText, NumbersReadBackToTheSameDouble) {
  for (const double number : {0.1, -1.0 / 3.0, 1e-20, 123456789.125, 0.0}) {
    EXPECT_EQ(std::stod(UsdNumber(number)), number);
  }
  EXPECT_EQ(UsdVector({1, 2.5, -3}), "(1, 2.5, -3)");
}

TEST(UsdText, StringsCannotBeEndedByWhatIsInThem) {
  EXPECT_EQ(UsdString("a\"b\\c\nd"), "\"a\\\"b\\\\c d\"");
}

TEST(UsdText, NamesAreIdentifiersAndOfNoTwoTheSame) {
  UsdNames names;
  EXPECT_EQ(names.Add("mixamorig:Hips"), "mixamorig_Hips");
  EXPECT_EQ(names.Add("mixamorig_Hips"), "mixamorig_Hips_2");
  EXPECT_EQ(names.Add("7th"), "_7th");
  EXPECT_EQ(names.Add(""), "_");
  EXPECT_EQ(names.Add("\xC3\xA4"), "__");
}

}  // namespace
}  // namespace capfit::exports
