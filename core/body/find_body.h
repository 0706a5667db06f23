// Landmarks and body parts from the surface alone (paper, III-A).
#ifndef CAPFIT_CORE_BODY_FIND_BODY_H_
#define CAPFIT_CORE_BODY_FIND_BODY_H_

#include <Eigen/Core>
#include <map>
#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/body/body.h"
#include "core/formats/polygon_soup.h"
#include "core/mesh/body_mesh.h"

namespace capfit::body {

enum class Unit { kAuto, kMetre, kCentimetre, kMillimetre, kInch };
enum class UpAxis { kAuto, kX, kY, kZ };

struct BodyOptions {
  // kAuto: found from the height. One that makes no human body of it is refused, an odd one is
  // taken (warning UNIT_CONTRADICTS_BODY).
  Unit unit = Unit::kAuto;
  // kAuto: found from the body. Taken within 5 degrees of the body's own; a body that leans by
  // more stands along its own. From 45 degrees on that is a warning UP_AXIS_CONTRADICTS_BODY; one
  // that is upside down is refused.
  UpAxis up = UpAxis::kAuto;
  // Landmarks that the caller knows better, in the caller's frame. They replace the found ones. One
  // that lies off the body or far from where the body shows it is refused: INVALID_ARGUMENT with
  // the field "landmarks.NAME".
  std::map<LandmarkId, Eigen::Vector3d> landmarks;
  // Joints of a skeleton that came with the mesh, in the caller's frame (see skeleton_names.h).
  // They replace the found ones that the caller does not give, but for those that contradict the
  // surface (see told_landmarks.h): warning SKELETON_IGNORED. A skeleton that lies in the body also
  // says which tips are head, hands and feet (see extremities.h), and which side is the left.
  std::vector<formats::NamedJoint> skeleton;
  // Parts that must be there, none unless asked for: else FAILED_PRECONDITION with reason
  // PART_MISSING. Both sides of a pair are meant.
  PartSelection required = {false, false, false, false, false, false};
};

// Finds frame, landmarks, segments and medial curves of the body. Any usual pose; head, hands and
// feet, an arm or both, and the legs may be missing (a warning PART_MISSING each), as long as three
// of head, arms and legs are there. Errors: FAILED_PRECONDITION with reason NOT_A_BODY and the
// evidence ("found 0 of 5 extremities"), PART_MISSING;
// INVALID_ARGUMENT with reason CONTRADICTS_BODY for a unit, axis or landmark told. O(n log n).
[[nodiscard]] absl::StatusOr<Body> FindBody(const mesh::BodyMesh& mesh, const BodyOptions& options,
                                            const ThreadPool& pool, const FitObserver& observer);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_FIND_BODY_H_
