#include "core/metrics/measure.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/metrics/fitted_surface.h"
#include "tests/core/metrics/shapes.h"

namespace capfit::metrics {
namespace {

using body::Segment;
using Eigen::Vector3d;
using geometry::Sphere;
using std::numbers::pi;

constexpr body::PartSelection kAllParts = {true, true, true, true, true, true};

const ThreadPool& SingleThread() {
  static const ThreadPool pool(1);
  return pool;
}

body::Body BodyOf(mesh::BodyMesh mesh) {
  std::vector<Segment> segments(mesh.vertices().size(), Segment::kTorso);
  return {std::move(mesh), {}, 0.0, false, {}, std::move(segments), {}, {}};
}

capsule::PrimitiveSet SetOf(std::vector<Sphere> spheres,
                            std::vector<capsule::CapsuleEnds> capsules = {}) {
  capsule::PrimitiveSet set;
  set.origins.resize(spheres.size());
  set.spheres = std::move(spheres);
  set.capsules = std::move(capsules);
  return set;
}

Metrics MeasureAll(const body::Body& body, const capsule::PrimitiveSet& set,
                   MeasureOptions options = {}) {
  options.parts = kAllParts;
  return Measure(body, set, options, SingleThread(), NullObserver());
}

double BallVolume(double radius) { return 4.0 / 3.0 * pi * radius * radius * radius; }

const mesh::BodyMesh& UnitCube() {
  static const mesh::BodyMesh cube = test_shapes::Box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, 2);
  return cube;
}

TEST(MeasureTest, BallInsideACube) {
  const Metrics m = MeasureAll(BodyOf(UnitCube()), SetOf({{{0, 0, 0}, 0.4}}));
  EXPECT_EQ(m.n_p, 1);
  EXPECT_NEAR(m.outside, 0.0, 1e-12);
  EXPECT_NEAR(m.uncovered, 1 - BallVolume(0.4), 2e-4);
  EXPECT_DOUBLE_EQ(m.E_r, m.outside + m.uncovered);
  EXPECT_NEAR(m.volume_ratio, BallVolume(0.4), 2e-4);
  EXPECT_NEAR(m.mirror_error, 0.0, 1e-12);
  EXPECT_EQ(m.vertices_out, 26);
  EXPECT_NEAR(m.max_out_m, std::sqrt(0.75) - 0.4, 1e-12);
  // The mean of |p| over a side, by the midpoint rule.
  double mean = 0.0;
  for (int i = 0; i < 500; ++i) {
    for (int j = 0; j < 500; ++j) {
      mean += std::hypot((i + 0.5) / 500 - 0.5, (j + 0.5) / 500 - 0.5, 0.5) / 250'000;
    }
  }
  EXPECT_NEAR(m.E_M, 100 * (mean - 0.4) / std::sqrt(3.0), 0.02);
  EXPECT_NEAR(m.hausdorff, 100 * m.max_out_m / std::sqrt(3.0), 0.3);
  EXPECT_NEAR(m.gap.mean_m, mean - 0.4, 4e-4);
  EXPECT_NEAR(m.gap.max_m, m.max_out_m, 6e-3);
  EXPECT_GT(m.gap.p95_m, m.gap.mean_m);
  EXPECT_LT(m.gap.p95_m, m.gap.max_m);
  EXPECT_EQ(m.surface_out, 1.0);
  EXPECT_NEAR(m.iou, BallVolume(0.4), 2e-4);
}

TEST(MeasureTest, BallAroundACube) {
  // Turned, because columns cut sides that are parallel to them only as well as their spacing.
  geometry::Similarity turn;
  turn.rotation = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Metrics m = MeasureAll(BodyOf(UnitCube().Transformed(turn)), SetOf({{{0, 0, 0}, 0.9}}));
  EXPECT_NEAR(m.outside, BallVolume(0.9) - 1, 1e-3);
  EXPECT_NEAR(m.uncovered, 0.0, 1e-12);
  EXPECT_EQ(m.vertices_out, 0);
  EXPECT_EQ(m.max_out_m, 0.0);
  EXPECT_EQ(m.surface_out, 0.0);
  EXPECT_NEAR(m.iou, 1 / BallVolume(0.9), 1e-3);
}

// The columns are laid over the body before there is a set; far from it there are as many for all.
TEST(MeasureTest, WhatLiesBesideOrFarFromTheBodyCountsInFull) {
  struct Case {
    Sphere beside;
    double accuracy;
  };
  for (const auto& [beside, accuracy] :
       {Case{{{0.75, 0.7, 0}, 0.15}, 3e-4}, Case{{{-0.2, -0.8, 1}, 0.25}, 3e-4},
        Case{{{3, 0, 0}, 0.45}, 0.01}, Case{{{-0.2, -5, 0.3}, 0.45}, 0.01}}) {
    const Metrics m = MeasureAll(BodyOf(UnitCube()), SetOf({{{0, 0, 0}, 0.4}, beside}));
    EXPECT_NEAR(m.outside, BallVolume(beside.radius_m), accuracy) << beside.center_m.transpose();
    EXPECT_NEAR(m.uncovered, 1 - BallVolume(0.4), accuracy) << beside.center_m.transpose();
  }
}

TEST(MeasureTest, CapsuleAroundACapsule) {
  const Sphere a{{-0.5, 0.2, 0}, 0.2};
  const Sphere b{{0.5, 1.0, 0.1}, 0.35};
  const mesh::BodyMesh mesh = test_shapes::Capsule(a, b, 200, 60);
  const Metrics m =
      MeasureAll(BodyOf(mesh), SetOf({{a.center_m, 0.25}, {b.center_m, 0.40}}, {{0, 1}}));
  const double volume =
      geometry::TaperedCapsule({a.center_m, 0.25}, {b.center_m, 0.40}).Volume_m3();
  EXPECT_EQ(m.n_p, 3);
  EXPECT_NEAR(m.outside, volume / mesh.volume() - 1, 1e-3);
  EXPECT_NEAR(m.uncovered, 0.0, 1e-9);
  // Both radii grew by the same, so the surfaces are parallel.
  EXPECT_NEAR(m.E_M, 100 * 0.05 / mesh.diagonal(), 0.02);
  EXPECT_NEAR(m.hausdorff, 100 * 0.05 / mesh.diagonal(), 0.02);
  EXPECT_NEAR(m.gap.p95_m, 0.05, 3e-4);
}

TEST(MeasureTest, ConcentricBallsAreTheDifferenceOfTheirRadiiApart) {
  const mesh::BodyMesh ball = test_shapes::Ball({{0, 0, 0}, 1.0}, 6);
  for (const double radius : {0.8, 0.97, 1.04, 1.5}) {
    const Metrics m = MeasureAll(BodyOf(ball), SetOf({{{0, 0, 0}, radius}}));
    const double expected = 100 * std::abs(radius - 1) / ball.diagonal();
    EXPECT_NEAR(m.E_M, expected, 0.005) << radius;  // the mesh is inscribed: 0.01 % of its size
    EXPECT_NEAR(m.hausdorff, expected, 0.02) << radius;
  }
}

TEST(MeasureTest, MirrorErrorOfBallsBesideOnAndAcrossTheMidPlane) {
  const body::Body body = BodyOf(UnitCube());
  EXPECT_NEAR(MeasureAll(body, SetOf({{{0.5, 0, 0}, 0.3}})).mirror_error, 2.0, 1e-9);
  EXPECT_NEAR(MeasureAll(body, SetOf({{{0, 0.1, 0.2}, 0.3}})).mirror_error, 0.0, 1e-9);
  EXPECT_NEAR(MeasureAll(body, SetOf({{{0.5, 0, 0}, 0.3}, {{-0.5, 0, 0}, 0.3}})).mirror_error, 0.0,
              1e-9);
  // Centre off by d: the common part is a lens of two balls 2 d apart.
  const double r = 0.3;
  const double d = 0.1;
  const double lens = 2 * pi * std::pow(r - d, 2) * (2 * r + d) / 3;
  EXPECT_NEAR(MeasureAll(body, SetOf({{{d, 0, 0}, r}})).mirror_error,
              2 * (1 - lens / BallVolume(r)), 2e-3);
}

// A tower of three unit cubes, the top one the head.
body::Body Tower() {
  body::Body body = BodyOf(test_shapes::Box({-0.5, 0, -0.5}, {0.5, 3, 0.5}, 3));
  for (std::size_t v = 0; v < body.vertex_segments.size(); ++v) {
    if (body.mesh.vertices()[v].y() > 2.5) body.vertex_segments[v] = Segment::kHead;
  }
  return body;
}

Metrics MeasureWithoutHead(const body::Body& body, const capsule::PrimitiveSet& set) {
  return Measure(body, set, {}, SingleThread(), NullObserver());  // parts: no head by default
}

TEST(MeasurePartsTest, AFullSetCoversTheFittedPartsAndIsOutsideOfNothingLeftOut) {
  // In the head only: not outside of the body, and covers nothing that was asked for.
  const Metrics m = MeasureWithoutHead(Tower(), SetOf({{{0, 2.5, 0}, 0.4}}));
  EXPECT_NEAR(m.outside, 0.0, 1e-12);
  EXPECT_NEAR(m.uncovered, 1.0, 1e-9);
  EXPECT_NEAR(m.volume_ratio, BallVolume(0.4) / 2, 2e-4);
}

TEST(MeasurePartsTest, VolumesAreRelativeToTheFittedParts) {
  // Half in the head, half below.
  const Metrics half = MeasureWithoutHead(Tower(), SetOf({{{0, 2, 0}, 0.4}}));
  EXPECT_NEAR(half.outside, 0.0, 1e-12);
  EXPECT_NEAR(half.uncovered, 1 - BallVolume(0.4) / 2 / 2, 2e-3);  // the cut is along the rows
  // Beside the body altogether.
  const Metrics beside = MeasureWithoutHead(Tower(), SetOf({{{2, 1, 0}, 0.4}}));
  EXPECT_NEAR(beside.outside, BallVolume(0.4) / 2, 1e-3);
  EXPECT_NEAR(beside.uncovered, 1.0, 1e-9);
}

// What coverage knows of the vertices is taken as it is.
TEST(MeasureTest, DistancesThatAreKnownGiveTheSameNumbers) {
  const body::Body tower = Tower();
  const capsule::PrimitiveSet set =
      SetOf({{{0, 0.2, 0}, 0.6}, {{0, 1.1, 0}, 0.7}, {{0, 2.3, 0.1}, 0.9}}, {{0, 1}});
  const std::vector<geometry::TaperedCapsule> solids = capsule::Solids(set);
  for (const body::PartSelection& parts : {body::PartSelection{}, kAllParts}) {
    MeasureOptions options;
    options.parts = parts;
    const NullObserver observer;
    Backlog backlog(SingleThread(), observer);
    const MeasureGround ground(tower, options, /*knows_vertices=*/true, backlog);
    backlog.Finish();
    EXPECT_FALSE(ground.vertices.has_value());
    tighten::UnionDistances known;
    for (const std::uint32_t v : ground.fitted.vertices) {
      std::size_t nearest = 0;
      const auto distance = [&](std::size_t k) {
        return solids[k].SignedDistance(ground.fitted.points_m[v]);
      };
      for (std::size_t k = 1; k < solids.size(); ++k) {
        if (distance(k) < distance(nearest)) nearest = k;
      }
      known.distance_m.push_back(distance(nearest));
      known.solid.push_back(static_cast<std::int32_t>(nearest));
    }
    const Metrics measured = Measure(tower, set, options, SingleThread(), NullObserver());
    for (const tighten::UnionDistances& told : {known, tighten::UnionDistances{}}) {
      const Metrics m = Measure(tower, ground, set, options, SingleThread(), NullObserver(), told);
      EXPECT_GT(m.vertices_out, 0);
      EXPECT_EQ(m.vertices_out, measured.vertices_out);
      EXPECT_NEAR(m.max_out_m, measured.max_out_m, 1e-12);
      EXPECT_NEAR(m.gap.mean_m, measured.gap.mean_m, 1e-6);
      EXPECT_NEAR(m.gap.max_m, measured.gap.max_m, 1e-6);
      EXPECT_EQ(m.E_r, measured.E_r);
    }
  }
}

// Gives up at one of its looks.
class GivesUp final : public FitObserver {
 public:
  explicit GivesUp(int last) : last_(last) {}
  void OnStage(Stage, double) override {}
  [[nodiscard]] bool IsCancelled() const override { return ++looks_ >= last_; }

