#include "core/section/feature_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "core/base/enum_index.h"
#include "core/body/find_body.h"
#include "core/formats/read_mesh.h"
#include "core/mesh/prepare_mesh.h"
#include "core/section/stations.h"
#include "tests/core/section/shapes.h"
#include "tests/support/bodies.h"

namespace capfit::section {
namespace {

using body::Part;

FeaturePolygons Extract(const body::Body& body, const SectionOptions& options = {},
                        int threads = 1) {
  return ExtractFeaturePolygons(body, options, ThreadPool(threads), NullObserver());
}

const FeaturePolygon& Named(const FeaturePolygons& polygons, const std::string& name) {
  for (const FeaturePolygon& p : polygons.polygons) {
    if (p.name == name) return p;
  }
  ADD_FAILURE() << "no polygon " << name;
  return polygons.polygons.front();
}

// What holds for the polygons of every body.
void ExpectSound(const body::Body& body, const FeaturePolygons& result) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < result.polygons.size(); ++i) {
    const FeaturePolygon& p = result.polygons[i];
    EXPECT_TRUE(names.insert(p.name).second) << p.name << " twice";
    EXPECT_GT(p.outline.area_m2(), 0.0);
    EXPECT_NEAR(p.frame.x_axis.dot(p.frame.y_axis), 0.0, 1e-12);
    EXPECT_NEAR(p.frame.Normal().norm(), 1.0, 1e-12);
    const bool first = i == 0 || result.polygons[i - 1].chain != p.chain;
    EXPECT_EQ(p.order, first ? 0 : result.polygons[i - 1].order + 1);
    const double before = first ? -1.0 : result.polygons[i - 1].arc_length_m;
    EXPECT_GT(p.arc_length_m, before) << p.name;
    // The outline goes around the medial point, or nearly so.
    EXPECT_LT(p.frame.ToPlane(body.chain(p.chain)->PointAt(p.arc_length_m)).norm(), 0.05);
    if (p.split) {
      for (const auto& piece : p.split->pieces) EXPECT_GE(piece.size(), 3u);
    }
  }
}

void ExpectMirrored(const FeaturePolygons& result) {
  for (std::size_t i = 0; i < result.polygons.size(); ++i) {
    const FeaturePolygon& p = result.polygons[i];
    ASSERT_GE(p.mirror, 0) << p.name;
    const FeaturePolygon& q = result.polygons[p.mirror];
    EXPECT_EQ(q.mirror, static_cast<int>(i));
    EXPECT_EQ(q.chain, body::MirrorPart(p.chain));
    const auto v = p.outline.vertices();
    const auto w = q.outline.vertices();
    ASSERT_EQ(v.size(), w.size());
    for (const Eigen::Vector2d& a : v) {
      EXPECT_TRUE(std::any_of(w.begin(), w.end(), [&a](const Eigen::Vector2d& b) {
        return b.x() == -a.x() && b.y() == a.y();
      })) << p.name;
    }
    const Eigen::Vector3d here = p.frame.ToSpace({0.03, 0.02});
    const Eigen::Vector3d there = q.frame.ToSpace({-0.03, 0.02});
    EXPECT_NEAR((there - Eigen::Vector3d(-here.x(), here.y(), here.z())).norm(), 0.0, 1e-12);
  }
}

TEST(FeaturePolygonTest, TwentyByDefaultWithTheirNames) {
  const body::Body body = StickFigure();
  const FeaturePolygons result = Extract(body);
  EXPECT_TRUE(result.warnings.empty());
  ASSERT_EQ(result.polygons.size(), 20u);
  ExpectSound(body, result);
  ExpectMirrored(result);
  const std::vector<std::string> torso{"hip_low", "hip", "waist", "bust", "chest", "neck"};
  for (std::size_t i = 0; i < torso.size(); ++i) EXPECT_EQ(result.polygons[i].name, torso[i]);
  for (const char* side : {"left_", "right_"}) {
    for (const char* name : {"upper_arm", "elbow", "wrist", "thigh", "knee", "calf", "ankle"}) {
      (void)Named(result, std::string(side) + name);
    }
  }
}

