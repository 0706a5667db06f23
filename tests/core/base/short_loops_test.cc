#include "core/base/short_loops.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <vector>

namespace capfit {
namespace {

class ShortLoopsTest : public testing::TestWithParam<int> {};

// Each step once, and none before the loop that it belongs to or after it: plain numbers would show
// it, and a race would be seen under ThreadSanitizer.
TEST_P(ShortLoopsTest, EachStepOfEachLoopIsDoneOnceAndInItsTurn) {
  const ThreadPool pool(GetParam());
  std::vector<int> done(8, 0);
  ShortLoops::Run(pool, GetParam(), [&](ShortLoops& loops) {
    for (int loop = 0; loop < 20000; ++loop) {
      const std::size_t count = loop % 9;
      loops.ForEach(count, [&](std::size_t i) {
        if (done[i] == loop) done[i] = loop + 1;
      });
      for (std::size_t i = 0; i < done.size(); ++i) {
        ASSERT_EQ(done[i], i < count ? loop + 1 : loop) << "loop " << loop << ", step " << i;
        done[i] = loop + 1;
      }
    }
  });
}

TEST_P(ShortLoopsTest, MayRunWithinALoopOfThePool) {
  const ThreadPool pool(GetParam());
  std::vector<int> sums(20, 0);
  pool.ForEach(sums.size(), [&](std::size_t k) {
    std::vector<int> parts(5, 0);
    ShortLoops::Run(pool, 4, [&](ShortLoops& loops) {
      for (int loop = 0; loop < 200; ++loop) {
        loops.ForEach(parts.size(), [&](std::size_t i) { parts[i] += static_cast<int>(i); });
      }
    });
    for (const int part : parts) sums[k] += part;
  });
  EXPECT_EQ(sums, std::vector<int>(sums.size(), 200 * (0 + 1 + 2 + 3 + 4)));
}

INSTANTIATE_TEST_SUITE_P(Threads, ShortLoopsTest, testing::Values(1, 2, 7));

// Another thread comes at some time, and then takes the last steps.
TEST(ShortLoopsTest, IdleThreadsHelp) {
  const ThreadPool pool(2);
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  std::atomic<bool> is_done = false;
  ShortLoops::Run(pool, 2, [&](ShortLoops& loops) {
    // Until two steps were at work at the same time.
    while (!is_done && std::chrono::steady_clock::now() < until) {
      std::atomic<int> there = 0;
      loops.ForEach(2, [&](std::size_t i) {
        ++there;
        if (i == 0) {
          for (int wait = 0; wait < 100000 && !is_done; ++wait) is_done = there == 2;
        }
      });
    }
  });
  EXPECT_TRUE(is_done);
}

TEST(ShortLoopsTest, NobodyHelpsWhereEachThreadHasAJobOfItsOwn) {
  const ThreadPool pool(2);
  const ThreadPool::Job one(pool);
  const ThreadPool::Job other(pool);
  std::size_t last = 0;
  bool is_in_order = true;
  ShortLoops::Run(pool, 2, [&](ShortLoops& loops) {
    for (int loop = 0; loop < 1000; ++loop) {
      last = 0;
      loops.ForEach(8, [&](std::size_t i) {
        is_in_order = is_in_order && i >= last;
        last = i;
      });
    }
  });
  EXPECT_TRUE(is_in_order);
}

}  // namespace
}  // namespace capfit
