#include "core/export/mesh_hulls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/status.h"
#include "core/export/frame.h"
#include "core/formats/read_mesh.h"
#include "core/mesh/prepare_mesh.h"
#include "tests/core/export/rigged_sample.h"

namespace capfit::exports {
namespace {

using Vec3 = Eigen::Vector3d;

// Two crossing capsules, in decimetres, Z up.
ColliderSet Cross() {
  ColliderSet set;
  set.primitives.spheres = {
      {Vec3(-5, 0, 0), 1.0}, {Vec3(5, 0, 0), 1.5}, {Vec3(0, 0, -5), 1.0}, {Vec3(0, 0, 5), 2.0}};
  set.primitives.origins.resize(4);
  set.primitives.capsules = {{0, 1}, {2, 3}};
  set.sphere_names = {"a", "b", "c d", "e"};
  set.body_from_mesh.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  set.body_from_mesh.scale = 0.1;
  return set;
}

formats::PolygonSoup Read(const std::string& bytes) {
  const auto soup = formats::ReadMesh(BytesOf(bytes));
  EXPECT_TRUE(soup.ok()) << soup.status();
  return soup.ok() ? *soup : formats::PolygonSoup();
}

TEST(MeshHulls, TheObjStandsOnTheMeshOrUpright) {
  for (const MeshFrame frame : {MeshFrame::kOfMesh, MeshFrame::kYUp}) {
    const auto exported = WriteHulls(Cross(), {.frame = frame});
    ASSERT_TRUE(exported.ok()) << exported.status();
    const formats::PolygonSoup soup = Read(exported->files[0].bytes);
    Vec3 high = Vec3::Constant(-1e9);
    for (const Vec3& vertex : soup.positions) high = high.cwiseMax(vertex);
    // The end at z = 7 is above in metres.
    const Vec3 expected = frame == MeshFrame::kOfMesh ? Vec3(6.5, 2, 7) : Vec3(0.65, 0.7, 0.2);
    EXPECT_TRUE(high.isApprox(expected, 0.01)) << high.transpose();
    EXPECT_THAT(exported->files[0].bytes, testing::HasSubstr("g c_d__e\n"));
  }
}

TEST(MeshHulls, TheUnionIsOneClosedSurfaceAroundTheVolumeOfBoth) {
  const auto exported = WriteUnion(Cross());
  ASSERT_TRUE(exported.ok()) << exported.status();
  EXPECT_EQ(exported->warnings.back().code, "UNION_DEVIATION");
  const formats::PolygonSoup soup = Read(exported->files[0].bytes);
  const auto prepared = mesh::PrepareMesh(soup);
  ASSERT_TRUE(prepared.ok()) << prepared.status();
  EXPECT_TRUE(prepared->warnings.empty());
  const auto solids = capsule::Solids(Cross().primitives);
  const geometry::Similarity to_mesh = UprightFromMesh(Cross()).Inverse();
  for (std::size_t c = 0; c < soup.face_vertices.size(); c += 3) {
    const Vec3 at = to_mesh.Apply((soup.positions[soup.face_vertices[c]] +
                                   soup.positions[soup.face_vertices[c + 1]] +
                                   soup.positions[soup.face_vertices[c + 2]]) /
                                  3.0);
    const double off = std::min(solids[0].SignedDistance(at), solids[1].SignedDistance(at));
    EXPECT_GT(off, -1e-4);  // decimetres
    EXPECT_LT(off, 0.04);
  }
  // Both volumes without what they share, which lies within a ball of 0.2 about the middle.
  const double both = 1e-3 * (solids[0].Volume_m3() + solids[1].Volume_m3());
  EXPECT_LT(prepared->mesh.volume(), both);
  EXPECT_GT(prepared->mesh.volume(), both - 4.2 * 0.2 * 0.2 * 0.2);
}

TEST(MeshHulls, TheUnionIsTheSameForAnyNumberOfThreads) {
  const auto one = WriteUnion(Cross(), {}, ThreadPool(1));
  const auto two = WriteUnion(Cross(), {}, ThreadPool(2));
  ASSERT_TRUE(one.ok() && two.ok());
  EXPECT_EQ(one->files[1].bytes, two->files[1].bytes);
}

TEST(MeshHulls, RefuseOptionsOutOfRange) {
  EXPECT_EQ(FieldOf(WriteHulls(Cross(), {.segments = 7}).status()), "segments");
  EXPECT_EQ(FieldOf(WriteHulls(Cross(), {.segments = 257}).status()), "segments");
  EXPECT_EQ(FieldOf(WriteUnion(Cross(), {.cell_m = 0.001}).status()), "cell_m");
}

}  // namespace
}  // namespace capfit::exports
