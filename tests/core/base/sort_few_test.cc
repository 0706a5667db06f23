#include "core/base/sort_few.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/base/random.h"

namespace capfit {
namespace {

TEST(SortFewTest, SortsAsTheLibraryDoesWhateverTheirNumber) {
  Random random(5);
  for (std::size_t count = 0; count < 40; ++count) {
    for (int round = 0; round < 20; ++round) {
      std::vector<std::uint64_t> values(count);
      // Few of them, so that many are equal.
      for (std::uint64_t& value : values) {
        value = static_cast<std::uint64_t>(random.NextIn(0.0, 12.0)) << 33;
      }
      std::vector<std::uint64_t> sorted = values;
      std::sort(sorted.begin(), sorted.end());
      SortFew(std::span(values));
      EXPECT_EQ(values, sorted);
    }
  }
}

}  // namespace
}  // namespace capfit
