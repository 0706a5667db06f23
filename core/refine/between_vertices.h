// Triangles whose corners are inside but whose middle is not.
#ifndef CAPFIT_CORE_REFINE_BETWEEN_VERTICES_H_
#define CAPFIT_CORE_REFINE_BETWEEN_VERTICES_H_

#include <vector>

#include "core/body/body.h"
#include "core/refine/capsule_graph.h"
#include "core/refine/cover_points.h"

namespace capfit::refine {

// Points inside triangles of the selected parts that stick out by more than 0.7 mm beyond
// `tolerance_m`, with what is allowed them (0.5 mm beyond it). A triangle whose corners share a
// capsule is inside (capsules are convex); the others are cut finer until each piece is certain.
// With symmetry the points are folded to x >= 0.
[[nodiscard]] std::vector<CoverPoint> StickingPoints(const body::Body& body,
                                                     const body::PartSelection& parts,
                                                     double tolerance_m, const CapsuleGraph& graph);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BETWEEN_VERTICES_H_
