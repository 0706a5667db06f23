#include "core/export/collider_set.h"

#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::exports {
namespace {

absl::Status CheckSize(const std::string& field, std::size_t size, std::size_t must_be) {
  if (size == must_be) return absl::OkStatus();
  return InvalidField(ErrorReason::kCountMismatch, field,
                      absl::StrCat("has ", size, " entries, must have ", must_be));
}

absl::Status CheckIndices(const std::string& field, const std::vector<std::int32_t>& indices,
                          std::size_t end) {
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] < 0 || std::cmp_greater_equal(indices[i], end)) {
      return IndexOutOfRange(absl::StrCat(field, "[", i, "]"), indices[i], end);
    }
  }
  return absl::OkStatus();
}

absl::Status CheckSphere(const geometry::Sphere& sphere, std::size_t index) {
  if (!sphere.center_m.allFinite() || !std::isfinite(sphere.radius_m)) {
    return InvalidField(ErrorReason::kNotFinite, absl::StrCat("spheres[", index, "]"),
                        "must be finite");
  }
  if (sphere.radius_m > 0.0) return absl::OkStatus();
  return InvalidField(ErrorReason::kOutOfRange, absl::StrCat("spheres[", index, "].radius"),
                      absl::StrCat("is ", sphere.radius_m, ", must be above 0"));
}

absl::Status CheckCapsule(const capsule::CapsuleEnds& ends, std::size_t index,
                          std::size_t sphere_count) {
  CAPFIT_RETURN_IF_ERROR(
      CheckIndices(absl::StrCat("capsules[", index, "]"), {ends[0], ends[1]}, sphere_count));
  if (ends[0] < ends[1]) return absl::OkStatus();
  return InvalidField(
      ErrorReason::kOutOfRange, absl::StrCat("capsules[", index, "][0]"),
      absl::StrCat("is ", ends[0], ", must be below ", ends[1], ", its second sphere"));
}

absl::Status CheckJoints(const ColliderSet& set) {
  for (std::size_t j = 0; j < set.joints.size(); ++j) {
    const formats::NamedJoint& joint = set.joints[j];
    if (!joint.to_mesh.allFinite()) {
      return InvalidField(ErrorReason::kNotFinite, absl::StrCat("joints[", j, "]"),
                          "must be finite");
    }
    if (joint.parent < -1 || joint.parent >= static_cast<std::int32_t>(set.joints.size())) {
      return IndexOutOfRange(absl::StrCat("joints[", j, "].parent"), joint.parent,
                             set.joints.size());
    }
  }
  CAPFIT_RETURN_IF_ERROR(CheckIndices("sphere_joints", set.sphere_joints, set.joints.size()));
  CAPFIT_RETURN_IF_ERROR(CheckIndices("capsule_joints", set.capsule_joints, set.joints.size()));
  const bool is_hung = !set.sphere_joints.empty();
  CAPFIT_RETURN_IF_ERROR(
      CheckSize("sphere_joints", set.sphere_joints.size(), is_hung ? set.sphere_count() : 0));
  return CheckSize("capsule_joints", set.capsule_joints.size(), is_hung ? set.capsule_count() : 0);
}

}  // namespace

absl::Status CheckColliderSet(const ColliderSet& set) {
  const std::size_t count = set.sphere_count();
  CAPFIT_RETURN_IF_ERROR(CheckSize("origins", set.primitives.origins.size(), count));
  CAPFIT_RETURN_IF_ERROR(CheckSize("sphere_names", set.sphere_names.size(), count));
  for (std::size_t i = 0; i < count; ++i) {
    CAPFIT_RETURN_IF_ERROR(CheckSphere(set.primitives.spheres[i], i));
  }
  for (std::size_t i = 0; i < set.capsule_count(); ++i) {
    CAPFIT_RETURN_IF_ERROR(CheckCapsule(set.primitives.capsules[i], i, count));
  }
  return CheckJoints(set);
}

std::vector<std::string> CapsuleNames(const ColliderSet& set) {
  std::vector<std::string> names;
  names.reserve(set.capsule_count());
  for (const capsule::CapsuleEnds& ends : set.primitives.capsules) {
    names.push_back(absl::StrCat(set.sphere_names[ends[0]], "__", set.sphere_names[ends[1]]));
  }
  return names;
}

std::vector<std::size_t> LoneSpheres(const ColliderSet& set) {
  std::vector<char> is_used(set.sphere_count(), 0);
  for (const capsule::CapsuleEnds& ends : set.primitives.capsules) {
    for (const int end : ends) is_used[end] = 1;
  }
  std::vector<std::size_t> lone;
  for (std::size_t i = 0; i < is_used.size(); ++i) {
    if (is_used[i] == 0) lone.push_back(i);
  }
  return lone;
}

}  // namespace capfit::exports
