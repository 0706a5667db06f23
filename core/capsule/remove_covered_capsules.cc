#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/capsule/build_primitives.h"
#include "core/capsule/mirrored_set.h"

namespace capfit::capsule {
namespace {

using geometry::Sphere;
using geometry::TaperedCapsule;

// A certificate that needs more cells than this is not worth having: the capsule stays. Typical
// ones need a few hundred.
constexpr int kMaxCells = 20'000;
// Size of the cells in which the inside is searched for cavities, relative to the capsule's larger
// radius. The surface is certified exactly; a cavity that fits between these is of no consequence.
constexpr double kCavityCell = 0.1;

// What remains of the set when some of it is left out.
struct Cover {
  std::vector<TaperedCapsule> solids;

  double Distance(const Eigen::Vector3d& point) const {
    double least = std::numeric_limits<double>::infinity();
    for (const TaperedCapsule& solid : solids) {
      least = std::min(least, solid.SignedDistance(point));
    }
    return least;
  }
  bool ContainsWhole(const TaperedCapsule& capsule) const {
    return std::any_of(solids.begin(), solids.end(), [&](const TaperedCapsule& solid) {
      return solid.Contains(capsule.a()) && solid.Contains(capsule.b());
    });
  }
};

// The cone between the two tangent circles of a capsule, with coordinates u along the slant and v
// round the axis, both in [0, 1].
class Slant {
 public:
  explicit Slant(const TaperedCapsule& capsule) : capsule_(capsule) {
    const Eigen::Vector3d helper =
        std::abs(capsule.axis().x()) < 0.6 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
    first_ = capsule.axis().cross(helper).normalized();
    second_ = capsule.axis().cross(first_);
  }
  Eigen::Vector3d At(double u, double v) const {
    const double angle = 2.0 * std::numbers::pi * v;
    const Eigen::Vector3d outward = std::cos(angle) * first_ + std::sin(angle) * second_;
    const Eigen::Vector3d normal =
        capsule_.sin_half_angle() * capsule_.axis() + capsule_.cos_half_angle() * outward;
    return (1 - u) * capsule_.a().center_m + u * capsule_.b().center_m +
           ((1 - u) * capsule_.a().radius_m + u * capsule_.b().radius_m) * normal;
  }
  double length() const { return capsule_.length_m() * capsule_.cos_half_angle(); }
  double girth() const {
    return 2.0 * std::numbers::pi * capsule_.cos_half_angle() *
           std::max(capsule_.a().radius_m, capsule_.b().radius_m);
  }

 private:
  const TaperedCapsule& capsule_;
  Eigen::Vector3d first_;
  Eigen::Vector3d second_;
};

// A rectangle on the slant.
struct Patch {
  double u = 0.5;
  double v = 0.5;
  double half_u = 0.5;
  double half_v = 0.5;
};

// Whether no point of the slant is further than `tolerance_m` outside the cover. Distances change
// no faster than points move, so one distance decides a whole patch, or it is cut.
bool CoversSlant(const Cover& cover, const TaperedCapsule& capsule, double tolerance_m) {
  const Slant slant(capsule);
  std::vector<Patch> patches;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 8; ++j) {
      patches.push_back({(i + 0.5) / 4, (j + 0.5) / 8, 0.5 / 4, 0.5 / 8});
    }
  }
  // Breadth first: an exposed point is found before much is certified.
  for (std::size_t next = 0; next < patches.size(); ++next) {
    if (next >= static_cast<std::size_t>(kMaxCells)) return false;
    const Patch patch = patches[next];
    const double distance = cover.Distance(slant.At(patch.u, patch.v));
    if (distance > tolerance_m) return false;
    const double half_length = patch.half_u * slant.length();
    const double half_girth = patch.half_v * slant.girth();
    if (distance + half_length + half_girth <= tolerance_m) continue;
    const bool cut_u = half_length > half_girth;
    for (const double side : {-0.5, 0.5}) {
      Patch half = patch;
      (cut_u ? half.u : half.v) += side * (cut_u ? patch.half_u : patch.half_v);
      (cut_u ? half.half_u : half.half_v) *= 0.5;
      patches.push_back(half);
    }
  }
  return true;
}

struct Cube {
  Eigen::Vector3d center;
  double half = 0.0;
};

Cube BoundingCube(const TaperedCapsule& capsule) {
  const Eigen::Array3d a = capsule.a().center_m;
  const Eigen::Array3d b = capsule.b().center_m;
  const Eigen::Array3d low = (a - capsule.a().radius_m).min(b - capsule.b().radius_m);
  const Eigen::Array3d high = (a + capsule.a().radius_m).max(b + capsule.b().radius_m);
  return {0.5 * (low + high), 0.5 * (high - low).maxCoeff()};
}

// Whether the inside of the capsule, whose surface is covered, has no cavity worth the name.
bool CoversInside(const Cover& cover, const TaperedCapsule& capsule, double tolerance_m) {
  const double least_half =
      0.5 * kCavityCell * std::max(capsule.a().radius_m, capsule.b().radius_m);
  std::vector<Cube> cubes = {BoundingCube(capsule)};
  for (int visited = 0; !cubes.empty(); ++visited) {
    if (visited >= kMaxCells) return false;
    const Cube cube = cubes.back();
    cubes.pop_back();
    const double reach = std::sqrt(3.0) * cube.half;
    const double own = capsule.SignedDistance(cube.center);
    if (own >= reach) continue;  // outside the capsule
    const double distance = cover.Distance(cube.center);
    if (own <= 0.0 && distance > tolerance_m) return false;
    if (distance + reach <= tolerance_m || cube.half <= least_half) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d step(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      cubes.push_back({cube.center + 0.5 * cube.half * step, 0.5 * cube.half});
    }
  }
  return true;
}

