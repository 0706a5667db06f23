// Bodies of which an arm, a leg or both legs are cut off somewhere.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/enum_index.h"
#include "tests/core/body/body_files.h"
#include "tests/core/body/cut_bodies.h"
#include "tests/support/bodies.h"

namespace capfit::body {
namespace {

using Eigen::Vector3d;
using formats::PolygonSoup;

// All beyond a share of the way from one landmark to another.
struct Cut {
  LandmarkId from;
  LandmarkId to;
  double share;

  [[nodiscard]] bool HasBeyond(const Body& whole, const Vector3d& point) const {
    const Vector3d start = whole.landmark(from)->position_m;
    const Vector3d way = whole.landmark(to)->position_m - start;
    const Vector3d at = whole.body_from_caller.Apply(point);
    // The other limbs are beyond such a plane too, but on the other side or far from the line.
    if (at.x() * start.x() <= 0.0) return false;
    const double along = (at - start).dot(way) / way.squaredNorm();
    return along > share && (at - start - along * way).norm() < 0.7 * way.norm();
  }
};

struct Case {
  std::string name;
  std::vector<Cut> cuts;
  std::vector<std::string> missing;
  friend void PrintTo(const Case& c, std::ostream* os) { *os << c.name; }
};

class CutLimbs : public testing::TestWithParam<Case> {
 protected:
  static void ExpectLimbsOf(const PolygonSoup& soup) {
    const auto whole = Find(Prepared(soup));
    ASSERT_TRUE(whole.ok()) << whole.status();
    const PolygonSoup rest = Without(soup, [&](const Vector3d& middle, std::uint32_t) {
      return std::any_of(GetParam().cuts.begin(), GetParam().cuts.end(),
                         [&](const Cut& cut) { return cut.HasBeyond(*whole, middle); });
    });
    ASSERT_LT(rest.face_count(), soup.face_count());
    const auto body = Find(Prepared(rest));
    ASSERT_TRUE(body.ok()) << body.status();
    for (int c = 0; c < kChainCount; ++c) EXPECT_TRUE(body->chains[c].has_value()) << c;
    EXPECT_FALSE(body->is_symmetric && GetParam().cuts.size() == 1);
    std::vector<std::string> missing;
    for (const Warning& w : body->warnings) {
      if (w.code == "PART_MISSING") missing.push_back(w.message.substr(0, w.message.find(" is ")));
    }
    EXPECT_EQ(missing, GetParam().missing);
    ExpectPartsOf(*whole, *body);
    for (const LandmarkId id : {LandmarkId::kLeftKnee, LandmarkId::kRightKnee,
                                LandmarkId::kLeftElbow, LandmarkId::kRightElbow}) {
      const bool is_there =
          std::none_of(GetParam().cuts.begin(), GetParam().cuts.end(),
                       [&](const Cut& cut) { return cut.HasBeyond(*whole, At(*whole, id)); });
      // Where both legs are cut, nothing tells how far down the knees are.
      if (!is_there || GetParam().cuts.size() > 1) continue;
      EXPECT_LE((At(*body, id) - At(*whole, id)).norm(), 0.045) << LandmarkName(id);
    }
  }

 private:
  static void ExpectPartsOf(const Body& whole, const Body& body) {
    const auto of_whole = whole.mesh.vertex_of_source();
    const auto of_body = body.mesh.vertex_of_source();
    std::size_t count = 0;
    std::size_t wrong = 0;
    for (std::size_t v = 0; v < of_body.size(); ++v) {
      if (of_body[v] < 0 || of_whole[v] < 0) continue;
      const Part part = PartOf(whole.vertex_segments[of_whole[v]]);
      // What is left of a hand or foot beside a cut counts as arm or leg.
      if (Index(part) >= kChainCount && part != Part::kHead) continue;
      ++count;
      if (part != PartOf(body.vertex_segments[of_body[v]])) {
        ++wrong;
      }
    }
    EXPECT_LE(static_cast<double>(wrong), 0.03 * static_cast<double>(count));
  }
};

TEST_P(CutLimbs, AreFoundAsFarAsTheyAreThere) { ExpectLimbsOf(MannequinSoup()); }

TEST_P(CutLimbs, AreFoundOnRealBodies) {
  CAPFIT_REQUIRE_BODIES();
  for (const char* const file : {"female_average_tpose.obj", "male_average_rest.obj"}) {
    SCOPED_TRACE(file);
    ExpectLimbsOf(RealSoup(file));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Somewhere, CutLimbs,
    testing::Values(
        Case{"ForeArm", {{LandmarkId::kLeftElbow, LandmarkId::kLeftWrist, 0.5}}, {"the left hand"}},
        Case{
            "Elbow", {{LandmarkId::kRightElbow, LandmarkId::kRightWrist, 0.2}}, {"the right hand"}},
        Case{"Shin", {{LandmarkId::kLeftKnee, LandmarkId::kLeftAnkle, 0.5}}, {"the left foot"}},
        Case{"Knee", {{LandmarkId::kRightKnee, LandmarkId::kRightAnkle, 0.0}}, {"the right foot"}},
        Case{"BothKnees",
             {{LandmarkId::kLeftKnee, LandmarkId::kLeftAnkle, 0.1},
              {LandmarkId::kRightKnee, LandmarkId::kRightAnkle, 0.1}},
             {"the left foot", "the right foot"}}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace capfit::body
