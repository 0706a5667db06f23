// Bad and awkward inputs through the whole fit: what comes out, how long it takes and what it
// costs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <iterator>
#include <span>
#include <string>

#include "core/base/status.h"
#include "core/formats/read_mesh.h"
#include "core/pipeline/fit.h"
#include "tests/support/bodies.h"
#include "tests/support/sanitizers.h"

namespace capfit::pipeline {
namespace {

constexpr double kMostSeconds = 2.0;
constexpr double kMostMegabytes = 500.0;

struct BrokenInput {
  const char* file;
  const char* outcome;  // "OK" and the warnings, or the code and the reason or field
  const char* message;  // a part of the refusal
};

// docs/mesh_repair.md says the same in words.
constexpr BrokenInput kInputs[] = {
    {"anisotropic.obj", "OK PART_MISSING PART_MISSING", ""},
    {"arms_fused_to_torso.obj", "OK PART_MISSING PART_MISSING", ""},
    {"arms_through_torso.obj", "OK SURFACE_OVERLAPS", ""},
    {"bad_buffer_view.glb", "INVALID_ARGUMENT OUT_OF_RANGE", "mesh.file buffer view 1"},
    {"centimetres.obj", "OK UNIT_ASSUMED", ""},
    {"cube.obj", "FAILED_PRECONDITION NOT_A_BODY", "found 0 of 5 extremities"},
    {"duplicate_faces.obj", "OK DUPLICATE_FACES", ""},
    {"empty.obj", "INVALID_ARGUMENT MISSING", "mesh.file is empty"},
    {"facing_back.obj", "OK", ""},
    {"far_from_origin.obj", "OK", ""},
    {"flipped_some.obj", "OK FACES_TURNED", ""},
    {"floating_parts.obj", "OK PARTS_LEFT_OUT", ""},
    {"good_5k.obj", "OK", ""},
    {"huge_count.ply", "INVALID_ARGUMENT MALFORMED_FILE", "claims 4000000000 records"},
    {"huge_count.stl", "INVALID_ARGUMENT MALFORMED_FILE", "claims 4294967295 triangles"},
    {"inches.obj", "OK UNIT_ASSUMED", ""},
    {"index_out_of_range.obj", "INVALID_ARGUMENT OUT_OF_RANGE", "mesh.file line 7495: "},
    {"index_zero.obj", "INVALID_ARGUMENT OUT_OF_RANGE", "mesh.file line 7495: "},
    {"inside_out.obj", "OK INSIDE_OUT", ""},
    {"lying_on_back.obj", "OK", ""},
    {"many_small_holes.obj", "OK HOLES_CLOSED", ""},
    {"millimetres.obj", "OK UNIT_ASSUMED", ""},
    {"mirrored.obj", "OK INSIDE_OUT", ""},
    {"mixed_polygons.obj", "OK", ""},
    {"nan.ply", "INVALID_ARGUMENT NOT_FINITE", "element 'vertex' row 0: x is nan"},
    {"nan_and_inf.obj", "INVALID_ARGUMENT NOT_FINITE", "line 52: x is nan"},
    {"no_faces.obj", "INVALID_ARGUMENT MISSING", "has no faces"},
    {"no_left_arm.obj", "OK PART_MISSING", ""},
    {"no_mesh.glb", "INVALID_ARGUMENT MISSING", "has no mesh"},
    {"nonmanifold_edge.obj", "OK FINS_DROPPED", ""},
    {"nonmanifold_vertex.obj",
     "OK UNUSED_VERTICES NONMANIFOLD_VERTICES PART_MISSING SECTION_MISSED SECTION_MISSED", ""},
    {"one_arm_up.obj", "OK", ""},
    {"open_hole.obj", "OK UNUSED_VERTICES HOLES_CLOSED", ""},
    {"open_neck_wrists_ankles.obj",
     "OK HOLES_CLOSED PART_MISSING PART_MISSING PART_MISSING PART_MISSING PART_MISSING", ""},
    {"rolled_90.obj", "OK", ""},
    {"sitting.obj", "OK SURFACE_OVERLAPS", ""},
    {"sphere.obj", "FAILED_PRECONDITION NOT_A_BODY", "found 0 of 5 extremities"},
    {"text_not_mesh.obj", "INVALID_ARGUMENT MISSING", "nothing to read"},
    {"torus.obj", "FAILED_PRECONDITION NOT_A_BODY", "found 0 of 5 extremities"},
    {"triangle_soup.obj", "OK VERTICES_WELDED", ""},
    {"triangle_soup_noisy.obj", "OK VERTICES_WELDED", ""},
    {"truncated.glb", "INVALID_ARGUMENT MALFORMED_FILE", "ends early"},
    {"truncated.ply", "INVALID_ARGUMENT MALFORMED_FILE", "ends early"},
    {"truncated.stl", "INVALID_ARGUMENT MALFORMED_FILE", "ends early"},
    {"turned_37.obj", "OK", ""},
    {"two_people.obj", "FAILED_PRECONDITION TWO_BODIES", "send one body"},
    {"unused_vertices.obj", "OK UNUSED_VERTICES", ""},
    {"upper_half.obj", "OK PART_MISSING PART_MISSING", ""},
    {"upper_half_open.obj", "OK HOLES_CLOSED PART_MISSING PART_MISSING", ""},
    {"upside_down.obj", "OK", ""},
    {"z_up.obj", "OK", ""},
    {"zero_area_faces.obj", "OK FINS_DROPPED DEGENERATE_FACES", ""},
};

absl::StatusOr<FitResult> FitFile(const std::filesystem::path& path) {
  const std::string bytes = test_support::ReadFile(path);
  const auto soup = formats::ReadMesh(std::as_bytes(std::span(bytes)),
                                      formats::FormatFromFileName(path.string()));
  if (!soup.ok()) return soup.status();
  const ThreadPool pool(1);
  NullObserver observer;
  return Fit(*soup, FitOptions(), pool, observer);
}

std::string OutcomeOf(const absl::StatusOr<FitResult>& result) {
  if (!result.ok()) {
    const absl::Status& status = result.status();
    const std::optional<ErrorReason> reason = ReasonOf(status);
    return std::string(absl::StatusCodeToString(status.code())) + " " +
           (reason ? std::string(ErrorReasonName(*reason)) : "no reason");
  }
  std::string outcome = "OK";
  for (const Warning& warning : result->warnings) outcome += " " + warning.code;
  return outcome;
}

double PeakMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// A sanitizer's own time and memory are not what is promised.
constexpr bool kIsMeasured = !test_support::kIsSanitized;

// (Processor time, because machines may be busy; the peak is that of all inputs so far.)
TEST(BrokenBodies, EachDoesWhatIsWrittenOfItInTimeAndSpace) {
  CAPFIT_REQUIRE_BODIES();
  const std::filesystem::path folder = test_support::BodiesFolder() / "broken";
  std::printf("%-28s %7s %6s  %s\n", "input", "CPU s", "MB", "outcome");
  for (const BrokenInput& input : kInputs) {
    if (!std::filesystem::exists(folder / input.file)) continue;
    const std::clock_t start = std::clock();
    const absl::StatusOr<FitResult> result = FitFile(folder / input.file);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const double megabytes = PeakMegabytes();
    const std::string outcome = OutcomeOf(result);
    std::printf("%-28s %7.2f %6.0f  %s\n", input.file, seconds, megabytes, outcome.c_str());
    EXPECT_EQ(outcome, input.outcome) << input.file;
    EXPECT_THAT(std::string(result.status().message()), testing::HasSubstr(input.message))
        << input.file;
    if (!kIsMeasured) continue;
    EXPECT_LE(seconds, kMostSeconds) << input.file;
    EXPECT_LE(megabytes, kMostMegabytes) << input.file;
  }
}

// The table leaves none out.
TEST(BrokenBodies, AllAreListed) {
  CAPFIT_REQUIRE_BODIES();
  for (const auto& entry :
       std::filesystem::directory_iterator(test_support::BodiesFolder() / "broken")) {
    const std::string name = entry.path().filename().string();
    if (name == "README.md") continue;
    EXPECT_TRUE(std::any_of(std::begin(kInputs), std::end(kInputs), [&](const BrokenInput& input) {
      return name == input.file;
    })) << name;
  }
}

// What is mended is the good body again, sphere by sphere.
TEST(BrokenBodies, MendedBodiesGetTheFitOfTheGoodOne) {
  CAPFIT_REQUIRE_BODIES();
  const std::filesystem::path folder = test_support::BodiesFolder() / "broken";
  const auto good = FitFile(folder / "good_5k.obj");
  ASSERT_TRUE(good.ok()) << good.status();
  for (const char* const file : {"duplicate_faces.obj", "flipped_some.obj", "floating_parts.obj",
                                 "inside_out.obj", "nonmanifold_edge.obj", "triangle_soup.obj",
                                 "unused_vertices.obj", "zero_area_faces.obj"}) {
    const auto mended = FitFile(folder / file);
    ASSERT_TRUE(mended.ok()) << file << mended.status();
    ASSERT_EQ(mended->primitives.spheres.size(), good->primitives.spheres.size()) << file;
    for (std::size_t i = 0; i < good->primitives.spheres.size(); ++i) {
      const geometry::Sphere& a = good->primitives.spheres[i];
      const geometry::Sphere& b = mended->primitives.spheres[i];
      EXPECT_LE((a.center_m - b.center_m).norm(), 1e-9) << file << " sphere " << i;
      EXPECT_NEAR(a.radius_m, b.radius_m, 1e-9) << file << " sphere " << i;
    }
  }
}

}  // namespace
}  // namespace capfit::pipeline
