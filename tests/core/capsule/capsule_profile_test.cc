#include "core/capsule/capsule_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace capfit::capsule {
namespace {

using geometry::Sphere;

// A tree of spheres of very different sizes, some far apart, some nearly swallowed.
PrimitiveSet RandomTree(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-0.3, 0.3);
  std::uniform_real_distribution<double> size(0.02, 0.15);
  PrimitiveSet set;
  for (int i = 0; i < count; ++i) {
    set.spheres.push_back({{place(random), place(random), place(random)}, size(random)});
    set.origins.push_back({});
    if (i > 0) set.capsules.push_back({static_cast<int>(random() % static_cast<unsigned>(i)), i});
  }
  return set;
}

// Signed in the lerped profile: the radius at the nearest point of the axis.
double LerpedDistance(const Sphere& a, const Sphere& b, const Eigen::Vector3d& point) {
  const Eigen::Vector3d axis = b.center_m - a.center_m;
  const double t =
      std::clamp((point - a.center_m).dot(axis) / std::max(axis.squaredNorm(), 1e-300), 0.0, 1.0);
  return (point - a.center_m - t * axis).norm() - (a.radius_m + t * (b.radius_m - a.radius_m));
}

TEST(CapsuleProfile, GrownForTheLerpedRadiusItHoldsTheHullThatItWas) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-0.5, 0.5);
  for (unsigned seed = 0; seed < 40; ++seed) {
    const PrimitiveSet before = RandomTree(seed, 12);
    PrimitiveSet grown = before;
    GrowForLerpedRadius(grown);
    int inside = 0;
    for (int i = 0; i < 4000; ++i) {
      const Eigen::Vector3d point(place(random), place(random), place(random));
      for (std::size_t k = 0; k < before.capsules.size(); ++k) {
        if (before.Capsule(k).SignedDistance(point) > 0.0) continue;
        ++inside;
        const CapsuleEnds& ends = grown.capsules[k];
        EXPECT_LE(LerpedDistance(grown.spheres[ends[0]], grown.spheres[ends[1]], point), 1e-12);
      }
    }
    EXPECT_GT(inside, 100);
  }
}

// Closed form: a cone with half angle 30 degrees reaches r / cos 30 across its axis.
TEST(CapsuleProfile, LerpedGrowthIsNoMoreThanTheConeNeeds) {
  PrimitiveSet set;
  set.spheres = {{{0, 0, 0}, 0.3}, {{0.4, 0, 0}, 0.1}};
  set.origins.resize(2);
  set.capsules = {{0, 1}};
  GrowForLerpedRadius(set);
  EXPECT_NEAR(set.spheres[0].radius_m, 0.3 / std::sqrt(0.75), 1e-12);
  EXPECT_NEAR(set.spheres[1].radius_m, 0.1 / std::sqrt(0.75), 1e-12);
}

TEST(CapsuleProfile, UniformCapsulesShareNothing) {
  PrimitiveSet set = RandomTree(3, 9);
  set.spheres.push_back({{1, 1, 1}, 0.1});  // a lone one
  set.origins.push_back({});
  const PrimitiveSet uniform = WithUniformRadii(set);
  ASSERT_EQ(uniform.capsules.size(), set.capsules.size());
  EXPECT_EQ(uniform.spheres.size(), 2 * set.capsules.size() + 1);
  EXPECT_EQ(ShapeCount(uniform), ShapeCount(set));
  std::vector<int> uses(uniform.spheres.size(), 0);
  for (std::size_t k = 0; k < uniform.capsules.size(); ++k) {
    const auto capsule = uniform.Capsule(k);
    EXPECT_EQ(capsule.a().radius_m, capsule.b().radius_m);
    EXPECT_DOUBLE_EQ(capsule.a().radius_m,
                     0.5 * (set.Capsule(k).a().radius_m + set.Capsule(k).b().radius_m));
    for (const int end : uniform.capsules[k]) ++uses[end];
  }
  EXPECT_EQ(*std::max_element(uses.begin(), uses.end()), 1);
}

TEST(CapsuleProfile, ImagesStayImages) {
  // A trunk on the mid-plane, an arm on each side, a bar between the arms' ends.
  PrimitiveSet set;
  set.spheres = {{{0, 0, 0}, 0.2},       {{0, 0.4, 0}, 0.1},  {{0.3, 0.4, 0}, 0.06},
                 {{-0.3, 0.4, 0}, 0.06}, {{0.5, 0, 0}, 0.05}, {{-0.5, 0, 0}, 0.05}};
  set.origins.resize(6);
  for (const auto& [sphere, image] : {std::pair{0, 0}, {1, 1}, {2, 3}, {3, 2}, {4, 5}, {5, 4}}) {
    set.origins[sphere].mirror = image;
  }
  set.capsules = {{0, 1}, {1, 2}, {1, 3}, {2, 3}};
  const PrimitiveSet uniform = WithUniformRadii(set);
  for (std::size_t i = 0; i < uniform.spheres.size(); ++i) {
    const int image = uniform.origins[i].mirror;
    ASSERT_GE(image, 0);
    EXPECT_EQ(uniform.origins[image].mirror, static_cast<int>(i));
    const Sphere& there = uniform.spheres[image];
    EXPECT_EQ(there.center_m.x(), -uniform.spheres[i].center_m.x());
    EXPECT_EQ(there.center_m.y(), uniform.spheres[i].center_m.y());
    EXPECT_EQ(there.radius_m, uniform.spheres[i].radius_m);
  }
}

TEST(CapsuleProfile, RaisedEndsOnlyAdd) {
  PrimitiveSet set = WithUniformRadii(RandomTree(8, 10));
  for (std::size_t i = 0; i < set.spheres.size(); i += 2) set.spheres[i].radius_m *= 1.5;
  const PrimitiveSet before = set;
  RaiseToUniformRadii(set);
  for (std::size_t k = 0; k < set.capsules.size(); ++k) {
    EXPECT_EQ(set.Capsule(k).a().radius_m, set.Capsule(k).b().radius_m);
    EXPECT_GE(set.Capsule(k).a().radius_m, before.Capsule(k).a().radius_m);
    EXPECT_GE(set.Capsule(k).b().radius_m, before.Capsule(k).b().radius_m);
  }
}

}  // namespace
}  // namespace capfit::capsule
