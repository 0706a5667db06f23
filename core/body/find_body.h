// Landmarks and body parts from the surface alone (paper, III-A).
#ifndef CAPFIT_CORE_BODY_FIND_BODY_H_
#define CAPFIT_CORE_BODY_FIND_BODY_H_

#include <Eigen/Core>
#include <map>
#include <optional>

#include "absl/status/statusor.h"
#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/body/body.h"
#include "core/mesh/body_mesh.h"

namespace capfit::body {

enum class Unit { kAuto, kMetre, kCentimetre, kMillimetre, kInch };
enum class UpAxis { kAuto, kX, kY, kZ };

struct BodyOptions {
  Unit unit = Unit::kAuto;    // kAuto: found from the height
  UpAxis up = UpAxis::kAuto;  // kAuto: found from the body
  // Landmarks that the caller knows better, in the caller's frame. They replace the found ones.
  std::map<LandmarkId, Eigen::Vector3d> landmarks;
};

// Finds frame, landmarks, segments and medial curves of the body. Any usual pose; head, hands and
// feet may be missing. Errors: FAILED_PRECONDITION with reason NOT_A_BODY and the evidence
// ("found 0 of 5 extremities"). O(n log n).
[[nodiscard]] absl::StatusOr<Body> FindBody(const mesh::BodyMesh& mesh, const BodyOptions& options,
                                            const ThreadPool& pool, const FitObserver& observer);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_FIND_BODY_H_
