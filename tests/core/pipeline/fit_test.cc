#include "core/pipeline/fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "core/formats/read_mesh.h"
#include "core/geometry/tapered_capsule.h"
#include "core/mannequin/mannequin.h"
#include "tests/support/bodies.h"

namespace capfit::pipeline {
namespace {

constexpr double kJudgeTolerance_m = 1e-4;

formats::PolygonSoup Mannequin(const mannequin::MannequinOptions& options = {}) {
  absl::StatusOr<formats::PolygonSoup> soup = mannequin::MakeMannequin(options);
  EXPECT_TRUE(soup.ok()) << soup.status();
  return *std::move(soup);
}

formats::PolygonSoup Read(const std::filesystem::path& path) {
  const std::string bytes = test_support::ReadFile(path);
  absl::StatusOr<formats::PolygonSoup> soup = formats::ReadMesh(
      std::as_bytes(std::span(bytes)), formats::FormatFromFileName(path.string()));
  EXPECT_TRUE(soup.ok()) << path << ": " << soup.status();
  return *std::move(soup);
}

FitResult FitOrDie(const formats::PolygonSoup& soup, const FitOptions& options, int threads = 2) {
  const ThreadPool pool(threads);
  NullObserver observer;
  absl::StatusOr<FitResult> result = Fit(soup, options, pool, observer);
  EXPECT_TRUE(result.ok()) << result.status();
  return result.ok() ? *std::move(result) : FitResult();
}

FitOptions AllParts(int max_primitives) {
  FitOptions options;
  options.max_primitives = max_primitives;
  options.parts = {true, true, true, true, true, true};
  return options;
}

// The furthest of the caller's vertices outside the set, in the caller's unit.
double FurthestOut(const formats::PolygonSoup& soup, const FitResult& result) {
  const std::vector<geometry::TaperedCapsule> solids = capsule::Solids(result.primitives);
  double furthest = -1e300;
  for (const Eigen::Vector3d& vertex : soup.positions) {
    double nearest = 1e300;
    for (const auto& solid : solids) nearest = std::min(nearest, solid.SignedDistance(vertex));
    furthest = std::max(furthest, nearest);
  }
  return furthest;
}

bool SameBits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void ExpectSameBits(const FitResult& a, const FitResult& b) {
  ASSERT_EQ(a.primitives.spheres.size(), b.primitives.spheres.size());
  EXPECT_EQ(a.primitives.capsules, b.primitives.capsules);
  for (std::size_t i = 0; i < a.primitives.spheres.size(); ++i) {
    const geometry::Sphere& p = a.primitives.spheres[i];
    const geometry::Sphere& q = b.primitives.spheres[i];
    EXPECT_TRUE(SameBits(p.radius_m, q.radius_m)) << "sphere " << i;
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(SameBits(p.center_m[k], q.center_m[k])) << i;
  }
  EXPECT_TRUE(SameBits(a.metrics.E_r, b.metrics.E_r));
  EXPECT_TRUE(SameBits(a.metrics.E_M, b.metrics.E_M));
  ASSERT_EQ(a.weights.has_value(), b.weights.has_value());
  if (a.weights.has_value()) {
    EXPECT_EQ(a.weights->weights, b.weights->weights);
  }
}

TEST(Fit, EnclosesTheMannequinWithinEveryBudget) {
  const formats::PolygonSoup soup = Mannequin();
  for (const int budget : {22, 32, 64, 128, 250}) {
    const FitResult result = FitOrDie(soup, AllParts(budget));
    EXPECT_LE(result.metrics.n_p, budget);
    EXPECT_GE(result.metrics.n_p, budget - 3);
    EXPECT_EQ(result.metrics.n_p, result.primitives.primitive_count());
    EXPECT_LE(FurthestOut(soup, result), kJudgeTolerance_m);
    EXPECT_LE(result.metrics.uncovered, 0.002);
  }
}

TEST(Fit, WarnsOfAToleranceThatHollowsTheSet) {
  const auto warned = [](double tolerance_m) {
    FitOptions options = AllParts(48);
    options.tolerance_m = tolerance_m;
    const FitResult result = FitOrDie(Mannequin(), options);
    const auto is_it = [](const Warning& w) { return w.code == "TOLERANCE_HOLLOWS"; };
    const auto warning = std::find_if(result.warnings.begin(), result.warnings.end(), is_it);
    EXPECT_EQ(warning != result.warnings.end(), result.metrics.uncovered > 0.2) << tolerance_m;
    return warning == result.warnings.end() ? "" : warning->message;
  };
  EXPECT_EQ(warned(0.002), "");
  EXPECT_THAT(warned(0.06), testing::HasSubstr("the tolerance of 60 mm leaves"));
}

TEST(Fit, RefusesABudgetThatThePartsCannotFitInto) {
  const ThreadPool pool(1);
  NullObserver observer;
  const auto result = Fit(Mannequin(), AllParts(19), pool, observer);
  EXPECT_EQ(result.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(result.status().message()),
              testing::HasSubstr("max_primitives is 19, must be at least 20"));
  EXPECT_LE(FitOrDie(Mannequin(), AllParts(20)).metrics.n_p, 20);
}

TEST(Fit, KeepsSphereAndCapsuleLimitsApart) {
  FitOptions options = AllParts(64);
  options.max_primitives.reset();
  options.max_spheres = 32;
  options.max_capsules = 32;
  const FitResult result = FitOrDie(Mannequin(), options);
  EXPECT_LE(result.primitives.spheres.size(), 32u);
  EXPECT_LE(result.primitives.capsules.size(), 32u);
  EXPECT_GE(result.metrics.n_p, 45);
}

TEST(Fit, SmallerPolygonErrorBuysMoreCirclesAndATighterSet) {
  FitOptions loose;
  loose.polygon_error = 0.5;
  FitOptions tight;
  tight.polygon_error = 0.1;
  const formats::PolygonSoup soup = Mannequin();
  const FitResult a = FitOrDie(soup, loose);
  const FitResult b = FitOrDie(soup, tight);
  EXPECT_LT(a.metrics.n_p, b.metrics.n_p);
  EXPECT_GT(a.metrics.E_r, b.metrics.E_r);
}

// As many primitives as the sections took, each of use: the same as if that many were asked for.
TEST(Fit, ABestFitToAPolygonErrorSpendsWhatItTook) {
  FitOptions by_error = AllParts(64);
  by_error.fit = FitMode::kBestFit;
  by_error.max_primitives.reset();
  by_error.polygon_error = 0.1;
  const formats::PolygonSoup soup = Mannequin();
  const FitResult a = FitOrDie(soup, by_error);
  by_error.fit = FitMode::kEnclose;
  const std::int64_t taken = FitOrDie(soup, by_error).metrics.n_p;
  EXPECT_LE(a.metrics.n_p, taken);
  FitOptions by_count = AllParts(static_cast<int>(taken));
  by_count.fit = FitMode::kBestFit;
  const FitResult b = FitOrDie(soup, by_count);
  EXPECT_LT(a.metrics.E_r, 1.15 * b.metrics.E_r);
}

TEST(Fit, SameBitsForAnyNumberOfThreads) {
  const formats::PolygonSoup soup = Mannequin();
  FitOptions options = AllParts(64);
  options.skinning = SkinningMode::kDense;
  const FitResult one = FitOrDie(soup, options, 1);
  ExpectSameBits(one, FitOrDie(soup, options, 2));
  ExpectSameBits(one, FitOrDie(soup, options, 7));
}

// With more fits than threads, then as many, then one: loops stay with their callers, or do not.
TEST(Fit, SameBitsSideBySideOnOnePool) {
  const formats::PolygonSoup soup = Mannequin();
  const FitOptions options = AllParts(64);
  const FitResult alone = FitOrDie(soup, options, 1);
  const ThreadPool pool(2);
  std::vector<absl::StatusOr<FitResult>> results(6, absl::UnknownError("not begun"));
  std::vector<std::thread> callers;
  for (std::size_t caller = 0; caller < 3; ++caller) {
    callers.emplace_back([&, caller] {
      for (std::size_t i = 0; i <= caller; ++i) {
        NullObserver observer;
        results[caller * (caller + 1) / 2 + i] = Fit(soup, options, pool, observer);
      }
    });
  }
  for (std::thread& caller : callers) caller.join();
  for (const absl::StatusOr<FitResult>& result : results) {
    ASSERT_TRUE(result.ok()) << result.status();
    ExpectSameBits(alone, *result);
  }
}

struct Copy {
  std::string name;
  double scale = 1.0;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d move = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector3d Apply(const Eigen::Vector3d& p) const {
    return scale * (turn * p) + move;
  }
};

Eigen::Matrix3d Turn(double angle_rad, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle_rad, axis.normalized()).matrix();
}

std::vector<Copy> Copies() {
  const double quarter = 1.5707963267948966;
  return {{"Moved", 1.0, Turn(0, {0, 1, 0}), {12.3, -45.6, 7.89}},
          {"Upright", 1.0, Turn(0.7, {0, 1, 0}), {0, 0, 0}},
          {"ZUp", 1.0, Turn(quarter, {1, 0, 0}), {0, 0, 0}},
          {"LyingAnyhow", 1.0, Turn(2.2, {0.3, -0.7, 0.9}), {0, 0, 0}},
          {"Centimetres", 100.0, Turn(0, {0, 1, 0}), {0, 0, 0}},
          {"Inches", 1.0 / 0.0254, Turn(0, {0, 1, 0}), {0, 0, 0}},
          {"AllTogether", 100.0, Turn(1.9, {-1, 2, 0.5}), {120.0, -30.0, 77.0}}};
}

// Sphere by sphere, to 1e-6 of the height (1.7e-6 m): rounding must not tip a choice.
void ExpectFollows(const FitResult& here, const FitResult& there, const Copy& copy) {
  const double tolerance = 1.7e-6 * copy.scale;
  EXPECT_NEAR(there.body_from_caller.scale, 1.0 / copy.scale, 1e-12);
  ASSERT_EQ(here.landmarks.size(), there.landmarks.size());
  for (std::size_t i = 0; i < here.landmarks.size(); ++i) {
    const Eigen::Vector3d expected = copy.Apply(here.landmarks[i].position);
    EXPECT_LE((there.landmarks[i].position - expected).norm(), tolerance) << here.landmarks[i].name;
  }
  EXPECT_EQ(here.primitives.capsules, there.primitives.capsules);
  ASSERT_EQ(here.primitives.spheres.size(), there.primitives.spheres.size());
  for (std::size_t i = 0; i < here.primitives.spheres.size(); ++i) {
    const geometry::Sphere& p = here.primitives.spheres[i];
    const geometry::Sphere& q = there.primitives.spheres[i];
    EXPECT_LE((q.center_m - copy.Apply(p.center_m)).norm(), tolerance) << "sphere " << i;
    EXPECT_NEAR(q.radius_m, copy.scale * p.radius_m, tolerance) << "sphere " << i;
  }
  EXPECT_NEAR(there.metrics.E_r, here.metrics.E_r, 1e-9);
}

void ExpectCopiesFollow(const formats::PolygonSoup& soup) {
  const FitResult here = FitOrDie(soup, AllParts(64));
  for (const Copy& copy : Copies()) {
    SCOPED_TRACE(copy.name);
    formats::PolygonSoup moved = soup;
    for (Eigen::Vector3d& p : moved.positions) p = copy.Apply(p);
    ExpectFollows(here, FitOrDie(moved, AllParts(64)), copy);
  }
}

TEST(Fit, FollowsTheMannequinIntoAnyFrameAndUnit) { ExpectCopiesFollow(Mannequin()); }

TEST(Fit, FollowsRealBodiesIntoAnyFrameAndUnit) {
  CAPFIT_REQUIRE_BODIES();
  for (const char* const file : {"broken/good_5k.obj", "broken/one_arm_up.obj"}) {
    SCOPED_TRACE(file);
    ExpectCopiesFollow(Read(test_support::BodiesFolder() / file));
  }
}

TEST(Fit, WeightsCarryTheCentresThroughMotionAndScale) {
  const formats::PolygonSoup soup = Mannequin();
  FitOptions options = AllParts(64);
  options.skinning = SkinningMode::kDense;
  const FitResult result = FitOrDie(soup, options);
  ASSERT_TRUE(result.weights.has_value());
  ASSERT_EQ(result.weights->vertex_count, soup.positions.size());
  const ThreadPool pool(2);
  const auto centers = skinning::Apply(*result.weights, soup.positions, pool);
  for (std::size_t i = 0; i < centers.size(); ++i) {
    EXPECT_LE((centers[i] - result.primitives.spheres[i].center_m).norm(), 1.7e-6) << i;
  }
}

TEST(Fit, ReportsStagesInOrderAndTimeThatAddsUp) {
  class Recorder final : public FitObserver {
   public:
    void OnStage(Stage stage, double fraction_done) override {
      if (!stages.empty()) {
        EXPECT_GE(fraction_done, last_fraction);
      }
      last_fraction = fraction_done;
      stages.push_back(stage);
    }
    [[nodiscard]] bool IsCancelled() const override { return false; }
    std::vector<Stage> stages;
    double last_fraction = 0.0;
  };
  const ThreadPool pool(1);
  Recorder recorder;
  const auto result = Fit(Mannequin(), AllParts(64), pool, recorder);
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_TRUE(std::is_sorted(recorder.stages.begin(), recorder.stages.end()));
  EXPECT_EQ(recorder.stages.front(), Stage::kMesh);
  EXPECT_EQ(recorder.stages.back(), Stage::kMetrics);
  double sum = 0.0;
  for (const double seconds : result->stage_seconds) sum += seconds;
  EXPECT_NEAR(sum, result->seconds, 0.01 * result->seconds + 1e-3);
}

TEST(Fit, StopsWhenNobodyWaits) {
  class Impatient final : public FitObserver {
   public:
    void OnStage(Stage, double) override {}
    [[nodiscard]] bool IsCancelled() const override { return true; }
  };
  const ThreadPool pool(1);
  Impatient observer;
  const auto result = Fit(Mannequin(), AllParts(64), pool, observer);
  EXPECT_EQ(result.status().code(), absl::StatusCode::kCancelled);
}

TEST(Fit, RealBodiesAreEnclosed) {
  CAPFIT_REQUIRE_BODIES();
  for (const std::filesystem::path& file : test_support::BodyFiles()) {
    SCOPED_TRACE(file.filename().string());
    const formats::PolygonSoup soup = Read(file);
    const bool is_cut = file.string().find("no_hands") != std::string::npos;
    for (const int budget : {64, 128}) {
      const FitResult result = FitOrDie(soup, AllParts(budget));
      EXPECT_LE(result.metrics.n_p, budget);
      EXPECT_GE(result.metrics.n_p, budget - 3);
      EXPECT_LE(FurthestOut(soup, result), kJudgeTolerance_m);
      EXPECT_LE(result.metrics.uncovered, 0.002);
      if (is_cut) {
        EXPECT_LE(result.metrics.E_r, budget == 64 ? 0.55 : 0.42);
      }
    }
  }
}

}  // namespace
}  // namespace capfit::pipeline
