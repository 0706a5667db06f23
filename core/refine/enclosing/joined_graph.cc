#include "core/refine/enclosing/joined_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/base/enum_index.h"

namespace capfit::refine {
namespace {

using capsule::MirroredSet;
using capsule::PrimitiveCount;

Region RegionOf(const Donor& donor, const capsule::CapsuleEnds& capsule) {
  return std::max(donor.regions[capsule[0]], donor.regions[capsule[1]]);
}

ByRegion<PrimitiveCount> CountsOf(const Donor& donor) {
  ByRegion<PrimitiveCount> counts{};
  for (const Region region : donor.regions) ++counts[Index(region)].spheres;
  for (const auto& ends : donor.graph->capsules()) ++counts[Index(RegionOf(donor, ends))].capsules;
  return counts;
}

// Tries all choices that may yet be the best.
class Chooser {
 public:
  Chooser(std::span<const Donor> donors, const capsule::Budget& budget)
      : donors_(donors), budget_(budget) {
    for (const Donor& donor : donors) counts_.push_back(CountsOf(donor));
    for (std::size_t r = kRegionCount; r-- > 0;) {
      const auto cheapest =
          std::min_element(donors.begin(), donors.end(),
                           [r](const Donor& a, const Donor& b) { return a.costs[r] < b.costs[r]; });
      cost_from_[r] = cost_from_[r + 1] + cheapest->costs[r];
    }
    ChooseFrom(0, 0.0, {});
  }

  [[nodiscard]] bool IsFound() const { return std::isfinite(least_); }
  [[nodiscard]] std::size_t DonorOf(Region region) const { return best_[Index(region)]; }
  // Whether spheres or capsules come from more than one.
  [[nodiscard]] bool IsOfSeveral() const {
    std::optional<std::size_t> first;
    for (std::size_t r = 0; r < kRegionCount; ++r) {
      if (counts_[best_[r]][r].total() == 0) continue;
      if (first && *first != best_[r]) return true;
      first = best_[r];
    }
    return false;
  }

 private:
  void ChooseFrom(std::size_t region, double cost, const PrimitiveCount& count) {
    if (!budget_.Allows(count) || cost + cost_from_[region] >= least_) return;
    if (region == kRegionCount) {
      least_ = cost;
      best_ = choice_;
      return;
    }
    for (std::size_t d = 0; d < donors_.size(); ++d) {
      const PrimitiveCount& own = counts_[d][region];
      choice_[region] = d;
      ChooseFrom(region + 1, cost + donors_[d].costs[region],
                 {count.spheres + own.spheres, count.capsules + own.capsules});
    }
  }

  std::span<const Donor> donors_;
  const capsule::Budget& budget_;
  std::vector<ByRegion<PrimitiveCount>> counts_;      // by donor
  std::array<double, kRegionCount + 1> cost_from_{};  // of a region and those after it, at least
  ByRegion<std::size_t> choice_{}, best_{};           // donors
  double least_ = std::numeric_limits<double>::infinity();  // cost of the best
};

class Joiner {
 public:
  Joiner(std::span<const Donor> donors, const Chooser& chooser)
      : donors_(donors), chooser_(chooser), joined_(donors.front().graph->is_mirrored()) {
    for (std::size_t d = 0; d < donors.size(); ++d) AddSpheres(d);
    for (std::size_t d = 0; d < donors.size(); ++d) AddCapsules(d);
  }

  [[nodiscard]] const MirroredSet& joined() const { return joined_; }

 private:
  void AddSpheres(std::size_t d) {
    const MirroredSet& graph = *donors_[d].graph;
    std::vector<int>& index = index_.emplace_back(graph.spheres().size(), -1);
    for (int v = 0; v < graph.sphere_count(); ++v) {
      const Region region = donors_[d].regions[v];
      if (chooser_.DonorOf(region) != d || !graph.IsRepresentative(v)) continue;
      const int image = graph.ImageOf(v);
      index[v] = joined_.AddSphere(graph.sphere(v), image == v, graph.part(v));
      index[image] = joined_.ImageOf(index[v]);
      regions_.resize(joined_.spheres().size(), region);
    }
  }

  void AddCapsules(std::size_t d) {
    for (const capsule::CapsuleEnds& ends : donors_[d].graph->capsules()) {
      if (chooser_.DonorOf(RegionOf(donors_[d], ends)) != d) continue;
      const int a = IndexOf(d, ends[0]);
      const int b = IndexOf(d, ends[1]);
      if (a >= 0 && b >= 0) joined_.AddCapsule(a, b);
    }
  }

  // Of a donor's sphere or the one that takes its place; -1: there is none.
  [[nodiscard]] int IndexOf(std::size_t d, int v) const {
    if (index_[d][v] >= 0) return index_[d][v];
    const geometry::Sphere& sought = donors_[d].graph->sphere(v);
    double least = std::numeric_limits<double>::infinity();
    int nearest = -1;
    for (int w = 0; w < joined_.sphere_count(); ++w) {
      if (regions_[w] != donors_[d].regions[v]) continue;
      const geometry::Sphere& sphere = joined_.sphere(w);
      const double apart =
          (sphere.center_m - sought.center_m).norm() + std::abs(sphere.radius_m - sought.radius_m);
      if (apart < least) least = apart, nearest = w;
    }
    return nearest;
  }

  std::span<const Donor> donors_;
  const Chooser& chooser_;
  MirroredSet joined_;
  std::vector<Region> regions_;          // of its spheres
  std::vector<std::vector<int>> index_;  // in it, by donor and sphere; -1: not taken
};

}  // namespace

std::optional<MirroredSet> JoinedGraph(std::span<const Donor> donors,
                                       const capsule::Budget& budget) {
  if (donors.size() < 2) return std::nullopt;
  const Chooser chooser(donors, budget);
  if (!chooser.IsFound() || !chooser.IsOfSeveral()) return std::nullopt;
  return Joiner(donors, chooser).joined();
}

}  // namespace capfit::refine