 private:
  int last_;
  mutable int looks_ = 0;
};

// What was not reached is 0, and nothing is read that is not there.
TEST(MeasureTest, EndsWhereverTheCallerGivesUp) {
  const body::Body tower = Tower();
  const capsule::PrimitiveSet set = SetOf({{{0, 0.2, 0}, 0.6}, {{0, 1.1, 0}, 0.7}}, {{0, 1}});
  for (const body::PartSelection& parts : {body::PartSelection{}, kAllParts}) {
    for (int last = 1; last < 40; ++last) {
      const GivesUp observer(last);
      MeasureOptions options;
      options.parts = parts;
      Backlog backlog(SingleThread(), observer);
      const MeasureGround ground(tower, options, false, backlog);
      backlog.Finish();
      const Metrics m = Measure(tower, ground, set, options, SingleThread(), observer);
      EXPECT_TRUE(m.n_p == 0 || m.n_p == 3);
    }
  }
}

TEST(MeasurePartsTest, OnlyTheFittedSurfaceAndVerticesCount) {
  const body::Body tower = Tower();
  const Metrics m = MeasureWithoutHead(tower, SetOf({{{0, 1, 0}, 1.4}}));
  EXPECT_EQ(m.vertices_out, 0);  // the head's sixteen corners are out, but not asked for
  EXPECT_GT(MeasureAll(tower, SetOf({{{0, 1, 0}, 1.4}})).vertices_out, 0);
  // Distances are a share of the box of two cubes.
  const double diagonal = std::sqrt(1 + 4 + 1);
  EXPECT_LE(m.hausdorff, 100 * (1.4 - 0.5) / diagonal + 1e-9);
  EXPECT_GT(m.hausdorff, 100 * (1.4 - 0.5) / diagonal - 0.5);
}

mesh::BodyMesh ClosedMesh(const FittedSurface& surface) {
  return test_shapes::MeshOf({surface.points_m.begin(), surface.points_m.end()},
                             {surface.fitted().begin(), surface.fitted().end()});
}

TEST(FittedSurfaceTest, IsClosedByAFanOverEachCut) {
  const body::Body tower = Tower();
  const FittedSurface surface = MakeFittedSurface(tower, {}, SingleThread());
  EXPECT_FALSE(surface.is_whole());
  const mesh::BodyMesh closed = ClosedMesh(surface);
  EXPECT_NEAR(closed.volume(), 2.0, 1e-12);
  EXPECT_NEAR(surface.box.diagonal().norm(), std::sqrt(6.0), 1e-12);
  EXPECT_NEAR(test_shapes::WindingNumber(closed, {0.1, 1.9, 0.2}), 1.0, 1e-9);
  EXPECT_NEAR(test_shapes::WindingNumber(closed, {0.1, 2.1, 0.2}), 0.0, 1e-9);
}

TEST(FittedSurfaceTest, FluxAddsUpToTheVolumeWhereOneHeightIsUsed) {
  const body::Body tower = Tower();
  const FittedSurface surface = MakeFittedSurface(tower, kAllParts, SingleThread());
  double area = 0.0;
  for (const double one : surface.skin_areas_m2) area += one;
  EXPECT_NEAR(area, 14.0, 1e-12);
  const auto torso = static_cast<std::size_t>(body::Part::kTorso);
  const FittedSurface fitted = MakeFittedSurface(tower, {}, SingleThread());
  EXPECT_NEAR(fitted.flux[torso], 2.0, 1e-12);  // closed in itself
}

TEST(FittedSurfaceTest, TwoCutsHaveAFanEach) {
  body::Body body = Tower();
  for (std::size_t v = 0; v < body.vertex_segments.size(); ++v) {
    if (body.mesh.vertices()[v].y() < 0.5) body.vertex_segments[v] = Segment::kLeftFoot;
  }
  const FittedSurface surface = MakeFittedSurface(body, {}, SingleThread());
  EXPECT_EQ(surface.points_m.size(), body.mesh.vertices().size() + 2);
  EXPECT_NEAR(ClosedMesh(surface).volume(), 1.0, 1e-12);
}

TEST(FittedSurfaceTest, AllPartsAreTheWholeBody) {
  const body::Body tower = Tower();
  const FittedSurface surface = MakeFittedSurface(tower, kAllParts, SingleThread());
  EXPECT_TRUE(surface.is_whole());
  EXPECT_EQ(surface.skin().size(), surface.triangles.size());
}

// Against points thrown at random, judged by solid angles and the solids' own distances.
TEST(MeasureTest, AgreesWithPointsAtRandom) {
  const mesh::BodyMesh bracket = test_shapes::Bracket();
  const capsule::PrimitiveSet set = SetOf({{{0.5, 0.4, 0.5}, 0.6},
                                           {{1.6, 0.5, 0.4}, 0.4},
                                           {{0.5, 1.7, 0.6}, 0.5},
                                           {{1.5, 1.5, 0.5}, 0.3}},
                                          {{0, 1}, {0, 2}});
  const auto solids = capsule::Solids(set);
  Random random(5);
  constexpr int kPoints = 200'000;
  const Vector3d low(-0.3, -0.4, -0.3);
  const Vector3d high(2.2, 2.4, 1.3);
  int outside = 0;
  int uncovered = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Vector3d p(random.NextIn(low.x(), high.x()), random.NextIn(low.y(), high.y()),
                     random.NextIn(low.z(), high.z()));
    double distance = std::numeric_limits<double>::infinity();
    for (const auto& solid : solids) distance = std::min(distance, solid.SignedDistance(p));
    const bool in_body = test_shapes::WindingNumber(bracket, p) > 0.5;
    outside += distance < 0 && !in_body ? 1 : 0;
    uncovered += distance >= 0 && in_body ? 1 : 0;
  }
  const double per_point = (high - low).prod() / kPoints / bracket.volume();
  const Metrics m = MeasureAll(BodyOf(bracket), set);
  EXPECT_NEAR(m.outside, outside * per_point, 0.015);
  EXPECT_NEAR(m.uncovered, uncovered * per_point, 0.015);
}

