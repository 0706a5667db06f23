// Sets of nodes, against the same done node by node.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <queue>
#include <vector>

#include "core/base/random.h"
#include "core/solid/node_grid.h"
#include "core/solid/regions.h"
#include "core/solid/well_composed.h"

namespace capfit::solid {
namespace {

NodeGrid SmallGrid() {
  NodeGrid grid;
  grid.size = {128, 11, 9};
  return grid;
}

// Each inner node with the given chance.
NodeSet RandomSet(const NodeGrid& grid, double chance, std::uint64_t seed) {
  NodeSet set(grid);
  Random random(seed);
  for (std::uint32_t w = 1; w + 1 < grid.size[2]; ++w) {
    for (std::uint32_t v = 1; v + 1 < grid.size[1]; ++v) {
      for (std::uint32_t u = 1; u + 1 < grid.size[0]; ++u) {
        if (random.NextUnit() < chance) set.Add(u, v, w);
      }
    }
  }
  return set;
}

// The region of each node (-1: none) and their sizes, by walking from node to node.
struct Walked {
  std::vector<int> region;
  std::vector<std::size_t> sizes;
};

Walked Walk(const NodeGrid& grid, const NodeSet& set, bool value) {
  const auto [nu, nv, nw] = grid.size;
  const auto at = [&, nu = nu, nv = nv](int u, int v, int w) {
    return (static_cast<std::size_t>(w) * nv + v) * nu + u;
  };
  Walked walked;
  walked.region.assign(std::size_t{nu} * nv * nw, -1);
  for (int w = 0; w < static_cast<int>(nw); ++w) {
    for (int v = 0; v < static_cast<int>(nv); ++v) {
      for (int u = 0; u < static_cast<int>(nu); ++u) {
        if (walked.region[at(u, v, w)] >= 0 || set.Has(u, v, w) != value) continue;
        const int name = static_cast<int>(walked.sizes.size());
        walked.sizes.push_back(0);
        std::queue<std::array<int, 3>> open({{u, v, w}});
        walked.region[at(u, v, w)] = name;
        while (!open.empty()) {
          const auto [a, b, c] = open.front();
          open.pop();
          ++walked.sizes.back();
          for (const auto& [x, y, z] : {std::array{a - 1, b, c},
                                        {a + 1, b, c},
                                        {a, b - 1, c},
                                        {a, b + 1, c},
                                        {a, b, c - 1},
                                        {a, b, c + 1}}) {
            if (x < 0 || y < 0 || z < 0 || x >= static_cast<int>(nu) || y >= static_cast<int>(nv) ||
                z >= static_cast<int>(nw)) {
              continue;
            }
            if (walked.region[at(x, y, z)] >= 0 || set.Has(x, y, z) != value) continue;
            walked.region[at(x, y, z)] = name;
            open.push({x, y, z});
          }
        }
      }
    }
  }
  return walked;
}

template <typename Visit>
void ForEachNode(const NodeGrid& grid, const Visit& visit) {
  for (std::uint32_t w = 0; w < grid.size[2]; ++w) {
    for (std::uint32_t v = 0; v < grid.size[1]; ++v) {
      for (std::uint32_t u = 0; u < grid.size[0]; ++u) visit(u, v, w);
    }
  }
}

TEST(NodeRegionsTest, FillsWhatTheWalkFromOutsideDoesNotReach) {
  const NodeGrid grid = SmallGrid();
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    NodeSet set = RandomSet(grid, 0.7, seed);
    const NodeSet before = set;
    const Walked walked = Walk(grid, before, false);
    const std::size_t filled = FillCavities(grid, set);
    std::size_t expected = 0;
    std::size_t index = 0;
    ForEachNode(grid, [&](std::uint32_t u, std::uint32_t v, std::uint32_t w) {
      const int region = walked.region[index++];
      EXPECT_EQ(set.Has(u, v, w), before.Has(u, v, w) || region > 0);
      expected += region > 0 ? 1 : 0;
    });
    EXPECT_GT(expected, 0u);
    EXPECT_EQ(filled, expected);
  }
}

TEST(NodeRegionsTest, KeepsTheLargestRegion) {
  const NodeGrid grid = SmallGrid();
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    NodeSet set = RandomSet(grid, 0.28, seed);
    const Walked walked = Walk(grid, set, true);
    const std::vector<std::size_t> sizes = KeepLargestRegion(grid, set);
    ASSERT_EQ(sizes.size(), walked.sizes.size());
    EXPECT_EQ(sizes.front(), *std::max_element(walked.sizes.begin(), walked.sizes.end()));
    const Walked left = Walk(grid, set, true);
    ASSERT_EQ(left.sizes.size(), 1u);
    EXPECT_EQ(left.sizes[0], sizes.front());
  }
}

// Whether any square or cube of nodes is touched across its diagonal alone.
bool IsWellComposed(const NodeGrid& grid, const NodeSet& set) {
  bool is_fine = true;
  ForEachNode(grid, [&](std::uint32_t u, std::uint32_t v, std::uint32_t w) {
    if (u + 1 >= grid.size[0] || v + 1 >= grid.size[1] || w + 1 >= grid.size[2]) return;
    std::array<bool, 8> in;
    for (std::uint32_t c = 0; c < 8; ++c) in[c] = set.Has(u + c % 2, v + c / 2 % 2, w + c / 4);
    for (const auto& [a, b, c, d] : {std::array{0, 1, 2, 3}, {0, 1, 4, 5}, {0, 2, 4, 6}}) {
      if (in[a] == in[d] && in[b] == in[c] && in[a] != in[b]) is_fine = false;
    }
    for (int p = 0; p < 4; ++p) {
      int others = 0;
      for (int q = 0; q < 8; ++q) others += q != p && q != 7 - p && in[q] == in[p] ? 1 : 0;
      if (in[p] == in[7 - p] && others == 0) is_fine = false;
    }
  });
  return is_fine;
}

TEST(WellComposedTest, LeavesNoNodesThatTouchAcrossADiagonal) {
  const NodeGrid grid = SmallGrid();
  const ThreadPool pool(2);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    NodeSet set = RandomSet(grid, 0.1, seed);
    const NodeSet before = set;
    EXPECT_FALSE(IsWellComposed(grid, set));
    EXPECT_GT(MakeWellComposed(grid, pool, set), 0u);
    EXPECT_TRUE(IsWellComposed(grid, set));
    ForEachNode(grid, [&](std::uint32_t u, std::uint32_t v, std::uint32_t w) {
      EXPECT_TRUE(set.Has(u, v, w) || !before.Has(u, v, w));
      if (u == 0 || v == 0 || w == 0 || u + 1 == grid.size[0] || v + 1 == grid.size[1] ||
          w + 1 == grid.size[2]) {
        EXPECT_FALSE(set.Has(u, v, w)) << "the outermost nodes stay clear";
      }
    });
    EXPECT_EQ(MakeWellComposed(grid, pool, set), 0u);
  }
}

TEST(NodeNumbersTest, CountsInTheOrderOfTheWords) {
  const NodeGrid grid = SmallGrid();
  const NodeSet set = RandomSet(grid, 0.3, 1);
  const NodeNumbers numbers(set);
  std::uint32_t expected = 0;
  ForEachNode(grid, [&](std::uint32_t u, std::uint32_t v, std::uint32_t w) {
    if (!set.Has(u, v, w)) return;
    const std::size_t i = set.WordOf(u, v, w);
    EXPECT_EQ(numbers.Of(i, set.words()[i], u % 64), expected++);
  });
  EXPECT_EQ(numbers.count(), expected);
}

}  // namespace
}  // namespace capfit::solid
