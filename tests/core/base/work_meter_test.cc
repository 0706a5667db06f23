#include "core/base/work_meter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <vector>

#include "core/base/thread_pool.h"

namespace capfit {
namespace {

class Listener final : public FitObserver {
 public:
  void OnStage(Stage, double) override {}
  void OnFraction(double fraction_of_stage) override {
    fractions.push_back(fraction_of_stage);
    is_owner = is_owner && std::this_thread::get_id() == owner;
  }
  [[nodiscard]] bool IsCancelled() const override { return false; }

  std::vector<double> fractions;
  std::thread::id owner = std::this_thread::get_id();
  bool is_owner = true;
};

TEST(WorkMeterTest, PartsFollowEachOtherAndWorkFillsThem) {
  Listener listener;
  WorkMeter meter(listener);
  meter.Expect(0.5, 4);
  meter.Add(1);
  meter.Add(2);
  meter.Expect(1.0, 10);
  meter.Add(5);
  meter.Add(50);
  EXPECT_EQ(listener.fractions, (std::vector<double>{0.0, 0.125, 0.375, 0.5, 0.75, 1.0}));
}

TEST(WorkMeterTest, RoundsOfUnknownNumberNeverReachTheEnd) {
  Listener listener;
  WorkMeter meter(listener);
  for (int round = 0; round < 20; ++round) {
    meter.ExpectShare(0.25, 0.8, 1);
    meter.Add(1);
  }
  EXPECT_TRUE(std::is_sorted(listener.fractions.begin(), listener.fractions.end()));
  EXPECT_GT(listener.fractions.back(), 0.79);
  EXPECT_LT(listener.fractions.back(), 0.8);
}

TEST(WorkMeterTest, WhatWasExpectedTooEarlyDoesNotTakeItBack) {
  Listener listener;
  WorkMeter meter(listener);
  meter.Expect(0.6, 1);
  meter.Expect(0.4, 1);
  meter.Add(1);
  EXPECT_EQ(listener.fractions, (std::vector<double>{0.0, 0.6, 0.6}));
}

TEST(WorkMeterTest, WorkOfAllThreadsCountsAndOneThreadTells) {
  Listener listener;
  WorkMeter meter(listener);
  meter.Expect(0.5, 1000);
  ThreadPool(4).ForEach(1000, [&](std::size_t) { meter.Add(1); });
  meter.Add(0);
  EXPECT_TRUE(listener.is_owner);
  EXPECT_TRUE(std::is_sorted(listener.fractions.begin(), listener.fractions.end()));
  EXPECT_EQ(listener.fractions.back(), 0.5);
}

TEST(QuietObserverTest, SaysNothingAndCancelsWithTheOther) {
  struct Other final : FitObserver {
    void OnStage(Stage, double) override { ++calls; }
    void OnFraction(double) override { ++calls; }
    [[nodiscard]] bool IsCancelled() const override { return is_cancelled; }
    int calls = 0;
    bool is_cancelled = false;
  } other;
  QuietObserver quiet(other);
  WorkMeter meter(quiet);
  meter.Expect(1.0, 2);
  meter.Add(2);
  quiet.OnStage(Stage::kCoverage, 0.5);
  EXPECT_EQ(other.calls, 0);
  EXPECT_FALSE(meter.IsCancelled());
  other.is_cancelled = true;
  EXPECT_TRUE(meter.IsCancelled());
}

}  // namespace
}  // namespace capfit
