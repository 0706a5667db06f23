// Of several parts that share no edge the one that is the body.
#ifndef CAPFIT_CORE_MESH_MAIN_PART_H_
#define CAPFIT_CORE_MESH_MAIN_PART_H_

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "absl/status/statusor.h"
#include "core/mesh/surface.h"

namespace capfit::mesh {

// Share of the diagonal within which open edges are joined: 0.02 mm on a body, far above the
// rounding of float files, far below the gap between two fingers.
inline constexpr double kWeldShare = 1e-5;

struct MainPart {
  std::size_t turned = 0;  // of its faces, so that all lie the same way round
  std::size_t parts_left_out = 0;
  std::size_t faces_left_out = 0;
  double left_out_share = 0.0;  // of the whole area
};

// Turns the faces of each part the same way round and keeps the part of the largest volume.
// Refuses, with FAILED_PRECONDITION: no volume above `least_volume` (NO_VOLUME); a second part of
// similar size that is no inner wall (TWO_BODIES); a main part without an inside (NOT_ORIENTABLE).
[[nodiscard]] absl::StatusOr<MainPart> KeepMainPart(std::span<const Eigen::Vector3d> positions,
                                                    double least_volume, Surface& surface);

// Refuses a volume, of either sign, that is not above the least. `parts`: how many there are.
[[nodiscard]] absl::Status CheckEnclosedVolume(double volume, double least_volume,
                                               std::size_t parts);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_MAIN_PART_H_
