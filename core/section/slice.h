// Plane and mesh: the closed outlines of a cross section.
#ifndef CAPFIT_CORE_SECTION_SLICE_H_
#define CAPFIT_CORE_SECTION_SLICE_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/geometry/plane_frame.h"
#include "core/mesh/body_mesh.h"
#include "core/section/polygon.h"

namespace capfit::section {

// Cuts the triangles of `mesh` that `triangle_indices` names with the plane of `frame`. Cut edges
// are joined through the mesh's own edges, exactly; where the named triangles end (an armhole,
// say), the open ends are joined straight to the nearest fitting one, so that every outline is
// closed. Outlines are counter-clockwise where the surface's normals point outward; those of no
// area are left out. A vertex on the plane counts as above it. Largest area first; O(triangles).
[[nodiscard]] std::vector<Polygon> SliceTriangles(const mesh::BodyMesh& mesh,
                                                  std::span<const int> triangle_indices,
                                                  const geometry::PlaneFrame& frame);

// `count` points at equal distances along the outline, the first at the outline's first vertex.
[[nodiscard]] std::vector<Eigen::Vector2d> ResampleClosed(
    std::span<const Eigen::Vector2d> outline_m, int count);

// `count` points at equal distances along an open line, both ends included; count >= 2.
[[nodiscard]] std::vector<Eigen::Vector2d> ResampleOpen(std::span<const Eigen::Vector2d> line_m,
                                                        int count);

}  // namespace capfit::section

#endif  // CAPFIT_CORE_SECTION_SLICE_H_
