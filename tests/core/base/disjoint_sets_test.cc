#include "core/base/disjoint_sets.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

namespace capfit {
namespace {

TEST(DisjointSets, EachStartsAlone) {
  EXPECT_EQ(DisjointSets(3).All(), (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(DisjointSets, TheLowestMemberStandsForAll) {
  DisjointSets sets(6);
  sets.Join(4, 5);
  sets.Join(5, 2);
  sets.Join(3, 3);
  EXPECT_EQ(sets.Find(4), 2U);
  EXPECT_EQ(std::move(sets).All(), (std::vector<std::uint32_t>{0, 1, 2, 3, 2, 2}));
}

TEST(DisjointSets, GoesOnFromSetsThatAreJoinedAlready) {
  DisjointSets sets(std::vector<std::uint32_t>{0, 0, 2, 2});
  sets.Join(1, 3);
  EXPECT_EQ(std::move(sets).All(), (std::vector<std::uint32_t>{0, 0, 0, 0}));
}

// Against colours that are painted over, one by one.
TEST(DisjointSets, AgreesWithPaintingOver) {
  std::mt19937 random(7);
  constexpr std::uint32_t kCount = 200;
  DisjointSets sets(kCount);
  std::vector<std::uint32_t> color(kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) color[i] = i;
  for (int join = 0; join < 150; ++join) {
    const std::uint32_t a = random() % kCount;
    const std::uint32_t b = random() % kCount;
    sets.Join(a, b);
    const std::uint32_t from = std::max(color[a], color[b]);
    const std::uint32_t to = std::min(color[a], color[b]);
    for (std::uint32_t& c : color) c = c == from ? to : c;
  }
  EXPECT_EQ(std::move(sets).All(), color);
}

}  // namespace
}  // namespace capfit
