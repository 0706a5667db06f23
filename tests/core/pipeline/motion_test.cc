// Poses that are enclosed besides the one that is fitted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/status.h"
#include "core/formats/read_mesh.h"
#include "core/geometry/tapered_capsule.h"
#include "core/mannequin/mannequin.h"
#include "core/pipeline/fit.h"
#include "core/pipeline/motion_frames.h"
#include "tests/support/avatars.h"
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

double DistanceTo(const std::vector<geometry::TaperedCapsule>& solids, const Vec3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const geometry::TaperedCapsule& solid : solids) {
    least = std::min(least, solid.SignedDistance(point));
  }
  return least;
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
  for (const Vec3& v : vertices) furthest = std::max(furthest, DistanceTo(solids, v));
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
      auto& frame = motion->frames.emplace_back(soup.positions.size());
      std::memcpy(frame.data()->data(), frames.data() + at, frame_bytes);
    }
  }
};

double VolumeOf(const formats::PolygonSoup& soup, const std::vector<Eigen::Vector3f>& points) {
  double volume = 0.0;
  std::size_t begin = 0;
  for (std::size_t face = 0; face < soup.face_count(); ++face) {
    const std::size_t corners = soup.face_sizes.empty() ? 3 : soup.face_sizes[face];
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

struct MovingErrors {
  double at_rest = 0.0;    // E_r of the fit that knows of no motion
  double of_frames = 0.0;  // mean E_r with radii of each frame's own
};

MovingErrors ErrorsOfWalk(const Walk& walk, int primitives) {
  FitOptions options = WholeBody();
  options.max_primitives = primitives;
  const auto rest = FitMoving(walk.soup, options);
  EXPECT_TRUE(rest.ok()) << rest.status();
  walk.motion->radii = motion::MotionRadii::kPerFrame;
  options.motion = walk.motion;
  auto result = FitMoving(walk.soup, options);
  EXPECT_TRUE(result.ok()) << result.status();
  if (!rest.ok() || !result.ok()) return {};
  EXPECT_EQ(result->motion->radii_m.size(), walk.motion->frames.size());
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
  return {rest->metrics.E_r,
          (1.0 + rest->metrics.E_r) * result->motion->mean_volume_ratio / bodies - 1.0};
}

// With radii of each frame's own the frames' sets are hardly larger than the one of rest alone.
// What one budget comes to is the search's luck, so the limits are those of several together.
TEST(Motion, AWalkWithRadiiOfEachFrameIsEnclosedTightly) {
  CAPFIT_REQUIRE_BODIES();
  const Walk walk;
  MovingErrors mean;
  const std::vector<int> budgets = {60, 64, 68};
  for (const int budget : budgets) {
    SCOPED_TRACE(budget);
    const MovingErrors errors = ErrorsOfWalk(walk, budget);
    std::printf("%d primitives: E_r at rest %.3f, in the mean of the frames %.3f\n", budget,
                errors.at_rest, errors.of_frames);
    mean.at_rest += errors.at_rest / static_cast<double>(budgets.size());
    mean.of_frames += errors.of_frames / static_cast<double>(budgets.size());
  }
  // The tighter the fit of rest alone, the more of it is of that pose; so a limit of its own too.
  EXPECT_LE(mean.of_frames, 0.38);
  EXPECT_LE(mean.of_frames, 1.14 * mean.at_rest);
}

// The joints of the six kinds of rigs that avatars have, by what they are called there.
class Rig {
 public:
  explicit Rig(const formats::PolygonSoup& soup) : soup_(soup) {
    const Vec3 left = At("LeftUpLeg") - At("RightUpLeg");
    up_ = (0.5 * (At("LeftArm") + At("RightArm")) - 0.5 * (At("LeftUpLeg") + At("RightUpLeg")))
              .normalized();
    forward_ = left.cross(up_).normalized();
    left_ = up_.cross(forward_);
  }

  // A step: one leg forward with its knee bent, one back, arms the other way round.
  [[nodiscard]] std::vector<formats::Placing> Step(double phase) const {
    std::map<std::size_t, Eigen::Affine3d> turns;
    Turn("LeftUpLeg", left_, -0.45 * phase, turns);
    Turn("RightUpLeg", left_, 0.45 * phase, turns);
    Turn(phase > 0.0 ? "LeftLeg" : "RightLeg", left_, 0.6 * std::abs(phase), turns);
    Turn("LeftArm", left_, 0.3 * phase, turns);
    Turn("RightArm", left_, -0.3 * phase, turns);
    return Placed(turns);
  }

  [[nodiscard]] std::vector<formats::Placing> ArmsRaised(double by_rad) const {
    std::map<std::size_t, Eigen::Affine3d> turns;
    for (const char* side : {"Left", "Right"}) {
      const std::string name(side);
      const Vec3 arm = At(name + "ForeArm") - At(name + "Arm");
      Turn(name + "Arm", arm.cross(up_).normalized(), by_rad, turns);
    }
    return Placed(turns);
  }

 private:
  [[nodiscard]] std::size_t Index(const std::string& name) const {
    static const std::map<std::string, std::vector<std::string>> kNames = {
        {"LeftUpLeg", {"thigh_l", "J_Bip_L_UpperLeg", "upperleg01.L"}},
        {"RightUpLeg", {"thigh_r", "J_Bip_R_UpperLeg", "upperleg01.R"}},
        {"LeftLeg", {"calf_l", "J_Bip_L_LowerLeg", "lowerleg01.L"}},
        {"RightLeg", {"calf_r", "J_Bip_R_LowerLeg", "lowerleg01.R"}},
        {"LeftArm", {"upperarm_l", "J_Bip_L_UpperArm", "upperarm01.L"}},
        {"RightArm", {"upperarm_r", "J_Bip_R_UpperArm", "upperarm01.R"}},
        {"LeftForeArm", {"lowerarm_l", "J_Bip_L_LowerArm", "lowerarm01.L"}},
        {"RightForeArm", {"lowerarm_r", "J_Bip_R_LowerArm", "lowerarm01.R"}}};
    for (std::size_t j = 0; j < soup_.joints.size(); ++j) {
      const std::string& here = soup_.joints[j].name;
      if (here == name || here == "mixamorig:" + name) return j;
      const std::vector<std::string>& others = kNames.at(name);
      if (std::find(others.begin(), others.end(), here) != others.end()) return j;
    }
    ADD_FAILURE() << "no joint " << name;
    return 0;
  }
  [[nodiscard]] Vec3 At(const std::string& name) const {
    return soup_.joints[Index(name)].position;
  }

  void Turn(const std::string& name, const Vec3& axis, double by_rad,
            std::map<std::size_t, Eigen::Affine3d>& turns) const {
    turns[Index(name)] = Eigen::Translation3d(At(name)) * Eigen::AngleAxisd(by_rad, axis) *
                         Eigen::Translation3d(-At(name));
  }

  [[nodiscard]] std::vector<formats::Placing> Placed(
      const std::map<std::size_t, Eigen::Affine3d>& turns) const {
    std::vector<formats::Placing> placed;
    for (std::size_t j = 0; j < soup_.joints.size(); ++j) {
      Eigen::Affine3d now = Eigen::Affine3d::Identity();
      now.matrix().topRows<3>() = soup_.joints[j].to_mesh;
      for (auto above = static_cast<std::int32_t>(j); above >= 0;
           above = soup_.joints[above].parent) {
        const auto turn = turns.find(static_cast<std::size_t>(above));
        if (turn != turns.end()) now = turn->second * now;
      }
      placed.emplace_back(now.matrix().topRows<3>());
    }
    return placed;
  }

  const formats::PolygonSoup& soup_;
  Vec3 up_, forward_, left_;
};

class RigMotionTest : public testing::TestWithParam<std::string> {};

// A walk and raised arms, played on the avatar's own rig, with bones that carry the centres.
TEST_P(RigMotionTest, IsEnclosedInEveryFrame) {
  CAPFIT_REQUIRE_AVATARS();
  const std::string bytes =
      test_support::ReadFile(test_support::AvatarsFolder() / (GetParam() + ".glb"));
  const auto soup = formats::ReadMesh(std::as_bytes(std::span(bytes)));
  ASSERT_TRUE(soup.ok()) << soup.status();
  FitOptions options = WholeBody();
  options.skinning = SkinningMode::kBones;
  options.want_vertex_gaps = true;
  const auto rest = FitMoving(*soup, options);
  ASSERT_TRUE(rest.ok()) << rest.status();
  const Rig rig(*soup);
  auto motion = std::make_shared<Motion>();
  for (const double phase : {-1.0, -0.5, 0.0, 0.5, 1.0}) motion->joints.push_back(rig.Step(phase));
  for (const double by_rad : {0.4, 0.8}) motion->joints.push_back(rig.ArmsRaised(by_rad));
  for (const auto& joints : motion->joints) motion->frames.push_back(PoseVertices(*soup, joints));
  motion->radii = motion::MotionRadii::kPerFrame;
  options.motion = motion;
  const auto result = FitMoving(*soup, options);
  ASSERT_TRUE(result.ok()) << result.status();
  ASSERT_TRUE(result->bone_weights.has_value());
  EXPECT_GT(result->motion->max_out_before_m, 1e-4);  // there was something to do
  EXPECT_LE(result->motion->max_out_m, 0.0);

  // Brute force over the vertices that were fitted.
  const double metre = 1.0 / result->body_from_caller.scale;
  for (std::size_t f = 0; f < motion->frames.size(); ++f) {
    capsule::PrimitiveSet set = result->primitives;
    const std::vector<Vec3> centers = skinning::Apply(*result->bone_weights, motion->joints[f]);
    for (std::size_t i = 0; i < centers.size(); ++i) {
      set.spheres[i] = {centers[i], result->motion->radii_m[f][i] * metre};
    }
    const std::vector<geometry::TaperedCapsule> solids = capsule::Solids(set);
    double furthest = 0.0;
    for (std::size_t v = 0; v < result->vertex_gaps.size(); ++v) {
      if (std::isnan(result->vertex_gaps[v])) continue;
      furthest = std::max(furthest, DistanceTo(solids, motion->frames[f][v].cast<double>()));
    }
    EXPECT_LT(furthest, 1e-4 * metre) << "frame " << f;
  }
  const double mean_E_r = (1.0 + rest->metrics.E_r) * result->motion->mean_volume_ratio - 1.0;
  std::printf("%s: up to %.1f mm outside before; E_r %.3f at rest, about %.3f in the frames\n",
              GetParam().c_str(), 1e3 * result->motion->max_out_before_m, rest->metrics.E_r,
              mean_E_r);
  // Of these, parts slide along each other, and so move otherwise than what is beside them.
  const std::map<std::string, double> loose = {
      {"accessories_man", 1.15},  {"dressed_deleted_man", 1.14}, {"dressed_deleted_woman", 1.17},
      {"dressed_full_man", 1.14}, {"dressed_full_woman", 1.17},  {"robot_like", 1.59},
      {"skirt_woman", 1.14}};
  const auto limit = loose.find(GetParam());
  EXPECT_LE(mean_E_r, (limit == loose.end() ? 1.12 : limit->second) * rest->metrics.E_r);
}
INSTANTIATE_TEST_SUITE_P(Avatars, RigMotionTest,
                         testing::Values("accessories_child", "accessories_man", "armour_man",
                                         "dressed_deleted_centimetres", "dressed_deleted_man",
                                         "dressed_deleted_quantised", "dressed_deleted_woman",
                                         "dressed_full_man", "dressed_full_woman", "robot_like",
                                         "skirt_woman"),
                         [](const auto& of) { return of.param; });

}  // namespace
}  // namespace capfit::pipeline