// The defaults are few columns and samples; many more are the truth.
TEST(MeasureTest, FewColumnsAndSamplesTellWhatManyDo) {
  const body::Body body =
      BodyOf(test_shapes::Capsule({{-0.5, 0.2, 0}, 0.2}, {{0.5, 1.0, 0.1}, 0.35}, 60, 16));
  MeasureOptions many;
  many.columns = 1600;
  many.surface_samples = 200'000;
  for (const double grown : {-0.02, 0.0, 0.03}) {
    const capsule::PrimitiveSet set = SetOf({{{-0.45, 0.2, 0.02}, 0.21 + grown},
                                             {{0.1, 0.6, 0.03}, 0.3 + grown},
                                             {{0.5, 1.05, 0.1}, 0.36 + grown}},
                                            {{0, 1}, {1, 2}});
    const Metrics few = MeasureAll(body, set);
    const Metrics truth = MeasureAll(body, set, many);
    EXPECT_NEAR(few.E_r, truth.E_r, 5e-3 * truth.E_r);
    EXPECT_NEAR(few.volume_ratio, truth.volume_ratio, 5e-3 * truth.volume_ratio);
    EXPECT_NEAR(few.iou, truth.iou, 5e-3 * truth.iou);
    EXPECT_NEAR(few.E_M, truth.E_M, 1e-2 * truth.E_M);
    EXPECT_NEAR(few.gap.max_m, truth.gap.max_m, 2e-2 * truth.gap.max_m);
    EXPECT_EQ(few.vertices_out, truth.vertices_out);
    EXPECT_EQ(few.max_out_m, truth.max_out_m);
  }
}

