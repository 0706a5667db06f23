#include "core/tighten/surface_samples.h"

#include <gtest/gtest.h>

#include <vector>

namespace capfit::tighten {
namespace {

// The i-th lies at x = i.
Samples Numbered(int count) {
  Samples samples;
  for (int i = 0; i < count; ++i) {
    samples.Add({0, 0, 1}, {static_cast<float>(i), 0, 0}, 0.0f);
  }
  samples.FillUp();
  return samples;
}

TEST(SurfaceSamplesTest, WhatIsHiddenStaysHiddenWhateverComesLater) {
  Samples samples = Numbered(20);
  samples.Hide([](std::size_t i) { return i < 8 ? 0.0f : 0.5f; });
  samples.Hide([](std::size_t) { return 0.5f; });
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(samples.seen[i], i < 8 ? 0.0f : 0.25f);
}

TEST(SurfaceSamplesTest, OnlyTheSeenMoveOnInTheirOrderAndNoneIsLost) {
  Samples to;
  std::vector<float> moved;
  const auto take = [&] {
    for (std::size_t i = 0; i < static_cast<std::size_t>(to.count); ++i) moved.push_back(to.x[i]);
    to.count = 0;
  };
  std::vector<float> expected;
  for (int batch = 0; batch < 5; ++batch) {
    Samples samples = Numbered(60);
    samples.Hide([](std::size_t i) { return i % 3 == 0 ? 0.0f : 1.0f; });
    for (int i = 0; i < 60; ++i) {
      if (i % 3 != 0) expected.push_back(static_cast<float>(i));
    }
    samples.MoveSeen(to, take);
    EXPECT_EQ(samples.count, 0);
    EXPECT_LT(to.count, Samples::kMost);
  }
  take();
  EXPECT_EQ(moved, expected);
}

}  // namespace
}  // namespace capfit::tighten
