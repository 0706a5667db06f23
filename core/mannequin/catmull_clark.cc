#include "core/mannequin/catmull_clark.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace capfit::mannequin {
namespace {

using Eigen::Vector3d;

// An undirected edge with the quads on its two sides (of a closed mesh).
struct EdgeRecord {
  Edge ends;
  std::array<std::uint32_t, 2> quads;
  bool is_sharp = false;
};

// The edges of a closed mesh, and which of them each quad has: edges_of_quad[q][k] joins its
// corners k and k + 1.
struct EdgeTable {
  std::vector<EdgeRecord> edges;
  std::vector<Quad> edges_of_quad;
};

std::uint64_t EdgeKey(std::uint32_t a, std::uint32_t b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
}

// A side of a quad: 4 * quad + k, and the higher of its two vertices.
struct Side {
  std::uint32_t high;
  std::uint32_t id;
};

// The sides by their lower vertex: those of vertex v are [starts[v], starts[v + 1]).
struct SidesByVertex {
  std::vector<std::uint32_t> starts;
  std::vector<Side> sides;
};

SidesByVertex SortSides(const QuadMesh& mesh) {
  SidesByVertex sorted{std::vector<std::uint32_t>(mesh.vertices.size() + 1, 0),
                       std::vector<Side>(4 * mesh.quads.size())};
  const auto for_each = [&](const auto& visit) {
    for (std::uint32_t q = 0; q < mesh.quads.size(); ++q) {
      for (std::uint32_t k = 0; k < 4; ++k) {
        const auto [low, high] = std::minmax(mesh.quads[q][k], mesh.quads[q][(k + 1) % 4]);
        visit(low, Side{high, 4 * q + k});
      }
    }
  };
  for_each([&](std::uint32_t low, const Side&) { ++sorted.starts[low + 1]; });
  std::partial_sum(sorted.starts.begin(), sorted.starts.end(), sorted.starts.begin());
  std::vector<std::uint32_t> next = sorted.starts;
  for_each([&](std::uint32_t low, const Side& side) { sorted.sides[next[low]++] = side; });
  return sorted;
}

EdgeTable BuildEdges(const QuadMesh& mesh) {
  const SidesByVertex sorted = SortSides(mesh);
  EdgeTable table;
  table.edges.reserve(sorted.sides.size() / 2);
  table.edges_of_quad.resize(mesh.quads.size());
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    for (std::uint32_t i = sorted.starts[v]; i < sorted.starts[v + 1]; ++i) {
      for (std::uint32_t j = i + 1; j < sorted.starts[v + 1]; ++j) {
        const Side& first = sorted.sides[i];
        const Side& second = sorted.sides[j];
        if (first.high != second.high) continue;
        const auto id = static_cast<std::uint32_t>(table.edges.size());
        table.edges.push_back({{v, first.high}, {first.id / 4, second.id / 4}});
        table.edges_of_quad[first.id / 4][first.id % 4] = id;
        table.edges_of_quad[second.id / 4][second.id % 4] = id;
      }
    }
  }
  return table;
}

void MarkCreases(const QuadMesh& mesh, EdgeTable& table) {
  std::vector<std::uint64_t> keys;
  for (const Edge& e : mesh.creases) keys.push_back(EdgeKey(e[0], e[1]));
  std::sort(keys.begin(), keys.end());
  if (keys.empty()) return;
  for (EdgeRecord& edge : table.edges) {
    edge.is_sharp =
        std::binary_search(keys.begin(), keys.end(), EdgeKey(edge.ends[0], edge.ends[1]));
  }
}

// What the rules of a vertex need of its neighbourhood.
struct Star {
  Vector3d quad_sum = Vector3d::Zero();   // centroids of the quads around
  Vector3d edge_sum = Vector3d::Zero();   // the other ends of its edges
  Vector3d sharp_sum = Vector3d::Zero();  // the other ends of its sharp edges
  int valence = 0;
  int sharp_count = 0;
};

Vector3d Centroid(const QuadMesh& mesh, const Quad& q) {
  return 0.25 * ((mesh.vertices[q[0]] + mesh.vertices[q[2]]) +
                 (mesh.vertices[q[1]] + mesh.vertices[q[3]]));
}

std::vector<Star> BuildStars(const QuadMesh& mesh, const EdgeTable& table) {
  std::vector<Star> stars(mesh.vertices.size());
  for (const Quad& q : mesh.quads) {
    const Vector3d centroid = Centroid(mesh, q);
    for (const std::uint32_t v : q) stars[v].quad_sum += centroid;
  }
  for (const EdgeRecord& edge : table.edges) {
    for (int side = 0; side < 2; ++side) {
      Star& star = stars[edge.ends[static_cast<std::size_t>(side)]];
      const Vector3d& other = mesh.vertices[edge.ends[static_cast<std::size_t>(1 - side)]];
      star.edge_sum += other;
      ++star.valence;
      if (!edge.is_sharp) continue;
      star.sharp_sum += other;
      ++star.sharp_count;
    }
  }
  return stars;
}

Vector3d RefinedVertex(const Vector3d& p, const Star& star) {
  if (star.sharp_count >= 2) return 0.75 * p + 0.125 * star.sharp_sum;
  const double n = star.valence;
  return (star.quad_sum / n + star.edge_sum / n + (n - 2.0) * p) / n;
}

