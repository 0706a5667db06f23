// The plane that somebody stands on.
#ifndef CAPFIT_CORE_SOLID_FLOOR_PLANE_H_
#define CAPFIT_CORE_SOLID_FLOOR_PLANE_H_

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/mesh/edge_mates.h"
#include "core/solid/scan_parts.h"

namespace capfit::solid {

// A floor and where on it nothing stands.
struct FloorPlane {
  Floor floor;
  // The map of the floor: square cells, `size` of them a side, the floor's point in the middle.
  Eigen::Vector3d across = Eigen::Vector3d::UnitX();  // unit, in the plane; and the other one
  Eigen::Vector3d along = Eigen::Vector3d::UnitZ();
  double cell = 1.0;
  int size = 0;
  std::vector<char> bare;  // by cell; beyond the map all is bare

  [[nodiscard]] double HeightOf(const Eigen::Vector3d& p) const {
    return floor.up.dot(p - floor.point);
  }
  // Index of the cell below or above `p`; -1 beyond the map.
  [[nodiscard]] int CellOf(const Eigen::Vector3d& p) const;
  [[nodiscard]] bool IsBareAt(const Eigen::Vector3d& p) const {
    const int i = CellOf(p);
    return i < 0 || bare[i] != 0;
  }
};

// See FindScanParts. Nothing where there is none. O(n).
[[nodiscard]] std::optional<FloorPlane> FindFloorPlane(std::span<const Eigen::Vector3d> positions,
                                                       std::span<const mesh::Triangle> triangles);

}  // namespace capfit::solid

#endif  // CAPFIT_CORE_SOLID_FLOOR_PLANE_H_
