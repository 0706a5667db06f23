// A fitted body as a collider set, with joints chosen by where they lie: for tests of exports.
#ifndef CAPFIT_TESTS_READERS_SAMPLE_SET_H_
#define CAPFIT_TESTS_READERS_SAMPLE_SET_H_

#include <nlohmann/json.hpp>
#include <string>

#include "absl/status/statusor.h"
#include "core/export/collider_set.h"
#include "core/pipeline/fit.h"

namespace capfit::readers {

// Fits the file's bytes. Each sphere hangs on the joint whose bone (from it to a joint below it) is
// nearest to its centre, each capsule on the one nearest to its middle; without a rig on none.
[[nodiscard]] absl::StatusOr<exports::ColliderSet> SampleSet(const std::string& bytes,
                                                             const std::string& source,
                                                             const pipeline::FitOptions& options);

// What readers of the files compare with. In the mesh's own frame and unit:
//   spheres   name, center [x, y, z], radius, joint (-1: none), lone (no capsule uses it)
//   capsules  name, spheres [a, b], joint
//   joints    name, parent, node, to_mesh (three rows of four)
// and `upright_from_mesh`, the same three rows of four, which leads to the frame of frame.h
// (metres, +Y up): radii there are times `metres_per_unit`.
[[nodiscard]] nlohmann::json Expected(const exports::ColliderSet& set);

}  // namespace capfit::readers

#endif  // CAPFIT_TESTS_READERS_SAMPLE_SET_H_
