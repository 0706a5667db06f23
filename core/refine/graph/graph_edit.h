// Changes of topology: where another primitive could go, and which could be spared.
#ifndef CAPFIT_CORE_REFINE_GRAPH_GRAPH_EDIT_H_
#define CAPFIT_CORE_REFINE_GRAPH_GRAPH_EDIT_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "core/capsule/mirrored_set.h"

namespace capfit::refine {

enum class EditKind {
  kSplit,     // a sphere in the middle of capsule `first`: changes no shape
  kLink,      // a capsule between spheres `first` and `second`
  kLeaf,      // a new sphere at `center_m`, tied to sphere `first`
  kBall,      // a new sphere alone
  kPart,      // the mid-plane sphere `first` becomes a mirrored pair; tied when `second` is 1
  kUnlink,    // capsule `first` goes
  kDissolve,  // sphere `first` goes; its two neighbours, if it has two, are tied instead
};

struct Edit {
  EditKind kind = EditKind::kSplit;
  int first = -1;
  int second = -1;
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();
  double radius_m = 0.0;
};

// An edit that names what it touches and no place.
[[nodiscard]] inline Edit EditOf(EditKind kind, int first, int second = -1) {
  return {kind, first, second, Eigen::Vector3d::Zero(), 0.0};
}

// Whether the tie between spheres a < b is the image of one that comes earlier by its indices.
[[nodiscard]] bool IsLaterImage(const capsule::MirroredSet& graph, int a, int b);

// Whether what a tie or leaf adds comes with an image of its own.
[[nodiscard]] bool HasImage(const capsule::MirroredSet& graph, const Edit& addition);

struct EditedGraph {
  capsule::MirroredSet graph;
  std::vector<int> touched;         // nodes of `graph` whose surroundings changed
  std::vector<int> touched_before;  // the same in the graph before
  std::vector<int> new_index;       // by node of the graph before; -1: gone
  bool possible = false;
};

// The graph with the edit, mirrored where symmetric. Not possible: the tie exists already, the
// sphere to dissolve joins three capsules, and so on.
[[nodiscard]] EditedGraph Apply(const capsule::MirroredSet& graph, const Edit& edit);

// The nodes within `radius` capsules of the given ones, and their images.
[[nodiscard]] std::vector<char> Neighbourhood(const capsule::MirroredSet& graph,
                                              const std::vector<int>& nodes, int radius);

// A box around everything that the nodes marked `active` shape, with a margin.
[[nodiscard]] Eigen::AlignedBox3d ReachOf(const capsule::MirroredSet& graph,
                                          const std::vector<char>& active);

// The part of a graph that reaches into a box, with the images of what does.
struct LocalGraph {
  capsule::MirroredSet graph;
  std::vector<int> nodes;  // index in the whole graph of each node; increasing
};
[[nodiscard]] LocalGraph LocalGraphIn(const capsule::MirroredSet& graph,
                                      const Eigen::AlignedBox3d& box);

// A leaf that touches the body's surface at `point_m` from inside, at half the radius of the
// nearest capsule there; one for each end of that capsule.
[[nodiscard]] std::vector<Edit> LeavesAt(const capsule::MirroredSet& graph,
                                         const Eigen::Vector3d& point_m);

// How many pieces the graph falls into when only capsules tie spheres.
[[nodiscard]] int ComponentCount(const capsule::MirroredSet& graph);

// Where the smaller end of a capsule lies within the larger one and other capsules hang on it, ties
// those to the larger end: then nothing falls off when RemoveSwallowed takes the capsule. They
// bulge where the ends differ much: only for a graph that is settled afterwards.
void MergeSwallowed(capsule::MirroredSet& graph);

// Makes one sphere on the mid-plane of each pair whose halves nearly coincide there: two do no
// more, and what the other one took can be spent elsewhere.
void JoinNearPairs(capsule::MirroredSet& graph);

// Removes what does nothing: capsules swallowed by an end, spheres without a capsule inside
// another primitive. Returns the new index of each old node, -1 for the removed.
std::vector<int> RemoveSwallowed(capsule::MirroredSet& graph);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_GRAPH_GRAPH_EDIT_H_
