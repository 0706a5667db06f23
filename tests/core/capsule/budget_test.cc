#include "core/capsule/budget.h"

#include <gtest/gtest.h>

namespace capfit::capsule {
namespace {

void ExpectPrimitivesAlone(const Budget& budget, int primitives) {
  EXPECT_EQ(budget.max_primitives, primitives);
  EXPECT_EQ(budget.max_spheres, kNoLimit);
  EXPECT_EQ(budget.max_capsules, kNoLimit);
}

TEST(BudgetTest, ExcessIsThatOfTheLimitWhichIsBrokenMost) {
  const Budget budget{10, 6, 5};
  EXPECT_EQ(budget.Excess({.spheres = 5, .capsules = 5}), 0);
  EXPECT_EQ(budget.Excess({.spheres = 6, .capsules = 5}), 1);
  EXPECT_EQ(budget.Excess({.spheres = 9, .capsules = 0}), 3);
  EXPECT_EQ(budget.Excess({.spheres = 0, .capsules = 9}), 4);
}

TEST(BudgetTest, OfAnyKindHasTheSumOfLimitsThatAreNearlyTheSame) {
  ExpectPrimitivesAlone(Budget{kNoLimit, 32, 32}.OfAnyKind(), 64);
  ExpectPrimitivesAlone(Budget{kNoLimit, 33, 32}.OfAnyKind(), 65);
  ExpectPrimitivesAlone(Budget{kNoLimit, 32, 33}.OfAnyKind(), 64);
  ExpectPrimitivesAlone(Budget{50, 32, 32}.OfAnyKind(), 50);
  ExpectPrimitivesAlone(Budget{50, kNoLimit, kNoLimit}.OfAnyKind(), 50);
}

TEST(BudgetTest, OfAnyKindStaysItselfWhereOneLimitIsMuchLower) {
  for (const Budget& budget : {Budget{kNoLimit, 24, 40}, Budget{kNoLimit, 40, 24},
                               Budget{kNoLimit, 32, kNoLimit}, Budget{kNoLimit, kNoLimit, 32}}) {
    const Budget same = budget.OfAnyKind();
    EXPECT_EQ(same.max_primitives, budget.max_primitives);
    EXPECT_EQ(same.max_spheres, budget.max_spheres);
    EXPECT_EQ(same.max_capsules, budget.max_capsules);
  }
}

}  // namespace
}  // namespace capfit::capsule
