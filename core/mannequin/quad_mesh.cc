#include "core/mannequin/quad_mesh.h"

namespace capfit::mannequin {

QuadMesh WithMirrorImage(const QuadMesh& half) {
  QuadMesh whole = half;
  std::vector<std::uint32_t> image(half.vertices.size());
  for (std::uint32_t i = 0; i < image.size(); ++i) {
    const Eigen::Vector3d& p = half.vertices[i];
    image[i] = i;
    if (p.x() == 0.0) continue;
    image[i] = static_cast<std::uint32_t>(whole.vertices.size());
    whole.vertices.emplace_back(-p.x(), p.y(), p.z());
  }
  for (const Quad& q : half.quads) {
    whole.quads.push_back({image[q[0]], image[q[3]], image[q[2]], image[q[1]]});
  }
  for (const Edge& e : half.creases) {
    if (image[e[0]] != e[0] || image[e[1]] != e[1]) {
      whole.creases.push_back({image[e[0]], image[e[1]]});
    }
  }
  return whole;
}

}  // namespace capfit::mannequin
