#include "core/metrics/fitted_surface.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "core/mesh/surface_sums.h"

namespace capfit::metrics {
namespace {

using body::Part;

constexpr std::size_t kTrianglesPerChunk = 8192;

Part MostOf(Part a, Part b, Part c) {
  if (b == c) return b;
  return a == b || a == c ? a : std::min({a, b, c});
}

// From one mesh vertex to another.
using Edge = std::pair<std::uint32_t, std::uint32_t>;

// The edges along which skin meets what is left out, in the direction of the latter. Only a
// triangle that lacks one corner can border on skin; where two such meet, the edge hangs free.
std::vector<Edge> CutEdges(const mesh::BodyMesh& mesh, const std::vector<std::uint8_t>& selected) {
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
    surface.points_m.own().push_back(middle.sum / middle.count);
  }
  for (const Edge& edge : edges) {
    surface.triangles.own().push_back(
        {edge.first, edge.second, middles[cuts.Root(edge.first)].index});
    surface.parts.push_back(std::min(body::PartOf(body.vertex_segments[edge.first]),
                                     body::PartOf(body.vertex_segments[edge.second])));
  }
}

// The first corner met of each part is near enough to the others.
void FindMiddles(FittedSurface& surface) {
  std::array<bool, body::kPartCount> is_found{};
  const std::span<const mesh::Triangle> triangles = surface.fitted();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto part = static_cast<std::size_t>(surface.parts[surface.skin_begin + t]);
    if (std::exchange(is_found[part], true)) continue;
    surface.middle_z[part] = surface.points_m[triangles[t][0]].z();
  }
}

void SumUp(const ThreadPool& pool, FittedSurface& surface) {
  const std::span<const mesh::Triangle> triangles = surface.fitted();
  surface.skin_areas_m2.resize(triangles.size());
  std::vector<PartNumbers> chunks((triangles.size() + kTrianglesPerChunk - 1) / kTrianglesPerChunk);
  pool.ForChunks(triangles.size(), kTrianglesPerChunk, [&](std::size_t begin, std::size_t end) {
    PartNumbers flux{};
    for (std::size_t t = begin; t < end; ++t) {
      const auto part = static_cast<std::size_t>(surface.parts[surface.skin_begin + t]);
      const Eigen::Vector3d area = mesh::AreaVector(surface.points_m, triangles[t]);
      surface.skin_areas_m2[t] = area.norm();
      flux[part] +=
          area.z() * (mesh::Middle(surface.points_m, triangles[t]).z() - surface.middle_z[part]);
    }
    chunks[begin / kTrianglesPerChunk] = flux;
  });
  surface.skin_areas_m2.resize(surface.skin().size());
  for (const PartNumbers& chunk : chunks) {
    for (std::size_t p = 0; p < chunk.size(); ++p) surface.flux[p] += chunk[p];
  }
}

// A selected vertex that a triangle of the skin has for a corner.
constexpr std::uint8_t kInSkin = 2;

}  // namespace

FittedSurface MakeFittedSurface(const body::Body& body, const body::PartSelection& parts,
                                const ThreadPool& pool, const FitObserver& observer) {
  const std::span<const mesh::Triangle> triangles = body.mesh.triangles();
  FittedSurface surface;
  const std::span<const Eigen::Vector3d> vertices = body.mesh.vertices();
  std::vector<Part> part_of(vertices.size());
  std::vector<std::uint8_t> selected(part_of.size());
  std::array<Part, body::kSegmentCount> part_of_segment{};
  std::array<std::uint8_t, body::kSegmentCount> is_selected{};
  for (std::size_t s = 0; s < part_of_segment.size(); ++s) {
    part_of_segment[s] = body::PartOf(static_cast<body::Segment>(s));
    is_selected[s] = parts.Includes(part_of_segment[s]) ? 1 : 0;
  }
  surface.vertices.reserve(part_of.size());
  for (std::uint32_t v = 0; v < part_of.size(); ++v) {
    const auto segment = static_cast<std::size_t>(body.vertex_segments[v]);
    part_of[v] = part_of_segment[segment];
    selected[v] = is_selected[segment];
    if (selected[v] != 0) surface.vertices.push_back(v);
  }
  if (surface.vertices.size() == vertices.size()) {
    surface.points_m = LentOrOwn<Eigen::Vector3d>::Lent(vertices);
  } else {
    surface.points_m.own().assign(vertices.begin(), vertices.end());
  }
  if (observer.IsCancelled()) return surface;
  const auto is_skin = [&](const mesh::Triangle& t) {
    return selected[t[0]] != 0 && selected[t[1]] != 0 && selected[t[2]] != 0;
  };
  const auto skin =
      static_cast<std::size_t>(surface.vertices.size() == part_of.size()
                                   ? triangles.size()
                                   : std::count_if(triangles.begin(), triangles.end(), is_skin));
  surface.skin_begin = triangles.size() - skin;
  surface.skin_end = triangles.size();
  surface.parts.resize(triangles.size());
  if (surface.is_whole()) {
    surface.triangles = LentOrOwn<mesh::Triangle>::Lent(triangles);
  } else {
    surface.triangles.own().resize(triangles.size());
  }
  if (observer.IsCancelled()) return surface;
  const std::vector<Edge> cut =
      surface.is_whole() ? std::vector<Edge>() : CutEdges(body.mesh, selected);
  std::size_t next_out = 0;
  std::size_t next_in = surface.skin_begin;
  for (const mesh::Triangle& t : triangles) {
    const bool is_in = is_skin(t);
    const std::size_t at = is_in ? next_in++ : next_out++;
    if (!surface.is_whole()) surface.triangles.own()[at] = t;
    surface.parts[at] = MostOf(part_of[t[0]], part_of[t[1]], part_of[t[2]]);
    if (!is_in) continue;
    surface.has_part[static_cast<std::size_t>(surface.parts[at])] = true;
    for (const std::uint32_t v : t) selected[v] = kInSkin;
  }
  for (const std::uint32_t v : surface.vertices) {
    if (selected[v] == kInSkin) surface.box.extend(surface.points_m[v]);
  }
  if (observer.IsCancelled()) return surface;
  if (!surface.is_whole()) CloseCuts(body, cut, surface);
  FindMiddles(surface);
  SumUp(pool, surface);
  return surface;
}

}  // namespace capfit::metrics
