#include "tests/core/body/mannequin_trial.h"

#include <gtest/gtest.h>

#include "core/mesh/prepare_mesh.h"
#include "tests/core/body/body_files.h"

namespace capfit::body {
namespace {

// The first of those that the mannequin_trials program runs by the hundred.
TEST(MannequinTrial, BatteredMannequinsHaveAllLandmarksInTheirParts) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const MannequinTrial trial = MakeMannequinTrial(seed);
    SCOPED_TRACE(trial.Description());
    const auto prepared = mesh::PrepareMesh(trial.battered);
    ASSERT_TRUE(prepared.ok()) << prepared.status();
    const auto body = Find(prepared->mesh);
    ASSERT_TRUE(body.ok()) << body.status();
    for (const std::string& fault : FaultsOf(*body, trial)) ADD_FAILURE() << fault;
  }
}

// The examiner must be able to complain: left and right exchanged, a knee taken for an ankle.
TEST(MannequinTrial, FaultsAreSeen) {
  const MannequinTrial trial = MakeMannequinTrial(1);
  auto body = Find(mesh::PrepareMesh(trial.battered)->mesh);
  ASSERT_TRUE(body.ok()) << body.status();
  ASSERT_TRUE(FaultsOf(*body, trial).empty());
  Body exchanged = *body;
  for (int i = 0; i < kLandmarkCount; ++i) {
    const auto other = MirrorLandmark(static_cast<LandmarkId>(i));
    exchanged.landmarks[i] = body->landmark(other);
  }
  EXPECT_GE(FaultsOf(exchanged, trial).size(), 10u);
  body->landmarks[static_cast<int>(LandmarkId::kLeftAnkle)] = body->landmark(LandmarkId::kLeftKnee);
  EXPECT_EQ(FaultsOf(*body, trial).size(), 1u);
}

}  // namespace
}  // namespace capfit::body
