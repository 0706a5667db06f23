#include "core/refine/graph/graph_edit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/refine/graph/cone.h"
#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

// A new sphere nearer to the mid-plane than this share of its radius is put on it.
constexpr double kOnPlaneShare = 0.3;

std::vector<int> NeighboursOf(const CapsuleGraph& graph, int v) {
  std::vector<int> neighbours;
  for (const Edge& e : graph.edges) {
    if (e.a == v) neighbours.push_back(e.b);
    if (e.b == v) neighbours.push_back(e.a);
  }
  return neighbours;
}

void Split(const Edit& edit, EditedGraph& result) {
  CapsuleGraph& graph = result.graph;
  const Edge edge = graph.edges[U(edit.first)];
  const Node& a = graph.nodes[U(edge.a)];
  const Node& b = graph.nodes[U(edge.b)];
  const bool on_plane = graph.symmetric && edge.mirror == edit.first;
  const Eigen::Vector3d center = 0.5 * (a.center_m + b.center_m);
  const double radius = 0.5 * (a.radius_m + b.radius_m);
  graph.RemoveEdge(edit.first);
  const int middle = graph.AddNode(center, radius, on_plane);
  graph.AddEdge(edge.a, middle);
  graph.AddEdge(middle, edge.b);
  result.touched = {edge.a, edge.b, middle};
  result.touched_before = {edge.a, edge.b};
  result.possible = true;
}

void Link(const Edit& edit, EditedGraph& result) {
  if (edit.first == edit.second || result.graph.HasEdge(edit.first, edit.second)) return;
  result.graph.AddEdge(edit.first, edit.second);
  result.touched = result.touched_before = {edit.first, edit.second};
  result.possible = true;
}

// A new sphere there lies on the mid-plane rather than beside its image.
bool IsNearPlane(const Edit& edit) {
  return std::abs(edit.center_m.x()) < kOnPlaneShare * edit.radius_m;
}

void AddSphere(const Edit& edit, EditedGraph& result) {
  const bool on_plane = IsNearPlane(edit);
  const int v = result.graph.AddNode(edit.center_m, edit.radius_m, on_plane);
  result.touched = {v};
  if (edit.kind == EditKind::kLeaf) {
    result.graph.AddEdge(edit.first, v);
    result.touched.push_back(edit.first);
    result.touched_before = {edit.first};
  }
  result.possible = true;
}

void PartAtPlane(const Edit& edit, EditedGraph& result) {
  CapsuleGraph& graph = result.graph;
  const int v = edit.first;
  if (!graph.IsOnPlane(v)) return;
  const Node old = graph.nodes[U(v)];
  const std::vector<int> neighbours = NeighboursOf(graph, v);
  std::vector<Edge> kept;
  for (const Edge& e : graph.edges) {
    if (e.a != v && e.b != v) kept.push_back(e);
  }
  const int image = graph.sphere_count();
  const Eigen::Vector3d aside(0.25 * old.radius_m, 0.0, 0.0);
  graph.nodes[U(v)] = {old.center_m + aside, old.radius_m, image};
  graph.nodes.push_back({old.center_m - aside, old.radius_m, v});
  graph.edges = kept;
  graph.LinkEdges();
  for (const int n : neighbours) {
    const bool right = !graph.IsOnPlane(n) && graph.nodes[U(n)].center_m.x() < 0.0;
    graph.AddEdge(right ? image : v, n);
  }
  if (edit.second == 1) graph.AddEdge(v, image);
  result.touched = {v, image};
  result.touched_before = {v};
  result.possible = true;
}

void Unlink(const Edit& edit, EditedGraph& result) {
  const Edge edge = result.graph.edges[U(edit.first)];
  result.graph.RemoveEdge(edit.first);
  result.touched = result.touched_before = {edge.a, edge.b};
  result.possible = true;
}

