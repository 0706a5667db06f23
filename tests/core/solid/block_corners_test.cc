#include "core/solid/block_corners.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>

namespace capfit::solid {
namespace {

std::uint64_t NodesWhere(const std::function<bool(int, int, int)>& is_in) {
  std::uint64_t nodes = 0;
  for (int w = 0; w < 3; ++w) {
    for (int v = 0; v < 3; ++v) {
      for (int u = 0; u < 3; ++u) {
        if (is_in(u, v, w)) nodes |= std::uint64_t{1} << (u + 4 * (v + 4 * w));
      }
    }
  }
  return nodes;
}

TEST(BlockCornersTest, PlanesPassInOneSheet) {
  EXPECT_TRUE(IsOneSheetToldByCorners(NodesWhere([](int u, int, int) { return u < 1; })));
  EXPECT_TRUE(IsOneSheetToldByCorners(NodesWhere([](int u, int, int) { return u < 2; })));
  EXPECT_TRUE(IsOneSheetToldByCorners(NodesWhere([](int, int, int w) { return w > 0; })));
  EXPECT_TRUE(
      IsOneSheetToldByCorners(NodesWhere([](int u, int v, int w) { return u + v + w < 2; })));
}

TEST(BlockCornersTest, WhatCornersDoNotTellOrTwoSheetsDoNot) {
  EXPECT_FALSE(IsOneSheetToldByCorners(0)) << "no boundary";
  EXPECT_FALSE(IsOneSheetToldByCorners(NodesWhere([](int, int, int) { return true; })));
  // Only the middle; a plate between the corners; two opposite corners; two crosswise on a side.
  EXPECT_FALSE(IsOneSheetToldByCorners(
      NodesWhere([](int u, int v, int w) { return u == 1 && v == 1 && w == 1; })));
  EXPECT_FALSE(IsOneSheetToldByCorners(NodesWhere([](int u, int, int) { return u == 1; })));
  EXPECT_FALSE(IsOneSheetToldByCorners(
      NodesWhere([](int u, int v, int w) { return u == v && v == w && u != 1; })));
  EXPECT_FALSE(IsOneSheetToldByCorners(
      NodesWhere([](int u, int v, int w) { return w == 0 && u == v && u != 1; })));
}

// Turning the block changes nothing, nor does swapping inside and outside.
TEST(BlockCornersTest, TurnedAndInverted) {
  for (unsigned pattern = 0; pattern < 256; ++pattern) {
    const auto corner = [&](int u, int v, int w) {
      return (pattern >> ((u > 1) + 2 * (v > 1) + 4 * (w > 1)) & 1u) != 0;
    };
    const bool here =
        IsOneSheetToldByCorners(NodesWhere([&](int u, int v, int w) { return corner(u, v, w); }));
    EXPECT_EQ(here, IsOneSheetToldByCorners(
                        NodesWhere([&](int u, int v, int w) { return corner(v, w, u); })));
    EXPECT_EQ(here, IsOneSheetToldByCorners(
                        NodesWhere([&](int u, int v, int w) { return !corner(u, v, w); })));
  }
}

}  // namespace
}  // namespace capfit::solid