// Capsules that go or stay together: one, or a mirrored pair.
struct Group {
  std::array<int, 2> capsules{-1, -1};
  double volume_m3 = 0.0;
};

class Remover {
 public:
  Remover(PrimitiveSet& set, double tolerance_m)
      : set_(set),
        images_(ImagesOf(set)),
        tolerance_m_(tolerance_m),
        is_gone_(set.capsules.size(), false) {
    MakeGroups();
  }

  // The small ones first: a large capsule is worth more to the others. What one answer says stays
  // true when more is removed, for a cover only shrinks; so each group is asked once.
  void Run() {
    std::stable_sort(groups_.begin(), groups_.end(),
                     [](const Group& a, const Group& b) { return a.volume_m3 < b.volume_m3; });
    for (const Group& group : groups_) RemoveIf(group, &Remover::IsCoveredByOne);
    for (const Group& group : groups_) RemoveIf(group, &Remover::IsCoveredByUnion);
    std::vector<CapsuleEnds> kept;
    for (std::size_t i = 0; i < set_.capsules.size(); ++i) {
      if (!is_gone_[i]) kept.push_back(set_.capsules[i]);
    }
    set_.capsules = std::move(kept);
  }

 private:
  using Test = bool (Remover::*)(const TaperedCapsule&, const Cover&) const;

  void MakeGroups() {
    for (int i = 0; i < static_cast<int>(set_.capsules.size()); ++i) {
      const int image = images_.capsules[static_cast<std::size_t>(i)];
      if (image >= 0 && image < i) continue;  // its group is there already
      groups_.push_back(
          {{i, image == i ? -1 : image}, set_.Capsule(static_cast<std::size_t>(i)).Volume_m3()});
    }
  }

  void RemoveIf(const Group& group, Test is_covered) {
    if (is_gone_[static_cast<std::size_t>(group.capsules[0])]) return;
    const TaperedCapsule capsule = set_.Capsule(static_cast<std::size_t>(group.capsules[0]));
    if (!(this->*is_covered)(capsule, CoverWithout(group, capsule))) return;
    for (const int i : group.capsules) {
      if (i >= 0) is_gone_[static_cast<std::size_t>(i)] = true;
    }
  }

  // All others that come near; and the spheres, which stay.
  Cover CoverWithout(const Group& group, const TaperedCapsule& capsule) const {
    const Eigen::Vector3d middle = 0.5 * (capsule.a().center_m + capsule.b().center_m);
    const double reach = 0.5 * capsule.length_m() +
                         std::max(capsule.a().radius_m, capsule.b().radius_m) + tolerance_m_;
    Cover cover;
    const auto add = [&](const TaperedCapsule& solid) {
      if (solid.SignedDistance(middle) <= reach) cover.solids.push_back(solid);
    };
    for (int i = 0; i < static_cast<int>(set_.capsules.size()); ++i) {
      const auto index = static_cast<std::size_t>(i);
      if (is_gone_[index] || i == group.capsules[0] || i == group.capsules[1]) continue;
      add(set_.Capsule(index));
    }
    for (const Sphere& sphere : set_.spheres) add({sphere, sphere});
    return cover;
  }

  bool IsCoveredByOne(const TaperedCapsule& capsule, const Cover& cover) const {
    // A capsule that one of its ends swallows is that sphere.
    return capsule.IsSphere() || cover.ContainsWhole(capsule);
  }

  // The caps need no look: they are part of the end spheres.
  bool IsCoveredByUnion(const TaperedCapsule& capsule, const Cover& cover) const {
    return CoversSlant(cover, capsule, tolerance_m_) && CoversInside(cover, capsule, tolerance_m_);
  }

  PrimitiveSet& set_;
  Images images_;  // of the set as it came
  double tolerance_m_;
  std::vector<bool> is_gone_;
  std::vector<Group> groups_;
};

// Spheres that no capsule uses and that one of the others contains.
std::vector<bool> FindIdleSpheres(const PrimitiveSet& set) {
  std::vector<bool> is_idle = UsedSpheres(set);
  is_idle.flip();
  for (std::size_t i = 0; i < set.spheres.size(); ++i) {
    if (!is_idle[i]) continue;
    bool is_covered = false;
    for (std::size_t k = 0; k < set.capsules.size() && !is_covered; ++k) {
      is_covered = set.Capsule(k).Contains(set.spheres[i]);
    }
    is_idle[i] = is_covered;
  }
  // An image with a rounding error of its own must not leave its partner behind.
  for (std::size_t i = 0; i < set.spheres.size(); ++i) {
    const int mirror = set.origins[i].mirror;
    if (mirror >= 0 && !is_idle[static_cast<std::size_t>(mirror)]) is_idle[i] = false;
  }
  return is_idle;
}

void RemoveIdleSpheres(PrimitiveSet& set) {
  std::vector<char> kept;
  for (const bool is_idle : FindIdleSpheres(set)) kept.push_back(!is_idle);
  MirroredSet rest(std::move(set), /*is_mirrored=*/false);  // pairs go or stay together already
  rest.KeepOnly(kept, std::vector<char>(rest.capsules().size(), 1));
  set = rest.set();
}

}  // namespace

void RemoveCoveredCapsules(PrimitiveSet& set, double tolerance_m) {
  Remover(set, tolerance_m).Run();
  RemoveIdleSpheres(set);
}

}  // namespace capfit::capsule
