#include "core/refine/refine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/body/find_body.h"
#include "core/coverage/cover_body.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"
#include "core/refine/best_fit/fill_error.h"
#include "core/refine/best_fit/occupancy_grid.h"
#include "core/refine/graph/graph_edit.h"

namespace capfit::refine {
namespace {

using Vec3 = Eigen::Vector3d;

body::Body FindMannequin(bool with_ends, int faces) {
  mannequin::MannequinOptions options;
  options.faces = faces;
  options.with_head = options.with_hands = options.with_feet = with_ends;
  const auto soup = mannequin::MakeMannequin(options);
  EXPECT_TRUE(soup.ok()) << soup.status().ToString();
  const auto prepared = mesh::PrepareMesh(*soup);
  EXPECT_TRUE(prepared.ok()) << prepared.status().ToString();
  auto body = body::FindBody(prepared->mesh, {}, ThreadPool(1), NullObserver());
  EXPECT_TRUE(body.ok()) << body.status().ToString();
  return *std::move(body);
}

const body::Body& CutMannequin() {
  static const body::Body body = FindMannequin(false, 5000);
  return body;
}

RefineOptions WithSpheresAndCapsules(int spheres, int capsules, bool enclose) {
  RefineOptions options;
  options.budget.max_spheres = spheres;
  options.budget.max_capsules = capsules;
  options.enclose = enclose;
  options.parts.head = options.parts.hands = options.parts.feet = true;
  return options;
}

RefineOptions WithPrimitives(int count, bool enclose) {
  RefineOptions options = WithSpheresAndCapsules(1000, 1000, enclose);
  options.budget.max_primitives = count;
  return options;
}

double FurthestVertex(const body::Body& body, const capsule::PrimitiveSet& set) {
  const std::vector<geometry::TaperedCapsule> solids = capsule::Solids(set);
  double worst = -1.0;
  for (const Vec3& v : body.mesh.vertices()) {
    double least = 1e9;
    for (const auto& solid : solids) least = std::min(least, solid.SignedDistance(v));
    worst = std::max(worst, least);
  }
  return worst;
}

double ErrorOf(const body::Body& body, const capsule::PrimitiveSet& set) {
  body::PartSelection all;
  all.head = all.hands = all.feet = true;
  return GridError(MakeOccupancyGrid(body, all, 0.008, false, ThreadPool(1)),
                   capsule::MirroredSet(set, false), ThreadPool(1));
}

// What the pipeline makes of it: an enclosing set covers.
capsule::PrimitiveSet Refine(const body::Body& body, const RefineOptions& options,
                             int threads = 2) {
  const ThreadPool pool(threads);
  const tighten::CoverTarget target = tighten::TargetOf(body, options.parts);
  NullObserver observer;
  capsule::PrimitiveSet set = RefineSet(body, target, options, pool, observer);
  if (!options.enclose) return set;
  coverage::CoverOptions cover;
  cover.tolerance_m = options.tolerance_m;
  cover.loosening = coverage::Loosening::kNone;
  (void)coverage::CoverBody(target, cover, pool, observer, set);
  return set;
}

// Keeps what it is told.
class Listener final : public FitObserver {
 public:
  void OnStage(Stage, double) override {}
  void OnFraction(double fraction_of_stage) override { fractions.push_back(fraction_of_stage); }
  [[nodiscard]] bool IsCancelled() const override { return false; }

