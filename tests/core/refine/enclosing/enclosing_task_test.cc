#include "core/refine/enclosing/enclosing_task.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/base/fit_observer.h"
#include "tests/core/refine/enclosing/tube.h"
#include "tests/core/refine/graphs.h"

namespace capfit::refine {
namespace {

const ThreadPool& Alone() {
  static const ThreadPool pool(1);
  return pool;
}

// One capsule around the whole tube.
capsule::MirroredSet Around(double radius_m) {
  capsule::MirroredSet graph;
  graph.AddSphere({{0, 0, 0}, radius_m}, false);
  graph.AddSphere({{0, kLength, 0}, radius_m}, false);
  graph.AddCapsule(0, 1);
  return graph;
}

tighten::CoverTarget Turned(tighten::CoverTarget target, const Eigen::Matrix3d& turn) {
  for (Eigen::Vector3d& p : target.points_m.own()) p = turn * p;
  return target;
}

capsule::MirroredSet Turned(capsule::MirroredSet graph, const Eigen::Matrix3d& turn) {
  for (int v = 0; v < graph.sphere_count(); ++v) {
    graph.sphere(v).center_m = turn * graph.sphere(v).center_m;
  }
  return graph;
}

TEST(EnclosingTaskTest, TheValueOfWhatEnclosesIsItsVolume) {
  const double r = 1.1 * kRadius;
  const double volume =
      std::numbers::pi * r * r * kLength + 4.0 / 3.0 * std::numbers::pi * r * r * r;
  EXPECT_NEAR(TubeTask().Value(Around(r), Alone()).total_m3, volume, 0.005 * volume);
}

// Each square metre of the tube is as far out as its radius lacks, and a cubic metre outside costs
// four. (The thinned points lie a little inside of the surface.)
TEST(EnclosingTaskTest, WhatSticksOutCostsItsAreaTimesItsDepth) {
  const double lacking = 0.01;
  const double r = kRadius - lacking;
  const double volume =
      std::numbers::pi * r * r * kLength + 4.0 / 3.0 * std::numbers::pi * r * r * r;
  const double outside = 2.0 * std::numbers::pi * kRadius * kLength * lacking;
  EXPECT_NEAR(TubeTask().Value(Around(r), Alone()).total_m3, volume + 4.0 * outside,
              0.1 * 4.0 * outside);
}

// The room between a wider capsule and the tube, and what is left outside of a thinner one at four
// times its price; without a body all is trunk.
TEST(EnclosingTaskTest, ARegionIsWorthTheRoomInIt) {
  for (const double r : {0.9 * kRadius, 1.1 * kRadius}) {
    const GraphValue value = TubeTask().Value(Around(r), Alone());
    const double room = 2.0 * std::numbers::pi * kRadius * kLength * std::abs(r - kRadius);
    const double price = r < kRadius ? 4.0 : 1.0;
    EXPECT_NEAR(value.of_region_m3[0], price * room, 0.1 * price * room) << r;
    for (int region = 1; region < kRegionCount; ++region) {
      EXPECT_EQ(value.of_region_m3[region], 0.0);
    }
  }
}

TEST(EnclosingTaskTest, TurningAllChangesNoValue) {
  const Eigen::Matrix3d turn(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, -0.5).normalized()));
  const EnclosingTask turned(Turned(Tube(), turn), /*symmetric=*/false, 0.0, 0.03);
  const double here = TubeTask().Value(Chain(4), Alone()).total_m3;
  EXPECT_NEAR(turned.Value(Turned(Chain(4), turn), Alone()).total_m3, here, 0.02 * here);
}

TEST(EnclosingTaskTest, FindingTheShapeAndTakingInLowerTheValue) {
  NullObserver observer;
  WorkMeter meter(observer);
  for (const bool is_mirrored : {false, true}) {
    const EnclosingTask task(Tube(), is_mirrored, 0.0, 0.03);
    capsule::MirroredSet graph(is_mirrored);
    for (const double y : {0.1, 0.6, 0.9}) graph.AddSphere({{0, y, 0.02}, 0.14}, true);
    graph.AddCapsule(0, 1);
    graph.AddCapsule(1, 2);
    const double before = task.Value(graph, Alone()).total_m3;
    task.FindShape(10, 1.0, /*seed=*/1, Alone(), meter, graph);
    task.TakeIn(3, /*seed=*/2, Alone(), meter, graph);
    EXPECT_LT(task.Value(graph, Alone()).total_m3, 0.95 * before);
    EXPECT_TRUE(!is_mirrored || capsule::IsExactlyMirrored(graph));
    for (const Eigen::Vector3d& p : Tube().points_m) EXPECT_LT(UnionDistance(graph, p), 0.004f);
  }
}

TEST(EnclosingTaskTest, WorstPointsStickOutAndLieApart) {
  const capsule::MirroredSet beads = Beads(3);
  const std::vector<Eigen::Vector3d> worst = TubeTask().WorstPoints(beads, 6, Alone());
  ASSERT_EQ(worst.size(), 6U);
  for (std::size_t i = 0; i < worst.size(); ++i) {
    EXPECT_GT(UnionDistance(beads, worst[i]), 0.0f);
    for (std::size_t k = 0; k < i; ++k) EXPECT_GT((worst[i] - worst[k]).norm(), 0.02);
  }
}

// What an addition wins at once: the price of what it takes in less its volume.
TEST(EnclosingTaskTest, ATieBetweenFarBeadsWinsAndOneInsideWinsNothing) {
  capsule::MirroredSet beads = Beads(3);
  beads.AddSphere({{0.0, 0.02, 0.0}, 0.5 * kRadius}, false);  // within the first
  const std::vector<double> gains = TubeTask().GainsOf(
      beads, {EditOf(EditKind::kLink, 0, 1), EditOf(EditKind::kLink, 0, 3)}, Alone());
  EXPECT_GT(gains[0], 0.0);
  EXPECT_EQ(gains[1], 0.0);
}

TEST(EnclosingTaskTest, ThePairTogetherIsWhatBothHave) {
  const EnclosingTask task(Tube(), /*symmetric=*/true, 0.0, 0.03);
  capsule::MirroredSet graph(true);
  const int low = graph.AddSphere({{0.03, 0.0, 0.0}, kRadius}, false);
  const int high = graph.AddSphere({{0.03, kLength, 0.0}, kRadius}, false);
  graph.AddCapsule(low, high);
  const GraphWorth worth = task.Weigh(graph);
  ASSERT_EQ(worth.edge_gap.size(), 2U);
  EXPECT_EQ(worth.edge_gap[0], worth.edge_gap[1]);
  EXPECT_EQ(worth.edge_loss[0], worth.edge_loss[1]);
  EXPECT_EQ(worth.node_loss[0], worth.node_loss[1]);
  EXPECT_GT(worth.edge_loss[0], 0.0);
}

}  // namespace
}  // namespace capfit::refine
