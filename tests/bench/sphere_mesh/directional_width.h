// The least width of a set of points: what bounds the radius of the sphere that stands for it.
#ifndef CAPFIT_TESTS_BENCH_SPHERE_MESH_DIRECTIONAL_WIDTH_H_
#define CAPFIT_TESTS_BENCH_SPHERE_MESH_DIRECTIONAL_WIDTH_H_

#include <Eigen/Core>
#include <array>

namespace capfit::bench {

// Extents along 30 directions spread over the half sphere.
class DirectionalWidth {
 public:
  DirectionalWidth();

  void Add(const Eigen::Vector3d& point);
  void Add(const DirectionalWidth& other);

  // The least extent of both together; 0 for at most one point.
  [[nodiscard]] double LeastWith(const DirectionalWidth& other) const;

 private:
  static constexpr int kDirections = 30;
  std::array<float, kDirections> low_;
  std::array<float, kDirections> high_;
};

}  // namespace capfit::bench

#endif  // CAPFIT_TESTS_BENCH_SPHERE_MESH_DIRECTIONAL_WIDTH_H_
