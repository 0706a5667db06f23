#include "core/mesh/principal_frame.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>  // determinant
#include <array>
#include <cmath>
#include <cstddef>

#include "core/base/chunk_sums.h"
#include "core/geometry/snap.h"

namespace capfit::mesh {
namespace {

// Numbers that are added up over all points. (Plain ones: sums of Eigen's small matrices wait for
// their memory, which takes three times as long.)
template <std::size_t kCount>
struct Totals {
  std::array<double, kCount> values{};

  Totals& operator+=(const Totals& more) {
    for (std::size_t i = 0; i < kCount; ++i) values[i] += more.values[i];
    return *this;
  }
};

// Adds up the numbers term(point).
template <std::size_t kCount, typename Term>
std::array<double, kCount> SumOf(std::span<const Eigen::Vector3d> points, const ThreadPool& pool,
                                 const Term& term) {
  const auto part = [&](std::size_t begin, std::size_t end) {
    Totals<kCount> sum;
    for (const Eigen::Vector3d& p : points.subspan(begin, end - begin)) sum += {term(p)};
    return sum;
  };
  return SumOverChunks(pool, points.size(), Totals<kCount>{}, part).values;
}

// Rows: the directions in which the points spread most, second most and least. The first and the
// more lopsided of the others point to where the points reach out farther.
Eigen::Matrix3d PrincipalAxes(std::span<const Eigen::Vector3d> points, const ThreadPool& pool) {
  const auto sums = SumOf<3>(points, pool, [](const Eigen::Vector3d& p) {
    return std::array{p.x(), p.y(), p.z()};
  });
  const Eigen::Vector3d mean = Eigen::Vector3d(sums.data()) / static_cast<double>(points.size());
  const auto products = SumOf<6>(points, pool, [&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d d = p - mean;
    return std::array{d.x() * d.x(), d.x() * d.y(), d.x() * d.z(),
                      d.y() * d.y(), d.y() * d.z(), d.z() * d.z()};
  });
  Eigen::Matrix3d spread;
  spread << products[0], products[1], products[2], products[1], products[3], products[4],
      products[2], products[4], products[5];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  Eigen::Matrix3d axes = solver.eigenvectors().rowwise().reverse().transpose();
  const auto cubes = SumOf<3>(points, pool, [&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d at = axes * (p - mean);
    return std::array{at.x() * at.x() * at.x(), at.y() * at.y() * at.y(), at.z() * at.z() * at.z()};
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
