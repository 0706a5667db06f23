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
                                                 const capsule::Budget& budget, int sizes,
                                                 int most_spared) {
  const bool with_ends = HasEnds(body, parts);
  // Smaller ones first, those of one size together.
  std::vector<std::vector<capsule::MirroredSet>> fitting;
  std::vector<capsule::MirroredSet> beyond;
  int last = 0;
  int first_beyond = 0;
  for (const NamedLayout& named : Layouts()) {
    if (named.kind != kind || named.with_ends != with_ends) continue;
    if (first_beyond > 0 && named.primitives > first_beyond) break;
    capsule::MirroredSet graph = HangLayout(named.layout, body, parts, body.is_symmetric);
    const int excess = budget.Excess(graph.count());
    if (excess > 0) {
      first_beyond = named.primitives;
      if (excess <= most_spared || fitting.empty()) beyond.push_back(std::move(graph));
      continue;
    }
    if (named.primitives > last) fitting.emplace_back();
    last = named.primitives;
    fitting.back().push_back(std::move(graph));
  }
  std::vector<capsule::MirroredSet> starts;
  const auto count = static_cast<std::size_t>(sizes);
  for (std::size_t i = fitting.size() - std::min(fitting.size(), count); i < fitting.size(); ++i) {
    std::move(fitting[i].begin(), fitting[i].end(), std::back_inserter(starts));
  }
  std::move(beyond.begin(), beyond.end(), std::back_inserter(starts));
  return starts;
}

}  // namespace capfit::refine