void Dissolve(const Edit& edit, EditedGraph& result) {
  CapsuleGraph& graph = result.graph;
  const int image = graph.symmetric ? graph.nodes[U(edit.first)].mirror : edit.first;
  const std::vector<int> neighbours = NeighboursOf(graph, edit.first);
  if (neighbours.size() > 2 || graph.sphere_count() <= 2) return;
  if (std::find(neighbours.begin(), neighbours.end(), image) != neighbours.end()) return;
  if (neighbours.size() == 2) graph.AddEdge(neighbours[0], neighbours[1]);
  std::vector<char> removed(graph.nodes.size(), 0);
  removed[U(edit.first)] = 1;
  const std::vector<int> index = graph.RemoveNodes(removed);
  for (const int n : neighbours) result.touched.push_back(index[U(n)]);
  result.touched_before = neighbours;
  result.touched_before.push_back(edit.first);
  result.possible = true;
}

}  // namespace

bool HasImage(const CapsuleGraph& graph, const Edit& addition) {
  if (!graph.symmetric) return false;
  const bool first_on_plane = graph.IsOnPlane(addition.first);
  if (addition.kind == EditKind::kLeaf) return !(first_on_plane && IsNearPlane(addition));
  if (graph.nodes[U(addition.first)].mirror == addition.second) return false;
  return !(first_on_plane && graph.IsOnPlane(addition.second));
}

EditedGraph Apply(const CapsuleGraph& graph, const Edit& edit) {
  EditedGraph result;
  result.graph = graph;
  switch (edit.kind) {
    case EditKind::kSplit:
      Split(edit, result);
      break;
    case EditKind::kLink:
      Link(edit, result);
      break;
    case EditKind::kLeaf:
    case EditKind::kBall:
      AddSphere(edit, result);
      break;
    case EditKind::kPart:
      PartAtPlane(edit, result);
      break;
    case EditKind::kUnlink:
      Unlink(edit, result);
      break;
    case EditKind::kDissolve:
      Dissolve(edit, result);
      break;
  }
  return result;
}

std::vector<char> Neighbourhood(const CapsuleGraph& graph, const std::vector<int>& nodes,
                                int radius) {
  std::vector<char> in(graph.nodes.size(), 0);
  for (const int v : nodes) {
    in[U(v)] = 1;
    if (graph.symmetric) in[U(graph.nodes[U(v)].mirror)] = 1;
  }
  for (int k = 0; k < radius; ++k) {
    std::vector<char> wider = in;
    for (const Edge& e : graph.edges) {
      if (in[U(e.a)] || in[U(e.b)]) wider[U(e.a)] = wider[U(e.b)] = 1;
    }
    in = wider;
  }
  return in;
}

LocalGraph LocalGraphIn(const CapsuleGraph& graph, const Eigen::AlignedBox3d& box) {
  const auto ball = [&graph](int v) {
    const Node& node = graph.nodes[U(v)];
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(node.radius_m);
    return Eigen::AlignedBox3d(node.center_m - reach, node.center_m + reach);
  };
  std::vector<char> keep_node(graph.nodes.size(), 0), keep_edge(graph.edges.size(), 0);
  const auto keep = [&](int v) {
    keep_node[U(v)] = 1;
    if (graph.symmetric) keep_node[U(graph.nodes[U(v)].mirror)] = 1;
  };
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const Edge& edge = graph.edges[e];
    if (!box.intersects(ball(edge.a).merged(ball(edge.b)))) continue;
    keep_edge[e] = 1;
    if (graph.symmetric) keep_edge[U(edge.mirror)] = 1;
    keep(edge.a);
    keep(edge.b);
  }
  for (int v = 0; v < graph.sphere_count(); ++v) {
    if (box.intersects(ball(v))) keep(v);
  }
  LocalGraph local;
  local.graph.symmetric = graph.symmetric;
  std::vector<int> index(graph.nodes.size(), -1);
  for (int v = 0; v < graph.sphere_count(); ++v) {
    if (!keep_node[U(v)]) continue;
    index[U(v)] = static_cast<int>(local.nodes.size());
    local.nodes.push_back(v);
  }
  for (const int v : local.nodes) {
    local.graph.nodes.push_back(graph.nodes[U(v)]);
    int& mirror = local.graph.nodes.back().mirror;
    if (mirror >= 0) mirror = index[U(mirror)];
  }
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    if (!keep_edge[e]) continue;
    local.graph.edges.push_back({index[U(graph.edges[e].a)], index[U(graph.edges[e].b)], -1});
  }
  local.graph.LinkEdges();
  return local;
}

