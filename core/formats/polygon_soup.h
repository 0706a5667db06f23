// A mesh as it came in: unchecked, in the caller's unit, axes, vertex and face order.
#ifndef CAPFIT_CORE_FORMATS_POLYGON_SOUP_H_
#define CAPFIT_CORE_FORMATS_POLYGON_SOUP_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace capfit::formats {

// A joint of a skeleton that came with the mesh (GLB), at the bind pose, in the mesh's frame.
struct NamedJoint {
  std::string name;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

// Nothing is promised: positions may be NaN, indices out of range, faces degenerate.
struct PolygonSoup {
  std::vector<Eigen::Vector3d> positions;
  // Corners of each face; empty: every face is a triangle.
  std::vector<std::uint32_t> face_sizes;
  // The corners of all faces, one face after the other.
  std::vector<std::uint32_t> face_vertices;
  std::vector<NamedJoint> joints;  // often empty
  // Read from a file: errors name the file, and faces of one or two corners, which PLY and OFF
  // files have, are left out with a warning. From a caller such faces are refused.
  bool is_from_file = false;

  [[nodiscard]] std::size_t face_count() const {
    return face_sizes.empty() ? face_vertices.size() / 3 : face_sizes.size();
  }
};

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_POLYGON_SOUP_H_
