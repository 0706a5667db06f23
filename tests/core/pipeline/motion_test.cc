// Poses that are enclosed besides the one that is fitted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

#include "core/base/status.h"
#include "core/formats/read_mesh.h"
#include "core/geometry/tapered_capsule.h"
#include "core/mannequin/mannequin.h"
#include "core/pipeline/fit.h"
#include "core/pipeline/motion_frames.h"
#include "tests/support/bodies.h"

namespace capfit::pipeline {
namespace {

using Vec3 = Eigen::Vector3d;

FitOptions WholeBody() {
  FitOptions options;
  options.quality = Quality::kTight;
  options.parts = {true, true, true, true, true, true};
  options.skinning = SkinningMode::kSparse;
  return options;
}

absl::StatusOr<FitResult> FitMoving(const formats::PolygonSoup& soup, const FitOptions& options) {
  NullObserver observer;
  return Fit(soup, options, ThreadPool(2), observer);
}

// The furthest vertex outside, brute force, with the centres where the result's weights carry them.
double FurthestOut(const FitResult& result, const std::vector<Eigen::Vector3f>& frame) {
  std::vector<Vec3> vertices;
  for (const Eigen::Vector3f& v : frame) vertices.push_back(v.cast<double>());
  capsule::PrimitiveSet set = result.primitives;
  const std::vector<Vec3> centers = skinning::Apply(*result.sparse_weights, vertices);
  for (std::size_t i = 0; i < centers.size(); ++i) set.spheres[i].center_m = centers[i];
  const std::vector<geometry::TaperedCapsule> solids = capsule::Solids(set);
  double furthest = -std::numeric_limits<double>::infinity();
  for (const Vec3& v : vertices) {
    double least = std::numeric_limits<double>::infinity();
    for (const geometry::TaperedCapsule& solid : solids) {
      least = std::min(least, solid.SignedDistance(v));
    }
    furthest = std::max(furthest, least);
  }
  return furthest;
}

std::vector<Eigen::Vector3f> FloatsOf(const formats::PolygonSoup& soup) {
  std::vector<Eigen::Vector3f> frame;
  for (const Vec3& p : soup.positions) frame.push_back(p.cast<float>());
  return frame;
}

formats::PolygonSoup MovingMannequin() {
  mannequin::MannequinOptions options;
  options.faces = 5000;
  return *mannequin::MakeMannequin(options);
}

// A body that turns and moves as one carries its set along: there is nothing to grow.
TEST(Motion, ABodyThatMovesAsOneCostsNothing) {
  const formats::PolygonSoup soup = MovingMannequin();
  const auto plain = FitMoving(soup, WholeBody());
  ASSERT_TRUE(plain.ok()) << plain.status();
  auto motion = std::make_shared<Motion>();
  const Eigen::AngleAxisd turn(1.2, Vec3(1, 2, 3).normalized());
  motion->frames.push_back(FloatsOf(soup));
  for (const Vec3& p : soup.positions) {
    if (motion->frames.size() < 2) motion->frames.emplace_back();
    motion->frames[1].push_back((turn * p + Vec3(0.2, -0.1, 0.5)).cast<float>());
  }
  FitOptions options = WholeBody();
  options.motion = motion;
  const auto moved = FitMoving(soup, options);
  ASSERT_TRUE(moved.ok()) << moved.status();
  EXPECT_EQ(moved->motion->frame_count, 2);
  EXPECT_EQ(moved->motion->most_points_out_before, 0);
  EXPECT_LT(moved->motion->volume_ratio, 1.005);
  for (const auto& frame : motion->frames) EXPECT_LT(FurthestOut(*moved, frame), 1e-6);
}

TEST(Motion, SwollenLimbsAreEnclosedInEveryFrame) {
  const formats::PolygonSoup soup = MovingMannequin();
  auto motion = std::make_shared<Motion>();
  for (const double swelling : {0.0, 0.01, -0.01}) {
    std::vector<Eigen::Vector3f> frame = FloatsOf(soup);
    for (Eigen::Vector3f& p : frame) {  // legs bulge to the front and the back in turn
      if (p.y() < 0.7F) p.z() += static_cast<float>(swelling) * std::sin(p.y() * 9.0F);
    }
    motion->frames.push_back(std::move(frame));
  }
  FitOptions options = WholeBody();
  options.motion = motion;
  const auto result = FitMoving(soup, options);
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_LE(result->motion->max_out_m, 0.0);
  EXPECT_EQ(result->metrics.vertices_out, 0);
  for (const auto& frame : motion->frames) EXPECT_LT(FurthestOut(*result, frame), 1e-6);
}

TEST(Motion, SaysWhatIsWrongWithFrames) {
  const formats::PolygonSoup soup = MovingMannequin();
  const auto refused = [&soup](auto change) {
    auto motion = std::make_shared<Motion>();
    motion->frames = {FloatsOf(soup), FloatsOf(soup)};
    change(*motion);
    FitOptions options = WholeBody();
    options.motion = motion;
    return FieldOf(FitMoving(soup, options).status()).value_or("");
  };
  EXPECT_EQ(refused([](Motion& m) { m.frames.clear(); }), "motion");
  EXPECT_EQ(refused([](Motion& m) { m.frames.resize(kMostMotionFrames + 1); }), "motion");
  EXPECT_EQ(refused([](Motion& m) { m.frames[1].pop_back(); }), "motion[1]");
  EXPECT_EQ(
      refused([](Motion& m) { m.frames[1][7].y() = std::numeric_limits<float>::quiet_NaN(); }),
      "motion[1][7]");
  FitOptions options = WholeBody();
  options.motion = std::make_shared<Motion>();
  options.fit = FitMode::kBestFit;
  EXPECT_EQ(FieldOf(ValidateOptions(options)), "motion");
  options.fit = FitMode::kEnclose;
  options.engine = "vrm";
  EXPECT_EQ(FieldOf(ValidateOptions(options)), "motion");
}

// One joint that holds all, then two that hold a half each.
TEST(Motion, PosesVerticesAsJointsPlaceThem) {
  formats::PolygonSoup soup;
  soup.positions = {Vec3(0, 1, 0), Vec3(0, 2, 0), Vec3(5, 5, 5)};
  soup.joints.resize(2);
  soup.joints[1].to_mesh.col(3) = soup.joints[1].bind.col(3) = Vec3(0, 1, 0);
  soup.influences.resize(3);
  soup.influences[0] = {{0, 0, 0, 0}, {1, 0, 0, 0}};
  soup.influences[1] = {{0, 1, 0, 0}, {0.5F, 0.5F, 0, 0}};  // the third is held by none
  std::vector<formats::Placing> now = {soup.joints[0].to_mesh, soup.joints[1].to_mesh};
  EXPECT_EQ(PoseVertices(soup, now)[1], Eigen::Vector3f(0, 2, 0));
  now[1].leftCols<3>() =
      Eigen::AngleAxisd(std::acos(-1.0) / 2, Vec3::UnitX()).toRotationMatrix();  // y to z
  const std::vector<Eigen::Vector3f> posed = PoseVertices(soup, now);
  EXPECT_EQ(posed[0], Eigen::Vector3f(0, 1, 0));
  EXPECT_LT((posed[1] - Eigen::Vector3f(0, 1.5F, 0.5F)).norm(), 1e-6F);
  EXPECT_EQ(posed[2], Eigen::Vector3f(5, 5, 5));
}

// The real body, its walk and its raised arms.
struct Walk {
  formats::PolygonSoup soup;
  std::shared_ptr<Motion> motion = std::make_shared<Motion>();

