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
// So far, in radii, the two spheres that a mid-plane sphere becomes lie from the plane at first.
constexpr double kAsideShare = 0.25;
// A pair this near to the plane, in radii, is one sphere.
constexpr double kNearShare = 0.1;

void Split(const Edit& edit, EditedGraph& result) {
  const auto [a, b] = capsule::CapsuleEnds(result.graph.ends(edit.first));
  result.touched = {a, b, result.graph.Cut(edit.first)};
  result.touched_before = {a, b};
  result.possible = true;
}

void Link(const Edit& edit, EditedGraph& result) {
  if (edit.first == edit.second || result.graph.HasCapsule(edit.first, edit.second)) return;
  result.graph.AddCapsule(edit.first, edit.second);
  result.touched = result.touched_before = {edit.first, edit.second};
  result.possible = true;
}

// A new sphere there lies on the mid-plane rather than beside its image.
bool IsNearPlane(const Edit& edit) {
  return std::abs(edit.center_m.x()) < kOnPlaneShare * edit.radius_m;
}

void AddSphere(const Edit& edit, EditedGraph& result) {
  const bool on_plane = IsNearPlane(edit);
  const int v = result.graph.AddSphere({edit.center_m, edit.radius_m}, on_plane);
  result.touched = {v};
  if (edit.kind == EditKind::kLeaf) {
    result.graph.AddCapsule(edit.first, v);
    result.touched.push_back(edit.first);
    result.touched_before = {edit.first};
  }
  result.possible = true;
}

void PartAtPlane(const Edit& edit, EditedGraph& result) {
  capsule::MirroredSet& graph = result.graph;
  const int v = edit.first;
  if (!graph.IsOnPlane(v)) return;
  const std::vector<int> neighbours = graph.NeighboursOf(v);
  const int image = graph.PartFromPlane(v, kAsideShare * graph.sphere(v).radius_m);
  for (const int n : neighbours) {
    const bool right = !graph.IsOnPlane(n) && graph.sphere(n).center_m.x() < 0.0;
    graph.AddCapsule(right ? image : v, n);
  }
  if (edit.second == 1) graph.AddCapsule(v, image);
  result.touched = {v, image};
  result.touched_before = {v};
  result.possible = true;
}

void Unlink(const Edit& edit, EditedGraph& result) {
  const capsule::CapsuleEnds edge = result.graph.ends(edit.first);
  result.graph.RemoveCapsule(edit.first);
  result.touched = result.touched_before = {edge[0], edge[1]};
  result.possible = true;
}

void Dissolve(const Edit& edit, EditedGraph& result) {
  capsule::MirroredSet& graph = result.graph;
  const int image = graph.is_mirrored() ? graph.ImageOf(edit.first) : edit.first;
  const std::vector<int> neighbours = graph.NeighboursOf(edit.first);
  if (neighbours.size() > 2 || graph.sphere_count() <= 2) return;
  if (std::find(neighbours.begin(), neighbours.end(), image) != neighbours.end()) return;
  if (neighbours.size() == 2) graph.AddCapsule(neighbours[0], neighbours[1]);
  std::vector<char> removed(graph.spheres().size(), 0);
  removed[edit.first] = 1;
  result.new_index = graph.RemoveSpheres(removed);
  for (const int n : neighbours) result.touched.push_back(result.new_index[n]);
  result.touched_before = neighbours;
  result.touched_before.push_back(edit.first);
  result.possible = true;
}

// One sphere of a pair whose halves nearly coincide; -1: there is none.
int FirstNearPair(const capsule::MirroredSet& graph) {
  for (int v = 0; v < graph.sphere_count(); ++v) {
    const geometry::Sphere& sphere = graph.sphere(v);
    if (graph.ImageOf(v) == v) continue;
    if (std::abs(sphere.center_m.x()) <= kNearShare * sphere.radius_m) return v;
  }
  return -1;
}

}  // namespace

bool IsLaterImage(const capsule::MirroredSet& graph, int a, int b) {
  const int image_a = graph.ImageOf(a), image_b = graph.ImageOf(b);
  return std::minmax(image_a, image_b) < std::minmax(a, b);
}

bool HasImage(const capsule::MirroredSet& graph, const Edit& addition) {
  if (!graph.is_mirrored()) return false;
  const bool first_on_plane = graph.IsOnPlane(addition.first);
  if (addition.kind == EditKind::kLeaf) return !(first_on_plane && IsNearPlane(addition));
  if (graph.ImageOf(addition.first) == addition.second) return false;
  return !(first_on_plane && graph.IsOnPlane(addition.second));
}