TEST(FeaturePolygonTest, TubesHaveTheirOwnSections) {
  const FeaturePolygons result = Extract(StickFigure());
  const double shrink = 16.0 / kPi * std::sin(kPi / 16);  // 32 sides instead of a circle
  for (const FeaturePolygon& p : result.polygons) {
    const double expected = p.chain == Part::kTorso ? kPi * 0.15 * 0.1
                            : p.chain == Part::kLeftArm || p.chain == Part::kRightArm
                                ? kPi * 0.04 * 0.04
                                : kPi * 0.07 * 0.07;
    EXPECT_NEAR(p.outline.area_m2(), shrink * expected, 0.01 * expected) << p.name;
  }
  EXPECT_NEAR(Named(result, "waist").frame.origin_m.y(), 1.0, 1e-9);
  EXPECT_NEAR(Named(result, "left_elbow").frame.origin_m.x(), 0.45, 1e-9);
  EXPECT_NEAR(Named(result, "left_ankle").frame.origin_m.y(), 0.05, 0.02);
  EXPECT_NEAR(Named(result, "left_thigh").frame.origin_m.y(), 0.69, 0.02);
  EXPECT_NEAR(Named(result, "right_wrist").frame.origin_m.x(), -0.7, 0.02);
}

TEST(FeaturePolygonTest, MoreAndFewer) {
  const body::Body body = StickFigure();
  for (int torso = 2; torso <= 12; ++torso) {
    SectionOptions options;
    options.torso_polygons = torso;
    options.arm_polygons = 2 + torso % 5;
    options.leg_polygons = 2 + torso % 7;
    const FeaturePolygons result = Extract(body, options);
    EXPECT_EQ(static_cast<int>(result.polygons.size()),
              torso + 2 * options.arm_polygons + 2 * options.leg_polygons);
    ExpectSound(body, result);
    ExpectMirrored(result);
    for (const char* end : {"left_wrist", "left_upper_arm", "left_thigh", "left_ankle", "hip"}) {
      (void)Named(result, end);
    }
  }
}

TEST(FeaturePolygonTest, OnlyTheAskedParts) {
  SectionOptions options;
  options.parts.arms = false;
  options.parts.torso = false;
  const FeaturePolygons result = Extract(StickFigure(), options);
  EXPECT_EQ(result.polygons.size(), 8u);
  for (const FeaturePolygon& p : result.polygons) {
    EXPECT_TRUE(p.chain == Part::kLeftLeg || p.chain == Part::kRightLeg);
  }
}

TEST(FeaturePolygonTest, WithoutSymmetryNothingIsLinked) {
  body::Body body = StickFigure();
  body.is_symmetric = false;
  const FeaturePolygons result = Extract(body);
  EXPECT_EQ(result.polygons.size(), 20u);
  for (const FeaturePolygon& p : result.polygons) EXPECT_EQ(p.mirror, -1);
}

TEST(FeaturePolygonTest, AMissingChainIsNoProblem) {
  body::Body body = StickFigure();
  body.chains[Index(Part::kRightArm)].reset();
  body.is_symmetric = false;
  EXPECT_EQ(Extract(body).polygons.size(), 17u);
}

TEST(FeaturePolygonTest, SameBitsForAnyThreads) {
  const body::Body body = StickFigure();
  const FeaturePolygons one = Extract(body, {}, 1);
  for (const int threads : {2, 7}) {
    const FeaturePolygons other = Extract(body, {}, threads);
    ASSERT_EQ(one.polygons.size(), other.polygons.size());
    for (std::size_t i = 0; i < one.polygons.size(); ++i) {
      const auto a = one.polygons[i].outline.vertices();
      const auto b = other.polygons[i].outline.vertices();
      EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
    }
  }
}

TEST(StationsTest, FramesKeepLeftAndMirror) {
  const body::Body body = StickFigure();
  for (const Part chain : {Part::kLeftArm, Part::kLeftLeg}) {
    const geometry::PlaneFrame left = PlaneAt(body, chain, 0.2);
    const geometry::PlaneFrame right = PlaneAt(body, body::MirrorPart(chain), 0.2);
    const geometry::PlaneFrame image = MirroredFrame(left);
    EXPECT_NEAR((image.origin_m - right.origin_m).norm(), 0.0, 1e-12);
    EXPECT_NEAR((image.x_axis - right.x_axis).norm(), 0.0, 1e-12);
    EXPECT_NEAR((image.y_axis - right.y_axis).norm(), 0.0, 1e-12);
  }
  EXPECT_NEAR(PlaneAt(body, Part::kTorso, 0.3).x_axis.x(), 1.0, 1e-12);
  EXPECT_NEAR(PlaneAt(body, Part::kLeftLeg, 0.3).x_axis.x(), 1.0, 1e-12);
}

