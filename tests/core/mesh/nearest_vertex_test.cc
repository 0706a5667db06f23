#include "core/mesh/nearest_vertex.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "core/base/random.h"

namespace capfit::mesh {
namespace {

using Vec3 = Eigen::Vector3d;

Vec3 RandomPoint(Random& random) {
  const double x = random.NextUnit();
  const double y = random.NextUnit();
  return {x, y, random.NextUnit()};
}

std::uint32_t OneByOne(const std::vector<Vec3>& vertices, const Vec3& point) {
  std::uint32_t best = 0;
  for (std::uint32_t v = 1; v < vertices.size(); ++v) {
    if ((vertices[v] - point).squaredNorm() < (vertices[best] - point).squaredNorm()) best = v;
  }
  return best;
}

void ExpectNearest(const std::vector<Vec3>& vertices, const std::vector<Vec3>& points) {
  const NearestVertex nearest(vertices);
  for (const Vec3& point : points) {
    const std::uint32_t expected = OneByOne(vertices, point);
    ASSERT_EQ(nearest.At(point), expected) << point.transpose();
    // From the answer, from far away and from what may be as near.
    for (const std::size_t near :
         {std::size_t{expected}, vertices.size() / 2, vertices.size() - 1}) {
      ASSERT_EQ(nearest.At(point, static_cast<std::uint32_t>(near)), expected) << point.transpose();
    }
  }
}

TEST(NearestVertexTest, IsTheOneThatLookingAtAllFinds) {
  Random random(7);
  std::vector<Vec3> sphere, points;
  for (int i = 0; i < 3000; ++i) {
    sphere.push_back((RandomPoint(random) - Vec3::Constant(0.5)).normalized());
    if (i % 3 != 0) continue;
    // On the surface, near it, in the middle and far away.
    const double far = i % 2 == 0 ? 1.0 + 0.02 * random.NextUnit() : 20.0 * random.NextUnit();
    points.push_back(far * (RandomPoint(random) - Vec3::Constant(0.5)).normalized());
  }
  points.push_back(Vec3::Zero());
  ExpectNearest(sphere, points);
}

// Points as far from several vertices get the first of them, also where cells meet.
TEST(NearestVertexTest, OfEqualsTheFirst) {
  std::vector<Vec3> lattice, points;
  for (int i = 0; i < 1000; ++i) lattice.emplace_back(i % 10, i / 10 % 10, i / 100);
  for (const int i : {0, 111, 555, 999}) lattice.push_back(lattice[i]);
  for (const Vec3& p : lattice) {
    points.push_back(p);
    points.push_back(p + Vec3(0.5, 0, 0));
    points.push_back(p + Vec3(0.5, 0.5, 0.5));
    points.push_back(p - Vec3(0, 0.5, 7.0));
  }
  ExpectNearest(lattice, points);
}

TEST(NearestVertexTest, FlatAndSingle) {
  ExpectNearest({Vec3(1, 2, 3)}, {Vec3(1, 2, 3), Vec3(-5, 0, 9)});
  ExpectNearest({Vec3(1, 2, 3), Vec3(1, 2, 3)}, {Vec3(0, 0, 0)});
  std::vector<Vec3> line;
  for (int i = 0; i < 200; ++i) line.emplace_back(0.01 * i, 0, 0);
  ExpectNearest(line, {Vec3(0.501, 3, 0), Vec3(-1, 0, 0), Vec3(9, 0, 1e-9)});
}

}  // namespace
}  // namespace capfit::mesh
