#include "core/metrics/fitted_surface.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace capfit::metrics {
namespace {

using body::Part;

Part PartOfTriangle(const body::Body& body, const mesh::Triangle& t) {
  const auto part = [&](std::size_t k) { return body::PartOf(body.vertex_segments[t[k]]); };
  if (part(1) == part(2)) return part(1);
  return part(0) == part(1) || part(0) == part(2) ? part(0) : std::min({part(0), part(1), part(2)});
}

// From one mesh vertex to another.
using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::vector<bool> SelectedVertices(const body::Body& body, const body::PartSelection& parts) {
  std::vector<bool> selected;
  selected.reserve(body.vertex_segments.size());
  for (const body::Segment segment : body.vertex_segments) {
    selected.push_back(parts.Includes(body::PartOf(segment)));
  }
  return selected;
}

// The edges along which skin meets what is left out, in the direction of the latter. Only a
// triangle that lacks one corner can border on skin; where two such meet, the edge hangs free.
std::vector<Edge> CutEdges(const mesh::BodyMesh& mesh, const std::vector<bool>& selected) {
  std::vector<Edge> edges;
  for (const mesh::Triangle& t : mesh.triangles()) {
    if (selected[t[0]] + selected[t[1]] + selected[t[2]] != 2) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge edge(t[k], t[(k + 1) % 3]);
      if (selected[edge.first] && selected[edge.second]) edges.push_back(edge);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<Edge> cut;
  std::copy_if(edges.begin(), edges.end(), std::back_inserter(cut), [&](const Edge& edge) {
    return !std::binary_search(edges.begin(), edges.end(), Edge(edge.second, edge.first));
  });
  return cut;
}

// Vertices that edges join, as sets with one representative each.
class JoinedVertices {
 public:
  explicit JoinedVertices(const std::vector<Edge>& edges) {
    for (const Edge& edge : edges) parent_[Root(edge.first)] = Root(edge.second);
  }
  std::uint32_t Root(std::uint32_t vertex) {
    const auto it = parent_.try_emplace(vertex, vertex).first;
    if (it->second == vertex) return vertex;
    const std::uint32_t root = Root(it->second);
    parent_[vertex] = root;
    return root;
  }

 private:
  std::map<std::uint32_t, std::uint32_t> parent_;
};

// Any fan over all edges of a cut closes it, for as many of them enter each vertex as leave it.
void CloseCuts(const body::Body& body, const std::vector<Edge>& edges, FittedSurface& surface) {
  JoinedVertices cuts(edges);
  struct Middle {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0.0;
    std::uint32_t index = 0;
  };
  std::map<std::uint32_t, Middle> middles;
  for (const Edge& edge : edges) {
    Middle& middle = middles[cuts.Root(edge.first)];
    middle.sum += surface.points_m[edge.first];
    middle.count += 1.0;
  }
  for (auto& [root, middle] : middles) {
    middle.index = static_cast<std::uint32_t>(surface.points_m.size());
    surface.points_m.push_back(middle.sum / middle.count);
  }
  for (const Edge& edge : edges) {
    surface.triangles.push_back({edge.first, edge.second, middles[cuts.Root(edge.first)].index});
    surface.parts.push_back(std::min(body::PartOf(body.vertex_segments[edge.first]),
                                     body::PartOf(body.vertex_segments[edge.second])));
  }
}

}  // namespace

FittedSurface MakeFittedSurface(const body::Body& body, const body::PartSelection& parts) {
  const std::vector<bool> selected = SelectedVertices(body, parts);
  FittedSurface surface;
  surface.points_m.assign(body.mesh.vertices().begin(), body.mesh.vertices().end());
  for (std::uint32_t v = 0; v < selected.size(); ++v) {
    if (selected[v]) surface.vertices.push_back(v);
  }
  for (const mesh::Triangle& t : body.mesh.triangles()) {
    const Part part = PartOfTriangle(body, t);
    if (!selected[t[0]] || !selected[t[1]] || !selected[t[2]]) {
      surface.left_out.push_back(t);
      surface.left_out_parts.push_back(part);
      continue;
    }
    surface.triangles.push_back(t);
    surface.parts.push_back(part);
    surface.has_part[static_cast<std::size_t>(part)] = true;
    for (const std::uint32_t v : t) surface.box.extend(surface.points_m[v]);
  }
  surface.skin_count = surface.triangles.size();
  surface.is_whole = surface.left_out.empty();
  if (!surface.is_whole) CloseCuts(body, CutEdges(body.mesh, selected), surface);
  return surface;
}

}  // namespace capfit::metrics
