#include "core/refine/graph/capsule_graph.h"

#include <algorithm>
#include <utility>

#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

Eigen::Vector3d Mirrored(const Eigen::Vector3d& p) { return {-p.x(), p.y(), p.z()}; }

}  // namespace

bool CapsuleGraph::HasEdge(int a, int b) const {
  const int low = std::min(a, b);
  const int high = std::max(a, b);
  return std::any_of(edges.begin(), edges.end(),
                     [&](const Edge& e) { return e.a == low && e.b == high; });
}

int CapsuleGraph::AddNode(const Eigen::Vector3d& center_m, double radius_m, bool on_plane) {
  const int index = sphere_count();
  if (!symmetric) {
    nodes.push_back({center_m, radius_m, -1});
  } else if (on_plane) {
    nodes.push_back({{0.0, center_m.y(), center_m.z()}, radius_m, index});
  } else {
    nodes.push_back({center_m, radius_m, index + 1});
    nodes.push_back({Mirrored(center_m), radius_m, index});
  }
  return index;
}

void CapsuleGraph::AddEdge(int a, int b) {
  const auto add = [this](int i, int j) {
    if (i != j && !HasEdge(i, j)) edges.push_back({std::min(i, j), std::max(i, j), -1});
  };
  add(a, b);
  if (symmetric) add(nodes[U(a)].mirror, nodes[U(b)].mirror);
  LinkEdges();
}

void CapsuleGraph::RemoveEdge(int e) {
  const int image = edges[U(e)].mirror;
  const auto [low, high] = std::minmax(e, image);
  edges.erase(edges.begin() + high);
  if (low >= 0 && low != high) edges.erase(edges.begin() + low);
  LinkEdges();
}

std::vector<int> CapsuleGraph::RemoveNodes(const std::vector<char>& removed) {
  std::vector<char> gone = removed;
  if (symmetric) {
    for (std::size_t v = 0; v < nodes.size(); ++v) {
      if (removed[v]) gone[U(nodes[v].mirror)] = 1;
    }
  }
  std::vector<int> index(nodes.size(), -1);
  int kept = 0;
  for (std::size_t v = 0; v < nodes.size(); ++v) {
    if (!gone[v]) index[v] = kept++;
  }
  std::vector<Node> old_nodes = std::exchange(nodes, {});
  for (std::size_t v = 0; v < old_nodes.size(); ++v) {
    if (gone[v]) continue;
    nodes.push_back(old_nodes[v]);
    if (symmetric) nodes.back().mirror = index[U(old_nodes[v].mirror)];
  }
  for (const Edge& e : std::exchange(edges, {})) {
    if (index[U(e.a)] >= 0 && index[U(e.b)] >= 0) {
      edges.push_back({index[U(e.a)], index[U(e.b)], -1});
    }
  }
  LinkEdges();
  return index;
}

void CapsuleGraph::CopyToImages() {
  if (!symmetric) return;
  for (int v = 0; v < sphere_count(); ++v) {
    Node& node = nodes[U(v)];
    if (node.mirror == v) {
      node.center_m.x() = 0.0;
    } else if (node.mirror > v) {
      nodes[U(node.mirror)].center_m = Mirrored(node.center_m);
      nodes[U(node.mirror)].radius_m = node.radius_m;
    }
  }
}

void CapsuleGraph::LinkEdges() {
  for (Edge& e : edges) e.mirror = -1;
  if (!symmetric) return;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto [low, high] = std::minmax(nodes[U(edges[i].a)].mirror, nodes[U(edges[i].b)].mirror);
    for (std::size_t j = 0; j < edges.size(); ++j) {
      if (edges[j].a == low && edges[j].b == high) edges[i].mirror = static_cast<int>(j);
    }
  }
}

}  // namespace capfit::refine
