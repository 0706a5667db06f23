#include "core/tighten/row_table.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>

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
    if (i % 50 == 0) program.batches.emplace_back().penalty_factor = random.NextIn(0.5, 2.0);
    program.batches.back().rows.push_back(row);
  }
  return program;
}

TEST(RowTableTest, GroupsAreWholeLanesThatHoldEachRowOnce) {
  const PenaltyProgram program = RandomRows(137);
  for (const Eigen::Index lane : {kDoublesInLane, kFloatsInLane}) {
    const RowLayout layout = LayOutRows(program, lane);
    std::set<std::pair<std::uint32_t, std::uint32_t>> met;
    Eigen::Index next = 0;
    for (const RowGroup& group : layout.groups) {
      EXPECT_EQ(group.begin, next);
      EXPECT_EQ((group.end - group.begin) % lane, 0);
      EXPECT_LT(group.end - group.begin - static_cast<Eigen::Index>(group.count), lane);
      next = group.end;
      for (std::size_t i = 0; i < group.count; ++i) {
        const RowPlace& place = layout.order[group.first_in_order + i];
        EXPECT_TRUE(met.emplace(place.batch, place.row).second);
        const PenaltyRow& row = program.batches[place.batch].rows[place.row];
        EXPECT_EQ(row.first, (std::array<int, 2>{group.first_a, group.first_b}));
      }
    }
    EXPECT_EQ(layout.size, next);
    EXPECT_EQ(met.size(), 137u);
  }
}

TEST(RowTableTest, PartsHoldEachGroupOnceAndAboutAsManyRows) {
  const PenaltyProgram program = RandomRows(4000);
  const RowLayout layout = LayOutRows(program, kFloatsInLane);
  EXPECT_GT(layout.parts.size(), 3u);
  std::size_t next = 0;
  for (const RowPart& part : layout.parts) {
    EXPECT_EQ(part.begin, next);
    next = part.end;
  }
  EXPECT_EQ(next, layout.groups.size());
}

template <typename Real>
class RowTablesTest : public testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(RowTablesTest, Reals);

TYPED_TEST(RowTablesTest, LanesHoldTheRowsAndFillingsThatNeverBind) {
  using Table = RowTable<TypeParam>;
  const PenaltyProgram program = RandomRows(137);
  const RowLayout layout = LayOutRows(program, kFloatsInLane);
  const ThreadPool pool(2);
  Table table;
  ShortLoops::Run(pool, 2, [&](ShortLoops& loops) { table.Take(program, layout, loops); });
  for (const RowGroup& group : layout.groups) {
    for (Eigen::Index k = group.begin; k < group.end; ++k) {
      const RowLane<TypeParam> lane = table.LaneAt(k - k % Table::kLane);
      const Eigen::Index in_lane = k % Table::kLane;
      const auto i = static_cast<std::size_t>(k - group.begin);
      if (i >= group.count) {
        EXPECT_LT(lane.value()[in_lane], -1.0);
        EXPECT_GT(lane.penalty()[in_lane], 0.0);
        for (Eigen::Index c = 0; c < 8; ++c) EXPECT_EQ(lane.coefficient(c)[in_lane], 0.0);
        continue;
      }
      const RowPlace& place = layout.order[group.first_in_order + i];
      const RowBatch& batch = program.batches[place.batch];
      const PenaltyRow& row = batch.rows[place.row];
      EXPECT_EQ(lane.value()[in_lane], static_cast<TypeParam>(row.value));
      EXPECT_EQ(lane.penalty()[in_lane],
                static_cast<TypeParam>(row.penalty * batch.penalty_factor));
      for (Eigen::Index c = 0; c < 8; ++c) {
        EXPECT_EQ(lane.coefficient(c)[in_lane], static_cast<TypeParam>(row.coefficients[c]));
      }
    }
  }
}

}  // namespace
}  // namespace capfit::tighten
