// The part of the body that the set is meant to stand for (M_n of the paper).
#ifndef CAPFIT_CORE_METRICS_FITTED_SURFACE_H_
#define CAPFIT_CORE_METRICS_FITTED_SURFACE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/body/anatomy.h"
#include "core/body/body.h"
#include "core/mesh/body_mesh.h"

namespace capfit::metrics {

// The triangles whose three corners belong to selected parts, closed by a flat fan over each cut.
struct FittedSurface {
  std::vector<Eigen::Vector3d> points_m;  // the mesh's vertices, then the fans' middles
  std::vector<mesh::Triangle> triangles;  // indices into points_m: the skin, then the caps
  std::size_t skin_count = 0;             // how many of them are skin
  std::vector<std::uint32_t> vertices;    // mesh vertices of the selected parts
  bool is_whole = false;                  // nothing is left out: the body's own surface
  Eigen::AlignedBox3d box;                // of the skin; empty when there is none

  [[nodiscard]] std::span<const mesh::Triangle> skin() const {
    return std::span(triangles).first(skin_count);
  }
};

// O(n).
[[nodiscard]] FittedSurface MakeFittedSurface(const body::Body& body,
                                              const body::PartSelection& parts);

}  // namespace capfit::metrics

#endif  // CAPFIT_CORE_METRICS_FITTED_SURFACE_H_