  Walk() {
    const auto folder = test_support::BodiesFolder() / "animation";
    const std::string bytes = test_support::ReadFile(folder / "female_average_rest.obj");
    soup = *formats::ReadMesh(std::as_bytes(std::span(bytes)));
    const std::string frames =
        test_support::ReadFile(folder / "female_average_walk_then_raise_arms.bin");
    const std::size_t frame_bytes = soup.positions.size() * sizeof(Eigen::Vector3f);
    for (std::size_t at = 0; at + frame_bytes <= frames.size(); at += frame_bytes) {
      std::memcpy(motion->frames.emplace_back(soup.positions.size()).data(), frames.data() + at,
                  frame_bytes);
    }
  }
};

double VolumeOf(const formats::PolygonSoup& soup, const std::vector<Eigen::Vector3f>& points) {
  double volume = 0.0;
  std::size_t begin = 0;
  for (const std::uint32_t corners : soup.face_sizes) {
    const auto corner = [&](std::size_t i) -> Vec3 {
      return points[soup.face_vertices[begin + i]].cast<double>();
    };
    for (std::size_t i = 1; i + 1 < corners; ++i) {
      volume += corner(0).dot(corner(i).cross(corner(i + 1))) / 6.0;
    }
    begin += corners;
  }
  return volume;
}

TEST(Motion, AWalkIsEnclosed) {
  CAPFIT_REQUIRE_BODIES();
  const Walk walk;
  ASSERT_EQ(walk.motion->frames.size(), 72U);
  FitOptions options = WholeBody();
  options.motion = walk.motion;
  const auto result = FitMoving(walk.soup, options);
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_GT(result->motion->max_out_before_m, 0.005);  // there was something to do
  EXPECT_LE(result->motion->max_out_m, 0.0);
  EXPECT_LT(result->motion->volume_ratio, 1.08);
  for (std::size_t f = 0; f < walk.motion->frames.size(); ++f) {
    EXPECT_LT(FurthestOut(*result, walk.motion->frames[f]), 1e-5) << f;
  }
}

// With radii of each frame's own the frames' sets are hardly larger than the one of rest alone.
TEST(Motion, AWalkWithRadiiOfEachFrameIsEnclosedTightly) {
  CAPFIT_REQUIRE_BODIES();
  const Walk walk;
  FitOptions options = WholeBody();
  const auto rest = FitMoving(walk.soup, options);
  ASSERT_TRUE(rest.ok()) << rest.status();
  walk.motion->radii = motion::MotionRadii::kPerFrame;
  options.motion = walk.motion;
  auto result = FitMoving(walk.soup, options);
  ASSERT_TRUE(result.ok()) << result.status();
  ASSERT_EQ(result->motion->radii_m.size(), walk.motion->frames.size());
  const double body_at_rest = VolumeOf(walk.soup, FloatsOf(walk.soup));
  double bodies = 0.0;
  for (std::size_t f = 0; f < walk.motion->frames.size(); ++f) {
    for (std::size_t i = 0; i < result->primitives.spheres.size(); ++i) {
      result->primitives.spheres[i].radius_m = result->motion->radii_m[f][i];
    }
    EXPECT_LT(FurthestOut(*result, walk.motion->frames[f]), 1e-5) << f;
    bodies += VolumeOf(walk.soup, walk.motion->frames[f]) / body_at_rest;
  }
  bodies /= static_cast<double>(walk.motion->frames.size());
  // All is enclosed, so E_r is the union's volume over the body's, less 1.
  const double mean_E_r =
      (1.0 + rest->metrics.E_r) * result->motion->mean_volume_ratio / bodies - 1.0;
  std::printf("E_r at rest %.3f, in the mean of the frames %.3f\n", rest->metrics.E_r, mean_E_r);
  EXPECT_LE(mean_E_r, 1.12 * rest->metrics.E_r);
}

}  // namespace
}  // namespace capfit::pipeline
