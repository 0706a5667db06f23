#include "core/mesh/plane_cutter.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "core/base/random.h"
#include "core/base/thread_pool.h"

namespace capfit::mesh {
namespace {

struct Soup {
  std::vector<Eigen::Vector3d> points;
  std::vector<Triangle> triangles;
};

// Small triangles anywhere, some of them flat, neighbours in the list far from each other.
Soup RandomSoup(Random& random, int count) {
  Soup soup;
  const auto any = [&] { return random.NextIn(-1.0, 1.0); };
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d at(any(), any(), any());
    for (int k = 0; k < 3; ++k) {
      soup.points.push_back(at + 0.1 * Eigen::Vector3d(any(), i % 5 == 0 ? 0.0 : any(), any()));
    }
    const auto first = static_cast<std::uint32_t>(3 * i);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

std::vector<CutPiece> CutOneByOne(const Soup& soup, const Eigen::Vector3d& origin,
                                  const Eigen::Vector3d& normal) {
  std::vector<CutPiece> pieces;
  const auto height = [&](std::uint32_t v) { return normal.dot(soup.points[v] - origin); };
  for (const Triangle& t : soup.triangles) {
    CutTriangle(soup.points, t, {height(t[0]), height(t[1]), height(t[2])}, pieces);
  }
  return pieces;
}

void ExpectSame(const std::vector<CutPiece>& got, const std::vector<CutPiece>& want) {
  ASSERT_EQ(got.size(), want.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_EQ(got[i].from, want[i].from);
    EXPECT_EQ(got[i].to, want[i].to);
    EXPECT_EQ(got[i].start, want[i].start);
    EXPECT_EQ(got[i].nearest_vertex, want[i].nearest_vertex);
  }
}

TEST(PlaneCutterTest, CutsWhatEachTriangleByItselfWouldBeCutTo) {
  Random random(3);
  const ThreadPool pool(3);
  for (const int count : {0, 1, 7, 8, 9, 64, 65, 2'000}) {
    const Soup soup = RandomSoup(random, count);
    const PlaneCutter cutter(soup.points, soup.triangles, pool);
    for (int plane = 0; plane < 50; ++plane) {
      const Eigen::Vector3d normal =
          plane < 3 ? Eigen::Vector3d(Eigen::Vector3d::Unit(plane))
                    : Eigen::Vector3d(random.NextIn(-1, 1), random.NextIn(-1, 1), 0.3).normalized();
      // Through a corner now and then, whose height is exactly 0.
      const Eigen::Vector3d origin = plane % 2 == 0 && count > 0
                                         ? soup.points[static_cast<std::size_t>(plane) % 3]
                                         : Eigen::Vector3d(0.0, random.NextIn(-1.2, 1.2), 0.0);
      ExpectSame(cutter.Cut(origin, normal), CutOneByOne(soup, origin, normal));
    }
  }
}

}  // namespace
}  // namespace capfit::mesh
