// The checked mesh that every later room works on.
#ifndef CAPFIT_CORE_MESH_BODY_MESH_H_
#define CAPFIT_CORE_MESH_BODY_MESH_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/geometry/similarity.h"
#include "core/mesh/edge_mates.h"

namespace capfit::mesh {

// One closed, consistently oriented surface with outward normals: every edge belongs to two
// triangles that run it in opposite directions, volume > 0, all coordinates finite, no vertex
// unused, no triangle with two equal corners. It may cut through itself. Immutable; copying copies
// the arrays, so pass it by reference or move it.
class BodyMesh {
 public:
  // For makers of meshes inside the core that keep the promises themselves. `vertex_of_source` maps
  // each of the caller's vertices to a vertex here, -1 where none is left of it. `mates` are those
  // of the half-edges; empty: they are looked for.
  BodyMesh(std::vector<Eigen::Vector3d> vertices, std::vector<Triangle> triangles,
           std::vector<std::int32_t> vertex_of_source, std::vector<HalfEdge> mates = {},
           const ThreadPool& pool = ThreadPool(1));

  [[nodiscard]] std::span<const Eigen::Vector3d> vertices() const& { return vertices_; }
  std::span<const Eigen::Vector3d> vertices() && = delete;
  [[nodiscard]] std::span<const Triangle> triangles() const& { return triangles_; }
  std::span<const Triangle> triangles() && = delete;
  // For each half-edge the one across the edge (see edge_mates.h).
  [[nodiscard]] std::span<const HalfEdge> mates() const& { return mates_; }
  std::span<const HalfEdge> mates() && = delete;
  // Size: the caller's vertex count. Several sources may map to one vertex (welded copies).
  [[nodiscard]] std::span<const std::int32_t> vertex_of_source() const& {
    return vertex_of_source_;
  }
  std::span<const std::int32_t> vertex_of_source() && = delete;

  [[nodiscard]] double volume() const { return volume_; }  // cube of the mesh's unit, > 0
  [[nodiscard]] const Eigen::Vector3d& centroid() const { return centroid_; }  // of the volume
  [[nodiscard]] double area() const { return area_; }  // square of the mesh's unit
  [[nodiscard]] double least_triangle_area() const { return least_triangle_area_; }
  [[nodiscard]] const Eigen::Vector3d& box_min() const { return box_min_; }
  [[nodiscard]] const Eigen::Vector3d& box_max() const { return box_max_; }
  [[nodiscard]] double diagonal() const { return (box_max_ - box_min_).norm(); }

  // The same mesh in another frame.
  [[nodiscard]] BodyMesh Transformed(const geometry::Similarity& similarity) const;

 private:
  void Measure(const ThreadPool& pool);

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<std::int32_t> vertex_of_source_;
  std::vector<HalfEdge> mates_;
  double volume_ = 0.0;
  Eigen::Vector3d centroid_ = Eigen::Vector3d::Zero();
  double area_ = 0.0;
  double least_triangle_area_ = 0.0;
  Eigen::Vector3d box_min_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d box_max_ = Eigen::Vector3d::Zero();
};

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_BODY_MESH_H_
