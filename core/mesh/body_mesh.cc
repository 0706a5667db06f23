#include "core/mesh/body_mesh.h"

#include <cstddef>
#include <utility>

#include "core/base/chunk_sums.h"

namespace capfit::mesh {
namespace {

using Points = std::vector<Eigen::Vector3d>;

std::shared_ptr<const Points> InOrder(std::span<const Eigen::Vector3d> points,
                                      const CurveOrder& order, const ThreadPool& pool) {
  auto ordered = std::make_shared<Points>(order.source.size());
  pool.ForChunks(ordered->size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) (*ordered)[i] = points[order.source[i]];
  });
  return ordered;
}

}  // namespace

BodyMesh::BodyMesh(Points vertices, std::vector<Triangle> triangles,
                   std::vector<std::int32_t> vertex_of_source, RawVector<HalfEdge> mates,
                   const ThreadPool& pool) {
  if (mates.empty()) mates = FindEdgeMates(triangles, vertices.size(), pool).mate;
  if (!vertices.empty()) measures_ = Measure(vertices, triangles, pool);
  connections_ = std::make_shared<const Connections>(Connections{
      {triangles.begin(), triangles.end()}, std::move(mates), {}, std::move(vertex_of_source)});
  vertices_ = std::make_shared<const Points>(std::move(vertices));
}

BodyMesh::BodyMesh(std::span<const Eigen::Vector3d> vertices,
                   std::span<const Eigen::Vector3d> snapped, CurveOrder order,
                   RawVector<HalfEdge> mates, std::vector<std::int32_t> vertex_of_source,
                   const SurfaceMeasures& measures, const PrincipalFrame& frame,
                   const ThreadPool& pool)
    : vertices_(InOrder(vertices, order, pool)),
      measures_(measures),
      frame_(frame),
      snapped_(InOrder(snapped, order, pool)) {
  connections_ = std::make_shared<const Connections>(
      Connections{std::move(order.triangles), std::move(mates), std::move(order.first_triangle),
                  std::move(vertex_of_source)});
}

BodyMesh BodyMesh::Transformed(const geometry::Similarity& similarity) const {
  Points moved(vertices_->size());
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = similarity.Apply((*vertices_)[i]);
  return Transformed(similarity, std::move(moved), ThreadPool(1));
}

BodyMesh BodyMesh::Transformed(const geometry::Similarity& similarity, Points moved,
                               const ThreadPool& pool) const {
  BodyMesh mesh;
  if (!moved.empty()) mesh.measures_ = Moved(measures_, similarity, moved, pool);
  mesh.connections_ = connections_;
  mesh.vertices_ = std::make_shared<const Points>(std::move(moved));
  return mesh;
}

BodyMesh BodyMesh::InCurveOrder(const ThreadPool& pool, const FitObserver& observer) const {
  if (frame_) return *this;
  const PrincipalFrame frame = FindPrincipalFrame(*vertices_, measures_, pool);
  if (observer.IsCancelled()) return *this;
  const Points snapped = SnappedPoints(*vertices_, frame, pool);
  CurveOrder order = OrderAlongCurve(snapped, connections_->triangles, pool, observer);
  if (observer.IsCancelled()) return *this;
  EdgeMates mates =
      FindEdgeMates(order.triangles, vertices_->size(), pool, observer, order.first_triangle);
  if (observer.IsCancelled()) return *this;
  std::vector<std::int32_t> vertex_of_source = connections_->vertex_of_source;
  for (std::int32_t& v : vertex_of_source) {
    if (v >= 0) v = static_cast<std::int32_t>(order.rank[v]);
  }
  return BodyMesh(*vertices_, snapped, std::move(order), std::move(mates.mate),
                  std::move(vertex_of_source), measures_, frame, pool);
}

}  // namespace capfit::mesh
