#include "core/base/status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace capfit {
namespace {

absl::StatusOr<int> Half(int value) {
  if (value % 2 != 0)
    return InvalidField(ErrorReason::kOutOfRange, "value", "is odd, must be even");
  return value / 2;
}

absl::StatusOr<int> Quarter(int value) {
  CAPFIT_ASSIGN_OR_RETURN(const int half, Half(value));
  CAPFIT_RETURN_IF_ERROR(Half(half).status());
  return half / 2;
}

TEST(Status, InvalidFieldNamesTheFieldInMessageAndPayload) {
  const absl::Status status =
      IndexOutOfRange("mesh.arrays.triangle_indices[17]", 90210, std::size_t{6890});
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(status.message(), "mesh.arrays.triangle_indices[17] is 90210, must be below 6890");
  EXPECT_EQ(FieldOf(status), "mesh.arrays.triangle_indices[17]");
  EXPECT_EQ(ReasonOf(status), ErrorReason::kOutOfRange);
  EXPECT_THAT(FactsOf(status), testing::ElementsAre(testing::Pair("value", "90210"),
                                                    testing::Pair("limit", "[0, 6890)")));
}

TEST(Status, RangesNameBothEnds) {
  const absl::Status status = OutOfRange("options.tolerance_m", 0.25, 0.0, 0.1);
  EXPECT_EQ(status.message(), "options.tolerance_m is 0.25, must be in [0, 0.1]");
  EXPECT_THAT(FactsOf(status), testing::Contains(testing::Pair("limit", "[0, 0.1]")));
}

TEST(Status, OutOfRangeTellsTheValueFromTheLimit) {
  const auto text = [](double value) {
    return std::string(OutOfRange("tolerance_m", value, 0.0, 0.1).message());
  };
  EXPECT_EQ(text(0.1000000015), "tolerance_m is 0.100000002, must be in [0, 0.1]");
  EXPECT_EQ(text(0.10000000000000002), "tolerance_m is 0.10000000000000002, must be in [0, 0.1]");
  EXPECT_EQ(text(-0.5), "tolerance_m is -0.5, must be in [0, 0.1]");
}

TEST(Status, WhatIsNotFiniteHasAReasonOfItsOwn) {
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(ReasonOf(OutOfRange("tolerance_m", value, 0.0, 0.1)), ErrorReason::kNotFinite);
  }
  EXPECT_EQ(ReasonOf(OutOfRange("tolerance_m", 0.2, 0.0, 0.1)), ErrorReason::kOutOfRange);
}

TEST(Status, EveryReasonHasItsNameAndCode) {
  for (const KnownReason& known : ErrorReasons()) {
    EXPECT_EQ(ErrorReasonFromName(known.name), known.reason) << known.name;
    const absl::Status status = Refused(known.reason, "message");
    EXPECT_EQ(ReasonOf(status), known.reason) << known.name;
    EXPECT_EQ(status.code(), known.code) << known.name;
  }
  EXPECT_EQ(ErrorReasonFromName("NO_SUCH_REASON"), std::nullopt);
}

TEST(Status, WarningsTravelWithAnErrorAndNotWithSuccess) {
  const std::vector<Warning> warnings = {{"HOLES_CLOSED", "two holes\twere\nclosed", 2},
                                         {"UNIT_ASSUMED", "taken to be in inches", 0}};
  const std::vector<Warning> back =
      WarningsOf(WithWarnings(Refused(ErrorReason::kNotABody, "a chair"), warnings));
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[0].code, "HOLES_CLOSED");
  EXPECT_EQ(back[0].message, "two holes were closed");
  EXPECT_EQ(back[0].count, 2);
  EXPECT_EQ(back[1].message, "taken to be in inches");
  EXPECT_TRUE(WithWarnings(absl::OkStatus(), warnings).ok());
}

TEST(Status, MacrosHandErrorsUpUnchanged) {
  EXPECT_EQ(*Quarter(12), 3);
  EXPECT_EQ(FieldOf(Quarter(5).status()), "value");
  EXPECT_EQ(FieldOf(Quarter(6).status()), "value");  // the inner half is odd
}

}  // namespace
}  // namespace capfit
