// The set while it is being refined: spheres as nodes, capsules as edges, mirrored in pairs.
#ifndef CAPFIT_CORE_REFINE_GRAPH_CAPSULE_GRAPH_H_
#define CAPFIT_CORE_REFINE_GRAPH_CAPSULE_GRAPH_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/capsule/budget.h"

namespace capfit::refine {

struct Node {
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();  // body frame
  double radius_m = 0.0;
  int mirror = -1;  // index of the mirrored node; its own on the mid-plane; -1 without symmetry
};

struct Edge {
  int a = 0;  // a < b
  int b = 0;
  int mirror = -1;  // index of the mirrored edge; its own where it is its own image
};

// Where `symmetric`, the graph is its own image in x = 0, bit for bit: every node and edge names
// its image, and only one of each pair (the representative, with the lower index) carries
// variables.
struct CapsuleGraph {
  std::vector<Node> nodes;
  std::vector<Edge> edges;
  bool symmetric = false;

  // Node `v` or edge `e` carries the variables of its pair.
  [[nodiscard]] bool IsNodeRepresentative(int v) const {
    return !symmetric || nodes[static_cast<std::size_t>(v)].mirror >= v;
  }
  [[nodiscard]] bool IsEdgeRepresentative(int e) const {
    return !symmetric || edges[static_cast<std::size_t>(e)].mirror >= e;
  }
  [[nodiscard]] bool IsOnPlane(int v) const {
    return symmetric && nodes[static_cast<std::size_t>(v)].mirror == v;
  }
  [[nodiscard]] bool HasEdge(int a, int b) const;
  [[nodiscard]] int sphere_count() const { return static_cast<int>(nodes.size()); }
  [[nodiscard]] int capsule_count() const { return static_cast<int>(edges.size()); }
  [[nodiscard]] capsule::PrimitiveCount count() const { return {sphere_count(), capsule_count()}; }
  [[nodiscard]] int primitive_count() const { return count().total(); }

  // Adds a node and, off the plane of a symmetric graph, its image right after it. Returns the
  // node's index.
  int AddNode(const Eigen::Vector3d& center_m, double radius_m, bool on_plane);
  // Adds the edge and its image, where they are not there yet; a == b adds nothing.
  void AddEdge(int a, int b);
  // Removes the edge and its image.
  void RemoveEdge(int e);
  // Removes the marked nodes, their images and their edges. Returns the new index of each old
  // node, -1 for the removed.
  std::vector<int> RemoveNodes(const std::vector<char>& removed);
  // Copies the representatives onto their images.
  void CopyToImages();
  // Works out edge.mirror anew from node.mirror.
  void LinkEdges();
};

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_GRAPH_CAPSULE_GRAPH_H_
