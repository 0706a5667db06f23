// Our readers against OpenMesh's, which share no code: the same files must give the same vertices
// and faces in the same order (to single precision, which is what OpenMesh reads in).
#include <gtest/gtest.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

#include "core/formats/read_mesh.h"
#include "tests/support/bodies.h"
#include "tests/support/scratch.h"

namespace capfit::mesh {
namespace {

using OpenMeshSurface = OpenMesh::PolyMesh_ArrayKernelT<>;

void ExpectSameSurface(const std::filesystem::path& path) {
  SCOPED_TRACE(path.filename().string());
  OpenMeshSurface theirs;
  ASSERT_TRUE(OpenMesh::IO::read_mesh(theirs, path.string()));
  const std::string bytes = test_support::ReadFile(path);
  const auto ours = formats::ReadMesh(std::as_bytes(std::span(bytes)),
                                      formats::FormatFromFileName(path.filename().string()));
  ASSERT_TRUE(ours.ok()) << ours.status();
  ASSERT_EQ(ours->positions.size(), theirs.n_vertices());
  for (std::size_t i = 0; i < ours->positions.size(); ++i) {
    const auto& q = theirs.point(OpenMesh::VertexHandle(static_cast<int>(i)));
    const Eigen::Vector3d difference = ours->positions[i] - Eigen::Vector3d(q[0], q[1], q[2]);
    ASSERT_LE(difference.norm(), 1e-6 * (1.0 + ours->positions[i].norm())) << "vertex " << i;
  }
  std::vector<std::uint32_t> their_corners;
  for (const auto face : theirs.faces()) {
    for (const auto vertex : face.vertices()) {
      their_corners.push_back(static_cast<std::uint32_t>(vertex.idx()));
    }
  }
  EXPECT_EQ(ours->face_vertices, their_corners);
}

TEST(OpenMeshOracle, ReadsAHandMadePyramidAlike) {
  const test_support::Scratch scratch;
  std::ofstream(scratch.Path("pyramid.obj"))
      << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 1.25\n"
         "f 4 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
  std::ofstream(scratch.Path("pyramid.off"))
      << "OFF\n5 5 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.5 1.25\n"
         "4 3 2 1 0\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";
  ExpectSameSurface(scratch.Path("pyramid.obj"));
  ExpectSameSurface(scratch.Path("pyramid.off"));
}

TEST(OpenMeshOracle, ReadsRealBodiesAlike) {
  CAPFIT_REQUIRE_BODIES();
  for (const std::filesystem::path& path : test_support::BodyFiles()) ExpectSameSurface(path);
  // Not the OFF files: OpenMesh reads nothing from one with a comment before its counts.
  const std::filesystem::path bodies = test_support::BodiesFolder();
  for (const char* const name :
       {"formats/female_average.ply", "formats/male_muscular_quads_big_endian_double.ply",
        "scale/female_average_tri_064k.ply"}) {
    ExpectSameSurface(bodies / name);
  }
}

}  // namespace
}  // namespace capfit::mesh