EditedGraph Apply(const capsule::MirroredSet& graph, const Edit& edit) {
  EditedGraph result;
  result.graph = graph;
  result.new_index.resize(graph.spheres().size());
  std::iota(result.new_index.begin(), result.new_index.end(), 0);
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

std::vector<char> Neighbourhood(const capsule::MirroredSet& graph, const std::vector<int>& nodes,
                                int radius) {
  std::vector<char> in(graph.spheres().size(), 0);
  for (const int v : nodes) {
    in[v] = 1;
    if (graph.is_mirrored()) in[graph.ImageOf(v)] = 1;
  }
  for (int k = 0; k < radius; ++k) {
    std::vector<char> wider = in;
    for (const capsule::CapsuleEnds& e : graph.capsules()) {
      if (in[e[0]] || in[e[1]]) wider[e[0]] = wider[e[1]] = 1;
    }
    in = wider;
  }
  return in;
}

Eigen::AlignedBox3d ReachOf(const capsule::MirroredSet& graph, const std::vector<char>& active) {
  constexpr double kMarginM = 0.02;
  Eigen::AlignedBox3d box;
  const auto add = [&](int v) {
    const geometry::Sphere& node = graph.sphere(v);
    Eigen::Vector3d center = node.center_m;
    if (graph.is_mirrored()) center.x() = std::abs(center.x());
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(node.radius_m + kMarginM);
    box.extend(center - reach);
    box.extend(center + reach);
  };
  for (const capsule::CapsuleEnds& e : graph.capsules()) {
    if (!active[e[0]] && !active[e[1]]) continue;
    add(e[0]);
    add(e[1]);
  }
  for (int v = 0; v < graph.sphere_count(); ++v) {
    if (active[v]) add(v);
  }
  return box;
}

LocalGraph LocalGraphIn(const capsule::MirroredSet& graph, const Eigen::AlignedBox3d& box) {
  const auto ball = [&graph](int v) {
    const geometry::Sphere& sphere = graph.sphere(v);
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(sphere.radius_m);
    return Eigen::AlignedBox3d(sphere.center_m - reach, sphere.center_m + reach);
  };
  std::vector<char> keep_sphere(graph.spheres().size(), 0);
  std::vector<char> keep_capsule(graph.capsules().size(), 0);
  const auto keep = [&](int v) { keep_sphere[v] = keep_sphere[graph.ImageOf(v)] = 1; };
  for (int e = 0; e < graph.capsule_count(); ++e) {
    const auto [a, b] = graph.ends(e);
    if (!box.intersects(ball(a).merged(ball(b)))) continue;
    keep_capsule[e] = keep_capsule[graph.ImageOfCapsule(e)] = 1;
    keep(a);
    keep(b);
  }
  for (int v = 0; v < graph.sphere_count(); ++v) {
    if (box.intersects(ball(v))) keep(v);
  }
  LocalGraph local{graph, {}};
  local.graph.KeepOnly(keep_sphere, keep_capsule);
  for (int v = 0; v < graph.sphere_count(); ++v) {
    if (keep_sphere[v]) local.nodes.push_back(v);
  }
  return local;
}

std::vector<Edit> LeavesAt(const capsule::MirroredSet& graph, const Eigen::Vector3d& point_m) {
  const std::vector<Cone> cones = ConesOf(graph);
  const Eigen::Vector3f p = point_m.cast<float>();
  float least = std::numeric_limits<float>::max();
  const Cone* nearest = nullptr;
  for (const Cone& cone : cones) {
    const float distance = cone.SignedDistance(p.x(), p.y(), p.z());
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

int ComponentCount(const capsule::MirroredSet& graph) {
  std::vector<int> root(graph.spheres().size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&root](int v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  int count = graph.sphere_count();
  for (const capsule::CapsuleEnds& e : graph.capsules()) {
    const int a = find(e[0]), b = find(e[1]);
    if (a == b) continue;
    root[a] = b;
    --count;
  }
  return count;
}

void MergeSwallowed(capsule::MirroredSet& graph) {
  for (int e = 0; e < graph.capsule_count();) {
    const Cone cone = MakeCone(graph, graph.ends(e)[0], graph.ends(e)[1]);
    const int large = cone.node_a, small = cone.node_b;
    const bool is_own_image = graph.is_mirrored() && graph.ImageOf(small) == large;
    if (!cone.is_sphere || is_own_image) {
      ++e;
      continue;
    }
    for (const int n : graph.NeighboursOf(small)) {
      const bool is_image = graph.is_mirrored() && graph.ImageOf(small) == n;
      graph.AddCapsule(large, is_image ? graph.ImageOf(large) : n);
    }
    std::vector<char> removed(graph.spheres().size(), 0);
    removed[small] = 1;
    graph.RemoveSpheres(removed);
    e = 0;
  }
}

void JoinNearPairs(capsule::MirroredSet& graph) {
  for (int v = FirstNearPair(graph); v >= 0; v = FirstNearPair(graph)) {
    graph.sphere(v).radius_m += std::abs(graph.sphere(v).center_m.x());
    graph.JoinOnPlane(v);
  }
}

std::vector<int> RemoveSwallowed(capsule::MirroredSet& graph) {
  for (int e = 0; e < graph.capsule_count();) {
    if (MakeCone(graph, graph.ends(e)[0], graph.ends(e)[1]).is_sphere) {
      graph.RemoveCapsule(e);
      e = 0;
    } else {
      ++e;
    }
  }
  const std::vector<Cone> cones = ConesOf(graph);
  std::vector<char> removed(graph.spheres().size(), 0);
  for (std::size_t j = graph.capsules().size(); j < cones.size(); ++j) {
    const Cone& ball = cones[j];
    for (std::size_t k = 0; k < cones.size(); ++k) {
      // Of two equal balls the first one stays.
      const float margin = k < graph.capsules().size() || k < j ? 0.0f : -1e-6f;
      if (k == j || removed[cones[k].node_a]) continue;
      if (cones[k].SignedDistance(ball.ax, ball.ay, ball.az) <= -ball.radius + margin) {
        removed[ball.node_a] = 1;
        if (graph.is_mirrored()) removed[graph.ImageOf(ball.node_a)] = 1;
        break;
      }
    }
  }
  return graph.RemoveSpheres(removed);
}

}  // namespace capfit::refine
