// Plane ∩ mesh as closed loops, exact along the triangles' edges.
#ifndef CAPFIT_CORE_SECTION_PLANE_SECTION_H_
#define CAPFIT_CORE_SECTION_PLANE_SECTION_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/geometry/plane_frame.h"
#include "core/mesh/plane_cutter.h"

namespace capfit::section {

// Where an edge of the mesh passes the plane.
struct SectionPoint {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  // in the plane's frame
  std::uint32_t nearest_vertex = 0;                      // the nearer end of the edge
};

// A closed curve in the plane; the last point joins the first. The body lies to the left of it
// where the frame's normal points to the viewer, so outer loops run counter-clockwise and the
// walls of hollows clockwise.
using SectionLoop = std::vector<SectionPoint>;

// All loops, in the order of their lowest triangle. Vertices on the plane count as above it, so
// every loop closes and none is torn, whatever the plane touches; a face that lies in the plane
// gives its border. Neighbouring points may coincide.
[[nodiscard]] std::vector<SectionLoop> CutMesh(const mesh::PlaneCutter& mesh,
                                               const geometry::PlaneFrame& plane);

}  // namespace capfit::section

#endif  // CAPFIT_CORE_SECTION_PLANE_SECTION_H_
