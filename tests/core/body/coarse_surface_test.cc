#include "core/body/coarse_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/body/find_body.h"
#include "core/body/surface_graph.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"
#include "core/mesh/surface_sums.h"
#include "tests/core/body/body_files.h"

namespace capfit::body {
namespace {

mesh::BodyMesh Mannequin(int faces) {
  mannequin::MannequinOptions options;
  options.faces = faces;
  options.quads = false;
  return std::move(mesh::PrepareMesh(*mannequin::MakeMannequin(options))->mesh);
}

CoarseSurface Coarse(int faces, int threads) {
  const ThreadPool pool(threads);
  return MakeCoarseSurface(MakeWorkingCopy(Mannequin(faces), pool, NullObserver()), pool);
}

TEST(CoarseSurface, TakesFewVerticesAsTheyAre) {
  const WorkingCopy copy = MakeWorkingCopy(Mannequin(10'000), ThreadPool(1), NullObserver());
  const CoarseSurface same = MakeCoarseSurface(copy, ThreadPool(1));
  EXPECT_TRUE(std::ranges::equal(same.points, copy.points));
  EXPECT_TRUE(std::ranges::equal(same.triangles, copy.mesh.triangles()));
  EXPECT_TRUE(std::ranges::equal(same.mates, copy.mesh.mates()));
  ASSERT_EQ(same.VerticesOf(7).size(), 1u);
  EXPECT_EQ(same.VerticesOf(7).front(), 7u);
}

TEST(CoarseSurface, HasSomeThousandNodesThatHoldEachVertexOnce) {
  for (const int faces : {64'000, 200'000}) {
    const CoarseSurface coarse = Coarse(faces, 1);
    EXPECT_GT(coarse.points.size(), 3000u);
    EXPECT_LT(coarse.points.size(), 10000u);
    std::vector<std::uint32_t> vertices = coarse.vertices;
    std::sort(vertices.begin(), vertices.end());
    for (std::uint32_t v = 0; v < vertices.size(); ++v) ASSERT_EQ(vertices[v], v);
    for (std::uint32_t n = 0; n < coarse.points.size(); ++n) {
      ASSERT_FALSE(coarse.VerticesOf(n).empty());
    }
  }
}

TEST(CoarseSurface, IsClosedAndNearTheWholeOne) {
  const CoarseSurface coarse = Coarse(64'000, 1);
  for (mesh::HalfEdge h = 0; h < coarse.mates.size(); ++h) {
    const mesh::HalfEdge mate = coarse.mates[h];
    ASSERT_EQ(coarse.mates[mate], h);
    ASSERT_EQ(mesh::StartOf(coarse.triangles, h), mesh::EndOf(coarse.triangles, mate));
    ASSERT_EQ(mesh::EndOf(coarse.triangles, h), mesh::StartOf(coarse.triangles, mate));
  }
  EXPECT_NEAR(mesh::AreaOf(coarse.points, coarse.triangles), 1.0, 0.03);
  const SurfaceGraph graph(coarse.points, coarse.triangles, coarse.mates);
  const std::vector<double> distance = graph.Distances(std::vector{GeodesicSource{0, 0.0}});
  EXPECT_LT(*std::max_element(distance.begin(), distance.end()), 10.0) << "all can be reached";
}

TEST(CoarseSurface, IsTheSameForAnyNumberOfThreads) {
  const CoarseSurface one = Coarse(64'000, 1);
  const CoarseSurface three = Coarse(64'000, 3);
  EXPECT_EQ(one.points, three.points);
  EXPECT_EQ(one.areas, three.areas);
  EXPECT_EQ(one.triangles, three.triangles);
  EXPECT_EQ(one.mates, three.mates);
  EXPECT_EQ(one.vertices, three.vertices);
  EXPECT_EQ(one.first, three.first);
}

TEST(CoarseSurface, LandmarksComeOutAsOnFewerFaces) {
  const auto few = Find(Mannequin(25'000));
  const auto many = Find(Mannequin(100'000));
  ASSERT_TRUE(few.ok() && many.ok());
  for (int i = 0; i < kLandmarkCount; ++i) {
    ASSERT_EQ(few->landmarks[i].has_value(), many->landmarks[i].has_value());
    if (!few->landmarks[i]) continue;
    EXPECT_LT((few->landmarks[i]->position_m - many->landmarks[i]->position_m).norm(), 0.025)
        << LandmarkName(static_cast<LandmarkId>(i));
  }
}

}  // namespace
}  // namespace capfit::body
