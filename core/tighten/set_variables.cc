#include "core/tighten/set_variables.h"

namespace capfit::tighten {

using capsule::PrimitiveSet;

SetVariables::SetVariables(PrimitiveSet& set)
    : spheres_(set.spheres.size()),
      images_(capsule::ImagesOf(set)),
      solids_(capsule::SolidEnds(set)) {
  for (int i = 0; i < static_cast<int>(set.spheres.size()); ++i) {
    const int image = images_.spheres[i];
    if (image >= 0 && image < i) {
      spheres_[i] = {of(image).first, -1.0};
      set.spheres[i] = MirrorImage(set.spheres[image]);
      continue;
    }
    spheres_[i] = {4 * orbit_count_, image == i ? 0.0 : 1.0};
    if (image == i) set.spheres[i].center_m.x() = 0.0;
    representatives_.push_back(i);
    ++orbit_count_;
  }
  FindSolidImages();
}

// Those of the capsules, which come first, and of the spheres behind them.
void SetVariables::FindSolidImages() {
  if (!is_symmetric()) return;
  const std::size_t capsules = images_.capsules.size();
  solid_images_.assign(images_.capsules.begin(), images_.capsules.end());
  std::vector<std::size_t> solid_of(spheres_.size(), 0);
  for (std::size_t k = capsules; k < solids_.size(); ++k) {
    solid_of[solids_[k][0]] = k;
  }
  for (std::size_t k = capsules; k < solids_.size(); ++k) {
    solid_images_.push_back(solid_of[image_of_sphere(solids_[k][0])]);
  }
}

void SetVariables::Apply(const Eigen::VectorXd& change, PrimitiveSet& set) const {
  for (const int sphere : representatives_) {
    const SphereVariables& variables = of(sphere);
    geometry::Sphere& target = set.spheres[sphere];
    if (variables.x_sign != 0.0) target.center_m.x() += change[variables.first];
    target.center_m.y() += change[variables.first + 1];
    target.center_m.z() += change[variables.first + 2];
    target.radius_m += change[variables.first + 3];
    const int image = images_.spheres[sphere];
    if (image > sphere) set.spheres[image] = MirrorImage(target);
  }
}

}  // namespace capfit::tighten