  std::vector<double> fractions;
};

TEST(RefineSetTest, TellsHowFarItIs) {
  const body::Body& body = CutMannequin();
  for (const bool enclose : {true, false}) {
    const RefineOptions options = WithPrimitives(64, enclose);
    Listener listener;
    (void)RefineSet(body, tighten::TargetOf(body, options.parts), options, ThreadPool(2), listener);
    std::vector<double>& told = listener.fractions;
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    told.erase(std::unique(told.begin(), told.end()), told.end());
    ASSERT_GT(told.size(), 30u) << enclose;
    EXPECT_GE(told.front(), 0.0);
    EXPECT_EQ(told.back(), 1.0) << enclose;
  }
}

// Between what the search leaves outside and what has to be inside there is little.
TEST(RefineSetTest, EnclosingSetsAreNearlyThatBeforeCoverage) {
  for (const RefineOptions& options :
       {WithSpheresAndCapsules(32, 32, true), WithPrimitives(100, true)}) {
    NullObserver observer;
    const capsule::PrimitiveSet set =
        RefineSet(CutMannequin(), tighten::TargetOf(CutMannequin(), options.parts), options,
                  ThreadPool(2), observer);
    EXPECT_LT(FurthestVertex(CutMannequin(), set), 0.015);
    EXPECT_LE(set.primitive_count(), options.budget.max_primitives);
  }
}

// A set for the pose at hand is loosened once more, for coverage to take in; one that will move
// not.
TEST(RefineSetTest, OnlyASetThatStaysIsLoosenedLast) {
  RefineOptions options = WithPrimitives(100, true);
  const auto outside_m = [&](bool will_move) {
    options.will_move = will_move;
    NullObserver observer;
    return FurthestVertex(
        CutMannequin(), RefineSet(CutMannequin(), tighten::TargetOf(CutMannequin(), options.parts),
                                  options, ThreadPool(2), observer));
  };
  EXPECT_LT(outside_m(true), outside_m(false));
}

TEST(RefineSetTest, MoreIsNotWorse) {
  double last = 10.0;
  for (const int count : {22, 32, 48, 64, 96}) {
    const capsule::PrimitiveSet set = Refine(CutMannequin(), WithPrimitives(count, true));
    EXPECT_LE(set.primitive_count(), count);
    EXPECT_GE(set.primitive_count(), count - 4);
    const double error = ErrorOf(CutMannequin(), set);
    EXPECT_LT(error, 1.02 * last) << count;
    last = error;
  }
}

TEST(RefineSetTest, OneLimitAloneHolds) {
  RefineOptions options = WithSpheresAndCapsules(24, 1'000'000, true);
  options.budget = {};
  options.budget.max_spheres = 24;
  const capsule::PrimitiveSet spheres = Refine(CutMannequin(), options);
  EXPECT_LE(spheres.spheres.size(), 24u);
  EXPECT_GE(spheres.spheres.size(), 22u);
  options.budget = {};
  options.budget.max_capsules = 20;
  const capsule::PrimitiveSet capsules = Refine(CutMannequin(), options);
  EXPECT_LE(capsules.capsules.size(), 20u);
  EXPECT_GE(capsules.capsules.size(), 18u);
}

void ExpectExactlyMirrored(const capsule::PrimitiveSet& set) {
  for (std::size_t i = 0; i < set.spheres.size(); ++i) {
    const int mirror = set.origins[i].mirror;
    ASSERT_GE(mirror, 0);
    const geometry::Sphere& image = set.spheres[mirror];
    EXPECT_EQ(image.center_m.x(), -set.spheres[i].center_m.x());
    EXPECT_EQ(image.center_m.y(), set.spheres[i].center_m.y());
    EXPECT_EQ(image.center_m.z(), set.spheres[i].center_m.z());
    EXPECT_EQ(image.radius_m, set.spheres[i].radius_m);
  }
}

TEST(RefineSetTest, EnclosesWithinAnEnginesLimits) {
  const capsule::PrimitiveSet set = Refine(CutMannequin(), WithSpheresAndCapsules(32, 32, true));
  EXPECT_LE(set.spheres.size(), 32u);
  EXPECT_LE(set.capsules.size(), 32u);
  EXPECT_GE(set.primitive_count(), 62);
  EXPECT_LE(FurthestVertex(CutMannequin(), set), 1e-5);
  EXPECT_LT(ErrorOf(CutMannequin(), set), 0.30);
  ExpectExactlyMirrored(set);
}

TEST(RefineSetTest, BestFitIsTightAndWithinBudget) {
  double last = 1.0;
  for (const int count : {22, 40, 64}) {
    const capsule::PrimitiveSet set = Refine(CutMannequin(), WithPrimitives(count, false));
    EXPECT_LE(set.primitive_count(), count);
    EXPECT_GE(set.primitive_count(), count - 2);
    const double error = ErrorOf(CutMannequin(), set);
    EXPECT_LT(error, last);
    last = error;
    ExpectExactlyMirrored(set);
  }
  EXPECT_LT(last, 0.12);
}

TEST(RefineSetTest, BestFitHangsTogetherAndReachesEveryLimb) {
  const body::Body body = FindMannequin(true, 5000);
  for (const int count : {32, 64}) {
    const capsule::PrimitiveSet set = Refine(body, WithPrimitives(count, false));
    const capsule::MirroredSet graph = capsule::MirroredSet(set, false);
    EXPECT_LE(ComponentCount(graph), count / 4) << count;
    EXPECT_LE(FurthestVertex(body, set), 0.12) << count;
  }
}

TEST(RefineSetTest, BestFitUsesLargerBudgetsToo) {
  const capsule::PrimitiveSet set = Refine(CutMannequin(), WithPrimitives(120, false));
  EXPECT_LE(set.primitive_count(), 120);
  EXPECT_GE(set.primitive_count(), 118);
  EXPECT_LT(ErrorOf(CutMannequin(), set), 0.06);
}

void ExpectSameBitsForAnyNumberOfThreads(const body::Body& body, const RefineOptions& options) {
  const capsule::PrimitiveSet one = Refine(body, options, 1);
  for (const int threads : {2, 5}) {
    const capsule::PrimitiveSet other = Refine(body, options, threads);
    ASSERT_EQ(one.spheres.size(), other.spheres.size());
    for (std::size_t i = 0; i < one.spheres.size(); ++i) {
      EXPECT_EQ(one.spheres[i].center_m, other.spheres[i].center_m);
      EXPECT_EQ(one.spheres[i].radius_m, other.spheres[i].radius_m);
    }
    EXPECT_EQ(one.capsules, other.capsules);
  }
}

TEST(RefineSetTest, SameBitsForAnyNumberOfThreads) {
  for (const bool enclose : {true, false}) {
    ExpectSameBitsForAnyNumberOfThreads(CutMannequin(), WithPrimitives(50, enclose));
  }
}

// A whole body and a budget that a standard layout fills: two searches side by side.
TEST(RefineSetTest, SameBitsForAnyNumberOfThreadsOfTwoSearches) {
  const body::Body whole = FindMannequin(true, 5000);
  const RefineOptions options = WithPrimitives(64, true);
  ExpectSameBitsForAnyNumberOfThreads(whole, options);
  Listener listener;
  (void)RefineSet(whole, tighten::TargetOf(whole, options.parts), options, ThreadPool(2), listener);
  EXPECT_TRUE(std::is_sorted(listener.fractions.begin(), listener.fractions.end()));
  EXPECT_EQ(listener.fractions.back(), 1.0);
}

TEST(RefineSetTest, ToleranceLetsVerticesOutByNoMoreThanThat) {
  RefineOptions options = WithSpheresAndCapsules(24, 24, true);
  options.tolerance_m = 0.004;
  const capsule::PrimitiveSet set = Refine(CutMannequin(), options);
  const double out = FurthestVertex(CutMannequin(), set);
  EXPECT_LE(out, 0.004 + 1e-5);
  EXPECT_GT(out, 0.001);
}

TEST(RefineSetTest, ABodyCalledAsymmetricIsFittedOnBothSides) {
  body::Body body = CutMannequin();
  body.is_symmetric = false;
  const capsule::PrimitiveSet set = Refine(body, WithSpheresAndCapsules(32, 32, true));
  EXPECT_LE(FurthestVertex(body, set), 1e-5);
  for (const capsule::SphereOrigin& origin : set.origins) EXPECT_EQ(origin.mirror, -1);
}

TEST(RefineSetTest, MissingLandmarksAreMadeUpFor) {
  body::Body body = CutMannequin();
  body.landmarks = {};
  const capsule::PrimitiveSet with_chains = Refine(body, WithPrimitives(40, true));
  EXPECT_LE(FurthestVertex(body, with_chains), 1e-5);
  body.chains = {};
  const capsule::PrimitiveSet with_nothing = Refine(body, WithPrimitives(30, true));
  EXPECT_LE(FurthestVertex(body, with_nothing), 1e-5);
  EXPECT_LE(with_nothing.primitive_count(), 30);
}

TEST(RefineSetTest, OnlySelectedPartsHaveToBeInside) {
  const body::Body body = FindMannequin(true, 5000);
  RefineOptions options = WithSpheresAndCapsules(32, 32, true);
  const capsule::PrimitiveSet whole = Refine(body, options);
  EXPECT_LE(FurthestVertex(body, whole), 1e-5);
  options.parts = {};
  const capsule::PrimitiveSet set = Refine(body, options);
  const std::vector<geometry::TaperedCapsule> solids = capsule::Solids(set);
  for (std::size_t v = 0; v < body.mesh.vertices().size(); ++v) {
    if (!options.parts.Includes(body::PartOf(body.vertex_segments[v]))) continue;
    double least = 1e9;
    for (const auto& solid : solids) {
      least = std::min(least, solid.SignedDistance(body.mesh.vertices()[v]));
    }
    EXPECT_LE(least, 1e-5);
  }
}

}  // namespace
}  // namespace capfit::refine
