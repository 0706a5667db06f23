#include "core/tighten/tighten.h"

#include <gtest/gtest.h>

#include "core/base/fit_observer.h"
#include "core/tighten/set_variables.h"
#include "core/tighten/union_volume.h"
#include "tests/core/tighten/tube_body.h"

namespace capfit::tighten {
namespace {

const ThreadPool& Alone() {
  static const ThreadPool pool(1);
  return pool;
}

double VolumeOf(capsule::PrimitiveSet set) {
  const SetVariables variables(set);
  return UnionVolumeGradient(set, variables, 0.005, /*seed=*/1, Alone()).volume_m3;
}

double FurthestOut(const TubeBody& body) {
  double furthest = -1.0;
  for (const Eigen::Vector3d& p : body.target.points_m) {
    furthest = std::max(furthest, DistanceToUnion(body.set, p));
  }
  return furthest;
}

// Large enough to enclose everything.
TubeBody Loose(std::uint64_t seed) {
  TubeBody body = MakeTubeBody(seed, 0.0);
  for (geometry::Sphere& sphere : body.set.spheres) sphere.radius_m *= 1.5;
  return body;
}

void TightenAll(TightenPhase phase, const ThreadPool& pool, TubeBody& body) {
  const PointGrid grid(body.target.points_m);
  const PointsToHold points{grid, 0.0};
  NullObserver observer;
  const WorkMeter meter(observer);
  Tighten({&points, 1}, SizeOf(body.target), phase, /*seed=*/1, pool, meter, body.set);
}

constexpr TightenPhase kAllInside{.steps = 10,
                                  .first_trust = 0.008,
                                  .last_trust = 0.0005,
                                  .first_penalty = 0.4,
                                  .last_penalty = 0.4};

TEST(TightenTest, MakesTheSetSmallerAroundThePoints) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    TubeBody body = Loose(seed);
    const double before = VolumeOf(body.set);
    TightenAll(kAllInside, Alone(), body);
    EXPECT_LT(VolumeOf(body.set), 0.8 * before);
    EXPECT_LT(FurthestOut(body), 1e-3);
    EXPECT_TRUE(IsExactlyMirrored(body.set));
  }
}

// A circle may come out as a point, and engines take spheres of no size too: the others must not
// wait for it.
TEST(TightenTest, ASphereWithoutRadiusHoldsUpNoOther) {
  TubeBody body = Loose(2);
  const double before = VolumeOf(body.set);
  body.set.spheres.push_back({body.set.spheres[0].center_m, 0.0});
  body.set.origins.push_back({body::Part::kTorso, -1, static_cast<int>(body.set.origins.size())});
  TightenAll(kAllInside, Alone(), body);
  EXPECT_LT(VolumeOf(body.set), 0.8 * before);
  EXPECT_LT(FurthestOut(body), 1e-3);
  EXPECT_GT(body.set.spheres.back().radius_m, 0.0);
}

TEST(TightenTest, FixedCentresStayAndUniformRadiiAre) {
  TubeBody body = Loose(4);
  const capsule::PrimitiveSet before = body.set;
  TightenPhase phase = kAllInside;
  phase.fixed_centers = true;
  TightenAll(phase, Alone(), body);
  for (std::size_t i = 0; i < before.spheres.size(); ++i) {
    EXPECT_LT((body.set.spheres[i].center_m - before.spheres[i].center_m).norm(), 1e-6);
  }
  EXPECT_LT(VolumeOf(body.set), VolumeOf(before));
  body = Loose(4);
  phase = kAllInside;
  phase.uniform_radius = true;
  phase.first_trust = 0.04;
  phase.steps = 24;
  TightenAll(phase, Alone(), body);
  const capsule::CapsuleEnds& bar = body.set.capsules.back();  // between two images
  EXPECT_EQ(body.set.spheres[bar[0]].radius_m, body.set.spheres[bar[1]].radius_m);
  double least = 1.0, most = 0.0;  // all hang together
  for (const geometry::Sphere& sphere : body.set.spheres) {
    least = std::min(least, sphere.radius_m);
    most = std::max(most, sphere.radius_m);
  }
  EXPECT_LT(most - least, 0.005);
}

TEST(TightenTest, SameBitsForAnyNumberOfThreads) {
  TubeBody one = Loose(5), three = Loose(5);
  const ThreadPool pool(3);
  TightenAll(kAllInside, Alone(), one);
  TightenAll(kAllInside, pool, three);
  for (std::size_t i = 0; i < one.set.spheres.size(); ++i) {
    EXPECT_EQ(one.set.spheres[i].center_m, three.set.spheres[i].center_m);
    EXPECT_EQ(one.set.spheres[i].radius_m, three.set.spheres[i].radius_m);
  }
}

}  // namespace
}  // namespace capfit::tighten
