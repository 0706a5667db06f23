#include "server/fit_executor.h"

#include <gtest/gtest.h>

#include <future>

namespace capfit::server {
namespace {

TEST(FitExecutor, AdmitsAsManyAsFitAndWait) {
  FitExecutor executor(2, 1);
  std::vector<FitExecutor::Place> places;
  for (int i = 0; i < 3; ++i) {
    places.push_back(executor.TryTakePlace());
    EXPECT_NE(places.back(), nullptr);
  }
  EXPECT_EQ(executor.TryTakePlace(), nullptr);
  places.pop_back();
  EXPECT_NE(executor.TryTakePlace(), nullptr) << "a place given back can be taken again";
}

TEST(FitExecutor, RunsAsManyAtATimeAsItHasThreads) {
  FitExecutor executor(2, 10);
  std::promise<void> first_runs;
  std::promise<void> second_runs;
  // Each waits for the other: done only when both run at the same time.
  executor.Submit([&] {
    first_runs.set_value();
    second_runs.get_future().wait();
  });
  std::promise<void> done;
  executor.Submit([&] {
    first_runs.get_future().wait();
    second_runs.set_value();
    done.set_value();
  });
  EXPECT_EQ(done.get_future().wait_for(std::chrono::seconds(30)), std::future_status::ready);
}

TEST(FitExecutor, RunsWhatIsQueuedInOrderBeforeItEnds) {
  std::vector<int> order;
  {
    FitExecutor executor(1, 100);
    for (int i = 0; i < 50; ++i) executor.Submit([&order, i] { order.push_back(i); });
  }
  ASSERT_EQ(order.size(), 50U);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(order[static_cast<std::size_t>(i)], i);
}

}  // namespace
}  // namespace capfit::server