TEST(MeasureTest, RelativeNumbersDoNotDependOnSize) {
  const mesh::BodyMesh capsule_mesh =
      test_shapes::Capsule({{0, 0.3, 0}, 0.2}, {{0, 1.5, 0}, 0.3}, 30, 8);
  const capsule::PrimitiveSet set = SetOf({{{0.1, 0.4, 0}, 0.25}, {{0, 1.4, 0.05}, 0.3}}, {{0, 1}});
  const Metrics one = MeasureAll(BodyOf(capsule_mesh), set);
  geometry::Similarity grow;
  grow.scale = 3.0;
  capsule::PrimitiveSet large = set;
  for (Sphere& s : large.spheres) s = {3.0 * s.center_m, 3.0 * s.radius_m};
  const Metrics three = MeasureAll(BodyOf(capsule_mesh.Transformed(grow)), large);
  EXPECT_NEAR(three.E_r, one.E_r, 1e-9);
  EXPECT_NEAR(three.E_M, one.E_M, 1e-6);
  EXPECT_NEAR(three.mirror_error, one.mirror_error, 1e-9);
  EXPECT_NEAR(three.max_out_m, 3 * one.max_out_m, 1e-12);
}

TEST(MeasureTest, SameBitsForAnyNumberOfThreads) {
  const body::Body body = BodyOf(test_shapes::Ball({{0, 1, 0}, 0.8}, 4));
  const capsule::PrimitiveSet set =
      SetOf({{{0.3, 1, 0}, 0.6}, {{-0.3, 1, 0.1}, 0.6}, {{0, 1.5, 0}, 0.4}, {{0, 0.5, 0}, 0.5}},
            {{0, 1}, {2, 3}});
  const Metrics one = MeasureAll(body, set);
  for (const int threads : {2, 3, 7}) {
    MeasureOptions options;
    options.parts = kAllParts;
    const Metrics many = Measure(body, set, options, ThreadPool(threads), NullObserver());
    EXPECT_EQ(many.E_r, one.E_r);
    EXPECT_EQ(many.E_M, one.E_M);
    EXPECT_EQ(many.hausdorff, one.hausdorff);
    EXPECT_EQ(many.mirror_error, one.mirror_error);
    EXPECT_EQ(many.max_out_m, one.max_out_m);
  }
}

