// The histogram and the loops of `capfit load`, with calls that are made up.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "client/load_run.h"

namespace capfit::client {
namespace {

TEST(LatencyHistogram, QuantilesAreAtMostABucketTooLarge) {
  LatencyHistogram times;
  for (int i = 1; i <= 1000; ++i) times.Add(1e-3 * i);
  for (const double fraction : {0.5, 0.9, 0.99, 0.999}) {
    EXPECT_GE(times.Quantile(fraction), fraction * 0.999999);
    EXPECT_LE(times.Quantile(fraction), fraction * 1.023);
  }
  EXPECT_EQ(times.Quantile(1.0), 1.0);
  EXPECT_NEAR(times.mean_seconds(), 0.5005, 1e-9);
}

TEST(LatencyHistogram, TakesNothingAndTheWidestRange) {
  LatencyHistogram times;
  EXPECT_EQ(times.Quantile(0.5), 0.0);
  times.Add(0.0);
  times.Add(1e9);
  EXPECT_LE(times.Quantile(0.5), 2e-6);
  LatencyHistogram sum;
  sum.Add(times);
  sum.Add(times);
  EXPECT_EQ(sum.count(), 4);
  EXPECT_EQ(sum.max_seconds(), 1e9);
}

const std::vector<LoadBody> kTwo = {{"small", "s"}, {"large", "llll"}};

TEST(RunLoad, CountsWhatIsWrong) {
  LoadPlan plan;
  plan.rate = 1e9;
  plan.clients = 1;
  std::atomic<int> number{0};
  plan.seconds = 8.5 / plan.rate;  // nine calls, whatever the clock says
  const LoadTally tally = RunLoad(kTwo, plan, [&](const LoadBody& body) -> LoadAnswer {
    switch (number++) {
      case 0:
        return {absl::UnavailableError("gone"), "", 0, false};
      case 1:
        return {absl::ResourceExhaustedError("full"), "", 0, true};
      case 2:
        return {absl::ResourceExhaustedError("full"), "", 0, false};
      case 3:
        return {absl::OkStatus(), "", 0, false};
      default:
        return {absl::OkStatus(), body.name + (number == 9 ? "x" : ""), 2, false};
    }
  });
  EXPECT_EQ(number, 9);
  EXPECT_EQ(tally.codes.at("UNAVAILABLE"), 1);
  EXPECT_EQ(tally.codes.at("RESOURCE_EXHAUSTED"), 2);
  EXPECT_EQ(tally.codes.at("OK"), 6);
  EXPECT_EQ(tally.refused_without_pushback, 1);
  EXPECT_EQ(tally.empty_results, 1);
  EXPECT_GE(tally.differing_results, 1);
  EXPECT_EQ(tally.first_message.at("UNAVAILABLE"), "gone");
  EXPECT_FALSE(tally.IsGood(false));
}

TEST(RunLoad, CallsComeAtTheirRateThoughAnswersTakeLong) {
  LoadPlan plan;
  plan.seconds = 0.2;
  plan.rate = 50.0;
  plan.clients = 1;
  const LoadTally tally = RunLoad(kTwo, plan, [](const LoadBody& body) -> LoadAnswer {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return {absl::OkStatus(), body.name, 1, false};
  });
  // One client needs 0.5 s for the 10 calls of 0.2 s, and the last waits for all before it.
  EXPECT_EQ(tally.answered.count(), 10);
  EXPECT_GE(tally.answered.max_seconds(), 0.3);
  EXPECT_GE(tally.late_calls, 5);
  EXPECT_TRUE(tally.IsGood(true));
}

}  // namespace
}  // namespace capfit::client
