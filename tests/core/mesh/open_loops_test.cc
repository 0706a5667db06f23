#include "core/mesh/open_loops.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "tests/core/mesh/soups.h"

namespace capfit::mesh {
namespace {

using testing::ElementsAre;

TEST(OpenLoopsTest, AClosedSurfaceHasNone) {
  EXPECT_TRUE(FindOpenLoops(WithHoles(Ball(24, 15), 0.0, 1)).empty());
}

// A filling runs a loop the way its vertices go: as the missing triangle did.
TEST(OpenLoopsTest, RunTheWayOfWhatIsMissing) {
  const std::vector<Triangle> open = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}};
  const std::vector<OpenLoop> loops = FindOpenLoops(SurfaceOf(open, 4));
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_THAT(loops[0].vertices, ElementsAre(0, 3, 2));
}

TEST(OpenLoopsTest, HaveAllOpenEdgesAndNoVertexTwice) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    const Surface surface = WithHoles(Ball(24, 15), 0.1 * static_cast<double>(seed), seed);
    std::size_t edges = 0;
    for (const OpenLoop& loop : FindOpenLoops(surface)) {
      edges += loop.vertices.size();
      const std::set<std::uint32_t> different(loop.vertices.begin(), loop.vertices.end());
      EXPECT_EQ(different.size(), loop.vertices.size());
      const Triangle& beside = surface.triangles[loop.triangle];
      EXPECT_TRUE(std::any_of(beside.begin(), beside.end(),
                              [&](std::uint32_t v) { return different.contains(v); }));
    }
    EXPECT_EQ(edges, static_cast<std::size_t>(
                         std::count(surface.mate.begin(), surface.mate.end(), kNoMate)));
  }
}

}  // namespace
}  // namespace capfit::mesh
