#include "server/fit_executor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <thread>

namespace capfit::server {
namespace {

TEST(FitExecutor, RunsAsManyAtATimeAsItHasThreads) {
  FitExecutor executor(2);
  std::promise<void> first_runs;
  std::promise<void> second_runs;
  // Each waits for the other: done only when both run at the same time.
  executor.Submit({}, [&] {
    first_runs.set_value();
    second_runs.get_future().wait();
  });
  std::promise<void> done;
  executor.Submit({}, [&] {
    first_runs.get_future().wait();
    second_runs.set_value();
    done.set_value();
  });
  EXPECT_EQ(done.get_future().wait_for(std::chrono::seconds(30)), std::future_status::ready);
}

TEST(FitExecutor, RunsWhatIsQueuedInOrderBeforeItEnds) {
  std::vector<int> order;
  {
    FitExecutor executor(1);
    for (int i = 0; i < 50; ++i) executor.Submit({}, [&order, i] { order.push_back(i); });
  }
  ASSERT_EQ(order.size(), 50U);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(order[i], i);
}

TEST(FitExecutor, AJobThatWaitsCanBeTakenBackOnce) {
  FitExecutor executor(1);
  std::promise<void> begun;
  std::promise<void> go_on;
  executor.Submit({}, [&] {
    begun.set_value();
    go_on.get_future().wait();
  });
  begun.get_future().wait();
  bool has_run = false;
  const FitExecutor::Ticket ticket = executor.Submit({}, [&] { has_run = true; });
  EXPECT_EQ(executor.waiting(), 1U);
  EXPECT_TRUE(executor.Withdraw(ticket));
  EXPECT_FALSE(executor.Withdraw(ticket));
  EXPECT_EQ(executor.waiting(), 0U);
  go_on.set_value();
  EXPECT_FALSE(has_run);
}

TEST(FitExecutor, KnowsHowLongAFitWouldWait) {
  FitExecutor executor(2);
  EXPECT_EQ(executor.ExpectedWaitSeconds({"", false, 5.0}), 0.0);
  std::promise<void> go_on;
  const std::shared_future<void> gate = go_on.get_future().share();
  const auto submit = [&](double expected_seconds) {
    executor.Submit({"", false, expected_seconds}, [gate] { gate.wait(); });
  };
  submit(5.0);
  while (executor.running() < 1) std::this_thread::yield();
  EXPECT_EQ(executor.ExpectedWaitSeconds({"", false, 5.0}), 0.0) << "one place is free";
  submit(5.0);
  while (executor.running() < 2) std::this_thread::yield();
  submit(3.0);
  // What is left of the two that run shrinks while we look; what waits does not.
  const double behind = executor.ExpectedWaitSeconds({"", false, 5.0});
  const double in_front = executor.ExpectedWaitSeconds({"", false, 1.0});
  EXPECT_LE(behind, (5.0 + 5.0 + 3.0) / 2.0);
  EXPECT_GE(behind, 3.0 / 2.0);
  EXPECT_LE(in_front, (5.0 + 5.0) / 2.0);
  go_on.set_value();
}

TEST(FitExecutor, LongJobsLeaveAPlaceToShortOnes) {
  FitExecutor executor(2);
  std::promise<void> go_on;
  const std::shared_future<void> gate = go_on.get_future().share();
  std::atomic<int> long_begun{0};
  for (int i = 0; i < 2; ++i) {
    executor.Submit({"", false, 2 * kLongFitSeconds}, [&] {
      ++long_begun;
      gate.wait();
    });
  }
  while (long_begun == 0) std::this_thread::yield();
  std::promise<void> done;
  executor.Submit({"", false, 0.1}, [&] { done.set_value(); });
  EXPECT_EQ(done.get_future().wait_for(std::chrono::seconds(30)), std::future_status::ready);
  EXPECT_EQ(long_begun, 1);
  go_on.set_value();
}

}  // namespace
}  // namespace capfit::server
