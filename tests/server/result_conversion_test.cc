#include "proto/wire/result_conversion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/status.h"
#include "tests/server/fake_fit.h"

namespace capfit::wire {
namespace {

using server::HandMadeResult;

void ExpectSameGap(const metrics::GapStatistics& got, const metrics::GapStatistics& sent) {
  EXPECT_EQ(got.mean_m, sent.mean_m);
  EXPECT_EQ(got.p95_m, sent.p95_m);
  EXPECT_EQ(got.max_m, sent.max_m);
}

TEST(ResultConversion, PrimitivesComeBackBitForBit) {
  const pipeline::FitResult sent = HandMadeResult();
  const capsule::PrimitiveSet& set = sent.primitives;
  pipeline::FitResult got;
  const absl::Status status = PrimitivesFromWire(PrimitivesToWire(sent), got);
  ASSERT_TRUE(status.ok()) << status;
  const capsule::PrimitiveSet* const back = &got.primitives;
  EXPECT_EQ(got.sphere_names, sent.sphere_names);
  ASSERT_EQ(back->spheres.size(), set.spheres.size());
  for (std::size_t i = 0; i < set.spheres.size(); ++i) {
    EXPECT_EQ(back->spheres[i].center_m, set.spheres[i].center_m);
    EXPECT_EQ(back->spheres[i].radius_m, set.spheres[i].radius_m);
    EXPECT_EQ(back->origins[i].part, set.origins[i].part);
    EXPECT_EQ(back->origins[i].polygon, set.origins[i].polygon);
    EXPECT_EQ(back->origins[i].mirror, set.origins[i].mirror);
  }
  EXPECT_EQ(back->capsules, set.capsules);
}

TEST(ResultConversion, WhatHeldAndWhatWasFittedComeBack) {
  const pipeline::FitResult sent = HandMadeResult(4);
  const v1::Summary wire = SummaryToWire(sent, "");
  EXPECT_EQ(wire.options().budget().max_spheres(), 32);
  EXPECT_FALSE(wire.options().budget().has_max_primitives());
  EXPECT_EQ(wire.options().capsule_profile(), v1::CAPSULE_PROFILE_TANGENT_HULL);
  pipeline::FitResult got;
  const absl::Status status = SummaryFromWire(wire, got);
  ASSERT_TRUE(status.ok()) << status;
  // Bit for bit: the same message again.
  EXPECT_EQ(SummaryToWire(got, "").SerializeAsString(), wire.SerializeAsString());
  EXPECT_EQ(got.effective_options.engine, "unity_cloth");
  EXPECT_TRUE(got.effective_options.parts.head);
  EXPECT_FALSE(got.effective_options.require_parts.torso);
  EXPECT_EQ(got.effective_options.up, body::UpAxis::kZ);
  EXPECT_EQ(got.body.vertex_count, 1234);
  EXPECT_EQ(got.body.box_max, Eigen::Vector3d(50, 20, 170));
  EXPECT_EQ(got.version, "1.2.3");
}

TEST(ResultConversion, SummaryComesBack) {
  const pipeline::FitResult result = HandMadeResult();
  const v1::Summary wire = SummaryToWire(result, "job-7");
  EXPECT_EQ(wire.request_id(), "job-7");
  EXPECT_EQ(wire.stages_size(), 8) << "the stage that took no time is left out";
  pipeline::FitResult back;
  ASSERT_TRUE(SummaryFromWire(wire, back).ok());
  EXPECT_EQ(back.metrics.n_p, result.metrics.n_p);
  EXPECT_EQ(back.metrics.E_r, result.metrics.E_r);
  EXPECT_EQ(back.metrics.outside, result.metrics.outside);
  EXPECT_EQ(back.metrics.uncovered, result.metrics.uncovered);
  EXPECT_EQ(back.metrics.E_M, result.metrics.E_M);
  EXPECT_EQ(back.metrics.hausdorff, result.metrics.hausdorff);
  EXPECT_EQ(back.metrics.max_gap_m, result.metrics.max_gap_m);
  EXPECT_EQ(back.metrics.volume_ratio, result.metrics.volume_ratio);
  EXPECT_EQ(back.metrics.mirror_error, result.metrics.mirror_error);
  EXPECT_EQ(back.metrics.vertices_out, result.metrics.vertices_out);
  EXPECT_EQ(back.metrics.max_out_m, result.metrics.max_out_m);
  EXPECT_EQ(back.metrics.spheres, result.metrics.spheres);
  EXPECT_EQ(back.metrics.capsules, result.metrics.capsules);
  EXPECT_EQ(back.metrics.iou, result.metrics.iou);
  EXPECT_EQ(back.metrics.surface_out, result.metrics.surface_out);
  ExpectSameGap(back.metrics.gap, result.metrics.gap);
  EXPECT_EQ(back.stage_seconds, result.stage_seconds);
  EXPECT_EQ(back.seconds, result.seconds);
  EXPECT_EQ(back.body_from_caller.rotation, result.body_from_caller.rotation);
  EXPECT_EQ(back.body_from_caller.scale, result.body_from_caller.scale);
  EXPECT_EQ(back.body_from_caller.translation, result.body_from_caller.translation);
}

TEST(ResultConversion, MetricsOfPartsComeBack) {
  const pipeline::FitResult result = HandMadeResult();
  v1::Summary wire = SummaryToWire(result, "");
  EXPECT_EQ(wire.metrics().parts_size(), 2);
  wire.mutable_metrics()->add_parts()->set_part(v1::BODY_PART_UNSPECIFIED);  // of a later version
  pipeline::FitResult back;
  ASSERT_TRUE(SummaryFromWire(wire, back).ok());
  for (std::size_t p = 0; p < result.metrics.parts.size(); ++p) {
    const auto& sent = result.metrics.parts[p];
    const auto& got = back.metrics.parts[p];
    ASSERT_EQ(got.has_value(), sent.has_value());
    if (!sent) continue;
    EXPECT_EQ(got->spheres, sent->spheres);
    EXPECT_EQ(got->capsules, sent->capsules);
    EXPECT_EQ(got->volume_m3, sent->volume_m3);
    EXPECT_EQ(got->E_r, sent->E_r);
    EXPECT_EQ(got->outside, sent->outside);
    EXPECT_EQ(got->uncovered, sent->uncovered);
    EXPECT_EQ(got->E_M, sent->E_M);
    EXPECT_EQ(got->volume_ratio, sent->volume_ratio);
    EXPECT_EQ(got->surface_out, sent->surface_out);
    EXPECT_EQ(got->vertices_out, sent->vertices_out);
    EXPECT_EQ(got->max_out_m, sent->max_out_m);
    ExpectSameGap(got->gap, sent->gap);
  }
}

TEST(ResultConversion, PolygonsLandmarksAndWarningsComeBack) {
  const pipeline::FitResult result = HandMadeResult();
  const auto polygon = PolygonFromWire(PolygonToWire(result.polygons[0]));
  ASSERT_TRUE(polygon.ok()) << polygon.status();
  EXPECT_EQ(polygon->name, "hip");
  EXPECT_EQ(polygon->outline, result.polygons[0].outline);
  ASSERT_EQ(polygon->circles.size(), 1U);
  EXPECT_EQ(polygon->circles[0].radius_m, result.polygons[0].circles[0].radius_m);
  EXPECT_EQ(polygon->outside_area_ratio, result.polygons[0].outside_area_ratio);

  pipeline::FitResult back;
  LandmarksFromWire(LandmarksToWire(result), back);
  ASSERT_EQ(back.landmarks.size(), 2U);
  EXPECT_EQ(back.landmarks[1].name, "left_wrist");
  EXPECT_EQ(back.landmarks[1].position, result.landmarks[1].position);
  EXPECT_EQ(back.landmarks[1].method, body::LandmarkMethod::kCaller);
  EXPECT_EQ(back.landmarks[0].confidence, 0.75);

  const Warning warning = WarningFromWire(WarningToWire(result.warnings[0]));
  EXPECT_EQ(warning.code, "HOLES_CLOSED");
  EXPECT_EQ(warning.message, "2 holes were closed");
  EXPECT_EQ(warning.count, 2);
}

TEST(ResultConversion, WrongMessagesOfAServerAreRefused) {
  pipeline::FitResult result;
  v1::PrimitiveSet set = PrimitivesToWire(HandMadeResult());
  set.mutable_capsules(1)->set_second_sphere(3);
  EXPECT_EQ(FieldOf(PrimitivesFromWire(set, result)), "primitives.capsules[1]");
  set.mutable_capsules(1)->set_first_sphere(2);
  set.mutable_capsules(1)->set_second_sphere(1);
  EXPECT_FALSE(PrimitivesFromWire(set, result).ok());
  set = PrimitivesToWire(HandMadeResult());
  set.mutable_spheres(2)->set_part(v1::BODY_PART_UNSPECIFIED);
  EXPECT_EQ(FieldOf(PrimitivesFromWire(set, result)), "primitives.spheres[2].part");
}

}  // namespace
}  // namespace capfit::wire
