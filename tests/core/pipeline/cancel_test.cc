// How soon a fit ends that its caller has given up, wherever it is by then.
#include <gtest/gtest.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "core/base/enum_index.h"
#include "core/mannequin/mannequin.h"
#include "core/pipeline/fit.h"

namespace capfit::pipeline {
namespace {

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

class GivenUp final : public FitObserver {
 public:
  void OnStage(Stage stage, double /*fraction_done*/) override { stage_ = stage; }
  [[nodiscard]] bool IsCancelled() const override { return is_given_up_; }
  // The stage that is under way, and when this was.
  Stage GiveUp() {
    const Stage stage = stage_;
    when_ = Clock::now();
    is_given_up_ = true;
    return stage;
  }
  [[nodiscard]] Clock::time_point when() const { return when_; }

 private:
  std::atomic<Stage> stage_{Stage::kMesh};
  std::atomic<bool> is_given_up_{false};
  Clock::time_point when_;
};

struct Case {
  std::string name;
  int faces = 20'000;
  FitOptions options;
  friend void PrintTo(const Case& c, std::ostream* os) { *os << c.name; }
};

class CancelTest : public testing::TestWithParam<Case> {
 protected:
  static formats::PolygonSoup Body() {
    mannequin::MannequinOptions options;
    options.faces = GetParam().faces;
    return mannequin::MakeMannequin(options).value();
  }
};

// Cancelled at so many moments, evenly over the time that a whole fit takes.
constexpr int kMoments = 16;
// Of a whole fit, which takes as much longer on a slow machine: a fit that never looked would go on
// for half of it in the middle of all moments. What is printed is what counts.
constexpr double kMostOfWhole = 0.15;

TEST_P(CancelTest, EndsSoonAtEachMomentAndSaysThatItWasCancelled) {
  const formats::PolygonSoup soup = Body();
  const ThreadPool pool(2);
  NullObserver nobody;
  const Clock::time_point begin = Clock::now();
  ASSERT_TRUE(Fit(soup, GetParam().options, pool, nobody).ok());
  const double whole_seconds = SecondsSince(begin);
  std::vector<double> waits;
  std::array<double, kStageCount> worst{};
  for (int i = 0; i < kMoments; ++i) {
    GivenUp observer;
    Stage stage = Stage::kMesh;
    std::thread caller([&] {
      std::this_thread::sleep_for(
          std::chrono::duration<double>(whole_seconds * (i + 0.5) / kMoments));
      stage = observer.GiveUp();
    });
    const auto result = Fit(soup, GetParam().options, pool, observer);
    const Clock::time_point end = Clock::now();
    caller.join();
    if (result.ok()) continue;  // over before its moment came
    EXPECT_EQ(result.status().code(), absl::StatusCode::kCancelled) << result.status();
    const double wait = std::chrono::duration<double>(end - observer.when()).count();
    waits.push_back(wait);
    double& stage_worst = worst[Index(stage)];
    stage_worst = std::max(stage_worst, wait);
  }
  ASSERT_GT(waits.size(), kMoments / 3U);
  std::sort(waits.begin(), waits.end());
  EXPECT_LT(waits[waits.size() / 2], kMostOfWhole * whole_seconds);
  std::printf("%s: %.2f s whole; milliseconds until it ends: median %.1f, worst %.1f;",
              GetParam().name.c_str(), whole_seconds, 1e3 * waits[waits.size() / 2],
              1e3 * waits.back());
  for (int i = 0; i < kStageCount; ++i) {
    const double seconds = worst[i];
    if (seconds > 0.0) {
      std::printf(" %s %.0f", std::string(StageName(static_cast<Stage>(i))).c_str(), 1e3 * seconds);
    }
  }
  std::printf("\n");
}

// Of this thread alone: what others do on the machine does not count.
double OwnSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// For fits on one thread: how much it works between two looks, and after the look that tells it to
// stop.
class Looks final : public FitObserver {
 public:
  // Cancels at that look; 0: never.
  explicit Looks(int last = 0) : last_(last) {}
  void OnStage(Stage, double /*fraction_done*/) override {}
  [[nodiscard]] bool IsCancelled() const override {
    const double now = OwnSeconds();
    if (last_ == 0 || count_ < last_) {
      longest_seconds_ = std::max(longest_seconds_, now - at_seconds_);
      at_seconds_ = now;
      ++count_;
    }
    return last_ > 0 && count_ >= last_;
  }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] double longest_seconds() const { return longest_seconds_; }
  [[nodiscard]] double SecondsSinceLook() const { return OwnSeconds() - at_seconds_; }

