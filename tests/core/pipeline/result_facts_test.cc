// What a result tells of itself: progress on the way, whose time it was, which options held, and
// which body it belongs to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "core/base/enum_index.h"
#include "core/base/status.h"
#include "core/mannequin/mannequin.h"
#include "core/pipeline/fit.h"

namespace capfit::pipeline {
namespace {

// Writes down what it is told.
class Notes final : public FitObserver {
 public:
  void OnStage(Stage stage, double fraction_done) override {
    stages.push_back(stage);
    fractions.push_back(fraction_done);
  }
  [[nodiscard]] bool IsCancelled() const override { return false; }

  std::vector<Stage> stages;
  std::vector<double> fractions;
};

formats::PolygonSoup Mannequin(double metres_per_unit = 1.0) {
  formats::PolygonSoup soup = mannequin::MakeMannequin({}).value();
  for (Eigen::Vector3d& p : soup.positions) p /= metres_per_unit;
  return soup;
}

absl::StatusOr<FitResult> FitWith(const formats::PolygonSoup& soup, const FitOptions& options,
                                  FitObserver& observer) {
  const ThreadPool pool(2);
  return Fit(soup, options, pool, observer);
}

FitResult MustFit(const formats::PolygonSoup& soup, const FitOptions& options) {
  NullObserver observer;
  return FitWith(soup, options, observer).value();
}

double SecondsOf(const FitResult& result, Stage stage) {
  return result.stage_seconds[Index(stage)];
}

struct ProgressCase {
  const char* name;
  Quality quality;
  FitMode fit;
  const char* engine;
  std::set<Stage> stages;
  friend void PrintTo(const ProgressCase& c, std::ostream* os) { *os << c.name; }
};
class ProgressTest : public testing::TestWithParam<ProgressCase> {};

TEST_P(ProgressTest, NeverFallsAndTimesBelongToTheirStages) {
  FitOptions options;
  options.quality = GetParam().quality;
  options.fit = GetParam().fit;
  options.engine = GetParam().engine;
  Notes notes;
  const absl::StatusOr<FitResult> result = FitWith(Mannequin(), options, notes);
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_TRUE(std::is_sorted(notes.fractions.begin(), notes.fractions.end()));
  EXPECT_GE(notes.fractions.front(), 0.0);
  EXPECT_LE(notes.fractions.back(), 1.0);
  std::set<Stage> timed;
  for (int i = 0; i < kStageCount; ++i) {
    if (result->stage_seconds[i] > 0.0) {
      timed.insert(static_cast<Stage>(i));
    }
  }
  EXPECT_EQ(timed, GetParam().stages);
  EXPECT_EQ(std::set<Stage>(notes.stages.begin(), notes.stages.end()), GetParam().stages);
}

using enum Stage;
INSTANTIATE_TEST_SUITE_P(
    All, ProgressTest,
    testing::Values(ProgressCase{"PaperEncloses",
                                 Quality::kPaper,
                                 FitMode::kEnclose,
                                 "",
                                 {kMesh, kBody, kSection, kCircle, kCapsule, kCoverage, kMetrics}},
                    ProgressCase{
                        "PaperBestFit",
                        Quality::kPaper,
                        FitMode::kBestFit,
                        "",
                        {kMesh, kBody, kSection, kCircle, kCapsule, kRefine, kCoverage, kMetrics}},
                    ProgressCase{"TightEncloses",
                                 Quality::kTight,
                                 FitMode::kEnclose,
                                 "",
                                 {kMesh, kBody, kRefine, kCoverage, kMetrics}},
                    ProgressCase{"TightBestFit",
                                 Quality::kTight,
                                 FitMode::kBestFit,
                                 "",
                                 {kMesh, kBody, kRefine, kCoverage, kMetrics}},
                    // Builds again with fewer capsules until the engine's shapes suffice.
                    ProgressCase{"StagesAreEnteredAgain",
                                 Quality::kPaper,
                                 FitMode::kEnclose,
                                 "iclone",
                                 {kMesh, kBody, kSection, kCircle, kCapsule, kCoverage, kMetrics}}),
    [](const auto& test) { return test.param.name; });

TEST(Progress, LongSearchesTellHowFarTheyAre) {
  FitOptions options;
  options.quality = Quality::kTight;
  options.max_primitives = 200;
  Notes notes;
  ASSERT_TRUE(FitWith(Mannequin(), options, notes).ok());
  double widest = 0.0;
  for (std::size_t i = 1; i < notes.fractions.size(); ++i) {
    widest = std::max(widest, notes.fractions[i] - notes.fractions[i - 1]);
  }
  EXPECT_LT(widest, 0.25) << "a jump that a person would take for a hang before it";
}

TEST(Progress, PaperTimeGoesToCoverageNotToOthers) {
  const FitResult result = MustFit(Mannequin(), {});
  EXPECT_GT(SecondsOf(result, kCoverage), 0.0);
  EXPECT_EQ(SecondsOf(result, kRefine), 0.0);
}

TEST(EffectiveOptionsOfAResult, DefaultsAreFilledIn) {
  const FitResult result = MustFit(Mannequin(0.01), {});
  EXPECT_EQ(result.effective_options.max_primitives, kDefaultMaxPrimitives);
  EXPECT_EQ(result.effective_options.unit, body::Unit::kCentimetre);
  EXPECT_EQ(result.effective_options.up, body::UpAxis::kY);
  EXPECT_EQ(result.version.find('.'), 1U);
}

TEST(EffectiveOptionsOfAResult, TheEnginesLimitsAreApplied) {
  FitOptions options;
  options.max_spheres = 20;
  options.engine = "unity_cloth";
  const FitResult result = MustFit(Mannequin(), options);
  EXPECT_EQ(result.effective_options.max_spheres, 20);
  EXPECT_EQ(result.effective_options.max_capsules, 32);
  EXPECT_EQ(result.effective_options.max_primitives, std::nullopt);
}

TEST(EffectiveOptionsOfAResult, ABodyThatLiesAskewHasNoUpAxis) {
  formats::PolygonSoup soup = Mannequin();
  const Eigen::AngleAxisd turn(std::numbers::pi / 5.0, Eigen::Vector3d(1, 2, 3).normalized());
  for (Eigen::Vector3d& p : soup.positions) p = turn * p;
  EXPECT_EQ(MustFit(soup, {}).effective_options.up, body::UpAxis::kAuto);
}

TEST(BodyFactsOfAResult, AreThoseOfTheCallersMesh) {
  const formats::PolygonSoup soup = Mannequin(0.01);
  const FitResult result = MustFit(soup, {});
  EXPECT_EQ(result.body.vertex_count, static_cast<std::int64_t>(soup.positions.size()));
  EXPECT_EQ(result.body.face_count, static_cast<std::int64_t>(soup.face_count()));
  Eigen::Vector3d low = soup.positions.front();
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& p : soup.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  EXPECT_LT((result.body.box_min - low).norm(), 1e-4);
  EXPECT_LT((result.body.box_max - high).norm(), 1e-4);
  EXPECT_NEAR(result.body.height_m, 0.01 * (high - low).y(), 0.01);
  EXPECT_TRUE(result.body.is_symmetric);
}

TEST(PolygonsOfSpheres, AreToldOnlyWithThePolygons) {
  const auto told = [](Quality quality, bool want_polygons) {
    FitOptions options;
    options.quality = quality;
    options.want_polygons = want_polygons;
    const FitResult result = MustFit(Mannequin(), options);
    int count = 0;
    for (const capsule::SphereOrigin& origin : result.primitives.origins) {
      EXPECT_LT(origin.polygon, static_cast<int>(result.polygons.size()));
      count += origin.polygon >= 0 ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(told(Quality::kPaper, false), 0);
  EXPECT_GT(told(Quality::kPaper, true), 10);
  EXPECT_EQ(told(Quality::kTight, true), 0);
}

TEST(WarningsOfARefusal, AreThoseThatWereNoticedBefore) {
  formats::PolygonSoup soup = Mannequin();
  soup.positions.emplace_back(0.0, 1.0, 0.0);  // no face uses it
  FitOptions options;
  options.max_primitives = 15;
  options.parts = {true, true, true, true, true, true};
  NullObserver observer;
  const absl::Status status = FitWith(soup, options, observer).status();
  EXPECT_EQ(ReasonOf(status), ErrorReason::kBudgetTooSmall) << status;
  const std::vector<Warning> warnings = WarningsOf(status);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "UNUSED_VERTICES");
  EXPECT_EQ(warnings[0].count, 1);
}

}  // namespace
}  // namespace capfit::pipeline
