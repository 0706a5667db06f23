// Landmarks and segments against the ground truth of real body shapes: the room's hard limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/core/body/body_files.h"
#include "tests/support/bodies.h"

namespace capfit::body {
namespace {

TEST(Accuracy, JointsAndSegmentsOfAllPosedBodies) {
  CAPFIT_REQUIRE_BODIES();
  std::vector<double> errors_mm;
  for (const PosedBody& posed : PosedBodies()) {
    SCOPED_TRACE(posed.file);
    const auto body = Find(LoadBody(posed.file));
    ASSERT_TRUE(body.ok()) << body.status();
    EXPECT_TRUE(body->warnings.empty()) << body->warnings.front().message;
    EXPECT_GE(LabelledRight(*body, "labels.bin"), 0.95);
    for (const auto& [name, truth] : posed.points) {
      if (IsMainJoint(name)) {
        errors_mm.push_back(ErrorMm(*body, name, truth));
        EXPECT_LE(errors_mm.back(), 45.0) << name;
      } else if (IsShoulderOrHip(name)) {
        EXPECT_LE(ErrorMm(*body, name, truth), 60.0) << name;
      } else if (name == "head_top" || name.ends_with("fingertip") || name.ends_with("toe_tip")) {
        EXPECT_LE(ErrorMm(*body, name, truth), 20.0) << name;
      }
    }
  }
  ASSERT_EQ(errors_mm.size(), 17u * 10u);
  std::nth_element(errors_mm.begin(), errors_mm.begin() + 85, errors_mm.end());
  EXPECT_LE(errors_mm[85], 15.0);
}

// The side of a wide chest lies beyond the plane through the shoulder's cap, but it is no arm.
class Chest : public testing::TestWithParam<std::string> {};

TEST_P(Chest, IsNoArmBelowTheArmpits) {
  CAPFIT_REQUIRE_BODIES();
  const auto body = Find(LoadBody(GetParam() + ".obj"));
  ASSERT_TRUE(body.ok()) << body.status();
  const std::string truth = test_support::ReadFile(test_support::BodiesFolder() / "labels.bin");
  const auto sources = body->mesh.vertex_of_source();
  ASSERT_EQ(truth.size(), sources.size());
  int below = 0;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Segment found = body->vertex_segments[sources[i]];
    const bool is_left = found == Segment::kLeftUpperArm;
    if (truth[i] != static_cast<char>(Segment::kTorso)) continue;
    if (!is_left && found != Segment::kRightUpperArm) continue;
    const auto& armpit =
        body->landmark(is_left ? LandmarkId::kLeftArmpit : LandmarkId::kRightArmpit);
    ASSERT_TRUE(armpit);
    const double depth = armpit->position_m.y() - body->mesh.vertices()[sources[i]].y();
    below += depth > 0.005 * body->height_m ? 1 : 0;
  }
  EXPECT_EQ(below, 0);
}

INSTANTIATE_TEST_SUITE_P(Wide, Chest,
                         testing::Values("female_average_sides", "female_heavy_rest",
                                         "male_heavy_rest"),
                         [](const auto& tested) { return tested.param; });

class Density : public testing::TestWithParam<std::string> {};

TEST_P(Density, SegmentsAndJointsHoldFromFiveToTwoHundredThousandFaces) {
  CAPFIT_REQUIRE_BODIES();
  const std::string name = "scale/female_average_" + GetParam();
  const auto body = Find(LoadBody(name + ".ply"));
  ASSERT_TRUE(body.ok()) << body.status();
  EXPECT_GE(LabelledRight(*body, name + ".labels.bin"), 0.95);
  for (const PosedBody& posed : PosedBodies()) {
    if (posed.file != "female_average_rest.obj") continue;
    for (const auto& [joint, truth] : posed.points) {
      if (!IsMainJoint(joint)) continue;
      EXPECT_LE(ErrorMm(*body, joint, truth), 30.0) << joint;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scale, Density,
                         testing::Values("tri_05k", "tri_10k", "tri_064k", "quad_050k", "tri_200k",
                                         "remeshed"),
                         [](const auto& tested) { return tested.param; });

class CutBody : public testing::TestWithParam<std::string> {};

TEST_P(CutBody, KeepsWhatIsThereAndHasNoLabelsForWhatIsNot) {
  CAPFIT_REQUIRE_BODIES();
  const std::string name = GetParam() + "_no_hands_feet_head";
  const auto body = Find(LoadBody(name + ".obj"));
  ASSERT_TRUE(body.ok()) << body.status();
  EXPECT_GE(LabelledRight(*body, name + ".labels.bin"), 0.95);
  for (const LandmarkId id :
       {LandmarkId::kHeadTop, LandmarkId::kLeftFingertip, LandmarkId::kRightFingertip,
        LandmarkId::kLeftToe, LandmarkId::kRightToe, LandmarkId::kLeftHeel,
        LandmarkId::kRightHeel}) {
    EXPECT_FALSE(body->landmark(id)) << LandmarkName(id);
  }
  for (const Segment segment : body->vertex_segments) {
    const Part part = PartOf(segment);
    EXPECT_TRUE(part < Part::kHead) << SegmentName(segment);
  }
  for (const auto& chain : body->chains) EXPECT_TRUE(chain.has_value());
  for (const PosedBody& posed : PosedBodies()) {
    if (posed.file != GetParam() + ".obj") continue;
    for (const auto& [joint, truth] : posed.points) {
      if (joint == "neck") continue;  // it is at the cut, higher up
      if (!IsMainJoint(joint) && !IsShoulderOrHip(joint)) continue;
      EXPECT_LE(ErrorMm(*body, joint, truth), IsMainJoint(joint) ? 30.0 : 60.0) << joint;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cut, CutBody,
                         testing::Values("female_average_rest", "male_muscular_tpose"),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace capfit::body
