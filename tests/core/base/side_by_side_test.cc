#include "core/base/side_by_side.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <new>
#include <thread>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/base/work_meter.h"

namespace capfit {
namespace {

class Recorder final : public FitObserver {
 public:
  void OnStage(Stage, double) override {}
  void OnFraction(double fraction_of_stage) override {
    fractions.push_back(fraction_of_stage);
    is_owner = is_owner && std::this_thread::get_id() == owner;
  }
  [[nodiscard]] bool IsCancelled() const override { return is_cancelled; }

  std::vector<double> fractions;
  std::thread::id owner = std::this_thread::get_id();
  bool is_owner = true;
  std::atomic<bool> is_cancelled = false;
};

TEST(SideBySideTest, TheWorksFillTheirSharesOfThePart) {
  Recorder recorder;
  SideBySide both(recorder, 0.25, 0.75, {0.5, 0.5});
  both.of(0).OnFraction(0.5);
  both.of(1).OnFraction(1.0);
  both.of(0).OnFraction(1.0);
  EXPECT_EQ(recorder.fractions, (std::vector<double>{0.375, 0.625, 0.75}));
}

TEST(SideBySideTest, OnlyTheOwnersThreadTellsAndItNeverFalls) {
  constexpr int kSteps = 1000;
  for (int round = 0; round < 20; ++round) {
    Recorder recorder;
    SideBySide both(recorder, 0.0, 1.0, {0.75, 0.25});
    both.Run(ThreadPool(2), [](std::size_t /*work*/, FitObserver& observer) {
      WorkMeter meter(observer);
      meter.Expect(1.0, kSteps);
      for (int i = 0; i < kSteps; ++i) meter.Add(1);
    });
    EXPECT_EQ(recorder.fractions.size(), kSteps + 1U);
    EXPECT_TRUE(recorder.is_owner);
    EXPECT_TRUE(std::is_sorted(recorder.fractions.begin(), recorder.fractions.end()));
    EXPECT_GE(recorder.fractions.back(), 0.75);
    EXPECT_LE(recorder.fractions.back(), 1.0);
  }
}

TEST(SideBySideTest, AWorkOfItsOwnForEachThreadAndOneAfterTheOtherOnOne) {
  for (const int threads : {1, 2}) {
    Recorder recorder;
    SideBySide three(recorder, 0.0, 1.0, {0.5, 0.25, 0.25});
    std::vector<std::thread::id> ids(3);
    three.Run(ThreadPool(threads),
              [&](std::size_t work, FitObserver&) { ids[work] = std::this_thread::get_id(); });
    EXPECT_EQ(ids[0], std::this_thread::get_id());
    EXPECT_EQ(ids[1] == ids[0], threads == 1);
    EXPECT_EQ(ids[2] == ids[0], threads == 1);
  }
}

TEST(SideBySideTest, WhatAWorkThrowsComesBack) {
  Recorder recorder;
  for (const std::size_t thrower : {0U, 1U}) {
    SideBySide both(recorder, 0.0, 1.0, {0.5, 0.5});
    EXPECT_THROW(both.Run(ThreadPool(2),
                          [&](std::size_t work, FitObserver&) {
                            if (work == thrower) throw std::bad_alloc();
                          }),
                 std::bad_alloc);
  }
}

TEST(SideBySideTest, AllAreCancelledTogether) {
  Recorder recorder;
  SideBySide both(recorder, 0.0, 1.0, {0.5, 0.5});
  EXPECT_FALSE(both.of(0).IsCancelled());
  recorder.is_cancelled = true;
  EXPECT_TRUE(both.of(0).IsCancelled());
  EXPECT_TRUE(both.of(1).IsCancelled());
}

}  // namespace
}  // namespace capfit
