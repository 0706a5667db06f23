#include "core/mesh/body_mesh.h"

#include <Eigen/Geometry>  // cross
#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/chunk_sums.h"
#include "core/mesh/surface_sums.h"

namespace capfit::mesh {

namespace {

struct Box {
  Eigen::Vector3d low;
  Eigen::Vector3d high;

  Box& operator+=(const Box& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
    return *this;
  }
};

struct Measures {
  double volume = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // of the volume
  double area = 0.0;
  double least_triangle_area = std::numeric_limits<double>::infinity();

  Measures& operator+=(const Measures& other) {
    volume += other.volume;
    moment += other.moment;
    area += other.area;
    least_triangle_area = std::min(least_triangle_area, other.least_triangle_area);
    return *this;
  }
};

}  // namespace

BodyMesh::BodyMesh(std::vector<Eigen::Vector3d> vertices, std::vector<Triangle> triangles,
                   std::vector<std::int32_t> vertex_of_source, std::vector<HalfEdge> mates,
                   const ThreadPool& pool)
    : vertices_(std::move(vertices)),
      triangles_(std::move(triangles)),
      vertex_of_source_(std::move(vertex_of_source)),
      mates_(std::move(mates)) {
  if (vertices_.empty()) return;
  if (mates_.empty()) mates_ = FindEdgeMates(triangles_, vertices_.size(), pool).mate;
  Measure(pool);
}

void BodyMesh::Measure(const ThreadPool& pool) {
  const auto box_of = [&](std::size_t begin, std::size_t end) {
    Box box = {vertices_[begin], vertices_[begin]};
    for (std::size_t i = begin; i < end; ++i) box += {vertices_[i], vertices_[i]};
    return box;
  };
  const Box first = {vertices_.front(), vertices_.front()};
  const Box box = SumOverChunks(pool, vertices_.size(), first, box_of);
  box_min_ = box.low;
  box_max_ = box.high;
  const Eigen::Vector3d middle = 0.5 * (box_min_ + box_max_);  // keeps digits far from the origin
  const auto part = [&](std::size_t begin, std::size_t end) {
    Measures sum;
    for (const Triangle& t : std::span(triangles_).subspan(begin, end - begin)) {
      const Eigen::Vector3d a = vertices_[t[0]] - middle;
      const Eigen::Vector3d b = vertices_[t[1]] - middle;
      const Eigen::Vector3d c = vertices_[t[2]] - middle;
      const double area = (b - a).cross(c - a).norm() / 2.0;
      const double volume = SignedVolume(a, b, c);
      sum += {volume, volume * (a + b + c) / 4.0, area, area};
    }
    return sum;
  };
  const Measures measures = SumOverChunks(pool, triangles_.size(), Measures{}, part);
  volume_ = measures.volume;
  centroid_ = middle + measures.moment / measures.volume;
  area_ = measures.area;
  least_triangle_area_ = measures.least_triangle_area;
}

BodyMesh BodyMesh::Transformed(const geometry::Similarity& similarity) const {
  std::vector<Eigen::Vector3d> moved(vertices_.size());
  for (std::size_t i = 0; i < vertices_.size(); ++i) moved[i] = similarity.Apply(vertices_[i]);
  return BodyMesh(std::move(moved), triangles_, vertex_of_source_, mates_);
}

}  // namespace capfit::mesh
