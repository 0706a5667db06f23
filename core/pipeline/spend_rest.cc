#include "core/pipeline/spend_rest.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace capfit::pipeline {
namespace {

using capsule::CapsuleEnds;
using capsule::PrimitiveSet;

// The capsule between the images of this one's ends: itself on the mid-plane; nothing where an end
// has no image or the images are not joined.
std::optional<std::size_t> MirrorOf(const PrimitiveSet& set, std::size_t index) {
  CapsuleEnds ends = set.capsules[index];
  for (int& end : ends) end = set.origins[static_cast<std::size_t>(end)].mirror;
  std::sort(ends.begin(), ends.end());
  const auto it = std::find(set.capsules.begin(), set.capsules.end(), ends);
  if (ends[0] < 0 || it == set.capsules.end()) return std::nullopt;
  return static_cast<std::size_t>(it - set.capsules.begin());
}

double SideArea(const PrimitiveSet& set, std::size_t index) {
  const geometry::TaperedCapsule capsule = set.Capsule(index);
  return capsule.length_m() * (capsule.a().radius_m + capsule.b().radius_m);
}

// Cuts one capsule; the index of the new sphere.
int Cut(std::size_t index, PrimitiveSet& set) {
  const auto [first, second] = set.capsules[index];
  const geometry::Sphere& a = set.spheres[static_cast<std::size_t>(first)];
  const geometry::Sphere& b = set.spheres[static_cast<std::size_t>(second)];
  const geometry::Sphere middle{0.5 * (a.center_m + b.center_m), 0.5 * (a.radius_m + b.radius_m)};
  capsule::SphereOrigin origin = set.origins[static_cast<std::size_t>(second)];
  origin.polygon = -1;
  origin.mirror = -1;
  const int added = static_cast<int>(set.spheres.size());
  set.spheres.push_back(middle);
  set.origins.push_back(origin);
  set.capsules[index] = {first, added};
  set.capsules.push_back({second, added});
  return added;
}

void CutWithImage(std::size_t index, std::optional<std::size_t> image, PrimitiveSet& set) {
  const int added = Cut(index, set);
  auto& origin = set.origins[static_cast<std::size_t>(added)];
  if (!image.has_value()) return;
  if (*image == index) {
    origin.mirror = added;
    return;
  }
  origin.mirror = Cut(*image, set);
  set.origins.back().mirror = added;
  set.origins.back().part = body::MirrorPart(set.origins[static_cast<std::size_t>(added)].part);
}

}  // namespace

void SpendRest(const capsule::Budget& budget, PrimitiveSet& set) {
  constexpr double kShareOfHalf = 0.25;
  std::vector<double> promise;
  for (std::size_t i = 0; i < set.capsules.size(); ++i) promise.push_back(SideArea(set, i));
  for (;;) {
    const int cuts = budget.Without(set.count()).Cuts();
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < set.capsules.size(); ++i) {
      const std::optional<std::size_t> image = MirrorOf(set, i);
      const int cost = image.has_value() && *image != i ? 2 : 1;
      if (cost > cuts) continue;
      if (!best.has_value() || promise[i] > promise[*best]) best = i;
    }
    if (!best.has_value()) return;
    const std::optional<std::size_t> image = MirrorOf(set, *best);
    const bool is_pair = image.has_value() && *image != *best;
    const double half = kShareOfHalf * promise[*best];
    CutWithImage(*best, image, set);
    promise[*best] = half;
    if (is_pair) promise[*image] = half;
    promise.resize(set.capsules.size(), half);
  }
}

}  // namespace capfit::pipeline