TEST(MeasureTest, AnEmptySetCoversNothing) {
  const Metrics m = MeasureAll(BodyOf(UnitCube()), SetOf({}));
  EXPECT_EQ(m.n_p, 0);
  EXPECT_EQ(m.outside, 0.0);
  EXPECT_EQ(m.uncovered, 1.0);
  EXPECT_EQ(m.mirror_error, 0.0);
  EXPECT_EQ(m.E_M, 0.0);
}

TEST(SignedGapsTest, AreDistancesToTheBoundaryOfTheUnion) {
  const body::Body body = BodyOf(UnitCube());
  const capsule::PrimitiveSet set = SetOf({{{0, 0, 0}, 0.6}, {{0.4, 0.4, 0.4}, 0.2}});
  const std::vector<double> gaps = SignedGaps(body, set, kAllParts, SingleThread());
  ASSERT_EQ(gaps.size(), body.mesh.vertices().size());
  int inside = 0;
  for (std::size_t v = 0; v < gaps.size(); ++v) {
    const Vector3d& p = body.mesh.vertices()[v];
    // None of the cube's vertices that are inside has the hidden surface next to it.
    EXPECT_NEAR(gaps[v], std::min(p.norm() - 0.6, (p - Vector3d(0.4, 0.4, 0.4)).norm() - 0.2),
                1e-12);
    inside += gaps[v] < 0.0 ? 1 : 0;
  }
  EXPECT_GT(inside, 5);
}

