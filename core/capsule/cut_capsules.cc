#include "core/capsule/cut_capsules.h"

#include <algorithm>

namespace capfit::capsule {
namespace {

int CostOfCut(const MirroredSet& set, int e) { return set.ImageOfCapsule(e) == e ? 1 : 2; }

// -1 where nothing that fits is worth anything.
int Worthiest(const MirroredSet& set, const std::vector<double>& worth, int cuts) {
  int worthiest = -1;
  double most = 0.0;
  for (int e = 0; e < set.capsule_count(); ++e) {
    const int cost = CostOfCut(set, e);
    if (!set.IsCapsuleRepresentative(e) || cost > cuts) continue;
    const double each = worth[e] / cost;
    if (each > most) most = each, worthiest = e;
  }
  return worthiest;
}

}  // namespace

void CutWorthiest(const Budget& budget, std::vector<double> worth, const WorthOfHalf& worth_of_half,
                  MirroredSet& set) {
  for (;;) {
    const int cut = Worthiest(set, worth, budget.Without(set.count()).Cuts());
    if (cut < 0) return;
    const double whole = worth[cut];
    const int image = set.ImageOfCapsule(cut);
    const auto [low, high] = std::minmax(cut, image);
    worth.erase(worth.begin() + high);
    if (low != high) worth.erase(worth.begin() + low);
    set.Cut(cut);
    for (int half = static_cast<int>(worth.size()); half < set.capsule_count(); ++half) {
      worth.push_back(worth_of_half(set, half, whole));
    }
  }
}

double OutlineArea(const MirroredSet& set, int capsule) {
  const geometry::Sphere& a = set.sphere(set.ends(capsule)[0]);
  const geometry::Sphere& b = set.sphere(set.ends(capsule)[1]);
  return CostOfCut(set, capsule) * (a.center_m - b.center_m).norm() * (a.radius_m + b.radius_m);
}

std::vector<double> OutlineAreas(const MirroredSet& set) {
  std::vector<double> areas;
  for (int e = 0; e < set.capsule_count(); ++e) areas.push_back(OutlineArea(set, e));
  return areas;
}

}  // namespace capfit::capsule
