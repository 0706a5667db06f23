#include "core/capsule/mirrored_set.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/random.h"
#include "core/capsule/cut_capsules.h"
#include "tests/core/capsule/mirrored.h"

namespace capfit::capsule {
namespace {

// Two mid-plane spheres, a hip and a foot on each side.
MirroredSet Legs(bool is_mirrored) {
  MirroredSet set(is_mirrored);
  const int chest = set.AddSphere({{0.0, 1.2, 0.01}, 0.12}, true);
  const int belly = set.AddSphere({{0.0, 1.0, 0.02}, 0.10}, true);
  const int hip = set.AddSphere({{0.08, 0.85, 0.0}, 0.09}, false, body::Part::kLeftLeg);
  const int foot = set.AddSphere({{0.12, 0.2, 0.03}, 0.05}, false, body::Part::kLeftLeg);
  set.AddCapsule(chest, belly);
  set.AddCapsule(belly, hip);
  set.AddCapsule(hip, foot);
  return set;
}

bool AreDistinct(const std::vector<CapsuleEnds>& capsules) {
  for (std::size_t i = 0; i < capsules.size(); ++i) {
    if (std::count(capsules.begin(), capsules.end(), capsules[i]) != 1) return false;
  }
  return true;
}

double UnionDistance(const PrimitiveSet& set, const Eigen::Vector3d& point) {
  double least = 1e9;
  for (const auto& solid : Solids(set)) least = std::min(least, solid.SignedDistance(point));
  return least;
}

TEST(MirroredSetTest, MirrorsWhatIsAdded) {
  const MirroredSet set = Legs(true);
  EXPECT_EQ(set.sphere_count(), 6);
  EXPECT_EQ(set.capsule_count(), 5);
  EXPECT_EQ(set.primitive_count(), 11);
  EXPECT_TRUE(IsExactlyMirrored(set));
  EXPECT_EQ(set.set().origins[3].part, body::Part::kRightLeg);
}

TEST(MirroredSetTest, WithoutMirroringNothingIsAnImage) {
  const MirroredSet set = Legs(false);
  EXPECT_EQ(set.sphere_count(), 4);
  EXPECT_EQ(set.capsule_count(), 3);
  for (int v = 0; v < 4; ++v) {
    EXPECT_TRUE(set.IsRepresentative(v));
    EXPECT_FALSE(set.IsOnPlane(v));
  }
}

TEST(MirroredSetTest, ACapsuleAcrossThePlaneIsItsOwnImage) {
  MirroredSet set = Legs(true);
  set.AddCapsule(2, 3);  // hip to hip
  EXPECT_EQ(set.capsule_count(), 6);
  EXPECT_EQ(set.ImageOfCapsule(5), 5);
  set.AddCapsule(3, 2);
  EXPECT_EQ(set.capsule_count(), 6) << "what is there is not added again";
  EXPECT_EQ(set.Cut(5), 6);
  EXPECT_TRUE(set.IsOnPlane(6));
  EXPECT_TRUE(IsExactlyMirrored(set));
}

TEST(MirroredSetTest, RemovesWithTheImage) {
  MirroredSet set = Legs(true);
  set.RemoveCapsule(1);
  EXPECT_EQ(set.capsule_count(), 3);
  EXPECT_TRUE(IsExactlyMirrored(set));
  std::vector<char> removed(6, 0);
  removed[4] = 1;  // the left foot
  EXPECT_EQ(set.RemoveSpheres(removed), (std::vector<int>{0, 1, 2, 3, -1, -1}));
  EXPECT_EQ(set.capsule_count(), 1);
  EXPECT_TRUE(IsExactlyMirrored(set));
}

TEST(MirroredSetTest, CopyToImagesMakesItExact) {
  MirroredSet set = Legs(true);
  set.sphere(2).center_m += Eigen::Vector3d(0.01, 0.02, 0.03);
  set.sphere(0).center_m.x() = 0.5;
  EXPECT_FALSE(IsExactlyMirrored(set));
  set.CopyToImages();
  EXPECT_TRUE(IsExactlyMirrored(set));
}

TEST(MirroredSetTest, OfAFinishedSetPairsAreMadeExactAndOthersLeftAlone) {
  PrimitiveSet finished = Legs(true).set();
  finished.spheres[3].radius_m += 1e-3;  // image of 2
  finished.origins[4].mirror = -1;       // 5 still names 4
  const MirroredSet set(finished, true);
  EXPECT_EQ(set.sphere(3).radius_m, set.sphere(2).radius_m);
  EXPECT_EQ(set.ImageOf(4), 4);
  EXPECT_EQ(set.ImageOf(5), 5);
  EXPECT_FALSE(set.IsOnPlane(4));
  MirroredSet cut = set;
  const int count = cut.sphere_count();
  cut.Cut(3);  // a thigh without an image
  EXPECT_EQ(cut.sphere_count(), count + 1);
  EXPECT_EQ(cut.set().origins.back().mirror, -1);
}

TEST(MirroredSetTest, OriginsStayWhereNothingIsMirrored) {
  const PrimitiveSet finished = Legs(true).set();
  MirroredSet set(finished, false);
  set.Cut(0);
  EXPECT_EQ(set.sphere_count(), 7);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(set.set().origins[i].mirror, finished.origins[i].mirror);
  }
}

// Whatever is done to it in whatever order.
TEST(MirroredSetTest, RandomEditsKeepItSound) {
  Random random(5);
  MirroredSet set = Legs(true);
  for (int step = 0; step < 400; ++step) {
    const int v = static_cast<int>(random.NextBelow(set.sphere_count()));
    const int w = static_cast<int>(random.NextBelow(set.sphere_count()));
    const int capsules = set.capsule_count();
    const int e = capsules == 0 ? -1 : static_cast<int>(random.NextBelow(capsules));
    switch (random.NextBelow(8)) {
      case 0:
        set.AddSphere({{random.NextIn(0.1, 0.5), random.NextIn(0.0, 1.0), 0.0}, 0.1}, v % 2 == 0);
        break;
      case 1:
        if (e >= 0) set.RemoveCapsule(e);
        break;
      case 2:
        if (e >= 0) set.Cut(e);
        break;
      case 3:
        if (set.IsOnPlane(v)) set.PartFromPlane(v, 0.02);
        break;
      case 7:
        if (set.ImageOf(v) != v) set.JoinOnPlane(v);
        break;
      case 4:
        if (set.sphere_count() > 12) {
          std::vector<char> removed(set.spheres().size(), 0);
          removed[v] = 1;
          set.RemoveSpheres(removed);
        }
        break;
      default:
        set.AddCapsule(v, w);
    }
    ASSERT_TRUE(IsExactlyMirrored(set)) << step;
    ASSERT_TRUE(AreDistinct(set.capsules())) << step;
    ASSERT_EQ(set.set().origins.size(), set.spheres().size());
  }
}

TEST(MirroredSetTest, JoiningAPairKeepsWhatHungOnIt) {
  MirroredSet set(true);
  const int pair = set.AddSphere({{0.01, 1.0, 0.0}, 0.1}, false);
  const int top = set.AddSphere({{0.0, 1.4, 0.0}, 0.1}, true);
  const int hip = set.AddSphere({{0.1, 0.8, 0.0}, 0.1}, false);
  set.AddCapsule(pair, set.ImageOf(pair));
  set.AddCapsule(pair, top);
  set.AddCapsule(pair, hip);
  set.AddCapsule(pair, set.ImageOf(hip));
  ASSERT_EQ(set.capsule_count(), 7);
  EXPECT_EQ(set.JoinOnPlane(pair), (std::vector<int>{0, -1, 1, 2, 3}));
  EXPECT_TRUE(set.IsOnPlane(0));
  EXPECT_EQ(set.sphere(0).center_m.x(), 0.0);
  EXPECT_EQ(set.NeighboursOf(0).size(), 3u);
  EXPECT_EQ(set.capsule_count(), 3);
  EXPECT_TRUE(IsExactlyMirrored(set));
}

TEST(MirroredSetTest, CuttingChangesNoShape) {
  const MirroredSet before = Legs(true);
  MirroredSet after = before;
  CutWorthiest({kNoLimit, 14, kNoLimit}, OutlineAreas(after), QuarterOfWhole, after);
  EXPECT_EQ(after.sphere_count(), 14);
  EXPECT_TRUE(IsExactlyMirrored(after));
  Random random(6);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d p(random.NextIn(-0.4, 0.4), random.NextIn(0, 1.4),
                            random.NextIn(-0.2, 0.2));
    EXPECT_NEAR(UnionDistance(after.set(), p), UnionDistance(before.set(), p), 1e-12);
  }
}

}  // namespace
}  // namespace capfit::capsule
