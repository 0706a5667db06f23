#include "core/capsule/primitive_set.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"

namespace capfit::capsule {
namespace {

PrimitiveSet WithMirrors(const std::vector<int>& mirrors, std::vector<CapsuleEnds> capsules) {
  PrimitiveSet set;
  for (const int mirror : mirrors) {
    set.spheres.push_back({{0, 0, 0}, 1});
    set.origins.push_back({body::Part::kTorso, -1, mirror});
  }
  set.capsules = std::move(capsules);
  return set;
}

TEST(ImagesOfTest, ItsOwnOnThePlaneAndNoneWhereTheTwoDoNotAgree) {
  const Images images = ImagesOf(WithMirrors({0, 2, 1, 1, -1, 99}, {{0, 1}, {0, 2}, {1, 3}}));
  EXPECT_EQ(images.spheres, (std::vector<int>{0, 2, 1, -1, -1, -1}));
  EXPECT_EQ(images.capsules, (std::vector<int>{1, 0, -1}));
  EXPECT_FALSE(images.is_whole);
}

TEST(ImagesOfTest, WholeOnlyWithAllCapsules) {
  EXPECT_TRUE(ImagesOf(WithMirrors({0, 2, 1}, {{0, 1}, {0, 2}, {1, 2}})).is_whole);
  EXPECT_FALSE(ImagesOf(WithMirrors({0, 2, 1}, {{0, 1}})).is_whole);
  EXPECT_TRUE(ImagesOf({}).is_whole);
}

// By trying all pairs of capsules.
TEST(ImagesOfTest, AgreesWithTryingAll) {
  Random random(7);
  for (int round = 0; round < 50; ++round) {
    std::vector<int> mirrors(12);
    for (int i = 0; i < 12; ++i) mirrors[i] = i < 4 ? i : i ^ 1;
    std::vector<CapsuleEnds> capsules;
    for (int a = 0; a < 12; ++a) {
      for (int b = a + 1; b < 12; ++b) {
        if (random.NextUnit() < 0.3) capsules.push_back({a, b});
      }
    }
    const PrimitiveSet set = WithMirrors(mirrors, capsules);
    const Images images = ImagesOf(set);
    for (std::size_t k = 0; k < capsules.size(); ++k) {
      CapsuleEnds wanted{mirrors[capsules[k][0]], mirrors[capsules[k][1]]};
      std::sort(wanted.begin(), wanted.end());
      const auto found = std::find(capsules.begin(), capsules.end(), wanted);
      const int expected =
          found == capsules.end() ? -1 : static_cast<int>(found - capsules.begin());
      EXPECT_EQ(images.capsules[k], expected);
    }
  }
}

TEST(SolidEndsTest, CapsulesInOrderThenSpheresThatNoneUses) {
  const PrimitiveSet set = WithMirrors({-1, -1, -1, -1}, {{2, 3}, {0, 2}});
  EXPECT_EQ(SolidEnds(set), (std::vector<CapsuleEnds>{{2, 3}, {0, 2}, {1, 1}}));
  EXPECT_EQ(Solids(set).size(), 3U);
}

}  // namespace
}  // namespace capfit::capsule
