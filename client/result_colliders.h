// A RESULT.json as what exports take.
#ifndef CAPFIT_CLIENT_RESULT_COLLIDERS_H_
#define CAPFIT_CLIENT_RESULT_COLLIDERS_H_

#include <string>

#include "absl/status/statusor.h"
#include "core/export/collider_set.h"

namespace capfit::client {

// `source`: see ColliderSet. A result of another program, which has spheres and capsules alone, is
// taken to be in metres with +Y up, and its spheres are called "sphere_1", "sphere_2", ...
// INVALID_ARGUMENT names the member that is wrong.
[[nodiscard]] absl::StatusOr<exports::ColliderSet> CollidersOf(const std::string& result_text,
                                                               const std::string& source);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_RESULT_COLLIDERS_H_
