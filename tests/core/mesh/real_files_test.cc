// The real bodies: sound, spoilt and in other formats.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ctime>
#include <filesystem>

#include "core/base/status.h"
#include "core/formats/read_mesh.h"
#include "core/mesh/prepare_mesh.h"
#include "tests/core/mesh/soups.h"
#include "tests/fuzz/mesh_promises.h"
#include "tests/support/bodies.h"
#include "tests/support/told.h"

namespace capfit::mesh {
namespace {

using testing::HasSubstr;

absl::StatusOr<formats::PolygonSoup> ReadFile(const std::filesystem::path& path,
                                              bool by_name = true) {
  const std::string bytes = test_support::ReadFile(path);
  return formats::ReadMesh(
      std::as_bytes(std::span(bytes)),
      by_name ? formats::FormatFromFileName(path.string()) : formats::MeshFormat::kUnknown);
}

PreparedMesh PreparedFile(const std::filesystem::path& path) {
  const auto soup = ReadFile(path);
  EXPECT_TRUE(soup.ok()) << path << ": " << soup.status();
  if (!soup.ok()) return PreparedMesh{BodyMesh({}, {}, {}), {}};
  auto prepared = PrepareMesh(*soup);
  EXPECT_TRUE(prepared.ok()) << path << ": " << prepared.status();
  if (!prepared.ok()) return PreparedMesh{BodyMesh({}, {}, {}), {}};
  EXPECT_EQ(fuzz::BrokenPromiseOfPrepare(*prepared, soup->positions.size()), "") << path;
  return *std::move(prepared);
}

TEST(RealFilesTest, SoundBodiesPassThrough) {
  CAPFIT_REQUIRE_BODIES();
  std::vector<std::filesystem::path> files = test_support::BodyFiles();
  for (const auto& entry :
       std::filesystem::directory_iterator(test_support::BodiesFolder() / "scale")) {
    if (entry.path().extension() == ".ply") files.push_back(entry.path());
  }
  for (const auto& file : files) {
    const auto soup = ReadFile(file);
    ASSERT_TRUE(soup.ok()) << file << soup.status();
    const auto prepared = PrepareMesh(*soup);
    ASSERT_TRUE(prepared.ok()) << file << prepared.status();
    EXPECT_EQ(CodesOf(*prepared), "") << file;
    ASSERT_EQ(prepared->mesh.vertices().size(), soup->positions.size()) << file;
    for (std::size_t i = 0; i < soup->positions.size(); ++i) {
      const std::int32_t v = prepared->mesh.vertex_of_source()[i];
      ASSERT_GE(v, 0) << file;
      ASSERT_EQ(prepared->mesh.vertices()[v], soup->positions[i]) << file;
    }
    EXPECT_EQ(fuzz::BrokenPromise(prepared->mesh, soup->positions.size()), "") << file;
  }
}

const Eigen::Vector3d& VertexOfSource(const PreparedMesh& prepared, std::size_t source) {
  return prepared.mesh.vertices()[prepared.mesh.vertex_of_source()[source]];
}

struct Twin {
  const char* file;
  const char* twin;
  double grid_m;  // coordinates agree when rounded to this
};

// The twins' coordinates have five decimals in text.
TEST(RealFilesTest, EveryFormatGivesTheSameMesh) {
  CAPFIT_REQUIRE_BODIES();
  const std::filesystem::path folder = test_support::BodiesFolder();
  const Twin twins[] = {
      {"formats/female_average.ply", "female_average_rest.obj", 1e-5},
      {"formats/female_average.off", "female_average_rest.obj", 1e-5},
      {"formats/female_average.glb", "female_average_rest.obj", 1e-5},
      {"formats/male_muscular_quads.off", "male_muscular_rest.obj", 1e-5},
      {"formats/male_muscular_quads_big_endian_double.ply", "male_muscular_rest.obj", 1e-5},
      {"formats/male_muscular_under_nodes.glb", "male_muscular_rest.obj", 1e-5},
      {"formats/female_average_5k_ascii.ply", "scale/female_average_tri_05k.ply", 1e-5}};
  for (const Twin& twin : twins) {
    for (const bool by_name : {true, false}) {
      const auto read = ReadFile(folder / twin.file, by_name);
      const auto expected = ReadFile(folder / twin.twin, by_name);
      ASSERT_TRUE(read.ok() && expected.ok()) << twin.file << read.status();
      ASSERT_EQ(read->positions.size(), expected->positions.size()) << twin.file;
      for (std::size_t i = 0; i < read->positions.size(); ++i) {
        ASSERT_LT((read->positions[i] - expected->positions[i]).norm(), twin.grid_m)
            << twin.file << " vertex " << i;
      }
    }
    const PreparedMesh mesh = PreparedFile(folder / twin.file);
    const PreparedMesh expected = PreparedFile(folder / twin.twin);
    EXPECT_EQ(CodesOf(mesh), "") << twin.file;
    EXPECT_NEAR(mesh.mesh.volume(), expected.mesh.volume(), 1e-6) << twin.file;
    EXPECT_NEAR(mesh.mesh.area(), expected.mesh.area(), 1e-4) << twin.file;
  }
}

// STL has an order of vertices of its own, so the surfaces are compared.
TEST(RealFilesTest, StlGivesTheSameSurface) {
  CAPFIT_REQUIRE_BODIES();
  const std::filesystem::path folder = test_support::BodiesFolder();
  const Twin twins[] = {
      {"formats/female_average.stl", "formats/female_average.ply", 1e-7},
      {"formats/female_average_5k_ascii.stl", "formats/female_average_5k_ascii.ply", 1e-7}};
  for (const Twin& twin : twins) {
    const PreparedMesh mesh = PreparedFile(folder / twin.file);
    EXPECT_EQ(CodesOf(mesh), "") << twin.file;
    EXPECT_EQ(KeyOf(mesh.mesh, twin.grid_m),
              KeyOf(PreparedFile(folder / twin.twin).mesh, twin.grid_m))
        << twin.file;
  }
  const PreparedMesh muscular = PreparedFile(folder / "formats/male_muscular.stl");
  const PreparedMesh expected = PreparedFile(folder / "male_muscular_rest.obj");
  EXPECT_EQ(muscular.mesh.vertices().size(), expected.mesh.vertices().size());
  EXPECT_NEAR(muscular.mesh.volume(), expected.mesh.volume(), 1e-6);
}

// Some of its quads are pairs of triangles that make an inward corner or are not flat; which
// diagonal they had is lost. All else is the same.
TEST(RealFilesTest, ExporterStyleObjGivesTheSameVertices) {
  CAPFIT_REQUIRE_BODIES();
  const std::filesystem::path folder = test_support::BodiesFolder();
  const PreparedMesh mesh = PreparedFile(folder / "formats/female_average_5k_exporter_style.obj");
  const PreparedMesh expected = PreparedFile(folder / "scale/female_average_tri_05k.ply");
  EXPECT_EQ(CodesOf(mesh), "");
  ASSERT_EQ(mesh.mesh.vertices().size(), expected.mesh.vertices().size());
  for (std::size_t i = 0; i < mesh.mesh.vertices().size(); ++i) {
    ASSERT_LT((VertexOfSource(mesh, i) - VertexOfSource(expected, i)).norm(), 1e-5);
  }
  EXPECT_NEAR(mesh.mesh.volume(), expected.mesh.volume(), 0.005 * expected.mesh.volume());
}

struct Input {
  const char* file;
  const char* outcome;  // the codes of all warnings, or all of the refusal
  friend void PrintTo(const Input& input, std::ostream* os) { *os << input.file; }
};
class BrokenInputTest : public testing::TestWithParam<Input> {};

// As far as the mesh room is concerned: axes, unit and whether it is a body come later.
TEST_P(BrokenInputTest, DoesWhatItsDescriptionSaysWithinTwoSeconds) {
  CAPFIT_REQUIRE_BODIES();
  const std::filesystem::path folder = test_support::BodiesFolder() / "broken";
  if (!std::filesystem::exists(folder)) {
    GTEST_SKIP() << "SKIPPED: the bodies are there, but not the broken inputs beside them: "
                 << folder;
  }
  const std::filesystem::path path = folder / GetParam().file;
  ASSERT_TRUE(std::filesystem::exists(path)) << path;
  const std::clock_t start = std::clock();  // the processor's time: machines may be busy
  const auto soup = ReadFile(path);
  absl::Status status = soup.status();
  std::string outcome;
  if (soup.ok()) {
    const auto prepared = PrepareMesh(*soup);
    status = prepared.status();
    if (prepared.ok()) {
      outcome = CodesOf(*prepared);
      EXPECT_EQ(fuzz::BrokenPromiseOfPrepare(*prepared, soup->positions.size()), "");
    }
  }
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 2.0);
  if (status.ok()) {
    EXPECT_EQ(outcome, GetParam().outcome);
  } else {
    EXPECT_EQ(Told(status), GetParam().outcome);
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BrokenInputTest,
    testing::Values(
        Input{"anisotropic.obj", ""}, Input{"arms_fused_to_torso.obj", ""},
        Input{"arms_through_torso.obj", ""},
        Input{
            "bad_buffer_view.glb",
            "OUT_OF_RANGE [value=3030024, limit=60024, element=buffer view 1] mesh.file buffer "
            "view 1: it is out of range: it ends at byte 3030024 of the 60024 in the binary chunk"},
        Input{"centimetres.obj", ""}, Input{"cube.obj", ""},
        Input{"duplicate_faces.obj", "DUPLICATE_FACES"},
        Input{"empty.obj", "MISSING mesh.file is empty"}, Input{"facing_back.obj", ""},
        Input{"far_from_origin.obj", ""}, Input{"flipped_some.obj", "FACES_TURNED"},
        Input{"floating_parts.obj", "PARTS_LEFT_OUT"}, Input{"good_5k.obj", ""},
        Input{"huge_count.ply",
              "MALFORMED_FILE [value=4000000000, limit=7918, element=vertex] mesh.file element "
              "'vertex': the file ends early: it claims 4000000000 records of at least 12 bytes, "
              "but only 95024 bytes follow"},
        Input{"huge_count.stl",
              "MALFORMED_FILE [value=214748364834, limit=250084] mesh.file ends early: it claims "
              "4294967295 triangles, which take 214748364834 bytes, but has only 250084"},
        Input{"inches.obj", ""},
        Input{"index_out_of_range.obj",
              "OUT_OF_RANGE [value=3502, limit=[1, 2502], line=7495] mesh.file line 7495: a corner "
              "of face 4991 is 3502, must be in [1, 2502]"},
        Input{"index_zero.obj",
              "OUT_OF_RANGE [value=0, limit=[1, 2000000], line=7495] mesh.file line 7495: a corner "
              "of face 4991 is 0, must be in [1, 2000000]"},
        Input{"inside_out.obj", "INSIDE_OUT"}, Input{"lying_on_back.obj", ""},
        Input{"many_small_holes.obj", "HOLES_CLOSED"}, Input{"millimetres.obj", ""},
        Input{"mirrored.obj", "INSIDE_OUT"}, Input{"mixed_polygons.obj", ""},
        Input{"nan.ply",
              "NOT_FINITE [value=nan, limit=finite, element=vertex, row=0] mesh.file element "
              "'vertex' row 0: x is nan, must be finite"},
        Input{"nan_and_inf.obj",
              "NOT_FINITE [value=nan, limit=finite, line=52] mesh.file line 52: x is nan, must be "
              "finite"},
        Input{"no_faces.obj", "MISSING mesh.file has no faces"}, Input{"no_left_arm.obj", ""},
        Input{"no_mesh.glb", "MISSING mesh.file has no mesh: its scene draws no triangles"},
        Input{"nonmanifold_edge.obj", "FINS_DROPPED"},
        Input{"nonmanifold_vertex.obj", "UNUSED_VERTICES NONMANIFOLD_VERTICES"},
        Input{"one_arm_up.obj", ""}, Input{"open_hole.obj", "UNUSED_VERTICES HOLES_CLOSED"},
        Input{"open_neck_wrists_ankles.obj", "HOLES_CLOSED"}, Input{"rolled_90.obj", ""},
        Input{"sitting.obj", ""}, Input{"sphere.obj", ""},
        Input{"text_not_mesh.obj",
              "MISSING mesh.file holds nothing to read: an OBJ file has lines 'v x y z'"},
        Input{"torus.obj", ""}, Input{"triangle_soup.obj", "VERTICES_WELDED"},
        Input{"triangle_soup_noisy.obj", "VERTICES_WELDED"},
        Input{"truncated.glb",
              "MALFORMED_FILE [value=60724, limit=30362] mesh.file ends early: its header claims "
              "60724 bytes, but it has only 30362"},
        Input{"truncated.ply",
              "MALFORMED_FILE [value=5000, limit=2556, element=face, row=2556] mesh.file element "
              "'face' row 2556: the file ends early: it claims 5000 records of element 'face', but "
              "has only 2556"},
        Input{"truncated.stl",
              "MALFORMED_FILE [value=250084, limit=125049] mesh.file ends early: it claims 5000 "
              "triangles, which take 250084 bytes, but has only 125049"},
        Input{"turned_37.obj", ""},
        Input{"two_people.obj",
              "TWO_BODIES two separate parts are of similar size (the second has 100 % of the "
              "first one's volume); send one body"},
        Input{"unused_vertices.obj", "UNUSED_VERTICES"}, Input{"upper_half.obj", ""},
        Input{"upper_half_open.obj", "HOLES_CLOSED"}, Input{"upside_down.obj", ""},
        Input{"z_up.obj", ""}, Input{"zero_area_faces.obj", "FINS_DROPPED DEGENERATE_FACES"}),
    [](const auto& test) {
      std::string name = test.param.file;
      for (char& c : name) c = c == '.' ? '_' : c;
      return name;
    });

// What is mended must be the good body again.
TEST(RealFilesTest, MendedBodiesAreTheGoodBody) {
  CAPFIT_REQUIRE_BODIES();
  const std::filesystem::path folder = test_support::BodiesFolder() / "broken";
  const PreparedMesh good = PreparedFile(folder / "good_5k.obj");
  const SurfaceKey expected = KeyOf(good.mesh, 1e-5);
  for (const char* const file : {"duplicate_faces.obj", "flipped_some.obj", "floating_parts.obj",
                                 "inside_out.obj", "nonmanifold_edge.obj", "triangle_soup.obj",
                                 "unused_vertices.obj", "zero_area_faces.obj"}) {
    EXPECT_EQ(KeyOf(PreparedFile(folder / file).mesh, 1e-5), expected) << file;
  }
  for (const char* const file : {"many_small_holes.obj", "open_hole.obj", "far_from_origin.obj"}) {
    EXPECT_NEAR(PreparedFile(folder / file).mesh.volume(), good.mesh.volume(), 2e-5) << file;
  }
  // Kilometres away no digit is lost: the file has four decimals.
  const PreparedMesh far = PreparedFile(folder / "far_from_origin.obj");
  for (std::size_t i = 0; i < good.mesh.vertices().size(); ++i) {
    const Eigen::Vector3d moved = VertexOfSource(good, i) + Eigen::Vector3d(10000, 5000, -20000);
    ASSERT_LT((VertexOfSource(far, i) - moved).norm(), 1e-9) << i;
  }
}

}  // namespace
}  // namespace capfit::mesh
