#include "core/capsule/capsule_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace capfit::capsule {
namespace {

constexpr double kMaxLerpedSin = 0.5;

// The copy of a capsule's end is at 2 * capsule + side; copies of lone spheres follow.
class OwnEnds {
 public:
  explicit OwnEnds(const PrimitiveSet& set) : set_(set), images_(ImagesOf(set)) {
    const std::vector<bool> is_used = UsedSpheres(set);
    for (std::size_t i = 0; i < is_used.size(); ++i) {
      if (!is_used[i]) lone_.push_back(static_cast<int>(i));
    }
  }

  PrimitiveSet Copy() const {
    PrimitiveSet copy;
    for (std::size_t k = 0; k < set_.capsules.size(); ++k) {
      for (const int side : {0, 1}) Add(set_.capsules[k][side], ImageOf(k, side), copy);
      copy.capsules.push_back({static_cast<int>(2 * k), static_cast<int>(2 * k + 1)});
    }
    for (const int sphere : lone_) Add(sphere, ImageOfLone(sphere), copy);
    return copy;
  }

 private:
  void Add(int sphere, int image, PrimitiveSet& copy) const {
    copy.spheres.push_back(set_.spheres[sphere]);
    copy.origins.push_back(set_.origins[sphere]);
    copy.origins.back().mirror = image;
  }

  int ImageOf(std::size_t capsule, int side) const {
    const int image = images_.capsules[capsule];
    if (image < 0) return -1;
    const int end = images_.spheres[set_.capsules[capsule][side]];
    return 2 * image + (set_.capsules[image][0] == end ? 0 : 1);
  }

  int ImageOfLone(int sphere) const {
    const auto found = std::find(lone_.begin(), lone_.end(), images_.spheres[sphere]);
    if (found == lone_.end()) return -1;
    return static_cast<int>(2 * set_.capsules.size()) + static_cast<int>(found - lone_.begin());
  }

  const PrimitiveSet& set_;
  Images images_;
  std::vector<int> lone_;
};

}  // namespace

PrimitiveSet WithUniformRadii(const PrimitiveSet& set) {
  PrimitiveSet copy = OwnEnds(set).Copy();
  for (const CapsuleEnds& ends : copy.capsules) {
    double& a = copy.spheres[ends[0]].radius_m;
    double& b = copy.spheres[ends[1]].radius_m;
    a = b = 0.5 * (a + b);
  }
  return copy;
}

void RaiseToUniformRadii(PrimitiveSet& set) {
  for (const CapsuleEnds& ends : set.capsules) {
    double& a = set.spheres[ends[0]].radius_m;
    double& b = set.spheres[ends[1]].radius_m;
    a = b = std::max(a, b);
  }
}

void GrowForLerpedRadius(PrimitiveSet& set) {
  // Raising one end may steepen a neighbour, by less each time: radii only move towards the
  // largest.
  for (bool changed = true; changed;) {
    changed = false;
    for (const CapsuleEnds& ends : set.capsules) {
      geometry::Sphere& a = set.spheres[ends[0]];
      geometry::Sphere& b = set.spheres[ends[1]];
      geometry::Sphere& smaller = a.radius_m < b.radius_m ? a : b;
      const double least =
          std::max(a.radius_m, b.radius_m) - kMaxLerpedSin * (a.center_m - b.center_m).norm();
      if (smaller.radius_m >= least) continue;
      smaller.radius_m = least;
      changed = true;
    }
  }
  std::vector<double> factors(set.spheres.size(), 1.0);
  for (std::size_t k = 0; k < set.capsules.size(); ++k) {
    const double factor = 1.0 / set.Capsule(k).cos_half_angle();
    for (const int end : set.capsules[k]) factors[end] = std::max(factors[end], factor);
  }
  for (std::size_t i = 0; i < factors.size(); ++i) set.spheres[i].radius_m *= factors[i];
}

int ShapeCount(const PrimitiveSet& set) {
  const std::vector<bool> is_used = UsedSpheres(set);
  return static_cast<int>(set.capsules.size()) +
         static_cast<int>(std::count(is_used.begin(), is_used.end(), false));
}

}  // namespace capfit::capsule
