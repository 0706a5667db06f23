#include "core/base/backlog.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>
#include <vector>

namespace capfit {
namespace {

class BacklogTest : public testing::TestWithParam<int> {
 protected:
  const ThreadPool pool_{GetParam()};
  NullObserver observer_;
};

TEST_P(BacklogTest, DoesEachStepOnceAndLoopsInOrder) {
  Backlog backlog(pool_, observer_);
  std::array<std::vector<std::atomic<int>>, 3> done = {std::vector<std::atomic<int>>(50),
                                                       std::vector<std::atomic<int>>(1),
                                                       std::vector<std::atomic<int>>(30)};
  const auto count = [](const std::vector<std::atomic<int>>& loop) {
    int sum = 0;
    for (const std::atomic<int>& calls : loop) sum += calls;
    return sum;
  };
  for (std::size_t k = 0; k < done.size(); ++k) {
    backlog.Add(done[k].size(), [&, k](std::size_t i) {
      for (std::size_t before = 0; before < k; ++before) {
        EXPECT_EQ(count(done[before]), static_cast<int>(done[before].size()));
      }
      ++done[k][i];
    });
  }
  int works = 0;
  for (int i = 0; i < 10; ++i) {
    backlog.Beside([&, caller = std::this_thread::get_id()] {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      ++works;
    });
  }
  EXPECT_EQ(works, 10);
  backlog.Finish();
  for (const auto& loop : done) {
    for (const std::atomic<int>& calls : loop) EXPECT_EQ(calls, 1);
  }
}

TEST_P(BacklogTest, AStepThatIsAloneMayAddMore) {
  Backlog backlog(pool_, observer_);
  std::vector<std::atomic<int>> last(20);
  backlog.Add(1, [&](std::size_t) { backlog.Add(last.size(), [&](std::size_t i) { ++last[i]; }); });
  backlog.Add(0, [](std::size_t) { FAIL(); });
  backlog.Beside([] {});
  backlog.Finish();
  for (const std::atomic<int>& calls : last) EXPECT_EQ(calls, 1);
}

TEST_P(BacklogTest, WorkMayUseThePoolToo) {
  Backlog backlog(pool_, observer_);
  std::atomic<int> steps = 0;
  std::atomic<int> sum = 0;
  backlog.Add(200, [&](std::size_t) { ++steps; });
  backlog.Beside([&] { pool_.ForEach(100, [&](std::size_t) { ++sum; }); });
  EXPECT_EQ(sum, 100);
  backlog.Finish();
  EXPECT_EQ(steps, 200);
}

TEST_P(BacklogTest, WhoGivesUpGetsNoMoreOfIt) {
  class GivesUp final : public FitObserver {
   public:
    void OnStage(Stage, double) override {}
    [[nodiscard]] bool IsCancelled() const override { return has_given_up; }
    std::atomic<bool> has_given_up = false;
  };
  GivesUp observer;
  Backlog backlog(pool_, observer);
  std::atomic<int> first = 0;
  backlog.Add(1, [&](std::size_t) {
    ++first;
    observer.has_given_up = true;
  });
  backlog.Add(10, [](std::size_t) { FAIL(); });
  backlog.Finish();
  EXPECT_EQ(first, 1);
  int works = 0;
  backlog.Beside([&] { ++works; });
  EXPECT_EQ(works, 1);
}

INSTANTIATE_TEST_SUITE_P(Threads, BacklogTest, testing::Values(1, 2, 7));

// With a thread to spare, steps are done while the work waits for them.
TEST(Backlog, IsDoneBesideTheWork) {
  const ThreadPool pool(2);
  const NullObserver observer;
  Backlog backlog(pool, observer);
  std::atomic<bool> is_done = false;
  backlog.Add(1, [&](std::size_t) {
    is_done = true;
    is_done.notify_all();
  });
  backlog.Beside([&] { is_done.wait(false); });
  EXPECT_TRUE(is_done);
}

}  // namespace
}  // namespace capfit
