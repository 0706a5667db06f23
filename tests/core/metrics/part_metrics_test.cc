#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/enum_index.h"
#include "core/base/random.h"
#include "core/metrics/measure.h"
#include "core/metrics/volumes.h"
#include "tests/core/metrics/shapes.h"

namespace capfit::metrics {
namespace {

using body::Part;
using body::Segment;
using Eigen::Vector3d;
using geometry::Sphere;

const ThreadPool& Alone() {
  static const ThreadPool pool(1);
  return pool;
}

// A slab of 4 x 2 x 1: torso in the middle, an arm beyond |x| = 1 on either side, the head above
// y = 1.5 where |x| < 1.
body::Body Slab() {
  body::Body body = {
      test_shapes::Box({-2, 0, -0.5}, {2, 2, 0.5}, 8), {}, 0.0, false, {}, {}, {}, {}};
  for (const Vector3d& p : body.mesh.vertices()) {
    Segment segment = p.y() > 1.6 ? Segment::kHead : Segment::kTorso;
    if (p.x() > 1.1) segment = Segment::kLeftUpperArm;
    if (p.x() < -1.1) segment = Segment::kRightUpperArm;
    body.vertex_segments.push_back(segment);
  }
  return body;
}

struct PartSphere {
  Sphere sphere;
  Part part = Part::kTorso;
};

capsule::PrimitiveSet MakeSet(const std::vector<PartSphere>& spheres,
                              std::vector<capsule::CapsuleEnds> capsules = {}) {
  capsule::PrimitiveSet set;
  for (const PartSphere& one : spheres) {
    set.spheres.push_back(one.sphere);
    set.origins.push_back({one.part, -1, -1});
  }
  set.capsules = std::move(capsules);
  return set;
}

Metrics MeasureSlab(const body::Body& body, const capsule::PrimitiveSet& set,
                    body::PartSelection parts = {}) {
  MeasureOptions options;
  options.parts = parts;
  return Measure(body, set, options, Alone(), NullObserver());
}

const PartMetrics& Of(Part part, const Metrics& metrics) { return *metrics.parts[Index(part)]; }

double Ball(double radius) { return 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3); }

capsule::PrimitiveSet Mixed() {
  return MakeSet({{{{0.1, 0.8, 0.1}, 0.7}, Part::kTorso},
                  {{{1.5, 0.9, 0}, 0.8}, Part::kLeftArm},
                  {{{-1.4, 1.2, 0.2}, 0.5}, Part::kRightArm},
                  {{{0, 1.9, 0}, 0.4}, Part::kTorso},
                  {{{-2.5, 0.4, 0}, 0.3}, Part::kRightArm}},
                 {{0, 1}, {0, 2}, {2, 4}});
}

TEST(PartMetricsTest, OnlyPartsThatAreFittedAndThereAreReported) {
  const Metrics m = MeasureSlab(Slab(), Mixed());
  for (int p = 0; p < body::kPartCount; ++p) {
    const auto part = static_cast<Part>(p);
    EXPECT_EQ(m.parts[p].has_value(),
              part == Part::kTorso || part == Part::kLeftArm || part == Part::kRightArm)
        << body::PartName(part);
  }
  EXPECT_TRUE(MeasureSlab(Slab(), Mixed(), {.head = true}).parts[Index(Part::kHead)].has_value());
}

TEST(PartMetricsTest, PartsAddUpToTheWhole) {
  for (const bool head : {false, true}) {
    const Metrics m = MeasureSlab(Slab(), Mixed(), {.head = head});
    double volume = 0.0;
    double outside = 0.0;
    double uncovered = 0.0;
    double set = 0.0;
    double worst = 0.0;
    int vertices_out = 0;
    int spheres = 0;
    int capsules = 0;
    for (const auto& part : m.parts) {
      if (!part) continue;
      volume += part->volume_m3;
      outside += part->volume_m3 * part->outside;
      uncovered += part->volume_m3 * part->uncovered;
      set += part->volume_m3 * part->volume_ratio;
      vertices_out += part->vertices_out;
      worst = std::max(worst, part->gap.max_m);
      spheres += part->spheres;
      capsules += part->capsules;
      EXPECT_DOUBLE_EQ(part->E_r, part->outside + part->uncovered);
      EXPECT_LE(part->gap.mean_m, part->gap.p95_m);
      EXPECT_LE(part->gap.p95_m, part->gap.max_m);
    }
    EXPECT_GT(m.outside, 0.1);
    EXPECT_GT(m.uncovered, 0.1);
    EXPECT_NEAR(outside / volume, m.outside, 1e-12);
    EXPECT_NEAR(uncovered / volume, m.uncovered, 1e-12);
    EXPECT_NEAR(set / volume, m.volume_ratio, 1e-12);
    EXPECT_EQ(vertices_out, m.vertices_out);
    EXPECT_EQ(worst, m.gap.max_m);
    EXPECT_EQ(spheres, m.spheres);
    EXPECT_EQ(capsules, m.capsules);
    EXPECT_EQ(m.n_p, m.spheres + m.capsules);
  }
}

// A ball that bulges out of the left arm's end, front and back.
TEST(PartMetricsTest, ASetOnOneLimbOnlyConcernsThatLimb) {
  const Metrics m = MeasureSlab(Slab(), MakeSet({{{{2.1, 1, 0}, 0.55}, Part::kLeftArm}}));
  const PartMetrics& arm = Of(Part::kLeftArm, m);
  for (const Part part : {Part::kTorso, Part::kRightArm}) {
    EXPECT_NEAR(Of(part, m).uncovered, 1.0, 1e-12);
    EXPECT_EQ(Of(part, m).outside, 0.0);
    EXPECT_EQ(Of(part, m).volume_ratio, 0.0);
    EXPECT_EQ(Of(part, m).surface_out, 1.0);
    EXPECT_EQ(Of(part, m).spheres, 0);
  }
  const double volume =
      arm.volume_m3 + Of(Part::kTorso, m).volume_m3 + Of(Part::kRightArm, m).volume_m3;
  EXPECT_NEAR(arm.outside * arm.volume_m3, m.outside * volume, 1e-12);
  EXPECT_NEAR(arm.volume_ratio * arm.volume_m3, Ball(0.55), 8e-3);  // the arm's end is along z
  EXPECT_NEAR(arm.uncovered * arm.volume_m3 + arm.volume_ratio * arm.volume_m3,
              arm.volume_m3 + arm.outside * arm.volume_m3, 1e-12);
  EXPECT_EQ(arm.spheres, 1);
  EXPECT_LT(arm.surface_out, 1.0);
}

// Whatever the sphere says: in front of the torso, at its surface, it is the torso's.
TEST(PartMetricsTest, WhatTouchesTheBodyBelongsToThePartThatItTouches) {
  const Metrics m = MeasureSlab(Slab(), MakeSet({{{{0, 0.8, 0.5}, 0.4}, Part::kRightArm}}));
  EXPECT_NEAR(Of(Part::kTorso, m).outside * Of(Part::kTorso, m).volume_m3, Ball(0.4) / 2, 2e-3);
  EXPECT_EQ(Of(Part::kRightArm, m).outside, 0.0);
  EXPECT_EQ(Of(Part::kRightArm, m).spheres, 1);
}

TEST(PartMetricsTest, WhatTouchesNothingBelongsToThePartOfTheNearerSphere) {
  // A capsule beside the body, below it: the half near each end is that end's.
  const Metrics m = MeasureSlab(
      Slab(), MakeSet({{{{-0.5, -1, 0}, 0.3}, Part::kTorso}, {{{0.5, -1, 0}, 0.3}, Part::kLeftArm}},
                      {{0, 1}}));
  const PartMetrics& torso = Of(Part::kTorso, m);
  const PartMetrics& arm = Of(Part::kLeftArm, m);
  EXPECT_NEAR(torso.outside * torso.volume_m3, arm.outside * arm.volume_m3, 1e-9);
  EXPECT_NEAR(torso.outside * torso.volume_m3, 0.5 * (Ball(0.3) + 0.09 * std::numbers::pi), 3e-3);
  EXPECT_EQ(Of(Part::kRightArm, m).outside, 0.0);
}

TEST(PartMetricsTest, WhatPartsThatAreNotFittedTouchBelongsToThePrimitive) {
  // Above the head, which is not fitted: the columns that touch its front and back too.
  const Metrics m = MeasureSlab(Slab(), MakeSet({{{{0, 1.9, 0}, 0.7}, Part::kLeftArm}}));
  EXPECT_GT(Of(Part::kLeftArm, m).outside, 0.1);
  // A head's ball where no head is fitted counts for the torso.
  const Metrics head = MeasureSlab(Slab(), MakeSet({{{{0, 1.9, 0}, 0.7}, Part::kHead}}));
  EXPECT_EQ(Of(Part::kLeftArm, head).outside, 0.0);
  EXPECT_NEAR(Of(Part::kTorso, head).outside * Of(Part::kTorso, head).volume_m3,
              Of(Part::kLeftArm, m).outside * Of(Part::kLeftArm, m).volume_m3 +
                  Of(Part::kTorso, m).outside * Of(Part::kTorso, m).volume_m3,
              1e-12);
}

TEST(PartMetricsTest, MirroredBodySwapsLeftAndRight) {
  const body::Body body = Slab();
  const capsule::PrimitiveSet set = Mixed();
  std::vector<Vector3d> points(body.mesh.vertices().begin(), body.mesh.vertices().end());
  std::vector<mesh::Triangle> triangles(body.mesh.triangles().begin(), body.mesh.triangles().end());
  for (Vector3d& p : points) p.x() = -p.x();
  for (mesh::Triangle& t : triangles) std::swap(t[1], t[2]);
  body::Body image = {test_shapes::MeshOf(points, triangles), {}, 0.0, false, {}, {}, {}, {}};
  for (const Segment segment : body.vertex_segments) {
    const bool is_left = segment == Segment::kLeftUpperArm;
    const bool is_right = segment == Segment::kRightUpperArm;
    image.vertex_segments.push_back(is_left    ? Segment::kRightUpperArm
                                    : is_right ? Segment::kLeftUpperArm
                                               : segment);
  }
  capsule::PrimitiveSet set_image = set;
  for (std::size_t i = 0; i < set.spheres.size(); ++i) {
    set_image.spheres[i].center_m.x() *= -1.0;
    set_image.origins[i].part = body::MirrorPart(set.origins[i].part);
  }
  const Metrics m = MeasureSlab(body, set);
  const Metrics mirrored = MeasureSlab(image, set_image);
  for (int p = 0; p < body::kPartCount; ++p) {
    const auto& one = m.parts[p];
    const auto& other = mirrored.parts[Index(body::MirrorPart(static_cast<Part>(p)))];
    ASSERT_EQ(one.has_value(), other.has_value());
    if (!one) continue;
    EXPECT_NEAR(one->volume_m3, other->volume_m3, 1e-9);
    EXPECT_NEAR(one->outside, other->outside, 1e-9);
    EXPECT_NEAR(one->uncovered, other->uncovered, 1e-9);
    EXPECT_NEAR(one->volume_ratio, other->volume_ratio, 1e-9);
    EXPECT_NEAR(one->gap.mean_m, other->gap.mean_m, 0.02 * one->gap.mean_m);
    EXPECT_EQ(one->vertices_out, other->vertices_out);
    EXPECT_NEAR(one->max_out_m, other->max_out_m, 1e-12);
  }
}

TEST(PartMetricsTest, SameBitsForAnyNumberOfThreads) {
  MeasureOptions options;
  const Metrics one = Measure(Slab(), Mixed(), options, Alone(), NullObserver());
  const Metrics many = Measure(Slab(), Mixed(), options, ThreadPool(5), NullObserver());
  EXPECT_EQ(one.gap.p95_m, many.gap.p95_m);
  for (const Part part : {Part::kTorso, Part::kLeftArm, Part::kRightArm}) {
    EXPECT_EQ(Of(part, one).E_r, Of(part, many).E_r);
    EXPECT_EQ(Of(part, one).gap.p95_m, Of(part, many).gap.p95_m);
  }
}

}  // namespace
}  // namespace capfit::metrics
