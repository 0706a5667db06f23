// A mesh as it came in: unchecked, in the caller's unit, axes, vertex and face order.
#ifndef CAPFIT_CORE_FORMATS_POLYGON_SOUP_H_
#define CAPFIT_CORE_FORMATS_POLYGON_SOUP_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace capfit::formats {

// A turn, scale and shear, then a move: leads from one frame to another.
using Placing = Eigen::Matrix<double, 3, 4>;

// A joint of a skeleton that came with the mesh (GLB), where its node stands, in the mesh's frame.
struct NamedJoint {
  std::string name;  // may be empty
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::int32_t parent = -1;  // index of the nearest joint above it, -1 for none
  std::string human_bone =
      {};  // what the file itself says it is (VRM: "leftLowerArm"), often empty
  // From the node's own frame to the mesh's; its last column is `position`.
  Placing to_mesh = Placing::Identity();
  std::int32_t node = -1;  // index among the file's nodes, -1 where no file says
  // From the node's own frame to where the skin has its vertices before joints move them: the
  // inverse of its inverse bind matrix, in the space of the file's first skin. Where the file says
  // nothing, `to_mesh`. A vertex that joints hold stands at the sum of weight * to_mesh *
  // inverse(bind) * stored.
  Placing bind = Placing::Identity();
};

// Which joints move a vertex: the strongest four, weights >= 0 that sum to 1; all 0: none does.
struct JointInfluences {
  std::array<std::uint16_t, 4> joint{};  // indices into `joints`
  std::array<float, 4> weight{};
};

// A range of faces that the file keeps apart: a primitive of a mesh. Parts follow each other and
// hold every face once; one that repeats the faces of another (for a second material) has none.
struct SoupPart {
  std::string name;      // of the node or the mesh; may be empty, and several may have the same
  std::string material;  // may be empty
  std::size_t first_face = 0;
  std::size_t face_count = 0;
  std::int32_t joint = -1;  // the joint it hangs under rigidly, without a skin; -1 for none
};

// Nothing is promised: positions may be NaN, indices out of range, faces degenerate.
struct PolygonSoup {
  std::vector<Eigen::Vector3d> positions;
  // Corners of each face; empty: every face is a triangle.
  std::vector<std::uint32_t> face_sizes;
  // The corners of all faces, one face after the other.
  std::vector<std::uint32_t> face_vertices;
  std::vector<NamedJoint> joints;  // often empty
  // One for each position, or empty where nothing is skinned.
  std::vector<JointInfluences> influences;
  std::vector<SoupPart> parts;  // empty: all faces are one part without a name
  // Read from a file: errors name the file, and faces of one or two corners, which PLY and OFF
  // files have, are left out with a warning. From a caller such faces are refused.
  bool is_from_file = false;

  // Whether every face has three corners.
  [[nodiscard]] bool HasTrianglesOnly() const;
  [[nodiscard]] std::size_t face_count() const {
    return face_sizes.empty() ? face_vertices.size() / 3 : face_sizes.size();
  }
};

// The faces alone of those whose `mark` is `value`; no positions, joints or parts.
[[nodiscard]] PolygonSoup WithFaces(const PolygonSoup& soup, std::span<const char> mark,
                                    char value);

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_POLYGON_SOUP_H_
