#include "client/result_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "core/base/enum_index.h"
#include "tests/server/fake_fit.h"

namespace capfit::client {
namespace {

using testing::HasSubstr;

TEST(ResultTable, ShowsPartsMetricsStagesAndWarnings) {
  const std::string table = ResultTable(server::HandMadeResult());
  EXPECT_THAT(table, HasSubstr("torso            1        0  37.500 0.4600  0.3700  0.0900"));
  EXPECT_THAT(table, HasSubstr("left_arm         1        1   4.300 0.6100"));
  EXPECT_THAT(table, HasSubstr("  1.350  38.00  90.00 130.00   5.30     2\n"));
  EXPECT_THAT(table, HasSubstr("total            3        2  41.800 0.5000"));
  EXPECT_THAT(table, HasSubstr("gap               30.00 mm  mean"));
  EXPECT_THAT(table, HasSubstr("E_r              0.5000"));
  EXPECT_THAT(table, HasSubstr("circle         400.0 ms\n"));
  EXPECT_THAT(table, testing::Not(HasSubstr("head")));
  EXPECT_THAT(table, testing::Not(HasSubstr("warning"))) << "those are for standard error";
}

TEST(ResultTable, FitsInto100Columns) {
  pipeline::FitResult result = server::HandMadeResult();
  metrics::Metrics& whole = result.metrics;  // the widest figures that make sense
  whole.n_p = 1000;
  whole.spheres = whole.capsules = 500;
  whole.E_r = whole.outside = 9.9999;
  whole.volume_ratio = 10.999;
  whole.gap = {0.99999, 0.99999, 0.99999};
  whole.surface_out = 1.0;
  whole.vertices_out = 99'999;
  whole.max_out_m = 0.99999;
  whole.parts[Index(body::Part::kRightHand)] = {
      500, 500, 0.099, 9.9999, 9.9999, 1.0, 9.0, 10.999, {0.999, 0.999, 0.999}, 1.0, 99'999, 0.9};
  std::istringstream lines(ResultTable(result));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
}

TEST(ResultTable, ColumnsOfThePartsStandBelowTheirNames) {
  const std::string table = PartsTable(server::HandMadeResult().metrics);
  std::vector<std::size_t> widths;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) widths.push_back(line.size());
  ASSERT_EQ(widths.size(), 5U);  // two of names, two parts, the whole
  for (const std::size_t width : widths) EXPECT_EQ(width, widths[0]);
}

}  // namespace
}  // namespace capfit::client
