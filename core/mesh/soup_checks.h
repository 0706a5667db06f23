// Whether arrays from a caller make sense as a mesh at all.
#ifndef CAPFIT_CORE_MESH_SOUP_CHECKS_H_
#define CAPFIT_CORE_MESH_SOUP_CHECKS_H_

#include <cstddef>
#include <string>

#include "absl/status/status.h"
#include "core/mesh/polygon_soup.h"
#include "core/mesh/prepare_mesh.h"

namespace capfit::mesh {

// Counts the triangles that faces will become while they are read: what a file asks for is refused
// before it takes memory.
class TriangleCounter {
 public:
  explicit TriangleCounter(const MeshLimits& limits) : left_(limits.max_triangles()) {}

  // A face of that many corners. False where it is one too many.
  [[nodiscard]] bool Add(std::size_t corners) {
    const std::size_t triangles = corners < 3 ? 0 : corners - 2;
    if (triangles > left_) return false;
    left_ -= triangles;
    return true;
  }

 private:
  std::size_t left_;
};

// What to say where a TriangleCounter has had enough.
[[nodiscard]] std::string TooManyTriangles(const MeshLimits& limits);

// Sizes within `limits` and consistent, positions finite and within 1e12, indices in range.
// INVALID_ARGUMENT names the first offender. O(n), allocates nothing.
[[nodiscard]] absl::Status CheckSoup(const PolygonSoup& soup, const MeshLimits& limits);

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_SOUP_CHECKS_H_
