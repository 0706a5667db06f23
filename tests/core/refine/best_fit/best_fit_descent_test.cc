#include "core/refine/best_fit/best_fit_descent.h"

#include <gtest/gtest.h>

#include "core/refine/best_fit/fill_error.h"
#include "tests/core/refine/ball_body.h"
#include "tests/core/refine/graphs.h"

namespace capfit::refine {
namespace {

const Eigen::Vector3d kBodyCenter(0.0, 0.3, 0.05);
constexpr double kBodyRadius = 0.2;

const OccupancyGrid& Grid() {
  static const OccupancyGrid grid = MakeOccupancyGrid(
      BallBody(kBodyCenter, kBodyRadius), AllParts(), 0.008, /*folded=*/true, ThreadPool(1));
  return grid;
}

capsule::MirroredSet Off(bool is_mirrored) {
  capsule::MirroredSet graph(is_mirrored);
  graph.AddSphere({kBodyCenter + Eigen::Vector3d(0.0, 0.04, -0.03), 0.15}, true);
  return graph;
}

// A mirrored pair, each half as large as the ball.
capsule::MirroredSet Pair() {
  capsule::MirroredSet graph(true);
  graph.AddSphere({kBodyCenter + Eigen::Vector3d(0.05, 0.01, 0.0), 0.1}, false);
  return graph;
}

TEST(BestFitDescentTest, FindsTheBallFromBesideIt) {
  for (const bool is_mirrored : {false, true}) {
    capsule::MirroredSet graph = Off(is_mirrored);
    BestFitOptions options;
    options.steps = 150;
    DescendBestFit(Grid(), options, ThreadPool(1), NullObserver(), graph);
    EXPECT_LT((graph.sphere(0).center_m - kBodyCenter).norm(), 0.003);
    EXPECT_NEAR(graph.sphere(0).radius_m, kBodyRadius, 0.003);
    EXPECT_LT(GridError(Grid(), graph, ThreadPool(1)), 0.03);
  }
}

TEST(BestFitDescentTest, APairStaysExactAndTheErrorFalls) {
  capsule::MirroredSet graph = Pair();
  const double before = GridError(Grid(), graph, ThreadPool(1));
  DescendBestFit(Grid(), {}, ThreadPool(1), NullObserver(), graph);
  EXPECT_TRUE(capsule::IsExactlyMirrored(graph));
  EXPECT_LT(GridError(Grid(), graph, ThreadPool(1)), 0.5 * before);
}

TEST(BestFitDescentTest, OnlyActiveSpheresMove) {
  capsule::MirroredSet graph = Pair();
  const int still = graph.AddSphere({{0.0, 0.15, 0.05}, 0.05}, true);
  std::vector<char> active(graph.spheres().size(), 1);
  active[still] = 0;
  const capsule::MirroredSet before = graph;
  BestFitOptions options;
  options.active = &active;
  DescendBestFit(Grid(), options, ThreadPool(1), NullObserver(), graph);
  EXPECT_EQ(graph.sphere(still).center_m, before.sphere(still).center_m);
  EXPECT_EQ(graph.sphere(still).radius_m, before.sphere(still).radius_m);
  EXPECT_NE(graph.sphere(0).radius_m, before.sphere(0).radius_m);
}

TEST(BestFitDescentTest, SameSeedSameBits) {
  std::vector<capsule::MirroredSet> graphs;
  for (const std::uint64_t seed : {7, 7, 8}) {
    graphs.push_back(Pair());
    BestFitOptions options;
    options.seed = seed;
    DescendBestFit(Grid(), options, ThreadPool(1), NullObserver(), graphs.back());
  }
  EXPECT_EQ(graphs[0].sphere(0).center_m, graphs[1].sphere(0).center_m);
  EXPECT_NE(graphs[0].sphere(0).center_m, graphs[2].sphere(0).center_m);
  EXPECT_LT((graphs[0].sphere(0).center_m - graphs[2].sphere(0).center_m).norm(), 0.01);
}

}  // namespace
}  // namespace capfit::refine