// Where the vertex ends up after infinitely many steps.
Vector3d LimitVertex(const Vector3d& p, const Star& star) {
  if (star.sharp_count >= 2) return (4.0 * p + star.sharp_sum) / 6.0;
  // In terms of centroids c and neighbours e: (n (n - 1) p + 2 sum(e) + 4 sum(c)) / (n (n + 5)).
  const double n = star.valence;
  return (n * (n - 1.0) * p + 2.0 * star.edge_sum + 4.0 * star.quad_sum) / (n * (n + 5.0));
}

Vector3d EdgePoint(const QuadMesh& mesh, const EdgeRecord& edge) {
  Vector3d middle = 0.5 * (mesh.vertices[edge.ends[0]] + mesh.vertices[edge.ends[1]]);
  if (edge.is_sharp) return middle;
  return 0.5 * middle + 0.25 * (Centroid(mesh, mesh.quads[edge.quads[0]]) +
                                Centroid(mesh, mesh.quads[edge.quads[1]]));
}

// One step. The children of quad q are 4q .. 4q + 3, at the corners 0 .. 3, and all keep the
// parent's directions: child corner 0 is the one towards the parent's corner 0.
QuadMesh Refine(const QuadMesh& mesh) {
  EdgeTable table = BuildEdges(mesh);
  MarkCreases(mesh, table);
  const std::vector<Star> stars = BuildStars(mesh, table);
  const auto edge_start = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto quad_start = static_cast<std::uint32_t>(edge_start + table.edges.size());
  QuadMesh fine;
  fine.vertices.reserve(quad_start + mesh.quads.size());
  for (std::size_t i = 0; i < stars.size(); ++i) {
    fine.vertices.push_back(RefinedVertex(mesh.vertices[i], stars[i]));
  }
  for (std::uint32_t i = 0; i < table.edges.size(); ++i) {
    const EdgeRecord& edge = table.edges[i];
    fine.vertices.push_back(EdgePoint(mesh, edge));
    if (!edge.is_sharp) continue;
    fine.creases.push_back({edge.ends[0], edge_start + i});
    fine.creases.push_back({edge_start + i, edge.ends[1]});
  }
  fine.quads.reserve(4 * mesh.quads.size());
  for (std::uint32_t q = 0; q < mesh.quads.size(); ++q) {
    fine.vertices.push_back(Centroid(mesh, mesh.quads[q]));
    const Quad& v = mesh.quads[q];
    Quad e = table.edges_of_quad[q];
    for (std::uint32_t& id : e) id += edge_start;
    const std::uint32_t c = quad_start + q;
    fine.quads.push_back({v[0], e[0], c, e[3]});
    fine.quads.push_back({e[0], v[1], e[1], c});
    fine.quads.push_back({c, e[1], v[2], e[2]});
    fine.quads.push_back({e[3], c, e[2], v[3]});
  }
  return fine;
}

std::vector<Vector3d> LimitPoints(const QuadMesh& mesh) {
  EdgeTable table = BuildEdges(mesh);
  MarkCreases(mesh, table);
  const std::vector<Star> stars = BuildStars(mesh, table);
  std::vector<Vector3d> points;
  points.reserve(stars.size());
  for (std::size_t i = 0; i < stars.size(); ++i) {
    points.push_back(LimitVertex(mesh.vertices[i], stars[i]));
  }
  return points;
}

}  // namespace

SmoothSurface::SmoothSurface(const QuadMesh& cage, int levels) : size_((1 << levels) + 1) {
  QuadMesh fine = cage;
  for (int level = 0; level < levels; ++level) fine = Refine(fine);
  points_ = LimitPoints(fine);
  const auto size = static_cast<std::size_t>(size_);
  grid_.resize(cage.quads.size() * size * size);
  for (std::size_t q = 0; q < fine.quads.size(); ++q) {
    // The base-4 digits of q tell the way down from the cage's face: corner 0 .. 3 at each level.
    std::size_t i = 0;
    std::size_t j = 0;
    for (int level = 0; level < levels; ++level) {
      const std::size_t corner = (q >> (2 * level)) & 3;
      i |= static_cast<std::size_t>(corner == 1 || corner == 2) << level;
      j |= static_cast<std::size_t>(corner >= 2) << level;
    }
    const std::size_t face = q >> (2 * levels);
    std::uint32_t* const base = &grid_[(face * size + i) * size + j];
    base[0] = fine.quads[q][0];
    base[size] = fine.quads[q][1];
    base[size + 1] = fine.quads[q][2];
    base[1] = fine.quads[q][3];
  }
}

Vector3d SmoothSurface::At(std::size_t face, double u, double v) const {
  const int cells = size_ - 1;
  const int i = std::min(static_cast<int>(u * cells), cells - 1);
  const int j = std::min(static_cast<int>(v * cells), cells - 1);
  const double s = u * cells - i;
  const double t = v * cells - j;
  return (1 - s) * ((1 - t) * GridPoint(face, i, j) + t * GridPoint(face, i, j + 1)) +
         s * ((1 - t) * GridPoint(face, i + 1, j) + t * GridPoint(face, i + 1, j + 1));
}

}  // namespace capfit::mannequin
