// How large a mesh may be.
#ifndef CAPFIT_CORE_FORMATS_MESH_LIMITS_H_
#define CAPFIT_CORE_FORMATS_MESH_LIMITS_H_

#include <cstddef>

namespace capfit::formats {

// Limits on what is accepted. Sizes beyond them are refused before anything is allocated.
struct MeshLimits {
  std::size_t max_vertices = 2'000'000;
  std::size_t max_faces = 2'000'000;
  std::size_t max_corners_per_face = 1000;  // the flat end of a cut through a fine mesh
  // A face of n corners becomes n - 2 triangles; all of them together. (Enough for quads.)
  [[nodiscard]] std::size_t max_triangles() const { return 2 * max_faces; }
};

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_MESH_LIMITS_H_
