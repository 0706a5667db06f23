#include "client/result_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/server/fake_fit.h"

namespace capfit::client {
namespace {

using testing::HasSubstr;

TEST(ResultTable, ShowsPartsMetricsStagesAndWarnings) {
  const std::string table = ResultTable(server::HandMadeResult());
  EXPECT_THAT(table, HasSubstr("torso               1         0\n"));
  EXPECT_THAT(table, HasSubstr("left_arm            1         1\n"));
  EXPECT_THAT(table, HasSubstr("total               3         2\n"));
  EXPECT_THAT(table, HasSubstr("E_r              0.5000"));
  EXPECT_THAT(table, HasSubstr("circle         400.0 ms\n"));
  EXPECT_THAT(table, HasSubstr("warning: 2 holes were closed (HOLES_CLOSED)\n"));
  EXPECT_THAT(table, testing::Not(HasSubstr("head")));
}

}  // namespace
}  // namespace capfit::client
