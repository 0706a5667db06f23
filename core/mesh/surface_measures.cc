#include "core/mesh/surface_measures.h"

#include <Eigen/Geometry>  // cross
#include <algorithm>
#include <cstddef>
#include <limits>

#include "core/base/chunk_sums.h"
#include "core/mesh/surface_sums.h"

namespace capfit::mesh {
namespace {

struct Sums {
  double volume = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // of the volume
  double area = 0.0;
  double least_triangle_area = std::numeric_limits<double>::infinity();

  Sums& operator+=(const Sums& other) {
    volume += other.volume;
    moment += other.moment;
    area += other.area;
    least_triangle_area = std::min(least_triangle_area, other.least_triangle_area);
    return *this;
  }
};

}  // namespace

BoundingBox BoundingBoxOf(std::span<const Eigen::Vector3d> points, const ThreadPool& pool) {
  const auto box_of = [&](std::size_t begin, std::size_t end) {
    BoundingBox box = {points[begin], points[begin]};
    for (std::size_t i = begin; i < end; ++i) box += {points[i], points[i]};
    return box;
  };
  return SumOverChunks(pool, points.size(), BoundingBox{points.front(), points.front()}, box_of);
}

SurfaceMeasures Measure(std::span<const Eigen::Vector3d> vertices,
                        std::span<const Triangle> triangles, const ThreadPool& pool) {
  const BoundingBox box = BoundingBoxOf(vertices, pool);
  const Eigen::Vector3d middle = 0.5 * (box.low + box.high);  // keeps digits far from the origin
  const auto part = [&](std::size_t begin, std::size_t end) {
    Sums sum;
    for (const Triangle& t : triangles.subspan(begin, end - begin)) {
      const Eigen::Vector3d a = vertices[t[0]] - middle;
      const Eigen::Vector3d b = vertices[t[1]] - middle;
      const Eigen::Vector3d c = vertices[t[2]] - middle;
      const double area = (b - a).cross(c - a).norm() / 2.0;
      const double volume = SignedVolume(a, b, c);
      sum += {volume, volume * (a + b + c) / 4.0, area, area};
    }
    return sum;
  };
  const Sums sums = SumOverChunks(pool, triangles.size(), Sums{}, part);
  return {sums.volume, middle + sums.moment / sums.volume,
          sums.area,   sums.least_triangle_area,
          box.low,     box.high};
}

SurfaceMeasures Moved(const SurfaceMeasures& measures, const geometry::Similarity& similarity,
                      std::span<const Eigen::Vector3d> vertices, const ThreadPool& pool) {
  const double square = similarity.scale * similarity.scale;
  const BoundingBox box = BoundingBoxOf(vertices, pool);
  return {measures.volume * square * similarity.scale,
          similarity.Apply(measures.centroid),
          measures.area * square,
          measures.least_triangle_area * square,
          box.low,
          box.high};
}

}  // namespace capfit::mesh
