#include "core/refine/layouts/starting_graphs.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

bool HasEnds(const body::Body& body, const body::PartSelection& parts) {
  const std::array<bool, body::kPartCount> has_part = body::PartsAmong(body.vertex_segments);
  for (int p = body::kChainCount; p < body::kPartCount; ++p) {
    if (has_part[p] && parts.Includes(static_cast<body::Part>(p))) return true;
  }
  return false;
}

// Layouts of one kind, hung on the body some at a time, as the first ones may be enough.
class HungLayouts {
 public:
  HungLayouts(FitKind kind, const body::Body& body, const body::PartSelection& parts,
              const ThreadPool& pool)
      : body_(body), parts_(parts), pool_(pool) {
    const bool with_ends = HasEnds(body, parts);
    for (const NamedLayout& named : Layouts()) {
      if (named.kind == kind && named.with_ends == with_ends) layouts_.push_back(&named);
    }
  }

  [[nodiscard]] std::size_t size() const { return layouts_.size(); }
  [[nodiscard]] int Primitives(std::size_t i) const { return layouts_[i]->primitives; }

  // In order, each once.
  capsule::MirroredSet Take(std::size_t i) {
    if (i == hung_.size()) {
      hung_.resize(std::min(layouts_.size(), i + kAtOnce));
      pool_.ForEach(hung_.size() - i, [&](std::size_t k) {
        hung_[i + k] = HangLayout(layouts_[i + k]->layout, body_, parts_, body_.is_symmetric);
      });
    }
    return std::move(hung_[i]);
  }

 private:
  static constexpr std::size_t kAtOnce = 4;

  const body::Body& body_;
  const body::PartSelection& parts_;
  const ThreadPool& pool_;
  std::vector<const NamedLayout*> layouts_;
  std::vector<capsule::MirroredSet> hung_;
};

}  // namespace

std::vector<capsule::MirroredSet> StartingGraphs(FitKind kind, const body::Body& body,
                                                 const body::PartSelection& parts,
                                                 const capsule::Budget& budget,
                                                 const StartSizes& sizes, const ThreadPool& pool) {
  HungLayouts layouts(kind, body, parts, pool);
  std::vector<capsule::MirroredSet> fitting;  // those of the largest size that does
  std::vector<capsule::MirroredSet> beyond;
  std::vector<capsule::MirroredSet> near;  // the largest of those beyond with little to spare
  int last = 0;
  int first_beyond = 0;
  for (std::size_t i = 0; i < layouts.size(); ++i) {
    const int primitives = layouts.Primitives(i);
    if (first_beyond > 0 && primitives > first_beyond) break;
    capsule::MirroredSet graph = layouts.Take(i);
    const int excess = budget.Excess(graph.count());
    if (excess > 0) {
      if (excess < sizes.least_spared) {
        if (primitives <= sizes.largest_grown) near.assign(1, std::move(graph));
        continue;
      }
      first_beyond = primitives;
      if (excess <= sizes.most_spared || fitting.empty()) beyond.push_back(std::move(graph));
      continue;
    }
    if (primitives > sizes.largest_grown) continue;
    if (primitives > last) fitting.clear();
    last = primitives;
    fitting.push_back(std::move(graph));
  }
  if (beyond.empty()) beyond = std::move(near);
  std::move(fitting.begin(), fitting.end(), std::back_inserter(beyond));
  return beyond;
}

}  // namespace capfit::refine
