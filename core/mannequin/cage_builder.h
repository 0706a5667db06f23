// Building a cage of quads ring by ring.
#ifndef CAPFIT_CORE_MANNEQUIN_CAGE_BUILDER_H_
#define CAPFIT_CORE_MANNEQUIN_CAGE_BUILDER_H_

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/mannequin/quad_mesh.h"

namespace capfit::mannequin {

using Ring = std::vector<std::uint32_t>;  // vertex numbers, in order around a tube

// Collects vertices and quads. Rings run so that, looking along the tube in the direction in which
// it is built, they turn counter-clockwise; then all quads face outward.
class CageBuilder {
 public:
  std::uint32_t Add(const Eigen::Vector3d& position);
  void AddQuad(const Quad& quad) { mesh_.quads.push_back(quad); }

  // The band of quads between two rings of equal size;
  // Open rings (half tubes that end in the mirror plane) have no quad from their last vertex to
  // their first.
  void Bridge(const Ring& from, const Ring& to, bool closed);
  void BridgeColumn(const Ring& from, const Ring& to, std::size_t k);

  // Closes a ring of 2 (width + height) vertices with a grid of width x height quads whose corner
  // is ring[0] and whose first side runs along the ring. Inner vertices blend the ring and rise by
  // `bulge` in the middle.
  void Cap(const Ring& ring, int width, int height, const Eigen::Vector3d& bulge);

  // Makes the edges of the ring sharp.
  void Crease(const Ring& ring, bool closed);

  [[nodiscard]] const Eigen::Vector3d& position(std::uint32_t vertex) const {
    return mesh_.vertices[vertex];
  }
  [[nodiscard]] std::size_t quad_count() const { return mesh_.quads.size(); }
  [[nodiscard]] QuadMesh Take() && { return std::move(mesh_); }

 private:
  QuadMesh mesh_;
};

}  // namespace capfit::mannequin

#endif  // CAPFIT_CORE_MANNEQUIN_CAGE_BUILDER_H_
