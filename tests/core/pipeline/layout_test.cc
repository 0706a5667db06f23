// Layouts that are kept: the same spheres, names and capsules on the next body.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "core/base/status.h"
#include "core/formats/read_mesh.h"
#include "core/geometry/tapered_capsule.h"
#include "core/mannequin/mannequin.h"
#include "core/pipeline/fit.h"
#include "core/refine/layouts/standard_layouts.h"
#include "tests/support/avatars.h"
#include "tests/support/bodies.h"

namespace capfit::pipeline {
namespace {

formats::PolygonSoup Mannequin(mannequin::MannequinSex sex, double height_m) {
  mannequin::MannequinOptions options;
  options.faces = 5000;
  options.sex = sex;
  options.height_m = height_m;
  return *mannequin::MakeMannequin(options);
}

absl::StatusOr<FitResult> FitOn(const formats::PolygonSoup& soup, const FitOptions& options,
                                int threads = 2) {
  NullObserver observer;
  return Fit(soup, options, ThreadPool(threads), observer);
}

FitOptions Keeping(const refine::KeptLayout& layout) {
  FitOptions options;
  options.layout = layout;
  options.parts = layout.parts();
  return options;
}

const refine::KeptLayout& Standard() { return *refine::FindStandardLayout("standard-32"); }

void ExpectKept(const FitResult& result, const refine::KeptLayout& layout) {
  std::vector<std::string> names;
  for (const refine::KeptSphere& sphere : layout.spheres) names.push_back(sphere.name);
  EXPECT_EQ(result.sphere_names, names);
  EXPECT_EQ(result.primitives.capsules, layout.capsules);
  for (std::size_t i = 0; i < result.primitives.capsules.size(); ++i) {
    EXPECT_FALSE(result.primitives.Capsule(i).IsSphere()) << i;
  }
  EXPECT_EQ(result.metrics.vertices_out, 0);
  EXPECT_LE(result.metrics.max_gap_m, 1e-3);
}

TEST(Layout, StandardIsKeptOnMannequins) {
  const auto result = FitOn(Mannequin(mannequin::MannequinSex::kMale, 1.8), Keeping(Standard()));
  ASSERT_TRUE(result.ok()) << result.status();
  ExpectKept(*result, Standard());
  EXPECT_EQ(result->effective_options.layout->name, "standard-32");
  EXPECT_FALSE(result->effective_options.max_primitives.has_value());
}

TEST(Layout, OfAResultIsKeptOnTheNextBody) {
  FitOptions options;
  options.quality = Quality::kTight;
  options.max_primitives = 40;
  const auto first = FitOn(Mannequin(mannequin::MannequinSex::kFemale, 1.6), options);
  ASSERT_TRUE(first.ok()) << first.status();
  const refine::KeptLayout layout = LayoutOf(*first);
  for (const FitMode fit : {FitMode::kEnclose, FitMode::kBestFit}) {
    FitOptions keeping = Keeping(layout);
    keeping.parts = options.parts;
    keeping.fit = fit;
    const auto next = FitOn(Mannequin(mannequin::MannequinSex::kMale, 1.85), keeping);
    ASSERT_TRUE(next.ok()) << next.status();
    EXPECT_EQ(next->sphere_names, first->sphere_names);
    EXPECT_EQ(next->primitives.capsules, first->primitives.capsules);
    if (fit == FitMode::kEnclose) ExpectKept(*next, layout);
  }
}

TEST(Layout, SameBitsForAnyThreadCount) {
  const formats::PolygonSoup soup = Mannequin(mannequin::MannequinSex::kFemale, 1.7);
  const auto one = FitOn(soup, Keeping(Standard()), 1);
  const auto three = FitOn(soup, Keeping(Standard()), 3);
  ASSERT_TRUE(one.ok() && three.ok());
  for (std::size_t i = 0; i < one->primitives.spheres.size(); ++i) {
    EXPECT_EQ(one->primitives.spheres[i].center_m, three->primitives.spheres[i].center_m);
    EXPECT_EQ(one->primitives.spheres[i].radius_m, three->primitives.spheres[i].radius_m);
  }
}

TEST(Layout, ExcludesABudgetAndEnginesThatCannotKeepIt) {
  FitOptions options = Keeping(Standard());
  options.max_primitives = 64;
  EXPECT_EQ(ReasonOf(ValidateOptions(options)), ErrorReason::kConflict);
  options = Keeping(Standard());
  options.engine = "vrm";
  EXPECT_EQ(FieldOf(ValidateOptions(options)), "options.engine");
  options.engine = "unity_cloth";
  EXPECT_TRUE(ValidateOptions(options).ok());
  options.layout->spheres.push_back(options.layout->spheres.front());
  options.layout->spheres.back().name = "one_more";
  options.layout->spheres.back().mirror = -1;
  EXPECT_EQ(FieldOf(ValidateOptions(options)), "layout.spheres");
}

// Whole bodies, and avatars.
std::vector<std::filesystem::path> BodiesAndAvatars() {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path& path : test_support::BodyFiles()) {
    if (path.string().find("no_hands") == std::string::npos) files.push_back(path);
  }
  for (const auto& entry : std::filesystem::directory_iterator(test_support::AvatarsFolder())) {
    if (entry.path().extension() == ".glb") files.push_back(entry.path());
  }
  return files;
}

// Graph and names, nothing outside, E_r beside the free fit. What one body's free fit comes to is
// the search's luck, so the median is that of all.
TEST(Layout, StandardServesAllBodies) {
  CAPFIT_REQUIRE_BODIES();
  CAPFIT_REQUIRE_AVATARS();  // the limit holds for both together
  FitOptions free;
  free.quality = Quality::kTight;
  free.parts = Standard().parts();
  free.max_spheres = free.max_capsules = 32;
  std::vector<double> ratios;
  for (const std::filesystem::path& path : BodiesAndAvatars()) {
    SCOPED_TRACE(path.filename().string());
    const std::string bytes = test_support::ReadFile(path);
    const auto soup = formats::ReadMesh(std::as_bytes(std::span(bytes)),
                                        formats::FormatFromFileName(path.string()));
    ASSERT_TRUE(soup.ok()) << soup.status();
    const auto kept = FitOn(*soup, Keeping(Standard()));
    ASSERT_TRUE(kept.ok()) << kept.status();
    ExpectKept(*kept, Standard());
    const auto best = FitOn(*soup, free);
    ASSERT_TRUE(best.ok()) << best.status();
    ratios.push_back(kept->metrics.E_r / best->metrics.E_r);
  }
  ASSERT_GE(ratios.size(), 25U);
  std::sort(ratios.begin(), ratios.end());
  // The free search starts from this layout as well, and gets better than it as the search does.
  EXPECT_GE(ratios.front(), 0.95);
  EXPECT_LE(ratios[ratios.size() / 2], 1.09);
  EXPECT_LE(ratios.back(), 1.25);
}

}  // namespace
}  // namespace capfit::pipeline
