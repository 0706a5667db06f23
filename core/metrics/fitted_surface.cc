#include "core/metrics/fitted_surface.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <utility>

#include "core/base/chunk_sums.h"
#include "core/base/enum_index.h"
#include "core/mesh/surface_sums.h"

namespace capfit::metrics {
namespace {

using body::Part;

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

// A selected vertex that a triangle of the skin has for a corner.
constexpr std::uint8_t kInSkin = 2;

// The steps in which a surface is made, in this order, and what they need until it is.
class Maker {
 public:
  Maker(const body::Body& body, const body::PartSelection& parts, FittedSurface& surface)
      : body_(body), parts_(parts), surface_(surface) {}

  void TakeVertices() {
    const std::span<const Eigen::Vector3d> vertices = body_.mesh.vertices();
    part_of_.resize(vertices.size());
    selected_.resize(vertices.size());
    std::array<Part, body::kSegmentCount> part_of_segment{};
    std::array<std::uint8_t, body::kSegmentCount> is_selected{};
    for (std::size_t s = 0; s < part_of_segment.size(); ++s) {
      part_of_segment[s] = body::PartOf(static_cast<body::Segment>(s));
      is_selected[s] = parts_.Includes(part_of_segment[s]) ? 1 : 0;
    }
    surface_.vertices.reserve(vertices.size());
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
      const std::size_t segment = Index(body_.vertex_segments[v]);
      part_of_[v] = part_of_segment[segment];
      selected_[v] = is_selected[segment];
      if (selected_[v] != 0) surface_.vertices.push_back(v);
    }
    surface_.parts.resize(body_.mesh.triangles().size());
    if (surface_.vertices.size() == vertices.size()) {
      TakeAll();
    } else {
      TakeSome();
    }
  }

  // Those of the mesh's triangles [begin, end), where all of them are taken.
  void NameParts(std::size_t begin, std::size_t end) {
    if (!surface_.is_whole()) return;
    for (std::size_t t = begin; t < end; ++t) surface_.parts[t] = PartOfTriangle(t);
  }

  // The first corner met of each part is near enough to the others.
  void FindMiddles() {
    const std::span<const mesh::Triangle> triangles = surface_.fitted();
    std::array<bool, body::kPartCount> is_found{};
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const std::size_t part = Index(surface_.parts[surface_.skin_begin + t]);
      if (std::exchange(is_found[part], true)) continue;
      surface_.middle_z[part] = surface_.points_m[triangles[t][0]].z();
      if (surface_.skin_begin + t < surface_.skin_end) surface_.has_part[part] = true;
    }
    surface_.skin_areas_m2.resize(triangles.size());
    fluxes_.resize((triangles.size() + kMeshChunk - 1) / kMeshChunk);
  }

  // Of the fitted triangles [begin, end), a chunk.
  void SumUp(std::size_t begin, std::size_t end) {
    const std::span<const mesh::Triangle> triangles = surface_.fitted();
    PartNumbers flux{};
    for (std::size_t t = begin; t < end; ++t) {
      const std::size_t part = Index(surface_.parts[surface_.skin_begin + t]);
      const Eigen::Vector3d area = mesh::AreaVector(surface_.points_m, triangles[t]);
      surface_.skin_areas_m2[t] = area.norm();
      flux[part] +=
          area.z() * (mesh::Middle(surface_.points_m, triangles[t]).z() - surface_.middle_z[part]);
    }
    fluxes_[begin / kMeshChunk] = flux;
  }

  void End() {
    surface_.skin_areas_m2.resize(surface_.skin().size());
    for (const PartNumbers& flux : fluxes_) {
      for (std::size_t p = 0; p < flux.size(); ++p) surface_.flux[p] += flux[p];
    }
  }

 private:
  [[nodiscard]] Part PartOfTriangle(std::size_t t) const {
    const mesh::Triangle& corners = body_.mesh.triangles()[t];
    return MostOf(part_of_[corners[0]], part_of_[corners[1]], part_of_[corners[2]]);
  }

  void TakeAll() {
    surface_.points_m = LentOrOwn<Eigen::Vector3d>::Lent(body_.mesh.vertices());
    surface_.triangles = LentOrOwn<mesh::Triangle>::Lent(body_.mesh.triangles());
    surface_.skin_end = surface_.triangles.size();
    surface_.box = {body_.mesh.box_min(), body_.mesh.box_max()};
  }

  void TakeSome() {
    const std::span<const Eigen::Vector3d> vertices = body_.mesh.vertices();
    const std::span<const mesh::Triangle> triangles = body_.mesh.triangles();
    surface_.points_m.own().assign(vertices.begin(), vertices.end());
    const auto is_skin = [this](const mesh::Triangle& t) {
      return selected_[t[0]] != 0 && selected_[t[1]] != 0 && selected_[t[2]] != 0;
    };
    const auto skin =
        static_cast<std::size_t>(std::count_if(triangles.begin(), triangles.end(), is_skin));
    surface_.skin_begin = triangles.size() - skin;
    surface_.skin_end = triangles.size();
    const std::vector<Edge> cut = CutEdges(body_.mesh, selected_);
    surface_.triangles.own().resize(triangles.size());
    std::size_t next_out = 0;
    std::size_t next_in = surface_.skin_begin;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const bool is_in = is_skin(triangles[t]);
      const std::size_t at = is_in ? next_in++ : next_out++;
      surface_.triangles.own()[at] = triangles[t];
      surface_.parts[at] = PartOfTriangle(t);
      if (!is_in) continue;
      for (const std::uint32_t v : triangles[t]) selected_[v] = kInSkin;
    }
    for (const std::uint32_t v : surface_.vertices) {
      if (selected_[v] == kInSkin) surface_.box.extend(surface_.points_m[v]);
    }
    CloseCuts(body_, cut, surface_);
  }

  const body::Body& body_;
  const body::PartSelection parts_;
  FittedSurface& surface_;
  std::vector<Part> part_of_;           // by vertex
  std::vector<std::uint8_t> selected_;  // by vertex
  std::vector<PartNumbers> fluxes_;     // by chunk of triangles
};

}  // namespace

FittedSurface::FittedSurface(const body::Body& body, const body::PartSelection& selected,
                             Backlog& backlog) {
  const auto maker = std::make_shared<Maker>(body, selected, *this);
  backlog.Add(1, [maker](std::size_t) { maker->TakeVertices(); });
  backlog.AddChunks(body.mesh.triangles().size(), kMeshChunk,
                    [maker](std::size_t begin, std::size_t end) { maker->NameParts(begin, end); });
  backlog.Add(1, [this, maker, &backlog](std::size_t) {
    maker->FindMiddles();
    backlog.AddChunks(fitted().size(), kMeshChunk,
                      [maker](std::size_t begin, std::size_t end) { maker->SumUp(begin, end); });
    backlog.Add(1, [maker](std::size_t) { maker->End(); });
  });
}

FittedSurface MakeFittedSurface(const body::Body& body, const body::PartSelection& parts,
                                const ThreadPool& pool) {
  const NullObserver observer;
  Backlog backlog(pool, observer);
  FittedSurface surface(body, parts, backlog);
  backlog.Finish();
  return surface;
}

}  // namespace capfit::metrics
