// A fitted body as a collider set, and what readers of its exports must find: for tests of exports.
#ifndef CAPFIT_TESTS_READERS_SAMPLE_SET_H_
#define CAPFIT_TESTS_READERS_SAMPLE_SET_H_

#include <nlohmann/json.hpp>
#include <string>

#include "absl/status/statusor.h"
#include "core/export/collider_set.h"
#include "core/pipeline/fit.h"

namespace capfit::readers {

// Fits the file's bytes. Joints are those that the result names; without a rig there are none.
[[nodiscard]] absl::StatusOr<exports::ColliderSet> SampleSet(const std::string& bytes,
                                                             const std::string& source,
                                                             const pipeline::FitOptions& options);

// What readers of the files compare with. In the mesh's own frame and unit:
//   spheres   name, center [x, y, z], radius, joint (-1: none), lone (no capsule uses it)
//   capsules  name, spheres [a, b], joint
//   joints    name, parent, node, to_mesh (three rows of four)
// In a pose that turns every joint about its own place, and with it all that hangs below:
//   joints    posed (to_mesh, then), moved_upright (position and rotation x, y, z, w: the joint's
//             movement since rest, in the frame below)
//   spheres   posed_center; capsules posed_centers: where `animate --one-joint` has them
// and `upright_from_mesh`, the same three rows of four, which leads to the frame of frame.h
// (metres, +Y up): radii there are times `metres_per_unit`.
[[nodiscard]] nlohmann::json Expected(const exports::ColliderSet& set);

}  // namespace capfit::readers

#endif  // CAPFIT_TESTS_READERS_SAMPLE_SET_H_
