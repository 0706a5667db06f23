#include "core/mesh/principal_frame.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>  // determinant
#include <cmath>
#include <cstddef>

#include "core/base/chunk_sums.h"
#include "core/geometry/snap.h"

namespace capfit::mesh {
namespace {

// Adds up term(point).
template <typename Sum, typename Term>
Sum SumOf(std::span<const Eigen::Vector3d> points, const ThreadPool& pool, const Sum& zero,
          const Term& term) {
  return SumOverChunks(pool, points.size(), zero, [&](std::size_t begin, std::size_t end) {
    Sum sum = zero;
    for (const Eigen::Vector3d& p : points.subspan(begin, end - begin)) sum += term(p);
    return sum;
  });
}

// Rows: the directions in which the points spread most, second most and least. The first and the
// more lopsided of the others point to where the points reach out farther.
Eigen::Matrix3d PrincipalAxes(std::span<const Eigen::Vector3d> points, const ThreadPool& pool) {
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  const Eigen::Vector3d mean =
      SumOf(points, pool, zero, [](const Eigen::Vector3d& p) { return p; }) /
      static_cast<double>(points.size());
  const Eigen::Matrix3d no_products = Eigen::Matrix3d::Zero();
  const Eigen::Matrix3d products =
      SumOf(points, pool, no_products, [&](const Eigen::Vector3d& p) -> Eigen::Matrix3d {
        return (p - mean) * (p - mean).transpose();
      });
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(products);
  Eigen::Matrix3d axes = solver.eigenvectors().rowwise().reverse().transpose();
  const Eigen::Vector3d cubes =
      SumOf(points, pool, zero, [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
        const Eigen::Vector3d at = axes * (p - mean);
        return at.cwiseProduct(at).cwiseProduct(at);
      });
  const int lopsided = std::abs(cubes[1]) >= std::abs(cubes[2]) ? 1 : 2;
  for (const int k : {0, lopsided}) {
    if (cubes[k] < 0.0) axes.row(k) = -axes.row(k);
  }
  if (axes.determinant() < 0.0) axes.row(3 - lopsided) = -axes.row(3 - lopsided);
  return axes;
}

// to(vertex) of all.
template <typename To>
std::vector<Eigen::Vector3d> Each(std::span<const Eigen::Vector3d> vertices, const ThreadPool& pool,
                                  const To& to) {
  std::vector<Eigen::Vector3d> points(vertices.size());
  pool.ForChunks(points.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) points[v] = to(vertices[v]);
  });
  return points;
}

}  // namespace

PrincipalFrame FindPrincipalFrame(std::span<const Eigen::Vector3d> vertices,
                                  const SurfaceMeasures& measures, const ThreadPool& pool) {
  PrincipalFrame frame;
  frame.centroid = measures.centroid;
  frame.unit = std::sqrt(measures.area);
  const auto to_unit = [&](const Eigen::Vector3d& v) { return (v - frame.centroid) / frame.unit; };
  frame.axes = PrincipalAxes(Each(vertices, pool, to_unit), pool);
  return frame;
}

std::vector<Eigen::Vector3d> SnappedPoints(std::span<const Eigen::Vector3d> vertices,
                                           const PrincipalFrame& frame, const ThreadPool& pool) {
  return Each(vertices, pool, [&](const Eigen::Vector3d& v) {
    return geometry::Snap(frame.FromMesh(v), geometry::kCoordinateGrid);
  });
}

}  // namespace capfit::mesh
