#include "core/pipeline/sphere_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "core/body/find_body.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"
#include "core/pipeline/fit.h"
#include "core/pipeline/to_caller_frame.h"

namespace capfit::pipeline {
namespace {

using body::LandmarkId;
using body::Part;
using testing::ElementsAre;

formats::PolygonSoup SmallMannequin() {
  mannequin::MannequinOptions options;
  options.faces = 5000;
  return *mannequin::MakeMannequin(options);
}

body::Body BodyOf(const formats::PolygonSoup& soup) {
  const auto prepared = mesh::PrepareMesh(soup);
  EXPECT_TRUE(prepared.ok());
  auto body = body::FindBody(prepared->mesh, {}, ThreadPool(1), NullObserver());
  EXPECT_TRUE(body.ok()) << body.status();
  return *std::move(body);
}

FitOptions AllPartsWith(int max_primitives, Quality quality) {
  FitOptions options;
  options.max_primitives = max_primitives;
  options.quality = quality;
  options.parts = {true, true, true, true, true, true};
  return options;
}

// The set in the body frame.
capsule::PrimitiveSet SetOf(const formats::PolygonSoup& soup, const FitOptions& options) {
  NullObserver observer;
  const auto result = Fit(soup, options, ThreadPool(2), observer);
  EXPECT_TRUE(result.ok()) << result.status();
  return ToCallerFrame(result->primitives, result->body_from_caller);
}

std::vector<std::string> NamesOf(const formats::PolygonSoup& soup, const FitOptions& options) {
  return SphereNames(BodyOf(soup), SetOf(soup, options));
}

// "left" for "right" and the other way round.
std::string Mirrored(std::string name) {
  for (const auto& [from, to] : {std::pair("left", "right"), std::pair("right", "left")}) {
    const std::size_t at = name.find(from);
    if (at != std::string::npos) return name.replace(at, std::string(from).size(), to);
  }
  return name;
}

void ExpectUniqueAndPaired(const std::vector<std::string>& names,
                           const capsule::PrimitiveSet& set) {
  ASSERT_EQ(names.size(), set.spheres.size());
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const int mirror = set.origins[i].mirror;
    if (mirror < 0) continue;
    EXPECT_EQ(names[mirror], Mirrored(names[i]));
    const bool is_sided = Mirrored(names[i]) != names[i];
    EXPECT_EQ(is_sided, mirror != static_cast<int>(i)) << names[i];
  }
}

TEST(SphereNames, AreUniqueAndPairedOnSetsOfAllSizes) {
  const formats::PolygonSoup soup = SmallMannequin();
  const body::Body body = BodyOf(soup);
  for (const Quality quality : {Quality::kPaper, Quality::kTight}) {
    for (const int budget : {22, 64, 100}) {
      const capsule::PrimitiveSet set = SetOf(soup, AllPartsWith(budget, quality));
      const std::vector<std::string> names = SphereNames(body, set);
      ExpectUniqueAndPaired(names, set);
      int with_image = 0;
      for (const auto& origin : set.origins) with_image += origin.mirror >= 0 ? 1 : 0;
      EXPECT_EQ(with_image, static_cast<int>(names.size()));
      if (quality != Quality::kPaper) continue;
      for (const char* const name :
           {"head_1", "left_hand_1", "right_hand_1", "left_foot_1", "left_upper_arm_1",
            "left_forearm_1", "left_thigh_1", "right_calf_1"}) {
        EXPECT_THAT(names, testing::Contains(std::string(name))) << budget;
      }
    }
  }
}

TEST(SphereNames, StayWhenTheBodyIsTurnedScaledAndReordered) {
  const formats::PolygonSoup soup = SmallMannequin();
  formats::PolygonSoup other = soup;
  const Eigen::AngleAxisd turn(1.1, Eigen::Vector3d(0.3, -0.5, 0.8).normalized());
  const std::size_t count = soup.positions.size();
  for (std::size_t v = 0; v < count; ++v) {
    other.positions[count - 1 - v] =
        100.0 * (turn * soup.positions[v] + Eigen::Vector3d(3.0, -2.0, 7.0));
  }
  for (std::uint32_t& vertex : other.face_vertices) {
    vertex = static_cast<std::uint32_t>(count) - 1 - vertex;
  }
  const FitOptions options = AllPartsWith(64, Quality::kPaper);
  EXPECT_EQ(NamesOf(soup, options), NamesOf(other, options));
}

TEST(SphereNames, DoNotDependOnTheOrderOfTheSet) {
  const formats::PolygonSoup soup = SmallMannequin();
  const body::Body body = BodyOf(soup);
  const capsule::PrimitiveSet set = SetOf(soup, AllPartsWith(64, Quality::kPaper));
  capsule::PrimitiveSet other = set;
  std::reverse(other.spheres.begin(), other.spheres.end());
  std::reverse(other.origins.begin(), other.origins.end());
  for (auto& origin : other.origins) {
    if (origin.mirror >= 0)
      origin.mirror = static_cast<int>(set.spheres.size()) - 1 - origin.mirror;
  }
  std::vector<std::string> names = SphereNames(body, other);
  std::reverse(names.begin(), names.end());
  EXPECT_EQ(names, SphereNames(body, set));
}

// One sphere of a part at each place, without images.
capsule::PrimitiveSet Spheres(const std::vector<std::pair<Part, Eigen::Vector3d>>& places) {
  capsule::PrimitiveSet set;
  for (const auto& [part, center_m] : places) {
    set.spheres.push_back({center_m, 0.05});
    set.origins.push_back({part, -1, -1});
  }
  return set;
}

TEST(SphereNames, SayWhereASphereLies) {
  const body::Body body = BodyOf(SmallMannequin());
  const auto at = [&](LandmarkId id) { return body.landmark(id)->position_m; };
  const auto between = [&](LandmarkId a, LandmarkId b, double share) {
    return Eigen::Vector3d((1.0 - share) * at(a) + share * at(b));
  };
  const Eigen::Vector3d aside(0.1, 0.0, 0.0);
  const Eigen::Vector3d up(0.0, 0.01, 0.0);
  const capsule::PrimitiveSet set =
      Spheres({{Part::kTorso, at(LandmarkId::kHip)},
               {Part::kTorso, at(LandmarkId::kWaist)},
               {Part::kTorso, at(LandmarkId::kBust) + aside + up},
               {Part::kTorso, at(LandmarkId::kBust) + aside},
               {Part::kTorso, at(LandmarkId::kBust) - aside},
               {Part::kTorso, at(LandmarkId::kNeck)},
               {Part::kTorso, at(LandmarkId::kRightShoulder)},
               {Part::kHead, at(LandmarkId::kHeadTop)},
               {Part::kLeftArm, between(LandmarkId::kLeftShoulder, LandmarkId::kLeftElbow, 0.8)},
               {Part::kLeftArm, between(LandmarkId::kLeftShoulder, LandmarkId::kLeftElbow, 0.3)},
               {Part::kLeftArm, between(LandmarkId::kLeftElbow, LandmarkId::kLeftWrist, 0.5)},
               {Part::kRightLeg, between(LandmarkId::kRightHip, LandmarkId::kRightKnee, 0.5)},
               {Part::kRightLeg, between(LandmarkId::kRightKnee, LandmarkId::kRightAnkle, 0.5)},
               {Part::kRightFoot, at(LandmarkId::kRightToe)},
               {Part::kRightFoot, at(LandmarkId::kRightAnkle)}});
  EXPECT_THAT(SphereNames(body, set),
              ElementsAre("pelvis_1", "waist_1", "chest_left_2", "chest_left_1", "chest_right_1",
                          "neck_1", "shoulder_right_1", "head_1", "left_upper_arm_2",
                          "left_upper_arm_1", "left_forearm_1", "right_thigh_1", "right_calf_1",
                          "right_foot_2", "right_foot_1"));
}

TEST(SphereNames, AreThereWithoutLandmarksToo) {
  body::Body body = BodyOf(SmallMannequin());
  body.landmarks = {};
  const Eigen::Vector3d somewhere(0.2, 0.9, 0.0);
  const Eigen::Vector3d above(0.2, 1.0, 0.0);
  const capsule::PrimitiveSet set = Spheres({{Part::kTorso, above},
                                             {Part::kTorso, somewhere},
                                             {Part::kLeftArm, somewhere},
                                             {Part::kRightFoot, somewhere},
                                             {Part::kRightFoot, above}});
  EXPECT_THAT(SphereNames(body, set), ElementsAre("torso_left_2", "torso_left_1", "left_arm_1",
                                                  "right_foot_2", "right_foot_1"));
  body.chains = {};
  EXPECT_EQ(SphereNames(body, set)[2], "left_arm_1");
}

// A pair beside a sphere that only one side has, and spheres between the legs.
TEST(SphereNames, CountPairsBeforeWhatOneSideHasAlone) {
  const body::Body body = BodyOf(SmallMannequin());
  const Eigen::Vector3d knee = body.landmark(LandmarkId::kLeftKnee)->position_m;
  const Eigen::Vector3d image(-knee.x(), knee.y(), knee.z());
  const Eigen::Vector3d thigh = knee + Eigen::Vector3d(0.0, 0.2, 0.0);
  capsule::PrimitiveSet set = Spheres({{Part::kRightLeg, image - Eigen::Vector3d(0.0, 0.1, 0.0)},
                                       {Part::kLeftLeg, knee - Eigen::Vector3d(0.0, 0.1, 0.0)},
                                       {Part::kLeftLeg, knee - Eigen::Vector3d(0.0, 0.05, 0.0)},
                                       {Part::kLeftLeg, Eigen::Vector3d(0.0, thigh.y(), 0.0)}});
  set.origins[0].mirror = 1;
  set.origins[1].mirror = 0;
  set.origins[3].mirror = 3;
  EXPECT_THAT(SphereNames(body, set),
              ElementsAre("right_calf_1", "left_calf_1", "left_calf_2", "pelvis_1"));
}

}  // namespace
}  // namespace capfit::pipeline