TEST(SignedGapsTest, InsideAnOverlapTheyReachToTheCrease) {
  // Unit balls at x = -0.5 and 0.5; a small cube in their middle.
  const body::Body body = BodyOf(test_shapes::Box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}, 2));
  const capsule::PrimitiveSet set = SetOf({{{-0.5, 0, 0}, 1}, {{0.5, 0, 0}, 1}});
  const std::vector<double> gaps = SignedGaps(body, set, kAllParts, SingleThread());
  for (std::size_t v = 0; v < gaps.size(); ++v) {
    const Vector3d& p = body.mesh.vertices()[v];
    EXPECT_NEAR(-gaps[v], std::hypot(p.x(), std::sqrt(0.75) - p.tail<2>().norm()), 1e-4);
  }
}

TEST(SignedGapsTest, PartsThatAreNotSelectedHaveNone) {
  const body::Body tower = Tower();
  const std::vector<double> gaps = SignedGaps(tower, SetOf({{{0, 1, 0}, 1.0}}), {}, SingleThread());
  for (std::size_t v = 0; v < gaps.size(); ++v) {
    EXPECT_EQ(std::isnan(gaps[v]), tower.vertex_segments[v] == Segment::kHead);
  }
}

}  // namespace
}  // namespace capfit::metrics
