#include "core/tighten/set_variables.h"

#include <algorithm>
#include <utility>

namespace capfit::tighten {
namespace {

using capsule::PrimitiveSet;

// The image of a sphere, or -1 where the indices do not agree.
int ImageOf(const PrimitiveSet& set, int sphere) {
  const int count = static_cast<int>(set.spheres.size());
  const int image = set.origins[static_cast<std::size_t>(sphere)].mirror;
  if (image < 0 || image >= count) return -1;
  return set.origins[static_cast<std::size_t>(image)].mirror == sphere ? image : -1;
}

void MirrorOnto(int from, int to, PrimitiveSet& set) {
  geometry::Sphere image = set.spheres[static_cast<std::size_t>(from)];
  image.center_m.x() = -image.center_m.x();
  set.spheres[static_cast<std::size_t>(to)] = image;
}

std::vector<Solid> SolidsOf(const PrimitiveSet& set) {
  std::vector<Solid> solids;
  std::vector<bool> is_used(set.spheres.size(), false);
  for (const capsule::CapsuleEnds& ends : set.capsules) {
    solids.push_back({ends});
    for (const int end : ends) is_used[static_cast<std::size_t>(end)] = true;
  }
  for (int i = 0; i < static_cast<int>(set.spheres.size()); ++i) {
    if (!is_used[static_cast<std::size_t>(i)]) solids.push_back({{i, i}});
  }
  return solids;
}

}  // namespace

SetVariables::SetVariables(PrimitiveSet& set)
    : spheres_(set.spheres.size()), images_(set.spheres.size(), -1), solids_(SolidsOf(set)) {
  for (int i = 0; i < static_cast<int>(set.spheres.size()); ++i) {
    const auto index = static_cast<std::size_t>(i);
    images_[index] = ImageOf(set, i);
    if (images_[index] >= 0 && images_[index] < i) {
      spheres_[index] = {of(images_[index]).first, -1.0};
      MirrorOnto(images_[index], i, set);
      continue;
    }
    const bool is_centred = images_[index] == i;
    spheres_[index] = {4 * orbit_count_, is_centred ? 0.0 : 1.0};
    if (is_centred) set.spheres[index].center_m.x() = 0.0;
    representatives_.push_back(i);
    ++orbit_count_;
  }
  is_symmetric_ = FindSolidImages();
}

// Whether every sphere and every solid has one.
bool SetVariables::FindSolidImages() {
  if (std::find(images_.begin(), images_.end(), -1) != images_.end()) return false;
  std::vector<std::pair<std::array<int, 2>, std::size_t>> by_ends;
  for (std::size_t k = 0; k < solids_.size(); ++k) {
    const auto [low, high] = std::minmax(solids_[k].ends[0], solids_[k].ends[1]);
    by_ends.push_back({{low, high}, k});
  }
  std::sort(by_ends.begin(), by_ends.end());
  solid_images_.resize(solids_.size());
  for (std::size_t k = 0; k < solids_.size(); ++k) {
    const auto [low, high] = std::minmax(images_[static_cast<std::size_t>(solids_[k].ends[0])],
                                         images_[static_cast<std::size_t>(solids_[k].ends[1])]);
    const std::array<int, 2> ends = {low, high};
    const auto found = std::lower_bound(
        by_ends.begin(), by_ends.end(), ends,
        [](const auto& entry, const std::array<int, 2>& key) { return entry.first < key; });
    if (found == by_ends.end() || found->first != ends) return false;
    solid_images_[k] = found->second;
  }
  return true;
}

void SetVariables::Apply(const Eigen::VectorXd& change, PrimitiveSet& set) const {
  for (const int sphere : representatives_) {
    const SphereVariables& variables = of(sphere);
    geometry::Sphere& target = set.spheres[static_cast<std::size_t>(sphere)];
    if (variables.x_sign != 0.0) target.center_m.x() += change[variables.first];
    target.center_m.y() += change[variables.first + 1];
    target.center_m.z() += change[variables.first + 2];
    target.radius_m += change[variables.first + 3];
    const int image = images_[static_cast<std::size_t>(sphere)];
    if (image > sphere) MirrorOnto(sphere, image, set);
  }
}

std::vector<geometry::TaperedCapsule> ShapesOf(const std::vector<Solid>& solids,
                                               const PrimitiveSet& set) {
  std::vector<geometry::TaperedCapsule> shapes;
  shapes.reserve(solids.size());
  for (const Solid& solid : solids) {
    shapes.emplace_back(set.spheres[static_cast<std::size_t>(solid.ends[0])],
                        set.spheres[static_cast<std::size_t>(solid.ends[1])]);
  }
  return shapes;
}

}  // namespace capfit::tighten
