#include "core/mesh/used_vertices.h"

namespace capfit::mesh {
namespace {

constexpr std::uint32_t kLeftOut = 0xFFFFFFFFu;

}  // namespace

BodyMesh MeshOfUsed(const std::vector<Eigen::Vector3d>& positions, const VertexChanges& changes,
                    Surface surface, const ThreadPool& pool) {
  std::vector<std::uint32_t> new_index(positions.size() + changes.copied.size(), kLeftOut);
  for (const Triangle& t : surface.triangles) {
    new_index[t[0]] = new_index[t[1]] = new_index[t[2]] = 0;
  }
  std::vector<Eigen::Vector3d> vertices;
  vertices.reserve(new_index.size());
  for (std::size_t v = 0; v < new_index.size(); ++v) {
    if (new_index[v] == kLeftOut) continue;
    new_index[v] = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(positions[v < positions.size() ? v : changes.copied[v - positions.size()]]);
  }
  if (vertices.size() < new_index.size()) {
    for (Triangle& t : surface.triangles) {
      for (std::uint32_t& v : t) v = new_index[v];
    }
  }
  // A vertex may give way to one that gives way later, so the last come first.
  for (auto merge = changes.merged.rbegin(); merge != changes.merged.rend(); ++merge) {
    new_index[merge->first] = new_index[merge->second];
  }
  std::vector<std::int32_t> vertex_of_source(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const std::uint32_t index = new_index[changes.stand_in.empty() ? v : changes.stand_in[v]];
    vertex_of_source[v] = index == kLeftOut ? -1 : static_cast<std::int32_t>(index);
  }
  return BodyMesh(std::move(vertices), std::move(surface.triangles), std::move(vertex_of_source),
                  std::move(surface.mate), pool);
}

}  // namespace capfit::mesh
