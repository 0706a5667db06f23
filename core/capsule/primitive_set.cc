#include "core/capsule/primitive_set.h"

#include <algorithm>
#include <utility>

namespace capfit::capsule {
namespace {

using IndexByEnds = std::vector<std::pair<CapsuleEnds, int>>;

CapsuleEnds InOrder(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

IndexByEnds SortedByEnds(const std::vector<CapsuleEnds>& capsules) {
  IndexByEnds by_ends;
  for (const CapsuleEnds& ends : capsules) {
    by_ends.emplace_back(InOrder(ends[0], ends[1]), static_cast<int>(by_ends.size()));
  }
  std::sort(by_ends.begin(), by_ends.end());
  return by_ends;
}

int Find(const IndexByEnds& by_ends, const CapsuleEnds& ends) {
  const auto found = std::lower_bound(
      by_ends.begin(), by_ends.end(), ends,
      [](const auto& entry, const CapsuleEnds& wanted) { return entry.first < wanted; });
  return found == by_ends.end() || found->first != ends ? -1 : found->second;
}

std::vector<int> SphereImages(const std::vector<SphereOrigin>& origins) {
  std::vector<int> images(origins.size(), -1);
  for (std::size_t i = 0; i < origins.size(); ++i) {
    const int image = origins[i].mirror;
    if (image < 0 || std::cmp_greater_equal(image, origins.size())) continue;
    if (std::cmp_equal(origins[image].mirror, i)) images[i] = image;
  }
  return images;
}

bool HasAll(const std::vector<int>& images) {
  return std::find(images.begin(), images.end(), -1) == images.end();
}

}  // namespace

Images ImagesOf(const PrimitiveSet& set) {
  Images images{SphereImages(set.origins), std::vector<int>(set.capsules.size(), -1), false};
  const IndexByEnds by_ends = SortedByEnds(set.capsules);
  for (std::size_t k = 0; k < set.capsules.size(); ++k) {
    const int a = images.spheres[set.capsules[k][0]];
    const int b = images.spheres[set.capsules[k][1]];
    if (a >= 0 && b >= 0) images.capsules[k] = Find(by_ends, InOrder(a, b));
  }
  images.is_whole = HasAll(images.spheres) && HasAll(images.capsules);
  return images;
}

body::Part PartOfCapsule(const PrimitiveSet& set, std::size_t index) {
  const auto [first, second] = set.capsules[index];
  return std::max(set.origins[first].part, set.origins[second].part);
}

std::vector<bool> UsedSpheres(const PrimitiveSet& set) {
  std::vector<bool> is_used(set.spheres.size(), false);
  for (const CapsuleEnds& ends : set.capsules) {
    for (const int end : ends) is_used[end] = true;
  }
  return is_used;
}

std::vector<CapsuleEnds> SolidEnds(const PrimitiveSet& set) {
  std::vector<CapsuleEnds> solids = set.capsules;
  const std::vector<bool> is_used = UsedSpheres(set);
  for (int i = 0; i < static_cast<int>(set.spheres.size()); ++i) {
    if (!is_used[i]) solids.push_back({i, i});
  }
  return solids;
}

std::vector<geometry::TaperedCapsule> Solids(const PrimitiveSet& set) {
  std::vector<geometry::TaperedCapsule> solids;
  solids.reserve(set.capsules.size() + set.spheres.size());
  for (const auto& [a, b] : SolidEnds(set)) {
    solids.emplace_back(set.spheres[a], set.spheres[b]);
  }
  return solids;
}

}  // namespace capfit::capsule
