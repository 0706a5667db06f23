#include "core/pipeline/stage_clock.h"

#include <algorithm>
#include <numeric>

#include "core/base/enum_index.h"

namespace capfit::pipeline {
namespace {

// Milliseconds of each stage on a body of 64k triangles with 64 primitives, rounded: only their
// ratios count.
constexpr double kMeshMs = 10.0;
constexpr double kBodyMs = 35.0;
constexpr double kSectionMs = 5.0;
constexpr double kCircleMs = 50.0;
constexpr double kCapsuleMs = 2.0;
constexpr double kSettleMs = 90.0;
constexpr double kRefineMs = 200.0;
constexpr double kBalancedRefineMs = 35.0;
constexpr double kCoverageMs = 80.0;
constexpr double kCoverageOfRefinedMs = 30.0;
constexpr double kMetricsMs = 20.0;
constexpr double kDenseWeightsMs = 400.0;
constexpr double kSparseWeightsMs = 10.0;

// What is worth a message.
constexpr double kSmallestStep = 0.005;

std::array<double, kStageCount> SharesOf(const FitOptions& options) {
  const bool is_searched = options.quality != Quality::kPaper;
  const bool is_best = options.fit == FitMode::kBestFit;
  const bool has_polygons =
      !is_searched || options.want_polygons || options.polygon_error.has_value();
  std::array<double, kStageCount> shares{};
  const auto set = [&](Stage stage, double ms) { shares[Index(stage)] = ms; };
  set(Stage::kMesh, kMeshMs);
  set(Stage::kBody, kBodyMs);
  if (has_polygons) {
    set(Stage::kSection, kSectionMs);
    set(Stage::kCircle, kCircleMs);
    set(Stage::kCapsule, kCapsuleMs);
  }
  if (is_searched || is_best) {
    set(Stage::kRefine, options.quality == Quality::kTight      ? kRefineMs
                        : options.quality == Quality::kBalanced ? kBalancedRefineMs
                                                                : kSettleMs);
  }
  set(Stage::kCoverage, is_searched || is_best ? kCoverageOfRefinedMs : kCoverageMs);
  set(Stage::kMetrics, kMetricsMs);
  if (options.skinning != SkinningMode::kNone) {
    set(Stage::kSkinning,
        options.skinning == SkinningMode::kDense ? kDenseWeightsMs : kSparseWeightsMs);
  }
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= sum;
  return shares;
}

double Seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

StageClock::StageClock(const FitOptions& options, FitObserver& observer, FitResult& result)
    : observer_(observer), result_(result), shares_(SharesOf(options)) {}

void StageClock::Begin(Stage stage) {
  End();
  current_ = stage;
  stage_start_ = Clock::now();
  const double before =
      std::accumulate(shares_.begin(), shares_.begin() + static_cast<int>(stage), 0.0);
  fraction_done_ = std::max(fraction_done_, before);
  observer_.OnStage(stage, fraction_done_);
}

void StageClock::End() {
  if (!current_.has_value()) return;
  result_.stage_seconds[Index(*current_)] += Seconds(Clock::now() - stage_start_);
  result_.seconds = Seconds(Clock::now() - start_);
  current_.reset();
}

void StageClock::OnFraction(double fraction_of_stage) {
  if (!current_.has_value()) return;
  const std::size_t stage = Index(*current_);
  const double before = std::accumulate(shares_.begin(), shares_.begin() + stage, 0.0);
  const double done = before + std::clamp(fraction_of_stage, 0.0, 1.0) * shares_[stage];
  if (done < fraction_done_ + kSmallestStep) return;
  fraction_done_ = done;
  observer_.OnStage(*current_, done);
}

}  // namespace capfit::pipeline
