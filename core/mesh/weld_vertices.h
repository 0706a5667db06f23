// Copies of one vertex become one.
#ifndef CAPFIT_CORE_MESH_WELD_VERTICES_H_
#define CAPFIT_CORE_MESH_WELD_VERTICES_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace capfit::mesh {

// For each vertex the one that stands for it: itself, or the first of `candidates` whose position
// is equal, bit for bit (0 and -0 are equal). Vertices not among `candidates` (ascending) stand
// for themselves. O(n).
[[nodiscard]] std::vector<std::uint32_t> WeldEqual(std::span<const Eigen::Vector3d> positions,
                                                   std::span<const std::uint32_t> candidates);

// The same for positions within `tolerance` > 0 of each other: in ascending order each candidate
// joins the nearest earlier one that stands for itself, so a chain of close vertices does not
// collapse into one. O(n) for a tolerance well below the distance of distinct vertices.
[[nodiscard]] std::vector<std::uint32_t> WeldWithin(std::span<const Eigen::Vector3d> positions,
                                                    std::span<const std::uint32_t> candidates,
                                                    double tolerance);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_WELD_VERTICES_H_
