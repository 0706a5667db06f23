// The part of the body that the set is meant to stand for (M_n of the paper).
#ifndef CAPFIT_CORE_METRICS_FITTED_SURFACE_H_
#define CAPFIT_CORE_METRICS_FITTED_SURFACE_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/backlog.h"
#include "core/base/lent_or_own.h"
#include "core/base/thread_pool.h"
#include "core/body/anatomy.h"
#include "core/body/body.h"
#include "core/mesh/body_mesh.h"

namespace capfit::metrics {

// One number for each part of the body.
using PartNumbers = std::array<double, body::kPartCount>;

// The triangles whose three corners belong to selected parts, closed by a flat fan over each cut.
// The part of a triangle is that of most of its corners (all different: the first in the list of
// parts); that of a fan's triangle is the first part of its edge's two ends.
struct FittedSurface {
  FittedSurface() = default;
  // As MakeFittedSurface, but empty at first: all but its sums are made once what this adds to the
  // backlog is done, the sums once the whole backlog is. So long it stays where it is.
  FittedSurface(const body::Body& body, const body::PartSelection& selected, Backlog& backlog);

  LentOrOwn<Eigen::Vector3d> points_m;  // the mesh's vertices, then the fans' middles
  LentOrOwn<mesh::Triangle> triangles;  // indices into points_m: left out, then skin, then caps
  std::vector<body::Part> parts;        // of each of `triangles`
  std::size_t skin_begin = 0;           // the body is [0, skin_end), the fitted surface
  std::size_t skin_end = 0;             // [skin_begin, all)
  std::array<bool, body::kPartCount> has_part{};  // there is skin of this part
  std::vector<std::uint32_t> vertices;            // mesh vertices of the selected parts
  Eigen::AlignedBox3d box;                        // of the skin; empty when there is none
  std::vector<double> skin_areas_m2;              // of each triangle of the skin
  // By part of the fitted surface, the volume between its triangles and the plane at the height
  // middle_z, an arbitrary one near them, by signs. Of a closed part it is the volume.
  PartNumbers flux{};
  PartNumbers middle_z{};

  [[nodiscard]] std::span<const mesh::Triangle> skin() const {
    return triangles.view().subspan(skin_begin, skin_end - skin_begin);
  }
  [[nodiscard]] std::span<const mesh::Triangle> fitted() const {
    return triangles.view().subspan(skin_begin);
  }
  // Nothing is left out: the body's own surface.
  [[nodiscard]] bool is_whole() const { return skin_begin == 0; }
};

// O(n); mostly in parallel. Where nothing is left out the body's mesh lends its arrays: it must
// outlive the surface.
[[nodiscard]] FittedSurface MakeFittedSurface(const body::Body& body,
                                              const body::PartSelection& parts,
                                              const ThreadPool& pool);
FittedSurface MakeFittedSurface(body::Body&& body, const body::PartSelection& parts,
                                const ThreadPool& pool) = delete;

}  // namespace capfit::metrics

#endif  // CAPFIT_CORE_METRICS_FITTED_SURFACE_H_
