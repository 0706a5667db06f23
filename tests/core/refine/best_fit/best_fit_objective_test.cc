#include "core/refine/best_fit/best_fit_objective.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "tests/core/refine/ball_body.h"
#include "tests/core/refine/graphs.h"

namespace capfit::refine {
namespace {

const Eigen::Vector3d kObjectiveMiddle(0.0, 0.3, 0.05);

const BestFitObjective& BallObjective() {
  static const body::Body body = BallBody(kObjectiveMiddle, 0.2);
  static const BestFitObjective objective(
      MakeOccupancyGrid(body, AllParts(), 0.01, /*folded=*/true, ThreadPool(1)),
      {tighten::PointGrid(body.mesh.vertices(), tighten::PointGrid::Fold::kToPositiveX)},
      /*seed=*/1);
  return objective;
}

// Small spheres all over the ball, around a large one.
capsule::MirroredSet ManySmall(int pairs) {
  capsule::MirroredSet set(true);
  set.AddSphere({kObjectiveMiddle, 0.17}, true);
  for (int i = 0; i < pairs; ++i) {
    const double height = 1.0 - (2.0 * i + 1.0) / pairs;
    const double round = std::sqrt(1.0 - height * height);
    const double turn = std::numbers::pi * (0.618034 * i - std::floor(0.618034 * i));
    const Eigen::Vector3d out(round * std::sin(turn), height, round * std::cos(turn));
    set.AddSphere({kObjectiveMiddle + 0.17 * out, 0.03}, false);
  }
  return set;
}

// Lets one step through.
class OneStep final : public FitObserver {
 public:
  void OnStage(Stage, double) override {}
  [[nodiscard]] bool IsCancelled() const override { return std::exchange(is_over_, true); }

 private:
  mutable bool is_over_ = false;
};

// How far places and radii go together, at most.
double FirstStepM(const capsule::MirroredSet& before) {
  capsule::MirroredSet set = before;
  BallObjective().Settle(Effort::kFinish, ThreadPool(1), OneStep(), set);
  double most = 0.0;
  for (int v = 0; v < set.sphere_count(); ++v) {
    most = std::max(most, std::hypot((set.sphere(v).center_m - before.sphere(v).center_m).norm(),
                                     set.sphere(v).radius_m - before.sphere(v).radius_m));
  }
  return most;
}

// Large steps would throw small spheres about, and not all of them come back.
TEST(BestFitObjectiveTest, StepsOfManyPrimitivesBeginShorter) {
  const double of_few = FirstStepM(ManySmall(10));
  EXPECT_GT(of_few, 0.003);
  const capsule::MirroredSet many = ManySmall(320);
  ASSERT_EQ(many.primitive_count(), 641);
  EXPECT_NEAR(FirstStepM(many), 0.5 * of_few, 0.001 * of_few);
}

}  // namespace
}  // namespace capfit::refine