class RealBodyTest : public testing::Test {
 protected:
  static body::Body Load(const std::filesystem::path& path) {
    const std::string bytes = test_support::ReadFile(path);
    const auto soup = formats::ReadMesh(std::as_bytes(std::span(bytes.data(), bytes.size())));
    const auto prepared = mesh::PrepareMesh(soup.value());
    auto body = body::FindBody(prepared.value().mesh, {}, ThreadPool(1), NullObserver());
    return std::move(body).value();
  }
};

TEST_F(RealBodyTest, EveryBodyHasItsTwentySections) {
  CAPFIT_REQUIRE_BODIES();
  for (const auto& path : test_support::BodyFiles()) {
    SCOPED_TRACE(path.filename().string());
    const body::Body body = Load(path);
    const double h = body.height_m;
    const FeaturePolygons result = Extract(body);
    EXPECT_EQ(result.polygons.size(), 20u);
    EXPECT_TRUE(result.warnings.empty());
    ExpectSound(body, result);
    if (body.is_symmetric) ExpectMirrored(result);
    // Sizes of people: the trunk without arms is wider than deep and no wider than a third of the
    // height; limbs get thinner outward.
    const double chest = Named(result, "chest").outline.area_m2();
    EXPECT_GT(chest, 0.008 * h * h);
    EXPECT_LT(chest, 0.05 * h * h);
    for (const char* side : {"left_", "right_"}) {
      const auto area = [&](const char* name) {
        return Named(result, std::string(side) + name).outline.area_m2();
      };
      EXPECT_GT(area("thigh"), area("knee"));
      EXPECT_GT(area("calf"), area("ankle"));
      EXPECT_GT(area("upper_arm"), area("wrist"));
      EXPECT_GT(area("elbow"), 0.9 * area("wrist"));
      EXPECT_LT(area("upper_arm"), 0.01 * h * h);  // no trunk in it
      EXPECT_LT(area("thigh"), 0.025 * h * h);     // nor the other leg
    }
  }
}

TEST_F(RealBodyTest, SexIsToldByTheBreasts) {
  CAPFIT_REQUIRE_BODIES();
  for (const auto& path : test_support::BodyFiles()) {
    SCOPED_TRACE(path.filename().string());
    const body::Body body = Load(path);
    const bool is_female = path.filename().string().rfind("female", 0) == 0;
    const FeaturePolygons result = Extract(body);
    EXPECT_EQ(result.bust_is_split, is_female) << result.breast_height_ratio;
    EXPECT_EQ(Named(result, "bust").split.has_value(), is_female);
    EXPECT_TRUE(Named(result, "hip").split.has_value());
    SectionOptions options;
    options.sex = is_female ? Sex::kMale : Sex::kFemale;
    EXPECT_EQ(Extract(body, options).bust_is_split, !is_female);
  }
}

TEST_F(RealBodyTest, EndPolygonsLieAtTheEnds) {
  CAPFIT_REQUIRE_BODIES();
  for (const auto& path : test_support::BodyFiles()) {
    SCOPED_TRACE(path.filename().string());
    const body::Body body = Load(path);
    const FeaturePolygons result = Extract(body);
    for (const auto& [name, part] : std::map<std::string, Part>{{"left_wrist", Part::kLeftArm},
                                                                {"left_ankle", Part::kLeftLeg},
                                                                {"neck", Part::kTorso}}) {
      const double rest = body.chain(part)->length_m() - Named(result, name).arc_length_m;
      EXPECT_LT(rest, 0.03 * body.height_m) << name;  // a slanting cut costs most of it
    }
    EXPECT_LT(Named(result, "hip_low").arc_length_m, 0.02 * body.height_m);
  }
}

}  // namespace
}  // namespace capfit::section
