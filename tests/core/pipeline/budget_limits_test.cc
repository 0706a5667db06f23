// What a set may have at most, and the errors that name it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <span>
#include <string>

#include "core/base/status.h"
#include "core/body/find_body.h"
#include "core/formats/read_mesh.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"
#include "core/pipeline/engines.h"
#include "core/pipeline/fit.h"
#include "core/pipeline/plan.h"
#include "tests/support/bodies.h"

namespace capfit::pipeline {
namespace {

constexpr int kOpen = capsule::kNoLimit;

const formats::PolygonSoup& Soup() {
  static const formats::PolygonSoup soup = [] {
    mannequin::MannequinOptions options;
    options.faces = 4000;
    return *mannequin::MakeMannequin(options);
  }();
  return soup;
}

capsule::Budget BudgetOf(const FitOptions& options) {
  return TotalBudget(WithEngineLimits(options));
}

capsule::PrimitiveSet SetOf(const FitOptions& options) {
  NullObserver observer;
  const auto result = Fit(Soup(), options, ThreadPool(2), observer);
  EXPECT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->metrics.vertices_out, 0);
  return result->primitives;
}

TEST(TotalBudget, NeverExceedsTheContract) {
  FitOptions options;
  options.max_primitives = 1000;
  EXPECT_EQ(BudgetOf(options).max_spheres, 500);
  options.max_primitives = 500;
  EXPECT_EQ(BudgetOf(options).max_spheres, kOpen);  // cannot be reached
  options.max_primitives.reset();
  options.max_capsules = 1000;
  EXPECT_EQ(BudgetOf(options).max_spheres, 500);
  options.max_capsules.reset();
  options.max_spheres = 500;
  EXPECT_EQ(BudgetOf(options).max_capsules, 1000);
  options.max_spheres.reset();
  options.polygon_error = 0.001;
  EXPECT_EQ(BudgetOf(options).max_primitives, 1000);
  EXPECT_EQ(BudgetOf(options).max_spheres, 500);
  for (const char* const engine : {"mujoco", "vrm"}) {
    FitOptions uniform;
    uniform.engine = engine;
    uniform.max_primitives = 1000;
    EXPECT_EQ(BudgetOf(uniform).max_capsules, 250);
  }
}

TEST(TotalBudget, SpheresAloneBoundTheCapsules) {
  FitOptions options;
  options.max_spheres = 32;
  EXPECT_EQ(BudgetOf(options).max_spheres, 32);
  EXPECT_EQ(BudgetOf(options).max_capsules, 64);
  options.max_capsules = 500;
  EXPECT_EQ(BudgetOf(options).max_capsules, 500);
}

FitOptions ThirtyTwoAndThirtyTwo() {
  FitOptions options;
  options.quality = Quality::kTight;
  options.parts = {true, true, true, true, true, true};
  options.max_spheres = 32;
  options.max_capsules = 32;
  return options;
}

// What cloth engines allow. Whether three capsules of 64 primitives stay unused is a matter of the
// search, and cost a tenth of the error at some resolutions.
TEST(SpheresAndCapsules, ServeOneWomanAtEveryResolution) {
  CAPFIT_REQUIRE_BODIES();
  for (const char* const file :
       {"female_average_rest.obj", "scale/female_average_tri_05k.ply",
        "scale/female_average_tri_10k.ply", "scale/female_average_tri_25k.ply",
        "scale/female_average_tri_064k.ply"}) {
    const std::string bytes = test_support::ReadFile(test_support::BodiesFolder() / file);
    const auto soup = formats::ReadMesh(std::as_bytes(std::span(bytes)));
    ASSERT_TRUE(soup.ok()) << soup.status();
    NullObserver observer;
    const auto result = Fit(*soup, ThirtyTwoAndThirtyTwo(), ThreadPool(2), observer);
    ASSERT_TRUE(result.ok()) << result.status();
    EXPECT_LE(result->primitives.spheres.size(), 32u);
    EXPECT_LE(result->primitives.capsules.size(), 32u);
    EXPECT_GE(result->metrics.n_p, 62) << file;
    EXPECT_LE(result->metrics.E_r, 0.34) << file;
  }
}

// Where the spheres are used up first, ties between them are what is left to be won.
TEST(SpheresAndCapsules, CapsulesAreSpentWhenSpheresAreUsedUp) {
  FitOptions options = ThirtyTwoAndThirtyTwo();
  options.max_spheres = options.max_capsules = 64;
  const capsule::PrimitiveSet set = SetOf(options);
  EXPECT_EQ(set.spheres.size(), 64u);
  EXPECT_LE(set.capsules.size(), 64u);
  EXPECT_GE(set.capsules.size(), 56u);
}

TEST(ContractLimits, HoldForCapsulesThatShareNoSpheres) {
  FitOptions options;
  options.engine = "mujoco";
  options.max_primitives = 1000;
  const capsule::PrimitiveSet set = SetOf(options);
  EXPECT_LE(set.spheres.size(), 500u);
  EXPECT_GT(set.spheres.size(), 400u);
  EXPECT_LE(set.capsules.size(), 250u);
}

TEST(ContractLimits, HoldForTheSmallestPolygonError) {
  FitOptions options;
  options.polygon_error = kMinPolygonError;
  const capsule::PrimitiveSet set = SetOf(options);
  EXPECT_LE(set.spheres.size(), 500u);
  EXPECT_LE(set.primitive_count(), 1000);
  EXPECT_GT(set.primitive_count(), 200);
}

TEST(ContractLimits, APolygonErrorOutOfReachIsAWarning) {
  const auto missed = [](double polygon_error) -> std::int64_t {
    FitOptions options;
    options.polygon_error = polygon_error;
    NullObserver observer;
    const auto result = Fit(Soup(), options, ThreadPool(2), observer);
    for (const Warning& warning : result->warnings) {
      if (warning.code == "POLYGON_ERROR_MISSED") return warning.count;
    }
    return 0;
  };
  EXPECT_GT(missed(kMinPolygonError), 3);
  EXPECT_EQ(missed(0.5), 0);
}

// Three limits, each named as the caller gave it, whatever an engine made of it.
TEST(CheckBudget, NamesTheLimitThatTheCallerGave) {
  FitOptions all;
  all.parts = {true, true, true, true, true, true};
  const auto refusal = [&](const FitOptions& options) {
    NullObserver observer;
    const auto result = Fit(Soup(), options, ThreadPool(1), observer);
    EXPECT_EQ(ReasonOf(result.status()), ErrorReason::kBudgetTooSmall) << result.status();
    return result.status();
  };
  FitOptions options = all;
  options.max_primitives = 19;
  EXPECT_EQ(std::string(refusal(options).message()),
            "options.budget.max_primitives is 19, must be at least 20 for the parts asked for on "
            "this body");
  options.engine = "mujoco";  // 5 capsules with spheres of their own, 5 balls
  EXPECT_EQ(std::string(refusal(options).message()),
            "options.budget.max_primitives is 19, must be at least 20 for the parts asked for on "
            "this body, as capsules of mujoco share no spheres");
  EXPECT_THAT(FactsOf(refusal(options)),
              testing::ElementsAre(testing::Pair("value", "19"), testing::Pair("limit", ">= 20")));
  options = all;
  options.max_spheres = 14;
  EXPECT_EQ(FieldOf(refusal(options)), "options.budget.spheres_and_capsules.max_spheres");
  options.engine = "vrm";
  EXPECT_EQ(FieldOf(refusal(options)), "options.budget.spheres_and_capsules.max_spheres");
}

TEST(CheckBudget, NamesTheEngineWhereItsOwnLimitIsTooLow) {
  const auto prepared = mesh::PrepareMesh(Soup());
  const auto body = body::FindBody(prepared->mesh, {}, ThreadPool(1), NullObserver());
  ASSERT_TRUE(body.ok());
  FitOptions asked;
  asked.engine = "iclone";
  FitOptions limited = WithEngineLimits(asked);
  EXPECT_TRUE(CheckBudget(*body, asked, limited).ok());
  limited.max_capsules = 4;
  const absl::Status status = CheckBudget(*body, asked, limited);
  EXPECT_EQ(FieldOf(status), "options.engine");
  EXPECT_NE(std::string(status.message()).find("iclone allows 16 shapes"), std::string::npos);
}

}  // namespace
}  // namespace capfit::pipeline