std::vector<Edit> LeavesAt(const CapsuleGraph& graph, const Eigen::Vector3d& point_m) {
  const std::vector<Cone> cones = ConesOf(graph);
  const Eigen::Vector3f p = point_m.cast<float>();
  float least = std::numeric_limits<float>::max();
  const Cone* nearest = nullptr;
  for (const Cone& cone : cones) {
    const float distance = SignedDistance(cone, p.x(), p.y(), p.z());
    if (distance < least) least = distance, nearest = &cone;
  }
  if (nearest == nullptr) return {};
  const ConeFoot foot = Locate(*nearest, point_m);
  Edit leaf;
  leaf.kind = EditKind::kLeaf;
  leaf.first = nearest->node_a;
  leaf.radius_m = 0.5 * foot.radius_m;
  leaf.center_m = point_m - leaf.radius_m * foot.normal;
  std::vector<Edit> leaves = {leaf};
  if (!nearest->is_sphere) {
    leaf.first = nearest->node_b;
    leaves.push_back(leaf);
  }
  return leaves;
}

int ComponentCount(const CapsuleGraph& graph) {
  std::vector<int> root(graph.nodes.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&root](int v) {
    while (root[U(v)] != v) v = root[U(v)] = root[U(root[U(v)])];
    return v;
  };
  int count = graph.sphere_count();
  for (const Edge& e : graph.edges) {
    const int a = find(e.a), b = find(e.b);
    if (a == b) continue;
    root[U(a)] = b;
    --count;
  }
  return count;
}

void MergeSwallowed(CapsuleGraph& graph) {
  for (int e = 0; e < graph.capsule_count();) {
    const Cone cone = MakeCone(graph, graph.edges[U(e)].a, graph.edges[U(e)].b);
    const int large = cone.node_a, small = cone.node_b;
    const bool is_own_image = graph.symmetric && graph.nodes[U(small)].mirror == large;
    if (!cone.is_sphere || is_own_image) {
      ++e;
      continue;
    }
    for (const int n : NeighboursOf(graph, small)) {
      const bool is_image = graph.symmetric && graph.nodes[U(small)].mirror == n;
      graph.AddEdge(large, is_image ? graph.nodes[U(large)].mirror : n);
    }
    std::vector<char> removed(graph.nodes.size(), 0);
    removed[U(small)] = 1;
    graph.RemoveNodes(removed);
    e = 0;
  }
}

std::vector<int> RemoveSwallowed(CapsuleGraph& graph) {
  for (int e = 0; e < graph.capsule_count();) {
    if (MakeCone(graph, graph.edges[U(e)].a, graph.edges[U(e)].b).is_sphere) {
      graph.RemoveEdge(e);
      e = 0;
    } else {
      ++e;
    }
  }
  const std::vector<Cone> cones = ConesOf(graph);
  std::vector<char> removed(graph.nodes.size(), 0);
  for (std::size_t j = graph.edges.size(); j < cones.size(); ++j) {
    const Cone& ball = cones[j];
    for (std::size_t k = 0; k < cones.size(); ++k) {
      // Of two equal balls the first one stays.
      const float margin = k < graph.edges.size() || k < j ? 0.0f : -1e-6f;
      if (k == j || removed[U(cones[k].node_a)]) continue;
      if (SignedDistance(cones[k], ball.ax, ball.ay, ball.az) <= -ball.radius_a + margin) {
        removed[U(ball.node_a)] = 1;
        if (graph.symmetric) removed[U(graph.nodes[U(ball.node_a)].mirror)] = 1;
        break;
      }
    }
  }
  return graph.RemoveNodes(removed);
}

}  // namespace capfit::refine
