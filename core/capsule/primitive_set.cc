#include "core/capsule/primitive_set.h"

#include <algorithm>

namespace capfit::capsule {

body::Part PartOfCapsule(const PrimitiveSet& set, std::size_t index) {
  const auto [first, second] = set.capsules[index];
  return std::max(set.origins[static_cast<std::size_t>(first)].part,
                  set.origins[static_cast<std::size_t>(second)].part);
}

std::vector<geometry::TaperedCapsule> Solids(const PrimitiveSet& set) {
  std::vector<geometry::TaperedCapsule> solids;
  solids.reserve(set.capsules.size() + set.spheres.size());
  std::vector<bool> is_used(set.spheres.size(), false);
  for (std::size_t i = 0; i < set.capsules.size(); ++i) {
    solids.push_back(set.Capsule(i));
    for (const int end : set.capsules[i]) is_used[static_cast<std::size_t>(end)] = true;
  }
  for (std::size_t i = 0; i < set.spheres.size(); ++i) {
    if (!is_used[i]) solids.emplace_back(set.spheres[i], set.spheres[i]);
  }
  return solids;
}

}  // namespace capfit::capsule
