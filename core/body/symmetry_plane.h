// The plane in which a body is most nearly its own mirror image.
#ifndef CAPFIT_CORE_BODY_SYMMETRY_PLANE_H_
#define CAPFIT_CORE_BODY_SYMMETRY_PLANE_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/body/coarse_surface.h"
#include "core/body/rings.h"
#include "core/mesh/nearest_vertex.h"

namespace capfit::body {

// normal . p = offset
struct MirrorPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double offset = 0.0;
};

// Robust least squares over what mirrors what: rings of left and right limbs, rings of trunk and
// head onto themselves. Limbs in different poses lose their say. In units of the square root of the
// surface's area.
[[nodiscard]] MirrorPlane SymmetryPlane(const Rings& rings, const ThreadPool& pool);

// The surface as a mirror image is laid beside it. Needs no plane yet, so that it can be made
// beside the search for one.
struct MirrorSurface {
  // The surface's areas must outlive this, its points may move on. O(nodes).
  explicit MirrorSurface(const CoarseSurface& surface);
  MirrorSurface(const MirrorSurface&) = delete;
  MirrorSurface& operator=(const MirrorSurface&) = delete;

  std::vector<Eigen::Vector3d> points;  // of the nodes
  std::vector<Eigen::Vector3d> normals;
  std::span<const double> areas;
  mesh::NearestVertex nearest;
};

// A plane a few millimetres or thousandths off, moved to where the surface mirrors itself best:
// robust least squares over how far the image of each node lies before or behind the surface.
// Whatever has no image (hair to one side, a limb in another pose) loses its say. O(nodes).
[[nodiscard]] MirrorPlane SharpenedPlane(const MirrorPlane& plane, const MirrorSurface& surface,
                                         const ThreadPool& pool);

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_SYMMETRY_PLANE_H_
