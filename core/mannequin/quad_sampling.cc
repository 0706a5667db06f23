#include "core/mannequin/quad_sampling.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <utility>

namespace capfit::mannequin {
namespace {

using Eigen::Vector3d;

Edge Undirected(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

std::size_t FindRoot(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// For each face the strip that its edges 0-1 and 2-3 belong to, and that of the other two.
std::vector<std::array<std::size_t, 2>> FindStrips(const QuadMesh& cage) {
  std::map<Edge, std::size_t> edge_ids;
  std::vector<std::size_t> parent;
  const auto id_of = [&](const Quad& q, std::size_t k) {
    const auto [it, is_new] = edge_ids.try_emplace(Undirected(q[k], q[(k + 1) % 4]), parent.size());
    if (is_new) parent.push_back(parent.size());
    return it->second;
  };
  for (const Quad& q : cage.quads) {
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t a = FindRoot(parent, id_of(q, k));
      const std::size_t b = FindRoot(parent, id_of(q, k + 2));
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<std::array<std::size_t, 2>> strips;
  for (const Quad& q : cage.quads) {
    strips.push_back({FindRoot(parent, id_of(q, 0)), FindRoot(parent, id_of(q, 1))});
  }
  return strips;
}

// Mean width of each strip: the length of the surface across it, over all its faces.
std::map<std::size_t, double> StripWidths(const QuadMesh& cage, const SmoothSurface& shape,
                                          const std::vector<std::array<std::size_t, 2>>& strips) {
  std::map<std::size_t, std::pair<double, int>> sums;
  const int last = shape.grid_size() - 1;
  const int middle = last / 2;
  for (std::size_t f = 0; f < cage.quads.size(); ++f) {
    std::array<double, 2> length{};
    for (int i = 0; i < last; ++i) {
      length[0] += (shape.GridPoint(f, i + 1, middle) - shape.GridPoint(f, i, middle)).norm();
      length[1] += (shape.GridPoint(f, middle, i + 1) - shape.GridPoint(f, middle, i)).norm();
    }
    for (std::size_t k = 0; k < 2; ++k) {
      sums[strips[f][k]].first += length[k];
      ++sums[strips[f][k]].second;
    }
  }
  std::map<std::size_t, double> widths;
  for (const auto& [strip, sum] : sums) widths[strip] = sum.first / sum.second;
  return widths;
}

Divisions Divide(const std::vector<std::array<std::size_t, 2>>& strips,
                 const std::map<std::size_t, double>& widths, double per_length) {
  Divisions divisions;
  for (const auto& pair : strips) {
    std::array<int, 2> counts{};
    for (std::size_t k = 0; k < 2; ++k) {
      counts[k] = std::max(1, static_cast<int>(std::lround(widths.at(pair[k]) * per_length)));
      divisions.largest = std::max(divisions.largest, counts[k]);
    }
    divisions.quad_count += counts[0] * counts[1];
    divisions.faces.push_back(counts);
  }
  return divisions;
}

// Hands out the vertices of the sampled mesh: each corner and edge of the cage once.
class Sampler {
 public:
  Sampler(const QuadMesh& cage, const SmoothSurface& surface, const Divisions& divisions)
      : cage_(cage),
        surface_(surface),
        divisions_(divisions),
        corners_(cage.vertices.size(), kNone) {}

  QuadMesh Run() && {
    for (std::size_t f = 0; f < cage_.quads.size(); ++f) SampleFace(f);
    return std::move(mesh_);
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;

  std::uint32_t Add(std::size_t face, double u, double v, bool on_plane) {
    Vector3d p = surface_.At(face, u, v);
    if (on_plane) p.x() = 0.0;
    mesh_.vertices.push_back(p);
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }
  [[nodiscard]] bool OnPlane(std::uint32_t vertex) const {
    return cage_.vertices[vertex].x() == 0.0;
  }

  // The point of the face's edge k at step i of n, counted from the edge's corner k.
  std::uint32_t EdgeVertex(std::size_t face, std::size_t k, int i, int n, double u, double v) {
    const std::uint32_t a = cage_.quads[face][k];
    const std::uint32_t b = cage_.quads[face][(k + 1) % 4];
    if (i == 0 || i == n) {
      std::uint32_t& corner = corners_[i == 0 ? a : b];
      if (corner == kNone) corner = Add(face, u, v, OnPlane(i == 0 ? a : b));
      return corner;
    }
    std::vector<std::uint32_t>& edge = edges_[Undirected(a, b)];
    if (edge.empty()) edge.assign(n, kNone);
    std::uint32_t& vertex = edge[a < b ? i : n - i];
    if (vertex == kNone) vertex = Add(face, u, v, OnPlane(a) && OnPlane(b));
    return vertex;
  }

  std::uint32_t Vertex(std::size_t face, int i, int j) {
    const auto [n, m] = divisions_.faces[face];
    const double u = static_cast<double>(i) / n;
    const double v = static_cast<double>(j) / m;
    if (j == 0) return EdgeVertex(face, 0, i, n, u, v);
    if (j == m) return EdgeVertex(face, 2, n - i, n, u, v);
    if (i == n) return EdgeVertex(face, 1, j, m, u, v);
    if (i == 0) return EdgeVertex(face, 3, m - j, m, u, v);
    return Add(face, u, v, false);
  }

  void SampleFace(std::size_t face) {
    const auto [n, m] = divisions_.faces[face];
    const auto columns = static_cast<std::uint32_t>(n + 1);
    std::vector<std::uint32_t> grid;
    for (int j = 0; j <= m; ++j) {
      for (int i = 0; i <= n; ++i) grid.push_back(Vertex(face, i, j));
    }
    for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(m); ++j) {
      for (std::uint32_t i = 0; i + 1 < columns; ++i) {
        const std::uint32_t at = j * columns + i;
        mesh_.quads.push_back({grid[at], grid[at + 1], grid[at + columns + 1], grid[at + columns]});
      }
    }
  }

  const QuadMesh& cage_;
  const SmoothSurface& surface_;
  const Divisions& divisions_;
  QuadMesh mesh_;
  std::vector<std::uint32_t> corners_;
  std::map<Edge, std::vector<std::uint32_t>> edges_;
};

}  // namespace

Divisions ChooseDivisions(const QuadMesh& cage, const SmoothSurface& shape, int quads) {
  const auto strips = FindStrips(cage);
  const auto widths = StripWidths(cage, shape, strips);
  double low = 1e-3;
  double high = 1e6;
  for (int step = 0; step < 60; ++step) {
    const double middle = std::sqrt(low * high);
    (Divide(strips, widths, middle).quad_count < quads ? low : high) = middle;
  }
  Divisions below = Divide(strips, widths, low);
  Divisions above = Divide(strips, widths, high);
  return std::abs(below.quad_count - quads) <= std::abs(above.quad_count - quads) ? below : above;
}

QuadMesh Sample(const QuadMesh& cage, const SmoothSurface& surface, const Divisions& divisions) {
  return Sampler(cage, surface, divisions).Run();
}

}  // namespace capfit::mannequin
