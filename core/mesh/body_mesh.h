// The checked mesh that every later room works on.
#ifndef CAPFIT_CORE_MESH_BODY_MESH_H_
#define CAPFIT_CORE_MESH_BODY_MESH_H_

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/raw_vector.h"
#include "core/base/thread_pool.h"
#include "core/geometry/similarity.h"
#include "core/mesh/curve_order.h"
#include "core/mesh/edge_mates.h"
#include "core/mesh/principal_frame.h"
#include "core/mesh/surface_measures.h"

namespace capfit::mesh {

// One closed, consistently oriented surface with outward normals: every edge belongs to two
// triangles that run it in opposite directions, volume > 0, all coordinates finite, no vertex
// unused, no triangle with two equal corners. It may cut through itself. Immutable; copies share
// the arrays and cost nothing.
class BodyMesh {
 public:
  // For makers of meshes inside the core that keep the promises themselves. `vertex_of_source` maps
  // each of the caller's vertices to a vertex here, -1 where none is left of it. `mates` are those
  // of the half-edges; empty: they are looked for.
  BodyMesh(std::vector<Eigen::Vector3d> vertices, std::vector<Triangle> triangles,
           std::vector<std::int32_t> vertex_of_source, RawVector<HalfEdge> mates = {},
           const ThreadPool& pool = ThreadPool(1));

  // In the order of a curve, of a surface with these measures in this frame. `vertices`, and the
  // same as SnappedPoints has them, in the order in which they came, all else in that of the curve.
  BodyMesh(std::span<const Eigen::Vector3d> vertices, std::span<const Eigen::Vector3d> snapped,
           CurveOrder order, RawVector<HalfEdge> mates, std::vector<std::int32_t> vertex_of_source,
           const SurfaceMeasures& measures, const PrincipalFrame& frame, const ThreadPool& pool);

  [[nodiscard]] std::span<const Eigen::Vector3d> vertices() const& { return *vertices_; }
  std::span<const Eigen::Vector3d> vertices() && = delete;
  [[nodiscard]] std::span<const Triangle> triangles() const& { return connections_->triangles; }
  std::span<const Triangle> triangles() && = delete;
  // For each half-edge the one across the edge (see edge_mates.h).
  [[nodiscard]] std::span<const HalfEdge> mates() const& { return connections_->mates; }
  std::span<const HalfEdge> mates() && = delete;
  // Of a mesh in the order of a curve the first of the triangles that begin at each vertex, the
  // last: end (see curve_order.h). Empty where it is in another.
  [[nodiscard]] std::span<const std::uint32_t> first_triangle() const& {
    return connections_->first_triangle;
  }
  std::span<const std::uint32_t> first_triangle() && = delete;
  // Size: the caller's vertex count. Several sources may map to one vertex (welded copies).
  [[nodiscard]] std::span<const std::int32_t> vertex_of_source() const& {
    return connections_->vertex_of_source;
  }
  std::span<const std::int32_t> vertex_of_source() && = delete;

  [[nodiscard]] double volume() const { return measures_.volume; }  // cube of the unit, > 0
  [[nodiscard]] double area() const { return measures_.area; }      // square of the mesh's unit
  [[nodiscard]] const Eigen::Vector3d& box_min() const { return measures_.box_min; }
  [[nodiscard]] const Eigen::Vector3d& box_max() const { return measures_.box_max; }
  [[nodiscard]] double diagonal() const { return measures_.diagonal(); }
  // By which it was put in the order of a curve; nothing where it was not, or was moved since.
  [[nodiscard]] const std::optional<PrincipalFrame>& frame() const { return frame_; }
  // The vertices in that frame, snapped (see principal_frame.h).
  [[nodiscard]] std::span<const Eigen::Vector3d> snapped() const& { return *snapped_; }
  std::span<const Eigen::Vector3d> snapped() && = delete;

  // The same mesh in another frame.
  [[nodiscard]] BodyMesh Transformed(const geometry::Similarity& similarity) const;
  // The same, where its vertices there are known already: `moved` are those that `similarity`
  // gives, but for rounding.
  [[nodiscard]] BodyMesh Transformed(const geometry::Similarity& similarity,
                                     std::vector<Eigen::Vector3d> moved,
                                     const ThreadPool& pool) const;
  // The same mesh with its vertices and triangles in the order of a curve; itself where it is.
  // Without a frame where the observer cancels.
  [[nodiscard]] BodyMesh InCurveOrder(const ThreadPool& pool, const FitObserver& observer) const;

 private:
  // What stays when vertices move.
  struct Connections {
    RawVector<Triangle> triangles;
    RawVector<HalfEdge> mates;
    std::vector<std::uint32_t> first_triangle;
    std::vector<std::int32_t> vertex_of_source;
  };

  BodyMesh() = default;

  std::shared_ptr<const Connections> connections_;
  std::shared_ptr<const std::vector<Eigen::Vector3d>> vertices_;
  SurfaceMeasures measures_;
  std::optional<PrincipalFrame> frame_;
  std::shared_ptr<const std::vector<Eigen::Vector3d>> snapped_;
};

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_BODY_MESH_H_
