#include "core/refine/starting_graphs.h"

#include <algorithm>
#include <utility>

#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

bool HasEnds(const body::Body& body, const body::PartSelection& parts) {
  return std::any_of(
      body.vertex_segments.begin(), body.vertex_segments.end(), [&](body::Segment s) {
        const body::Part part = body::PartOf(s);
        return U(static_cast<int>(part)) >= U(body::kChainCount) && parts.Includes(part);
      });
}

}  // namespace

int Excess(const Spending& spending, const CapsuleGraph& graph) {
  return std::max({0, graph.primitive_count() - spending.max_primitives,
                   graph.sphere_count() - spending.max_spheres,
                   graph.capsule_count() - spending.max_capsules});
}

std::vector<CapsuleGraph> StartingGraphs(Guise guise, const body::Body& body,
                                         const body::PartSelection& parts, const Spending& spending,
                                         int most_spared) {
  const bool with_ends = HasEnds(body, parts);
  std::vector<CapsuleGraph> starts;
  for (const NamedLayout& named : Layouts()) {
    if (named.guise != guise || named.with_ends != with_ends) continue;
    CapsuleGraph graph = HangLayout(named.layout, body, parts, body.is_symmetric);
    const int excess = Excess(spending, graph);
    if (excess == 0) starts.clear();
    if (excess <= most_spared || starts.empty()) starts.push_back(std::move(graph));
    if (excess > 0) break;
  }
  return starts;
}

}  // namespace capfit::refine
