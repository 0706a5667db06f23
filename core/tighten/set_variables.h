// The numbers that tightening and growing may turn: centres and radii, mirrored spheres as one.
#ifndef CAPFIT_CORE_TIGHTEN_SET_VARIABLES_H_
#define CAPFIT_CORE_TIGHTEN_SET_VARIABLES_H_

#include <Eigen/Core>
#include <vector>

#include "core/capsule/primitive_set.h"

namespace capfit::tighten {

// How a sphere hangs on the variables: four of them (x, y, z, radius) from `first` on. The image of
// a mirrored pair sees x with the other sign; on the mid-plane x is fixed at 0.
struct SphereVariables {
  int first = 0;
  double x_sign = 1.0;  // -1 for the image, 0 on the mid-plane
};

// The layout of the variables of a set: a flat view of it, good until its topology changes.
class SetVariables {
 public:
  // Makes mirrored spheres exact images and centred ones exactly centred, should they not be.
  explicit SetVariables(capsule::PrimitiveSet& set);

  [[nodiscard]] int count() const { return 4 * orbit_count_; }
  [[nodiscard]] const SphereVariables& of(int sphere) const { return spheres_[sphere]; }
  // capsule::SolidEnds of the set.
  [[nodiscard]] const std::vector<capsule::CapsuleEnds>& solids() const { return solids_; }
  // One sphere of each group of four variables, the one that sees x with its own sign.
  [[nodiscard]] const std::vector<int>& representatives() const { return representatives_; }

  // Whether the whole set is its own mirror image. Then every sphere and solid has an image, itself
  // on the mid-plane; otherwise each counts as its own.
  [[nodiscard]] bool is_symmetric() const { return images_.is_whole; }
  [[nodiscard]] std::size_t image_of_sphere(std::size_t sphere) const {
    if (!is_symmetric()) return sphere;
    return images_.spheres[sphere];
  }
  [[nodiscard]] std::size_t image_of_solid(std::size_t solid) const {
    return is_symmetric() ? solid_images_[solid] : solid;
  }

  // Change of the variables' values for a change (x, y, z, radius) of `sphere` alone: what a
  // gradient by the sphere contributes to the gradient by the variables.
  [[nodiscard]] Eigen::Vector4d ToVariables(int sphere, const Eigen::Vector4d& gradient) const {
    return {of(sphere).x_sign * gradient.x(), gradient.y(), gradient.z(), gradient.w()};
  }

  // Adds `change` (metres) to the centres and radii. Images stay exact, bit by bit.
  void Apply(const Eigen::VectorXd& change, capsule::PrimitiveSet& set) const;

 private:
  void FindSolidImages();

  std::vector<SphereVariables> spheres_;
  capsule::Images images_;
  std::vector<int> representatives_;
  std::vector<capsule::CapsuleEnds> solids_;
  std::vector<std::size_t> solid_images_;
  int orbit_count_ = 0;
};

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_SET_VARIABLES_H_
