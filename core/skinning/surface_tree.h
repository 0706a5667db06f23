// A closed surface in patches, from the whole down to a few vertices: what a centre sees of it is
// summed up vertex by vertex near the centre, and in large patches far from it.
#ifndef CAPFIT_CORE_SKINNING_SURFACE_TREE_H_
#define CAPFIT_CORE_SKINNING_SURFACE_TREE_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/body_mesh.h"
#include "core/mesh/edge_mates.h"

namespace capfit::skinning {

// Vertices of one part of the body that lie together and face alike. Floats: weights that are made
// of them are mended afterwards.
struct SurfacePatch {
  // Area-weighted mean of its vertices, relative to SurfaceTree::origin(), and a 1.
  Eigen::Array4f middle = Eigen::Array4f(0.0F, 0.0F, 0.0F, 1.0F);
  // Sum of area * outward normal, and a 0. A vertex has a third of each of its triangles.
  Eigen::Array4f area_vector = Eigen::Array4f::Zero();
  float area = 0.0F;
  float square_radius = 0.0F;  // area-weighted mean square distance of its vertices from the middle
  float bulge = 0.0F;          // sum of area vector . (vertex - middle): > 0 where it is convex
  float square_reach = 0.0F;   // square of the longest edge that starts at one of its vertices
  std::uint32_t begin = 0;     // its vertices: order()[begin] ... order()[end - 1], at least two
  std::uint32_t end = 0;
  // The two patches that it consists of; where there are none, it is but a few vertices.
  std::array<std::int32_t, 2> parts = {-1, -1};
  bool is_of_one = true;  // of one part of the body, as far as it was told

  [[nodiscard]] bool is_bucket() const { return parts[0] < 0; }
};

class SurfaceTree {
 public:
  // `parts`: for each vertex which part of the body it belongs to, below 16; patches keep them
  // apart. Empty: nobody knows. The mesh must outlive the tree. O(n): some 0.08 us a vertex.
  SurfaceTree(const mesh::BodyMesh& mesh, std::span<const std::uint8_t> parts);

  [[nodiscard]] const mesh::BodyMesh& mesh() const { return mesh_; }
  [[nodiscard]] const Eigen::Vector3d& origin() const { return origin_; }
  // The whole surface.
  [[nodiscard]] const SurfacePatch& root() const { return patches_.back(); }
  [[nodiscard]] const SurfacePatch& patch(std::int32_t index) const { return patches_[index]; }
  // All vertices, those of each patch together.
  [[nodiscard]] std::span<const std::uint32_t> order() const& { return order_; }
  std::span<const std::uint32_t> order() && = delete;
  // Where a vertex stands in order().
  [[nodiscard]] std::uint32_t PlaceOf(std::uint32_t vertex) const { return places_[vertex]; }
  // The vertex's share of the surface: sum of area * outward normal, and the area.
  [[nodiscard]] const Eigen::Array4f& ShareOf(std::uint32_t vertex) const {
    return shares_[vertex];
  }
  // The square of the longest edge that starts at it.
  [[nodiscard]] float SquareReachOf(std::uint32_t vertex) const { return square_reaches_[vertex]; }
  // A half-edge that starts at the vertex.
  [[nodiscard]] mesh::HalfEdge HalfEdgeFrom(std::uint32_t vertex) const {
    return half_edges_[vertex];
  }

 private:
  const mesh::BodyMesh& mesh_;
  Eigen::Vector3d origin_;
  std::vector<Eigen::Array4f> shares_;      // by vertex
  std::vector<float> square_reaches_;       // by vertex
  std::vector<mesh::HalfEdge> half_edges_;  // by vertex
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> places_;  // by vertex
  std::vector<SurfacePatch> patches_;  // parts before what they are parts of
};

}  // namespace capfit::skinning

#endif  // CAPFIT_CORE_SKINNING_SURFACE_TREE_H_
