#include "core/refine/layouts/starting_graphs.h"

#include <algorithm>
#include <iterator>
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

std::vector<capsule::MirroredSet> StartingGraphs(FitKind kind, const body::Body& body,
                                                 const body::PartSelection& parts,
                                                 const capsule::Budget& budget,
                                                 const StartSizes& sizes) {
  const bool with_ends = HasEnds(body, parts);
  std::vector<capsule::MirroredSet> fitting;  // those of the largest size that does
  std::vector<capsule::MirroredSet> beyond;
  std::vector<capsule::MirroredSet> near;  // the largest of those beyond with little to spare
  int last = 0;
  int first_beyond = 0;
  for (const NamedLayout& named : Layouts()) {
    if (named.kind != kind || named.with_ends != with_ends) continue;
    if (first_beyond > 0 && named.primitives > first_beyond) break;
    capsule::MirroredSet graph = HangLayout(named.layout, body, parts, body.is_symmetric);
    const int excess = budget.Excess(graph.count());
    if (excess > 0) {
      if (excess < sizes.least_spared) {
        if (named.primitives <= sizes.largest_grown) near.assign(1, std::move(graph));
        continue;
      }
      first_beyond = named.primitives;
      if (excess <= sizes.most_spared || fitting.empty()) beyond.push_back(std::move(graph));
      continue;
    }
    if (named.primitives > sizes.largest_grown) continue;
    if (named.primitives > last) fitting.clear();
    last = named.primitives;
    fitting.push_back(std::move(graph));
  }
  if (beyond.empty()) beyond = std::move(near);
  std::move(fitting.begin(), fitting.end(), std::back_inserter(beyond));
  return beyond;
}

}  // namespace capfit::refine
