// Whole fits of avatars of many parts against their ground truth, with their skeletons and without.
#include "tests/support/avatars.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/formats/read_mesh.h"
#include "core/pipeline/fit.h"
#include "core/skinning/mean_value_coordinates.h"
#include "tests/support/bodies.h"

namespace capfit::pipeline {
namespace {

using formats::PolygonSoup;
using nlohmann::json;

json Truths() {
  return json::parse(test_support::ReadFile(test_support::AvatarsFolder() / "truth.json"));
}

PolygonSoup ReadAvatar(const json& truth) {
  const std::string bytes =
      test_support::ReadFile(test_support::AvatarsFolder() / truth.at("file").get<std::string>());
  auto soup = formats::ReadMesh(std::as_bytes(std::span(bytes)));
  EXPECT_TRUE(soup.ok()) << soup.status();
  return soup.ok() ? *std::move(soup) : PolygonSoup();
}

// Where a part of the truth begins among the soup's faces.
std::size_t FirstFace(const json& part, const PolygonSoup& soup) {
  const std::size_t within = part.value("first_face", std::size_t{0});
  for (const formats::SoupPart& own : soup.parts) {
    if (own.name == part.at("node").get<std::string>()) return own.first_face + within;
  }
  return within;
}

FitResult FitAvatar(const PolygonSoup& soup, const std::string& name, FitOptions options = {}) {
  options.parts = {true, true, true, true, true, true};
  NullObserver observer;
  const auto result = Fit(soup, options, ThreadPool(2), observer);
  EXPECT_TRUE(result.ok()) << name << ": " << result.status();
  return result.ok() ? *result : FitResult();
}

// By the truth, how far the vertices to cover stick out at most, in metres.
double FurthestOut(const json& truth, const PolygonSoup& soup, const FitResult& result) {
  const auto solids = capsule::Solids(result.primitives);
  double furthest = -1.0;
  for (const json& part : truth.at("parts")) {
    if (part.at("cover") != "yes") continue;
    const std::size_t first = FirstFace(part, soup);
    for (std::size_t c = 3 * first; c < 3 * (first + part.at("faces").get<std::size_t>()); ++c) {
      const Eigen::Vector3d& vertex = soup.positions[soup.face_vertices[c]];
      double least = 1e300;
      for (const auto& solid : solids) least = std::min(least, solid.SignedDistance(vertex));
      furthest = std::max(furthest, truth.at("metres_per_file_unit").get<double>() * least);
    }
  }
  return furthest;
}

// The faces that were fitted, of all parts of a file by the name of their node.
std::size_t FacesTaken(const FitResult& result) {
  std::size_t faces = 0;
  for (const character::CharacterPart& part : result.body.parts) {
    faces += part.is_included ? part.face_count : 0;
  }
  return faces;
}

std::size_t FacesToCover(const json& truth) {
  std::size_t faces = 0;
  for (const json& part : truth.at("parts")) {
    faces += part.at("cover") == "yes" ? part.at("faces").get<std::size_t>() : 0;
  }
  return faces;
}

std::vector<double> JointErrorsMm(const json& truth, const FitResult& result) {
  std::vector<double> errors;
  for (const LandmarkResult& landmark : result.landmarks) {
    const auto joint = truth.at("joints").find(landmark.name);
    if (joint == truth.at("joints").end()) continue;
    const Eigen::Vector3d at((*joint)[0], (*joint)[1], (*joint)[2]);
    const double metres = truth.at("metres_per_file_unit");
    errors.push_back(1e3 * (metres * landmark.position - at).norm());
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

class AvatarsTest : public testing::TestWithParam<bool> {};

TEST_P(AvatarsTest, AreTakenAsTheTruthSaysAndEnclosed) {
  CAPFIT_REQUIRE_AVATARS();
  const bool has_rig = GetParam();
  const json truths = Truths();
  for (const auto& [name, truth] : truths.items()) {
    PolygonSoup soup = ReadAvatar(truth);
    if (!has_rig) {
      soup.joints.clear();
      soup.influences.clear();
    }
    const FitResult result = FitAvatar(soup, name);
    EXPECT_EQ(FacesTaken(result), FacesToCover(truth)) << name;
    EXPECT_LE(FurthestOut(truth, soup, result), 1e-6) << name;
    EXPECT_EQ(result.metrics.vertices_out, 0) << name;
    const bool is_told = has_rig && truth.at("rig").is_object();
    const std::vector<double> errors_mm = JointErrorsMm(truth, result);
    ASSERT_GE(errors_mm.size(), 12U) << name;
    EXPECT_LE(errors_mm[errors_mm.size() / 2], is_told ? 15.0 : 20.5) << name;
    EXPECT_LE(errors_mm.back(), is_told ? 45.0 : 60.0) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Skeletons, AvatarsTest, testing::Values(true, false),
                         [](const auto& given) { return given.param ? "With" : "Without"; });

TEST(AvatarOptionsTest, HairSkirtAndNamesDecideWhatIsEnclosed) {
  CAPFIT_REQUIRE_AVATARS();
  const json truth = Truths().at("skirt_woman");
  const PolygonSoup soup = ReadAvatar(truth);
  FitOptions options;
  options.character.hair = true;
  options.character.skirt = true;
  options.character.exclude = {"Shoes*"};
  const FitResult result = FitAvatar(soup, "skirt_woman", options);
  for (const character::CharacterPart& part : result.body.parts) {
    if (part.name == "Hair_01" || part.name == "Skirt_01_CLOTH") {
      EXPECT_TRUE(part.is_included) << part.name << " " << part.reason;
    }
    if (part.name == "Shoes_01_CLOTH") {
      EXPECT_FALSE(part.is_included);
    }
  }
}

// A shirt may join arm and trunk below the armpit; the chest is no arm for that.
TEST(AvatarLabelsTest, NothingOfTheTrunkIsAnArm) {
  CAPFIT_REQUIRE_AVATARS();
  FitOptions options;
  options.parts = {false, true, false, false, false, false};
  options.want_vertex_gaps = true;
  const json truths = Truths();
  for (const auto& [avatar, truth] : truths.items()) {
    const PolygonSoup soup = ReadAvatar(truth);
    NullObserver observer;
    const auto result = Fit(soup, options, ThreadPool(2), observer);
    ASSERT_TRUE(result.ok()) << result.status();
    double shoulder = 1e300;
    double armpit = 1e300;
    for (const LandmarkResult& landmark : result->landmarks) {
      const Eigen::Vector3d at = result->body_from_caller.Apply(landmark.position);
      if (landmark.name.ends_with("_shoulder")) shoulder = std::min(shoulder, std::abs(at.x()));
      if (landmark.name.ends_with("_armpit")) armpit = std::min(armpit, at.y());
    }
    ASSERT_LT(shoulder, 1.0);
    double innermost = 1e300;
    for (std::size_t v = 0; v < result->vertex_gaps.size(); ++v) {
      if (std::isnan(result->vertex_gaps[v])) continue;
      const Eigen::Vector3d at = result->body_from_caller.Apply(soup.positions[v]);
      if (at.y() < armpit) innermost = std::min(innermost, std::abs(at.x()));
    }
    EXPECT_GT(innermost, 0.5 * shoulder) << avatar;
  }
}

TEST(AvatarWeightsTest, CarryTheCentresFromTheFilesOwnVertices) {
  CAPFIT_REQUIRE_AVATARS();
  const json truth = Truths().at("dressed_deleted_man");
  const PolygonSoup soup = ReadAvatar(truth);
  FitOptions options;
  options.skinning = SkinningMode::kDense;
  options.want_vertex_gaps = true;
  const FitResult result = FitAvatar(soup, "dressed_deleted_man", options);
  ASSERT_TRUE(result.weights.has_value());
  ASSERT_EQ(result.weights->vertex_count, soup.positions.size());
  const auto centers = skinning::Apply(*result.weights, soup.positions, ThreadPool(1));
  for (std::size_t i = 0; i < centers.size(); ++i) {
    EXPECT_LE((centers[i] - result.primitives.spheres[i].center_m).norm(), 1e-5) << i;
  }
  ASSERT_EQ(result.vertex_gaps.size(), soup.positions.size());
  for (const float gap : result.vertex_gaps) {
    if (!std::isnan(gap)) {
      EXPECT_LE(gap, 1e-6F);
    }
  }
}

TEST(AvatarThreadsTest, SameBitsForAnyNumberOfThreads) {
  CAPFIT_REQUIRE_AVATARS();
  const PolygonSoup soup = ReadAvatar(Truths().at("armour_man"));
  NullObserver observer;
  const auto one = Fit(soup, {}, ThreadPool(1), observer);
  const auto many = Fit(soup, {}, ThreadPool(5), observer);
  ASSERT_TRUE(one.ok() && many.ok());
  EXPECT_EQ(one->primitives.capsules, many->primitives.capsules);
  for (std::size_t i = 0; i < one->primitives.spheres.size(); ++i) {
    EXPECT_EQ(one->primitives.spheres[i].center_m, many->primitives.spheres[i].center_m);
  }
}

}  // namespace
}  // namespace capfit::pipeline
