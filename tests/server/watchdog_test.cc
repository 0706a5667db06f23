#include "server/watchdog.h"

#include <gtest/gtest.h>

#include <future>
#include <vector>

namespace capfit::server {
namespace {

TEST(Watchdog, RingsInOrderAndNotBeforeItsTime) {
  const auto begin = Watchdog::Clock::now();
  std::promise<void> last;
  std::vector<int> rung;
  {
    Watchdog watchdog;
    watchdog.Set(begin + std::chrono::milliseconds(60), [&] {
      rung.push_back(2);
      last.set_value();
    });
    watchdog.Set(begin + std::chrono::milliseconds(30), [&] { rung.push_back(1); });
    ASSERT_EQ(last.get_future().wait_for(std::chrono::seconds(30)), std::future_status::ready);
  }
  EXPECT_GE(Watchdog::SecondsSince(begin), 0.06);
  EXPECT_EQ(rung, (std::vector<int>{1, 2}));
}

TEST(Watchdog, WhatWasDroppedDoesNotRing) {
  std::promise<void> later;
  bool has_rung = false;
  Watchdog watchdog;
  const Watchdog::Alarm dropped = watchdog.Set(Watchdog::After(0.05), [&] { has_rung = true; });
  watchdog.Set(Watchdog::After(0.1), [&] { later.set_value(); });
  watchdog.Drop(dropped);
  watchdog.Drop(dropped);
  later.get_future().wait();
  EXPECT_FALSE(has_rung);
}

TEST(Watchdog, EndsWithAlarmsThatHaveNotRung) {
  Watchdog watchdog;
  watchdog.Set(Watchdog::After(3600.0), [] { ADD_FAILURE(); });
}

}  // namespace
}  // namespace capfit::server
