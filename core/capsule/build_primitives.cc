#include "core/capsule/build_primitives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/enum_index.h"

namespace capfit::capsule {
namespace {

using geometry::Sphere;

// Mirrored spheres tie to the last digits.
constexpr double kGapTieM = 1e-9;

// Circles of a trunk polygon count as each other's mirror image when they match this well, relative
// to their radius. A symmetric fit matches to rounding; a fit that is not symmetric is nowhere
// near.
constexpr double kMirrorTolerance = 1e-4;

double MirrorError(const Sphere& a, const Sphere& b) {
  const Sphere image = MirrorImage(a);
  return ((image.center_m - b.center_m).norm() + std::abs(a.radius_m - b.radius_m)) / a.radius_m;
}

class Builder {
 public:
  Builder(std::span<const section::FeaturePolygon> polygons,
          std::span<const circle::PolygonApproximation> approximations)
      : polygons_(polygons), approximations_(approximations), first_(polygons.size(), 0) {}

  void AddSpheres() {
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      first_[p] = static_cast<int>(set_.spheres.size());
      AddSpheresOf(static_cast<int>(p));
    }
  }

  // Every circle with every circle of the next polygon (paper, III-C).
  void AddChainCapsules() {
    for (const std::vector<int>& chain : Chains()) {
      for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
        for (const int i : SpheresOf(chain[k])) {
          for (const int j : SpheresOf(chain[k + 1])) AddCapsule(i, j);
        }
      }
    }
  }

  void LinkLimbs() {
    const std::array<std::vector<int>, body::kChainCount> chains = Chains();
    const std::vector<int> torso = SpheresOfAll(chains[0]);
    for (std::size_t limb = 1; limb < chains.size(); ++limb) {
      if (chains[limb].empty() || torso.empty()) continue;
      LinkLimb(chains[limb].front(), torso);
    }
  }

  PrimitiveSet Take() { return std::move(set_); }

 private:
  void AddSpheresOf(int p) {
    const section::FeaturePolygon& polygon = polygons_[p];
    if (polygon.mirror >= 0 && polygon.mirror < p && IsImageOf(p, polygon.mirror)) {
      AddImagesOf(polygon.mirror, p);
      return;
    }
    for (const circle::Circle& c : approximations_[p].circles) {
      set_.spheres.push_back({polygon.frame.ToSpace(c.center_m), c.radius_m});
      set_.origins.push_back({polygon.chain, p, -1});
    }
    if (polygon.mirror == p) PairWithin(SpheresOf(p));
  }

  bool IsImageOf(int p, int source) const {
    const auto& circles = approximations_[p].circles;
    return polygons_[source].mirror == p &&
           circles.size() == approximations_[source].circles.size();
  }

  // The other side's spheres are exact images, whatever its own circles say.
  void AddImagesOf(int source, int p) {
    for (const int i : SpheresOf(source)) {
      set_.origins[i].mirror = static_cast<int>(set_.spheres.size());
      set_.spheres.push_back(MirrorImage(set_.spheres[i]));
      set_.origins.push_back({polygons_[p].chain, p, i});
    }
  }

  // Finds the mirrored pairs and the centred ones among the spheres of a trunk polygon, and makes
  // them exact. Each sphere goes to its best partner; one without a good partner stays unpaired.
  void PairWithin(const std::vector<int>& spheres) {
    for (const int i : spheres) {
      if (set_.origins[i].mirror >= 0) continue;
      int partner = -1;
      double least = kMirrorTolerance;
      for (const int j : spheres) {
        if (j < i || set_.origins[j].mirror >= 0) continue;
        const double error = MirrorError(At(i), At(j));
        if (error <= least) {
          least = error;
          partner = j;
        }
      }
      if (partner >= 0) MakePair(i, partner);
    }
  }

  void MakePair(int i, int j) {
    set_.origins[i].mirror = j;
    set_.origins[j].mirror = i;
    if (i == j) {
      At(i).center_m.x() = 0.0;
    } else {
      At(j) = MirrorImage(At(i));
    }
  }

  // The limb's first polygon and the trunk, by the pair of spheres that leaves the least gap.
  void LinkLimb(int polygon, const std::vector<int>& torso) {
    const int mirror = polygons_[polygon].mirror;
    if (mirror >= 0 && mirror < polygon && LinkLikeMirror(polygon)) return;
    const CapsuleEnds best = LeastGap(set_.spheres, SpheresOf(polygon), torso);
    if (best[0] >= 0) {
      AddCapsule(best[0], best[1]);
      links_.push_back(best);
    }
  }

  // Repeats the link of the other side, so that the set stays symmetric.
  bool LinkLikeMirror(int polygon) {
    for (const CapsuleEnds& link : links_) {
      const int i = set_.origins[link[0]].mirror;
      const int j = set_.origins[link[1]].mirror;
      if (i < 0 || j < 0 || set_.origins[i].polygon != polygon) continue;
      AddCapsule(i, j);
      return true;
    }
    return false;
  }

  void AddCapsule(int i, int j) { set_.capsules.push_back({std::min(i, j), std::max(i, j)}); }

  // The polygons of each chain, by order.
  std::array<std::vector<int>, body::kChainCount> Chains() const {
    std::array<std::vector<int>, body::kChainCount> chains;
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      chains[Index(polygons_[p].chain)].push_back(static_cast<int>(p));
    }
    for (std::vector<int>& chain : chains) {
      std::stable_sort(chain.begin(), chain.end(),
                       [&](int a, int b) { return polygons_[a].order < polygons_[b].order; });
    }
    return chains;
  }

  std::vector<int> SpheresOf(int polygon) const {
    std::vector<int> spheres;
    const auto& circles = approximations_[polygon].circles;
    for (std::size_t c = 0; c < circles.size(); ++c) {
      spheres.push_back(first_[polygon] + static_cast<int>(c));
    }
    return spheres;
  }

  std::vector<int> SpheresOfAll(const std::vector<int>& polygons) const {
    std::vector<int> all;
    for (const int p : polygons) {
      const std::vector<int> some = SpheresOf(p);
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }

  Sphere& At(int i) { return set_.spheres[i]; }

  std::span<const section::FeaturePolygon> polygons_;
  std::span<const circle::PolygonApproximation> approximations_;
  std::vector<int> first_;  // the first sphere of each polygon
  std::vector<CapsuleEnds> links_;
  PrimitiveSet set_;
};

}  // namespace

CapsuleEnds LeastGap(std::span<const Sphere> spheres, std::span<const int> from,
                     std::span<const int> to) {
  CapsuleEnds best{-1, -1};
  double least = std::numeric_limits<double>::infinity();
  for (const int i : from) {
    for (const int j : to) {
      const Sphere& other = spheres[j];
      const double gap =
          (spheres[i].center_m - other.center_m).norm() - spheres[i].radius_m - other.radius_m;
      if (gap >= least - kGapTieM) continue;
      least = gap;
      best = {i, j};
    }
  }
  return best;
}

PrimitiveSet BuildPrimitives(std::span<const section::FeaturePolygon> polygons,
                             std::span<const circle::PolygonApproximation> approximations,
                             bool link_limbs) {
  Builder builder(polygons, approximations);
  builder.AddSpheres();
  builder.AddChainCapsules();
  if (link_limbs) builder.LinkLimbs();
  return builder.Take();
}

}  // namespace capfit::capsule
