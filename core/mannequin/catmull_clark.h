// Catmull-Clark subdivision with sharp edges, kept as one square grid for each face of the cage.
#ifndef CAPFIT_CORE_MANNEQUIN_CATMULL_CLARK_H_
#define CAPFIT_CORE_MANNEQUIN_CATMULL_CLARK_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/mannequin/quad_mesh.h"

namespace capfit::mannequin {

// Points of the limit surface of a closed cage: for each of its faces a grid of (2^levels + 1)^2.
// Neighbouring faces share the points of their common edge bit for bit. OpenMesh subdivides; what
// it does not know (edges that stay sharp, where points end up in the limit) is added.
class SmoothSurface {
 public:
  // `cage` is closed; 0 <= levels <= 6. O(4^levels * faces), about 1 us for each grid point.
  SmoothSurface(const QuadMesh& cage, int levels);

  [[nodiscard]] int grid_size() const { return size_; }  // 2^levels + 1
  // Row i runs along the face's edge 0-1, column j along its edge 0-3.
  [[nodiscard]] const Eigen::Vector3d& GridPoint(std::size_t face, int i, int j) const {
    return points_[grid_[(face * size_ + i) * size_ + j]];
  }
  // The surface at (u, v) in [0, 1]^2 of a face, u along its edge 0-1: bilinear in the grid.
  [[nodiscard]] Eigen::Vector3d At(std::size_t face, double u, double v) const;

 private:
  int size_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::uint32_t> grid_;
};

}  // namespace capfit::mannequin

#endif  // CAPFIT_CORE_MANNEQUIN_CATMULL_CLARK_H_
