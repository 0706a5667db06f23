#include "core/refine/enclosing/give_up.h"

#include <algorithm>
#include <vector>

#include "core/refine/enclosing/enclosing_moves.h"

namespace capfit::refine {
namespace {

enum class Spared { kAny, kSpheres };

// Until no more than `left` is too much. Nothing beside what has just gone: it is missed more now.
template <typename TooMuch>
void GiveUpDownTo(int left, const EnclosingTask& task, const TooMuch& too_much, Spared spared,
                  capsule::MirroredSet& graph) {
  std::vector<Removal> removals = RemovalsOf(graph, task.Weigh(graph));
  if (spared == Spared::kSpheres) {  // capsules alone as a last resort
    std::stable_partition(removals.begin(), removals.end(), [](const Removal& removal) {
      return removal.edit.kind == EditKind::kDissolve;
    });
  }
  SparedGraph rest(graph);
  for (const Removal& removal : removals) {
    if (too_much(rest.graph()) <= left) break;
    const bool last_resort = spared == Spared::kSpheres && removal.edit.kind == EditKind::kUnlink;
    if (last_resort && rest.graph().primitive_count() < graph.primitive_count()) break;
    rest.Remove(removal.edit);
  }
  graph = rest.graph();
}

// Until nothing is too much; false where nothing may go any more.
template <typename TooMuch>
bool GiveUp(const EnclosingTask& task, const TooMuch& too_much, Spared spared,
            capsule::MirroredSet& graph) {
  while (too_much(graph) > 0) {
    const int before = graph.primitive_count();
    GiveUpDownTo(too_much(graph) / 2, task, too_much, spared, graph);
    if (graph.primitive_count() == before) return false;
  }
  return true;
}

}  // namespace

bool GiveUpExcess(const EnclosingTask& task, const capsule::Budget& budget, int left,
                  capsule::MirroredSet& graph) {
  // Capsules may stay as they are where there are only too many spheres.
  const bool only_spheres = graph.primitive_count() <= budget.max_primitives &&
                            graph.capsule_count() <= budget.max_capsules;
  return GiveUp(
      task, [&](const auto& g) { return budget.Excess(g.count()) - left; },
      only_spheres ? Spared::kSpheres : Spared::kAny, graph);
}

bool GiveUpTo(const EnclosingTask& task, int primitives, capsule::MirroredSet& graph) {
  return GiveUp(
      task, [primitives](const auto& g) { return g.primitive_count() - primitives; }, Spared::kAny,
      graph);
}

}  // namespace capfit::refine
