#include "core/base/thread_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <thread>
#include <vector>

namespace capfit {
namespace {

class ThreadPoolTest : public testing::TestWithParam<int> {};

TEST_P(ThreadPoolTest, CallsEachIndexOnce) {
  const ThreadPool pool(GetParam());
  std::vector<std::atomic<int>> calls(1000);
  pool.ForEach(calls.size(), [&](std::size_t i) { ++calls[i]; });
  for (const auto& count : calls) EXPECT_EQ(count, 1);
}

TEST_P(ThreadPoolTest, ChunksAreTheSameForAnyNumberOfThreads) {
  const ThreadPool pool(GetParam());
  std::vector<std::size_t> begin_of(103, 999);
  pool.ForChunks(103, 10, [&](std::size_t begin, std::size_t end) {
    EXPECT_LE(end - begin, 10u);
    for (std::size_t i = begin; i < end; ++i) begin_of[i] = begin;
  });
  for (std::size_t i = 0; i < begin_of.size(); ++i) EXPECT_EQ(begin_of[i], i / 10 * 10);
}

TEST_P(ThreadPoolTest, LoopsNest) {
  const ThreadPool pool(GetParam());
  std::atomic<int> sum = 0;
  pool.ForEach(20, [&](std::size_t) { pool.ForEach(50, [&](std::size_t) { ++sum; }); });
  EXPECT_EQ(sum, 1000);
}

TEST_P(ThreadPoolTest, ServesSeveralCallersAtOnce) {
  const ThreadPool pool(GetParam());
  std::atomic<int> sum = 0;
  std::vector<std::thread> callers;
  for (int i = 0; i < 4; ++i) {
    callers.emplace_back([&] { pool.ForEach(100, [&](std::size_t) { ++sum; }); });
  }
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(sum, 400);
}

TEST_P(ThreadPoolTest, NothingToDoIsFine) {
  const ThreadPool pool(GetParam());
  pool.ForEach(0, [](std::size_t) { FAIL(); });
}

INSTANTIATE_TEST_SUITE_P(Threads, ThreadPoolTest, testing::Values(1, 2, 7));

// Whether both turns of a loop are taken at the same time, each waiting for the other.
bool HelpComes(const ThreadPool& pool) {
  std::atomic<int> there = 0;
  std::atomic<bool> met = false;
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  pool.ForEach(2, [&](std::size_t i) {
    ++there;
    while (i == 0 && !met && std::chrono::steady_clock::now() < until) met = there == 2;
  });
  return met;
}

TEST(ThreadPool, OthersHelpWhileThereAreFewerJobsThanThreads) {
  const ThreadPool pool(2);
  EXPECT_TRUE(HelpComes(pool));
  const ThreadPool::Job job(pool);
  EXPECT_TRUE(HelpComes(pool));
}

TEST(ThreadPool, WithAJobForEachThreadLoopsStayWithTheirCallers) {
  const ThreadPool pool(2);
  {
    const ThreadPool::Job first(pool);
    const ThreadPool::Job second(pool);
    std::vector<std::thread::id> threads(100);
    pool.ForEach(100, [&](std::size_t i) { threads[i] = std::this_thread::get_id(); });
    EXPECT_EQ(threads, std::vector(100, std::this_thread::get_id()));
    std::vector<std::size_t> begun;
    pool.ForChunks(10, 3, [&](std::size_t begin, std::size_t) { begun.push_back(begin); });
    EXPECT_EQ(begun, (std::vector<std::size_t>{0, 3, 6, 9}));
  }
  EXPECT_TRUE(HelpComes(pool));
}

TEST(ThreadPool, ZeroMeansOnePerCore) { EXPECT_GE(ThreadPool(0).threads(), 1); }

}  // namespace
}  // namespace capfit
