#include "core/base/status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace capfit {
namespace {

absl::StatusOr<int> Half(int value) {
  if (value % 2 != 0) return InvalidField("value", "is odd, must be even");
  return value / 2;
}

absl::StatusOr<int> Quarter(int value) {
  CAPFIT_ASSIGN_OR_RETURN(const int half, Half(value));
  CAPFIT_RETURN_IF_ERROR(Half(half).status());
  return half / 2;
}

TEST(Status, InvalidFieldNamesTheFieldInMessageAndPayload) {
  const absl::Status status = InvalidField("triangle_indices[17]", "is 90210, must be below 6890");
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(status.message(), "triangle_indices[17] is 90210, must be below 6890");
  EXPECT_EQ(FieldOf(status), "triangle_indices[17]");
  EXPECT_EQ(ReasonOf(status), std::nullopt);
}

TEST(Status, CannotFitCarriesAReason) {
  const absl::Status status = CannotFit("NOT_A_BODY", "found 0 of 5 extremities");
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(ReasonOf(status), "NOT_A_BODY");
  EXPECT_EQ(FieldOf(status), std::nullopt);
}

TEST(Status, MacrosHandErrorsUpUnchanged) {
  EXPECT_EQ(*Quarter(12), 3);
  EXPECT_EQ(FieldOf(Quarter(5).status()), "value");
  EXPECT_EQ(FieldOf(Quarter(6).status()), "value");  // the inner half is odd
}

}  // namespace
}  // namespace capfit
