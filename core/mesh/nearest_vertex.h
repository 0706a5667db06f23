// Which vertex of a cloud is nearest to a point.
#ifndef CAPFIT_CORE_MESH_NEAREST_VERTEX_H_
#define CAPFIT_CORE_MESH_NEAREST_VERTEX_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace capfit::mesh {

// Vertices in cubic cells of about two each, where they lie evenly on a surface.
class NearestVertex {
 public:
  // At least one vertex, all finite; they are not copied and must outlive this. O(n).
  explicit NearestVertex(std::span<const Eigen::Vector3d> vertices);

  // The index of the nearest one, on a tie the lowest. O(1) near the surface; the cells looked at
  // grow with the square of the distance from it.
  [[nodiscard]] std::uint32_t At(const Eigen::Vector3d& point) const;
  // The same, sooner where the vertex `near` is near the point.
  [[nodiscard]] std::uint32_t At(const Eigen::Vector3d& point, std::uint32_t near) const;

 private:
  using Cell = std::array<int, 3>;

  [[nodiscard]] Cell CellOf(const Eigen::Vector3d& point) const;
  [[nodiscard]] std::size_t IndexOf(const Cell& cell) const;
  // How far the point lies beside a layer of cells along one axis, squared; 0 within.
  [[nodiscard]] double SquaredBeside(const Eigen::Vector3d& point, int axis, int cell) const;

  // What is as near as the best so far, or nearer.
  struct Best {
    double squared;
    std::uint32_t vertex;
  };
  [[nodiscard]] std::uint32_t Search(const Eigen::Vector3d& point, Best best) const;

  std::span<const Eigen::Vector3d> given_;
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero();
  double cell_ = 1.0;
  Cell size_ = {1, 1, 1};
  std::vector<std::uint32_t> begin_;  // of each cell in order_, and the end
  std::vector<std::uint32_t> order_;
  std::vector<Eigen::Vector3d> vertices_;  // in this order
};

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_NEAREST_VERTEX_H_
