// Where an enclosing set is loose.
#ifndef CAPFIT_CORE_COVERAGE_GAP_VOLUME_H_
#define CAPFIT_CORE_COVERAGE_GAP_VOLUME_H_

#include <vector>

#include "core/base/thread_pool.h"
#include "core/capsule/primitive_set.h"
#include "core/coverage/cover_vertices.h"

namespace capfit::coverage {

// For each capsule of `set` about how much volume lies between it and the surface that it covers,
// in cubic metres: the depth of each vertex in the solid that it is deepest in, times a third of
// the triangles around it. What lone spheres cover is left out. O(vertices * solids near).
[[nodiscard]] std::vector<double> GapVolumes(const CoverTarget& target,
                                             const capsule::PrimitiveSet& set,
                                             const ThreadPool& pool);

}  // namespace capfit::coverage

#endif  // CAPFIT_CORE_COVERAGE_GAP_VOLUME_H_
