#include "core/mesh/body_mesh.h"

#include <Eigen/Geometry>  // cross
#include <utility>

namespace capfit::mesh {

BodyMesh::BodyMesh(std::vector<Eigen::Vector3d> vertices, std::vector<Triangle> triangles,
                   std::vector<std::int32_t> vertex_of_source)
    : vertices_(std::move(vertices)),
      triangles_(std::move(triangles)),
      vertex_of_source_(std::move(vertex_of_source)) {
  if (vertices_.empty()) return;
  box_min_ = box_max_ = vertices_.front();
  for (const Eigen::Vector3d& v : vertices_) {
    box_min_ = box_min_.cwiseMin(v);
    box_max_ = box_max_.cwiseMax(v);
  }
  const Eigen::Vector3d middle = 0.5 * (box_min_ + box_max_);  // keeps digits far from the origin
  for (const Triangle& t : triangles_) {
    const Eigen::Vector3d a = vertices_[t[0]] - middle;
    const Eigen::Vector3d b = vertices_[t[1]] - middle;
    const Eigen::Vector3d c = vertices_[t[2]] - middle;
    volume_ += a.dot(b.cross(c)) / 6.0;
    area_ += (b - a).cross(c - a).norm() / 2.0;
  }
}

BodyMesh BodyMesh::Transformed(const geometry::Similarity& similarity) const {
  std::vector<Eigen::Vector3d> moved(vertices_.size());
  for (std::size_t i = 0; i < vertices_.size(); ++i) moved[i] = similarity.Apply(vertices_[i]);
  return BodyMesh(std::move(moved), triangles_, vertex_of_source_);
}

}  // namespace capfit::mesh
