#include "server/fit_queue.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace capfit::server {
namespace {

using Ticket = FitQueue::Ticket;

std::vector<Ticket> TakeAll(FitQueue& queue, double now_seconds) {
  std::vector<Ticket> order;
  while (const std::optional<Ticket> next = queue.TakeNext(now_seconds, true)) {
    order.push_back(*next);
  }
  return order;
}

TEST(FitQueue, EqualsGoInTheOrderInWhichTheyCame) {
  FitQueue queue;
  std::vector<Ticket> came;
  for (int i = 0; i < 5; ++i) came.push_back(queue.Add({"a", false, 0.0}, i));
  EXPECT_EQ(TakeAll(queue, 5.0), came);
  EXPECT_EQ(queue.TakeNext(6.0, true), std::nullopt);
}

TEST(FitQueue, ShortOnesPassLongOnesUntilTheyHaveWaitedForTheDifference) {
  FitQueue queue;
  const Ticket long_one = queue.Add({"a", false, 8.0}, 0.0);
  const Ticket before = queue.Add({"b", false, 1.0}, 6.9);
  EXPECT_EQ(queue.TakeNext(6.9, true), before);
  queue.Add({"c", false, 1.0}, 7.1);
  EXPECT_EQ(queue.TakeNext(7.1, true), long_one);
}

TEST(FitQueue, ClientsTakeTurnsHoweverManyCallsTheySend) {
  FitQueue queue;
  std::vector<Ticket> greedy;
  for (int i = 0; i < 4; ++i) greedy.push_back(queue.Add({"greedy", false, 1.0}, 0.0));
  const Ticket modest_1 = queue.Add({"modest", false, 1.0}, 0.0);
  const Ticket modest_2 = queue.Add({"modest", false, 1.0}, 0.0);
  const std::vector<Ticket> expected = {greedy[0], modest_1,  greedy[1],
                                        modest_2,  greedy[2], greedy[3]};
  EXPECT_EQ(TakeAll(queue, 0.0), expected);
}

TEST(FitQueue, WhatAClientGotIsHalfForgottenAfterTheHalfLife) {
  for (const bool has_waited : {false, true}) {
    FitQueue queue;
    queue.Add({"a", false, 4.0}, 0.0);
    static_cast<void>(queue.TakeNext(0.0, true));
    // 4 s are 2 s by then: more than the other's 1.5 s of waiting, less than its 2.5 s.
    const double now = kHalfLifeSeconds;
    const Ticket charged = queue.Add({"a", false, 1.0}, has_waited ? now - 2.5 : now - 1.5);
    const Ticket fresh = queue.Add({"b", false, 1.0}, now);
    EXPECT_EQ(queue.TakeNext(now, true), has_waited ? charged : fresh);
  }
}

TEST(FitQueue, BulkWaitsBehindInteractiveButNotForEver) {
  FitQueue queue;
  const Ticket bulk = queue.Add({"a", true, 1.0}, 0.0);
  const Ticket early = queue.Add({"b", false, 1.0}, kBulkHandicapSeconds - 0.1);
  EXPECT_EQ(queue.TakeNext(kBulkHandicapSeconds - 0.1, true), early);
  queue.Add({"c", false, 1.0}, kBulkHandicapSeconds + 0.1);
  EXPECT_EQ(queue.TakeNext(kBulkHandicapSeconds + 0.1, true), bulk);
}

TEST(FitQueue, LongOnesAreLeftWhereTheyMayNotBegin) {
  FitQueue queue;
  const Ticket long_one = queue.Add({"a", false, kLongFitSeconds + 1.0}, 0.0);
  EXPECT_EQ(queue.TakeNext(1000.0, false), std::nullopt);
  const Ticket short_one = queue.Add({"a", false, 1.0}, 1000.0);
  EXPECT_EQ(queue.TakeNext(1000.0, false), short_one);
  EXPECT_EQ(queue.TakeNext(1000.0, true), long_one);
}

TEST(FitQueue, KnowsTheWorkThatGoesBeforeAFit) {
  FitQueue queue;
  queue.Add({"a", false, 4.0}, 0.0);
  queue.Add({"b", false, 1.0}, 0.0);
  queue.Add({"c", true, 1.5}, 0.0);
  const auto before = [&](double expected_seconds, bool is_bulk) {
    return queue.SecondsBefore({"d", is_bulk, expected_seconds}, 0.0);
  };
  EXPECT_EQ(before(0.5, false), 0.0);
  EXPECT_EQ(before(1.0, false), 1.0) << "equals go in the order in which they came";
  EXPECT_EQ(before(5.0, false), 5.0);
  EXPECT_EQ(before(5.0, true), 6.5);
}

TEST(FitQueue, WhatWasRemovedIsNotTaken) {
  FitQueue queue;
  const Ticket first = queue.Add({"a", false, 1.0}, 0.0);
  const Ticket second = queue.Add({"a", false, 1.0}, 0.0);
  EXPECT_TRUE(queue.Remove(first));
  EXPECT_FALSE(queue.Remove(first));
  EXPECT_EQ(TakeAll(queue, 0.0), std::vector<Ticket>{second});
  EXPECT_FALSE(queue.Remove(second));
}

}  // namespace
}  // namespace capfit::server
