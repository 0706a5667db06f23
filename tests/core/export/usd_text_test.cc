#include "core/export/usd_text.h"

#include <gtest/gtest.h>

namespace capfit::exports {
namespace {

TEST(UsdText, VectorsAndQuaternionsBeginWithWhatUsdReadsFirst) {
  EXPECT_EQ(UsdVector({1, 2.5, -3}), "(1, 2.5, -3)");
  EXPECT_EQ(UsdQuaternion({0.5, 0.1, 0.2, 0.3}), "(0.5, 0.1, 0.2, 0.3)");  // w first
}

TEST(UsdText, StringsCannotBeEndedByWhatIsInThem) {
  EXPECT_EQ(UsdString("a\"b\\c\nd"), "\"a\\\"b\\\\c d\"");
}

TEST(UsdText, IdentifiersHoldWhatTheyCan) {
  EXPECT_EQ(UsdIdentifier("mixamorig:Hips"), "mixamorig_Hips");
  EXPECT_EQ(UsdIdentifier("7th"), "_7th");
  EXPECT_EQ(UsdIdentifier(""), "_");
  EXPECT_EQ(UsdIdentifier("\xC3\xA4"), "__");
}

}  // namespace
}  // namespace capfit::exports
