// Bodies that end somewhere between waist and knees: those of a camera that sees no more,
// of a shop that sells shirts, of headsets.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tests/core/body/body_files.h"
#include "tests/core/body/cut_bodies.h"
#include "tests/support/bodies.h"

namespace capfit::body {
namespace {

using Eigen::Vector3d;
using formats::PolygonSoup;

constexpr std::array kOfUpperBody = {LandmarkId::kHeadTop,      LandmarkId::kNeck,
                                     LandmarkId::kLeftShoulder, LandmarkId::kLeftElbow,
                                     LandmarkId::kLeftWrist,    LandmarkId::kRightShoulder,
                                     LandmarkId::kRightElbow,   LandmarkId::kRightWrist};

struct Height {
  std::string name;
  double above_crotch;  // share of the body's height
  friend void PrintTo(const Height& h, std::ostream* os) { *os << h.name; }
};

// Arms that hang below the cut stay.
PolygonSoup Above(const PolygonSoup& soup, const Body& whole, double above_crotch) {
  const double lowest =
      whole.landmark(LandmarkId::kCrotch)->position_m.y() + above_crotch * whole.height_m;
  const std::span<const std::int32_t> vertex_of = whole.mesh.vertex_of_source();
  const auto is_of_arm = [&](std::uint32_t source) {
    if (vertex_of[source] < 0) return false;
    const Part part = PartOf(whole.vertex_segments[vertex_of[source]]);
    return part == Part::kLeftArm || part == Part::kRightArm || part == Part::kLeftHand ||
           part == Part::kRightHand;
  };
  return Without(soup, [&](const Vector3d& middle, std::uint32_t corner) {
    return whole.body_from_caller.Apply(middle).y() < lowest && !is_of_arm(corner);
  });
}

void ExpectNoLegs(const Body& body) {
  std::vector<std::string> missing;
  for (const Warning& w : body.warnings) {
    if (w.code == "PART_MISSING") missing.push_back(w.message.substr(0, w.message.find(" was ")));
  }
  EXPECT_EQ(missing, (std::vector<std::string>{"the left leg", "the right leg"}));
  for (const Part part : {Part::kTorso, Part::kLeftArm, Part::kRightArm}) {
    EXPECT_TRUE(body.chain(part)) << PartName(part);
  }
  EXPECT_FALSE(body.landmark(LandmarkId::kCrotch));
  EXPECT_FALSE(body.landmark(LandmarkId::kLeftKnee));
}

class UpperBody : public testing::TestWithParam<Height> {
 protected:
  // As of the whole body: the same places, in the same unit, left on the left.
  static void ExpectIsMeasured(const PolygonSoup& soup, double within) {
    const auto whole = Find(Prepared(soup));
    ASSERT_TRUE(whole.ok()) << whole.status();
    const PolygonSoup rest = Above(soup, *whole, GetParam().above_crotch);
    ASSERT_LT(rest.face_count(), soup.face_count());
    const auto body = Find(Prepared(rest));
    ASSERT_TRUE(body.ok()) << body.status();
    ExpectNoLegs(*body);
    EXPECT_EQ(body->body_from_caller.scale, whole->body_from_caller.scale);
    for (const LandmarkId id : kOfUpperBody) {
      ASSERT_TRUE(body->landmark(id)) << LandmarkName(id);
      EXPECT_LE((At(*body, id) - At(*whole, id)).norm(), within * whole->height_m)
          << LandmarkName(id);
    }
  }
};

TEST_P(UpperBody, OfAMannequinIsMeasuredAsTheWhole) { ExpectIsMeasured(MannequinSoup(), 0.02); }

TEST_P(UpperBody, OfRealBodiesIsMeasuredAsTheWhole) {
  CAPFIT_REQUIRE_BODIES();
  for (const PosedBody& posed : PosedBodies()) {
    SCOPED_TRACE(posed.file);
    ExpectIsMeasured(RealSoup(posed.file), 0.025);
  }
}

INSTANTIATE_TEST_SUITE_P(DownTo, UpperBody,
                         testing::Values(Height{"Thighs", -0.10}, Height{"Crotch", -0.02},
                                         Height{"Hips", 0.05}, Height{"Waist", 0.14}),
                         [](const auto& tested) { return tested.param.name; });

TEST(UpperBody, IsTheSameHoweverItIsTurned) {
  const PolygonSoup soup = MannequinSoup();
  const auto whole = Find(Prepared(soup));
  ASSERT_TRUE(whole.ok()) << whole.status();
  const PolygonSoup rest = Above(soup, *whole, 0.03);
  PolygonSoup turned = rest;
  const Eigen::AngleAxisd turn(2.1, Vector3d(1.0, -2.0, 0.5).normalized());
  for (Vector3d& p : turned.positions) p = turn * p + Vector3d(3.0, -1.0, 0.2);
  const auto body = Find(Prepared(rest));
  const auto other = Find(Prepared(turned));
  ASSERT_TRUE(body.ok() && other.ok()) << other.status();
  for (const LandmarkId id : kOfUpperBody) {
    EXPECT_LE((body->landmark(id)->position_m - other->landmark(id)->position_m).norm(), 1e-6)
        << LandmarkName(id);
  }
}

}  // namespace
}  // namespace capfit::body
