#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "core/base/status.h"
#include "core/pipeline/fit.h"

namespace capfit::pipeline {
namespace {

struct Case {
  std::string name;
  std::function<void(FitOptions&)> change;
  absl::StatusCode code;
  std::string message;  // a part of it
  friend void PrintTo(const Case& c, std::ostream* os) { *os << c.name; }
};

class FitOptionsTest : public testing::TestWithParam<Case> {};

TEST_P(FitOptionsTest, IsJudgedWithFieldValueAndRange) {
  FitOptions options;
  GetParam().change(options);
  const absl::Status status = ValidateOptions(options);
  EXPECT_EQ(status.code(), GetParam().code);
  EXPECT_THAT(std::string(status.message()), testing::HasSubstr(GetParam().message));
}

constexpr auto kOk = absl::StatusCode::kOk;
constexpr auto kInvalid = absl::StatusCode::kInvalidArgument;

INSTANTIATE_TEST_SUITE_P(
    All, FitOptionsTest,
    testing::Values(
        Case{"Defaults", [](FitOptions&) {}, kOk, ""},
        Case{"LowestPrimitives", [](FitOptions& o) { o.max_primitives = 15; }, kOk, ""},
        Case{"TooFewPrimitives", [](FitOptions& o) { o.max_primitives = 14; }, kInvalid,
             "max_primitives is 14, must be in [15, 1000]"},
        Case{"TooManyPrimitives", [](FitOptions& o) { o.max_primitives = 1001; }, kInvalid,
             "max_primitives is 1001, must be in [15, 1000]"},
        Case{"TooFewSpheres", [](FitOptions& o) { o.max_spheres = 9; }, kInvalid,
             "max_spheres is 9, must be in [10, 500]"},
        Case{"TooFewCapsules", [](FitOptions& o) { o.max_capsules = 4; }, kInvalid,
             "max_capsules is 4, must be in [5, 1000]"},
        Case{"BothCapsIsOneWay",
             [](FitOptions& o) {
               o.max_spheres = 32;
               o.max_capsules = 32;
             },
             kOk, ""},
        Case{"TwoWays",
             [](FitOptions& o) {
               o.max_primitives = 64;
               o.polygon_error = 0.1;
             },
             kInvalid, "budget is given in more than one way"},
        Case{"ErrorTooSmall", [](FitOptions& o) { o.polygon_error = 0.0; }, kInvalid,
             "polygon_error is 0, must be in [0.001, 2]"},
        Case{"ErrorNotANumber",
             [](FitOptions& o) { o.polygon_error = std::numeric_limits<double>::quiet_NaN(); },
             kInvalid, "polygon_error is nan"},
        Case{"GrowingIsPapers", [](FitOptions& o) { o.grows_only = true; }, kOk, ""},
        Case{"GrowingIsNotTight",
             [](FitOptions& o) {
               o.grows_only = true;
               o.quality = Quality::kTight;
             },
             kInvalid, "grows_only is for quality paper"},
        Case{"Tolerance", [](FitOptions& o) { o.tolerance_m = 0.1; }, kOk, ""},
        Case{"ToleranceTooLarge", [](FitOptions& o) { o.tolerance_m = 0.2; }, kInvalid,
             "tolerance_m is 0.2, must be in [0, 0.1]"},
        Case{"ToleranceNotANumber",
             [](FitOptions& o) { o.tolerance_m = std::numeric_limits<double>::quiet_NaN(); },
             kInvalid, "tolerance_m is nan"},
        Case{"ToleranceOfTheBestFit",
             [](FitOptions& o) {
               o.tolerance_m = 0.001;
               o.fit = FitMode::kBestFit;
             },
             kInvalid, "tolerance_m is for fit enclose"},
        Case{"Engine", [](FitOptions& o) { o.engine = "iclone"; }, kOk, ""},
        Case{"UnknownEngine", [](FitOptions& o) { o.engine = "quake"; }, kInvalid,
             "engine is \"quake\", must be one of nvcloth, unity_cloth, "},
        Case{"ErrorWithinAnEnginesLimits",
             [](FitOptions& o) {
               o.engine = "nvcloth";
               o.polygon_error = 0.1;
             },
             kInvalid, "polygon_error cannot be promised within the limits of nvcloth"},
        Case{"NoParts", [](FitOptions& o) { o.parts = {false, false, false, false, false, false}; },
             kInvalid, "parts is empty"},
        Case{"LandmarkNotFinite",
             [](FitOptions& o) {
               o.landmarks[body::LandmarkId::kLeftWrist] = {
                   0, std::numeric_limits<double>::infinity(), 0};
             },
             kInvalid, "landmarks.left_wrist must be finite"}),
    [](const auto& test) { return test.param.name; });

TEST(FitOptions, RefusalsNameTheirField) {
  FitOptions options;
  options.max_primitives = 1;
  EXPECT_EQ(FieldOf(ValidateOptions(options)), "options.budget.max_primitives");
  EXPECT_EQ(ReasonOf(ValidateOptions(options)), ErrorReason::kOutOfRange);
  options.polygon_error = 0.1;
  EXPECT_EQ(ReasonOf(ValidateOptions(options)), ErrorReason::kConflict);
  FitOptions unknown;
  unknown.engine = "quake";
  EXPECT_EQ(ReasonOf(ValidateOptions(unknown)), ErrorReason::kUnknownValue);
  FitOptions nothing;
  nothing.parts = {false, false, false, false, false, false};
  EXPECT_EQ(ReasonOf(ValidateOptions(nothing)), ErrorReason::kMissing);
  FitOptions infinite;
  infinite.landmarks[body::LandmarkId::kNeck] = {0, std::numeric_limits<double>::infinity(), 0};
  EXPECT_EQ(ReasonOf(ValidateOptions(infinite)), ErrorReason::kNotFinite);
  EXPECT_EQ(FieldOf(ValidateOptions(infinite)), "options.landmarks.neck");
}

}  // namespace
}  // namespace capfit::pipeline
