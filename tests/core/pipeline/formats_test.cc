// The same body in every file format gives the same fit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/formats/read_mesh.h"
#include "core/pipeline/fit.h"
#include "tests/core/pipeline/glb_bytes.h"
#include "tests/support/bodies.h"

namespace capfit::pipeline {
namespace {

using formats::MeshFormat;
using formats::PolygonSoup;

constexpr double kSameShare = 1e-6;  // of the body's height

PolygonSoup ReadBytes(const std::string& bytes, MeshFormat format) {
  auto soup = formats::ReadMesh(std::as_bytes(std::span(bytes)), format);
  EXPECT_TRUE(soup.ok()) << soup.status();
  return soup.ok() ? *std::move(soup) : PolygonSoup();
}

PolygonSoup ReadBody(const std::string& name) {
  const std::filesystem::path path = test_support::BodiesFolder() / name;
  return ReadBytes(test_support::ReadFile(path), formats::FormatFromFileName(name));
}

FitResult FitSoup(const PolygonSoup& soup) {
  const ThreadPool pool(1);
  NullObserver observer;
  auto result = Fit(soup, FitOptions(), pool, observer);
  EXPECT_TRUE(result.ok()) << result.status();
  return result.ok() ? *std::move(result) : FitResult();
}

double HeightOf(const PolygonSoup& soup) {
  double low = 1e300;
  double high = -1e300;
  for (const Eigen::Vector3d& p : soup.positions) {
    low = std::min(low, p.y());
    high = std::max(high, p.y());
  }
  return high - low;
}

// The furthest that a sphere's centre or radius is from its twin's; infinite where they are not the
// same spheres and capsules.
double WorstSphere(const FitResult& a, const FitResult& b) {
  const auto& p = a.primitives;
  const auto& q = b.primitives;
  if (p.spheres.size() != q.spheres.size() || p.capsules != q.capsules) return HUGE_VAL;
  double worst = 0.0;
  for (std::size_t i = 0; i < p.spheres.size(); ++i) {
    worst = std::max({worst, (p.spheres[i].center_m - q.spheres[i].center_m).norm(),
                      std::abs(p.spheres[i].radius_m - q.spheres[i].radius_m)});
  }
  return worst;
}

double WorstLandmark(const FitResult& a, const FitResult& b) {
  if (a.landmarks.size() != b.landmarks.size()) return HUGE_VAL;
  double worst = 0.0;
  for (std::size_t i = 0; i < a.landmarks.size(); ++i) {
    worst = std::max(worst, (a.landmarks[i].position - b.landmarks[i].position).norm());
  }
  return worst;
}

void PrintRow(const std::string& file, const std::string& twin, const FitResult& a,
              const FitResult& b) {
  std::printf("%-46s %-34s %10.6f %10.6f %7.4f\n", file.c_str(), twin.c_str(),
              1e3 * WorstSphere(a, b), 1e3 * WorstLandmark(a, b), b.metrics.E_r);
}

// Files of the same numbers: those with five digits in text, and those with the unrounded ones as
// floats. Order and sharing of vertices differ (STL), as do triangles and quads.
TEST(Formats, TheSameNumbersGiveTheSameFitInEveryFormat) {
  CAPFIT_REQUIRE_BODIES();
  const std::vector<std::vector<std::string>> groups = {
      {"female_average_rest.obj", "formats/female_average.off"},
      {"formats/female_average.ply", "formats/female_average.glb", "formats/female_average.stl"},
      {"male_muscular_rest.obj", "formats/male_muscular_quads.off"},
      {"formats/female_average_5k_ascii.ply", "formats/female_average_5k_ascii.stl"}};
  std::printf("%-46s %-34s %10s %10s %7s\n", "file", "twin", "sphere mm", "landm. mm", "E_r");
  for (const std::vector<std::string>& group : groups) {
    const PolygonSoup twin = ReadBody(group[0]);
    const FitResult expected = FitSoup(twin);
    for (std::size_t i = 1; i < group.size(); ++i) {
      const FitResult result = FitSoup(ReadBody(group[i]));
      PrintRow(group[i], group[0], expected, result);
      EXPECT_LE(WorstSphere(expected, result), kSameShare * HeightOf(twin)) << group[i];
    }
  }
}

// Floats round vertices by a tenth of a micrometre, and the fit follows them smoothly, a few
// hundred times as far: 0.01 to 0.03 mm, depending on the compiler's flags, where a fit that
// settles elsewhere is millimetres away. Text rounded to five digits moves them by up to 5 um, 3e-6
// of the height, and the STL of the muscular body and the exporter's OBJ have other diagonals: here
// the fit is as good, the landmarks stay where they are, but coverage may settle elsewhere.
TEST(Formats, OtherDigitsOrDiagonalsGiveAsGoodAFit) {
  CAPFIT_REQUIRE_BODIES();
  struct Twin {
    const char* file;
    const char* twin;
    double landmark_mm;
    double sphere_mm;
  };
  for (const Twin& pair :
       {Twin{"formats/female_average.ply", "female_average_rest.obj", 0.1, HUGE_VAL},
        Twin{"formats/male_muscular_quads_big_endian_double.ply", "male_muscular_rest.obj", 0.1,
             HUGE_VAL},
        Twin{"formats/male_muscular_under_nodes.glb",
             "formats/male_muscular_quads_big_endian_double.ply", 1e-3, 0.1},
        Twin{"formats/male_muscular.stl", "formats/male_muscular_quads_big_endian_double.ply", 1.0,
             HUGE_VAL},
        Twin{"formats/female_average_5k_exporter_style.obj", "formats/female_average_5k_ascii.ply",
             5.0, HUGE_VAL}}) {
    const FitResult expected = FitSoup(ReadBody(pair.twin));
    const FitResult result = FitSoup(ReadBody(pair.file));
    PrintRow(pair.file, pair.twin, expected, result);
    EXPECT_LE(1e3 * WorstLandmark(expected, result), pair.landmark_mm) << pair.file;
    EXPECT_LE(1e3 * WorstSphere(expected, result), pair.sphere_mm) << pair.file;
    EXPECT_NEAR(result.metrics.E_r, expected.metrics.E_r, 0.1 * expected.metrics.E_r) << pair.file;
    EXPECT_TRUE(result.warnings.empty()) << pair.file;
  }
}

void AppendFloats(const Eigen::Vector3d& p, std::string& bytes) {
  for (const double x : p) AppendValue(static_cast<float>(x), bytes);
}

std::string FloatPly(const PolygonSoup& soup) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(soup.positions.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                      std::to_string(soup.face_vertices.size() / 3) +
                      "\nproperty list uchar uint vertex_indices\nend_header\n";
  for (const Eigen::Vector3d& p : soup.positions) AppendFloats(p, bytes);
  for (std::size_t i = 0; i < soup.face_vertices.size(); ++i) {
    if (i % 3 == 0) AppendValue<std::uint8_t>(3, bytes);
    AppendValue(soup.face_vertices[i], bytes);
  }
  return bytes;
}

std::string BinaryStl(const PolygonSoup& soup) {
  std::string bytes(80, ' ');
  AppendValue(static_cast<std::uint32_t>(soup.face_vertices.size() / 3), bytes);
  for (std::size_t i = 0; i < soup.face_vertices.size(); ++i) {
    if (i % 3 == 0) bytes.append(12, '\0');
    AppendFloats(soup.positions[soup.face_vertices[i]], bytes);
    if (i % 3 == 2) bytes.append(2, '\0');
  }
  return bytes;
}

// In centimetres with Z up where it hangs under nodes that say so.
std::string Glb(const PolygonSoup& soup, bool under_nodes) {
  std::string binary;
  for (const Eigen::Vector3d& p : soup.positions) {
    const Eigen::Vector3d z_up_cm(100.0 * p.x(), -100.0 * p.z(), 100.0 * p.y());
    AppendFloats(under_nodes ? z_up_cm : p, binary);
  }
  const std::size_t position_bytes = binary.size();
  for (const std::uint32_t v : soup.face_vertices) AppendValue(v, binary);
  nlohmann::json gltf;
  gltf["asset"]["version"] = "2.0";
  gltf["scenes"] = {{{"nodes", {0}}}};
  const double half = std::sqrt(0.5);
  gltf["nodes"] = {{{"mesh", 0}}};
  if (under_nodes) {
    gltf["nodes"] = {{{"rotation", {-half, 0, 0, half}}, {"children", {1}}},
                     {{"scale", {0.01, 0.01, 0.01}}, {"mesh", 0}}};
  }
  gltf["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}};
  gltf["buffers"] = {{{"byteLength", binary.size()}}};
  gltf["bufferViews"] = {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", position_bytes}},
                         {{"buffer", 0},
                          {"byteOffset", position_bytes},
                          {"byteLength", binary.size() - position_bytes}}};
  gltf["accessors"] = {{{"bufferView", 0},
                        {"componentType", 5126},
                        {"count", soup.positions.size()},
                        {"type", "VEC3"}},
                       {{"bufferView", 1},
                        {"componentType", 5125},
                        {"count", soup.face_vertices.size()},
                        {"type", "SCALAR"}}};
  return GlbBytes(gltf, binary);
}

// What a user's converter does with a text file: the decimals become the floats nearest to them.
TEST(Formats, ConvertedTextGivesTheFitOfTheText) {
  CAPFIT_REQUIRE_BODIES();
  const PolygonSoup text = ReadBody("formats/female_average_5k_ascii.ply");
  const FitResult expected = FitSoup(text);
  struct Conversion {
    const char* name;
    std::string bytes;
    MeshFormat format;
  };
  for (const Conversion& conversion :
       {Conversion{"converted to float PLY", FloatPly(text), MeshFormat::kPly},
        Conversion{"converted to binary STL", BinaryStl(text), MeshFormat::kStl},
        Conversion{"converted to GLB", Glb(text, false), MeshFormat::kGlb},
        Conversion{"converted to GLB, nodes, cm, Z up", Glb(text, true), MeshFormat::kGlb}}) {
    const FitResult result = FitSoup(ReadBytes(conversion.bytes, conversion.format));
    PrintRow(conversion.name, "female_average_5k_ascii.ply", expected, result);
    EXPECT_LE(WorstSphere(expected, result), kSameShare * HeightOf(text)) << conversion.name;
  }
}

}  // namespace
}  // namespace capfit::pipeline
