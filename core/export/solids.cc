#include "core/export/solids.h"

#include <utility>

namespace capfit::exports {
namespace {

std::int32_t JointOf(const std::vector<std::int32_t>& joints, std::size_t index) {
  return joints.empty() ? -1 : joints[index];
}

}  // namespace

Eigen::Isometry3d Solid::Place() const {
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  if (IsBall()) {
    place.translation() = ball().center_m;
    return place;
  }
  place.translation() = 0.5 * (hull.a().center_m + hull.b().center_m);
  place.linear() =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitY(), hull.axis()).toRotationMatrix();
  return place;
}

std::vector<Solid> SolidsOf(const ColliderSet& set) {
  const capsule::PrimitiveSet& primitives = set.primitives;
  std::vector<std::string> names = CapsuleNames(set);
  std::vector<Solid> solids;
  for (std::size_t k = 0; k < set.capsule_count(); ++k) {
    const std::size_t first = primitives.capsules[k][0];
    const std::size_t second = primitives.capsules[k][1];
    solids.push_back({std::move(names[k]),
                      JointOf(set.capsule_joints, k),
                      k,
                      {first, second},
                      primitives.Capsule(k)});
  }
  for (const std::size_t i : LoneSpheres(set)) {
    const geometry::Sphere& sphere = primitives.spheres[i];
    solids.push_back({set.sphere_names[i],
                      JointOf(set.sphere_joints, i),
                      std::nullopt,
                      {i, i},
                      geometry::TaperedCapsule(sphere, sphere)});
  }
  return solids;
}

}  // namespace capfit::exports