 private:
  int last_;
  mutable int count_ = 0;
  mutable double at_seconds_ = OwnSeconds();
  mutable double longest_seconds_ = 0.0;
};

// Of the work of a whole fit, by the processor's clock; printed in milliseconds beside. The longest
// is one pass over 300,000 triangles: 22 of 334 ms.
constexpr double kLongestStretch = 0.15;
constexpr int kLooksTried = 24;

// Of one fit: its seconds, those of its longest stretch and of what follows its last look.
struct Stretches {
  double whole = 0.0;
  double longest = 0.0;
  double last = 0.0;
  int looks = 0;
  [[nodiscard]] double Share() const { return std::max(longest, last) / whole; }
};

Stretches StretchesOf(const formats::PolygonSoup& soup, const FitOptions& options,
                      const ThreadPool& pool) {
  Stretches one;
  const double begin = OwnSeconds();
  Looks looks;
  EXPECT_TRUE(Fit(soup, options, pool, looks).ok());
  one.last = looks.SecondsSinceLook();
  one.whole = OwnSeconds() - begin;
  one.longest = looks.longest_seconds();
  one.looks = looks.count();
  return one;
}

// A busy machine makes this or that stretch longer now and then; one without looks is long in each
// fit.
Stretches ShortestOf(int fits, const formats::PolygonSoup& soup, const FitOptions& options,
                     const ThreadPool& pool) {
  Stretches best = StretchesOf(soup, options, pool);
  for (int i = 1; i < fits; ++i) {
    const Stretches one = StretchesOf(soup, options, pool);
    if (one.Share() < best.Share()) best = one;
  }
  return best;
}

TEST_P(CancelTest, LittleWorkIsDoneBetweenTwoLooksAndAfterTheLast) {
  const formats::PolygonSoup soup = Body();
  const ThreadPool pool(1);
  const Stretches stretches = ShortestOf(3, soup, GetParam().options, pool);
  EXPECT_LT(stretches.longest, kLongestStretch * stretches.whole);
  EXPECT_LT(stretches.last, kLongestStretch * stretches.whole);
  std::vector<double> after;
  for (int i = 0; i < kLooksTried; ++i) {
    Looks cancelled(1 + i * (stretches.looks - 1) / (kLooksTried - 1));
    const auto result = Fit(soup, GetParam().options, pool, cancelled);
    after.push_back(cancelled.SecondsSinceLook());
    EXPECT_EQ(result.status().code(), absl::StatusCode::kCancelled) << result.status();
  }
  const double longest_after = *std::max_element(after.begin(), after.end());
  EXPECT_LT(longest_after, kLongestStretch * stretches.whole);
  std::printf(
      "%s on one thread: %d looks, %.1f ms from one to the next at most of %.0f ms; "
      "%.1f ms after the last\n",
      GetParam().name.c_str(), stretches.looks, 1e3 * stretches.longest, 1e3 * stretches.whole,
      1e3 * longest_after);
}

FitOptions With(Quality quality, SkinningMode skinning, FitMode fit = FitMode::kEnclose) {
  FitOptions options;
  options.quality = quality;
  options.skinning = skinning;
  options.fit = fit;
  return options;
}

INSTANTIATE_TEST_SUITE_P(
    Ways, CancelTest,
    testing::Values(Case{"PaperDense", 20'000, With(Quality::kPaper, SkinningMode::kDense)},
                    Case{"PaperOfManyFaces", 300'000, With(Quality::kPaper, SkinningMode::kNone)},
                    Case{"Tight", 20'000, With(Quality::kTight, SkinningMode::kNone)},
                    Case{"BestTightSparse", 20'000,
                         With(Quality::kTight, SkinningMode::kSparse, FitMode::kBestFit)}),
    [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace capfit::pipeline
