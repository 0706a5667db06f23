#include "core/tighten/row_table.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace capfit::tighten {
namespace {

PenaltyProgram RandomRows(int count) {
  constexpr int kGroups = 5;
  Random random(23);
  PenaltyProgram program;
  program.gradient = Eigen::VectorXd::Zero(4 * kGroups);
  program.hessian = Eigen::VectorXd::Ones(4 * kGroups);
  program.lower = Eigen::VectorXd::Constant(4 * kGroups, -1.0);
  program.upper = Eigen::VectorXd::Constant(4 * kGroups, 1.0);
  for (int i = 0; i < count; ++i) {
    PenaltyRow row;
    const auto group = static_cast<int>(random.NextBelow(kGroups));
    row.first = {4 * group, random.NextUnit() < 0.5 ? -1 : 4 * ((group + 1) % kGroups)};
    for (double& c : row.coefficients) c = random.NextIn(-1.0, 1.0);
    row.value = random.NextIn(-1.0, 1.0);
    row.penalty = random.NextIn(0.5, 1.0);
    program.rows.push_back(row);
  }
  return program;
}

TEST(RowTableTest, GroupsAreWholeLanesThatHoldEachRowOnce) {
  const PenaltyProgram program = RandomRows(137);
  const std::vector<std::size_t> order = RowsByGroup(program);
  ASSERT_EQ(order.size(), program.rows.size());
  for (const Eigen::Index lane : {kDoublesInLane, kFloatsInLane}) {
    const RowTable<double> table(program, lane);
    std::size_t next = 0;
    for (const RowGroup& group : table.groups) {
      EXPECT_EQ(group.begin % lane, 0);
      EXPECT_EQ(group.end % lane, 0);
      for (Eigen::Index k = group.begin; k < group.end; ++k) {
        if (next == order.size() || program.rows[order[next]].first[0] != group.first_a ||
            program.rows[order[next]].first[1] != group.first_b) {
          EXPECT_LT(table.value[k], -1.0) << "fills up, and never binds";
          continue;
        }
        const PenaltyRow& row = program.rows[order[next++]];
        EXPECT_EQ(table.value[k], row.value);
        EXPECT_EQ(table.penalty[k], row.penalty);
        for (Eigen::Index c = 0; c < 8; ++c) {
          EXPECT_EQ(table.coefficients(k, c), row.coefficients[c]);
        }
      }
    }
    EXPECT_EQ(next, order.size());
  }
}

TEST(RowTableTest, FloatsFromDoublesAreThoseOfTheProgramme) {
  const PenaltyProgram program = RandomRows(61);
  const RowTable<float> own(program, kFloatsInLane);
  const RowTable<float> cast(RowTable<double>(program, kFloatsInLane));
  ASSERT_EQ(own.groups.size(), cast.groups.size());
  EXPECT_EQ(own.count, cast.count);
  EXPECT_TRUE((own.value.head(own.count) == cast.value.head(own.count)).all());
  EXPECT_TRUE((own.penalty.head(own.count) == cast.penalty.head(own.count)).all());
  EXPECT_TRUE((own.coefficients.topRows(own.count) == cast.coefficients.topRows(own.count)).all());
}

}  // namespace
}  // namespace capfit::tighten
