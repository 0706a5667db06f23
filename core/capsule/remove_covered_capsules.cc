#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>
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
// The inside is looked at on so many cones, of 1/10, 2/10 ... of the capsule's radii. The outermost
// is its surface; a cavity that fits between two is of no consequence.
constexpr int kCones = 10;

// Which of a cover's solids may be nearest somewhere in a cell: a stretch of its list of them.
struct Candidates {
  std::size_t first = 0;
  std::size_t last = 0;
};

struct Nearest {
  double distance_m = std::numeric_limits<double>::infinity();
  const TaperedCapsule* solid = nullptr;
};

// What remains of the set when some of it is left out.
class Cover {
 public:
  explicit Cover(std::vector<TaperedCapsule> solids) : solids_(std::move(solids)) {}

  [[nodiscard]] bool ContainsWhole(const TaperedCapsule& capsule) const {
    return std::any_of(solids_.begin(), solids_.end(), [&](const TaperedCapsule& solid) {
      return solid.Contains(capsule.a()) && solid.Contains(capsule.b());
    });
  }

  // For the first cells; what was handed out before is void.
  Candidates All() {
    listed_.resize(solids_.size());
    std::iota(listed_.begin(), listed_.end(), std::uint32_t{0});
    return {0, listed_.size()};
  }

  // What is nearest to the middle of a cell; and in place of `candidates`, which are those of a
  // cell that contains it, its own. A solid that is more than twice the cell's reach further than
  // the nearest is nearest nowhere in it, as distances change no faster than points move.
  Nearest Look(const Eigen::Vector3d& middle, double reach_m, Candidates& candidates) {
    distances_.clear();
    Nearest nearest;
    for (std::size_t i = candidates.first; i < candidates.last; ++i) {
      const TaperedCapsule& solid = solids_[listed_[i]];
      distances_.push_back(solid.SignedDistance(middle));
      if (distances_.back() < nearest.distance_m) nearest = {distances_.back(), &solid};
    }
    const std::size_t begin = listed_.size();
    for (std::size_t i = 0; i < distances_.size(); ++i) {
      if (distances_[i] > nearest.distance_m + 2.0 * reach_m + kRoundingM) continue;
      listed_.push_back(listed_[candidates.first + i]);
    }
    candidates = {begin, listed_.size()};
    return nearest;
  }

 private:
  static constexpr double kRoundingM = 1e-9;

  std::vector<TaperedCapsule> solids_;
  std::vector<std::uint32_t> listed_;  // indices of solids, cell by cell
  std::vector<double> distances_;      // of one cell
};

// The cone between the two tangent circles of a capsule, or of one with the same centres and a
// share of its radii, with coordinates u along the slant and v round the axis, both in [0, 1].
class Slant {
 public:
  Slant(const TaperedCapsule& whole, double share)
      : whole_(whole), capsule_(Scaled(whole.a(), share), Scaled(whole.b(), share)) {
    const Eigen::Vector3d& axis = capsule_.axis();
    const Eigen::Vector3d helper =
        std::abs(axis.x()) < 0.6 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
    first_ = axis.cross(helper).normalized();
    second_ = axis.cross(first_);
  }
  Eigen::Vector3d At(double u, double v) const { return At(u, v, 1.0); }
  // `stretch` times as far from the axis.
  Eigen::Vector3d At(double u, double v, double stretch) const {
    const double angle = 2.0 * std::numbers::pi * v;
    const Eigen::Vector3d outward = std::cos(angle) * first_ + std::sin(angle) * second_;
    const Eigen::Vector3d normal =
        capsule_.sin_half_angle() * capsule_.axis() + stretch * capsule_.cos_half_angle() * outward;
    return (1 - u) * capsule_.a().center_m + u * capsule_.b().center_m +
           ((1 - u) * capsule_.a().radius_m + u * capsule_.b().radius_m) * normal;
  }
  double length() const { return capsule_.length_m() * capsule_.cos_half_angle(); }
  // Where, in u, it leaves the whole capsule's end spheres, made larger by the tolerance, and
  // enters the second. It leaves the tangent circles along tangents.
  std::pair<double, double> BetweenEnds(double tolerance_m) const {
    const auto held = [&](const Sphere& whole, const Sphere& own) {
      const double reach = whole.radius_m + tolerance_m;
      return std::sqrt(reach * reach - own.radius_m * own.radius_m) / length();
    };
    return {held(whole_.a(), capsule_.a()), 1.0 - held(whole_.b(), capsule_.b())};
  }
  double girth() const {
    return 2.0 * std::numbers::pi * capsule_.cos_half_angle() *
           std::max(capsule_.a().radius_m, capsule_.b().radius_m);
  }

 private:
  static Sphere Scaled(const Sphere& sphere, double share) {
    return {sphere.center_m, share * sphere.radius_m};
  }

  const TaperedCapsule& whole_;
  TaperedCapsule capsule_;
  Eigen::Vector3d first_;
  Eigen::Vector3d second_;
};

// A rectangle on the slant.
struct Patch {
  double u = 0.5;
  double v = 0.5;
  double half_u = 0.5;
  double half_v = 0.5;
  Candidates candidates;
};

// Points whose convex hull contains the patch: the ends of its two arcs, and where the tangents at
// an arc's ends meet.
std::array<Eigen::Vector3d, 6> HullOf(const Patch& patch, const Slant& slant) {
  const double to_tangents = 1.0 / std::cos(2.0 * std::numbers::pi * patch.half_v);
  std::array<Eigen::Vector3d, 6> points;
  auto* next = points.begin();
  for (const double u : {patch.u - patch.half_u, patch.u + patch.half_u}) {
    *next++ = slant.At(u, patch.v - patch.half_v);
    *next++ = slant.At(u, patch.v, to_tangents);
    *next++ = slant.At(u, patch.v + patch.half_v);
  }
  return points;
}

// A solid is convex, and so is what is no further than the tolerance from it.
bool ContainsAll(const TaperedCapsule& solid, std::span<const Eigen::Vector3d> points,
                 double tolerance_m) {
  return std::all_of(points.begin(), points.end(), [&](const Eigen::Vector3d& point) {
    return solid.SignedDistance(point) <= tolerance_m;
  });
}

// Whether no point of the slant is further than `tolerance_m` outside the cover. What is nearest to
// a patch's middle contains all of it, or it is cut.
bool CoversSlant(Cover& cover, const Slant& slant, double tolerance_m) {
  const auto [begin, end] = slant.BetweenEnds(tolerance_m);
  const double width = end - begin;
  if (!(width > 0.0)) return true;
  const Candidates all = cover.All();
  std::vector<Patch> patches;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 8; ++j) {
      patches.push_back(
          {begin + width * (i + 0.5) / 4, (j + 0.5) / 8, width * 0.5 / 4, 0.5 / 8, all});
    }
  }
  // Breadth first: an exposed point is found before much is certified.
  for (std::size_t next = 0; next < patches.size(); ++next) {
    if (next >= kMaxCells) return false;
    Patch patch = patches[next];
    const double half_length = patch.half_u * slant.length();
    const double half_girth = patch.half_v * slant.girth();
    const double reach = half_length + half_girth;
    const Nearest nearest = cover.Look(slant.At(patch.u, patch.v), reach, patch.candidates);
    if (nearest.distance_m > tolerance_m) return false;
    if (ContainsAll(*nearest.solid, HullOf(patch, slant), tolerance_m)) continue;
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
  using Test = bool (Remover::*)(const TaperedCapsule&, Cover&) const;

  void MakeGroups() {
    for (int i = 0; i < static_cast<int>(set_.capsules.size()); ++i) {
      const int image = images_.capsules[i];
      if (image >= 0 && image < i) continue;  // its group is there already
      groups_.push_back({{i, image == i ? -1 : image}, set_.Capsule(i).Volume_m3()});
    }
  }

  void RemoveIf(const Group& group, Test is_covered) {
    if (is_gone_[group.capsules[0]]) return;
    const TaperedCapsule capsule = set_.Capsule(group.capsules[0]);
    Cover cover = CoverWithout(group, capsule);
    if (!(this->*is_covered)(capsule, cover)) return;
    for (const int i : group.capsules) {
      if (i >= 0) is_gone_[i] = true;
    }
  }

  // All others that come near; and the spheres, which stay.
  Cover CoverWithout(const Group& group, const TaperedCapsule& capsule) const {
    const Eigen::Vector3d middle = 0.5 * (capsule.a().center_m + capsule.b().center_m);
    const double reach = 0.5 * capsule.length_m() +
                         std::max(capsule.a().radius_m, capsule.b().radius_m) + tolerance_m_;
    std::vector<TaperedCapsule> solids;
    const auto add = [&](const TaperedCapsule& solid) {
      if (solid.SignedDistance(middle) <= reach) solids.push_back(solid);
    };
    for (int i = 0; i < static_cast<int>(set_.capsules.size()); ++i) {
      if (is_gone_[i] || i == group.capsules[0] || i == group.capsules[1]) continue;
      add(set_.Capsule(i));
    }
    for (const Sphere& sphere : set_.spheres) add({sphere, sphere});
    return Cover(std::move(solids));
  }

  bool IsCoveredByOne(const TaperedCapsule& capsule, Cover& cover) const {
    // A capsule that one of its ends swallows is that sphere.
    return capsule.IsSphere() || cover.ContainsWhole(capsule);
  }

  // What is not between the cones is part of the end spheres.
  bool IsCoveredByUnion(const TaperedCapsule& capsule, Cover& cover) const {
    for (int i = kCones; i > 0; --i) {
      if (!CoversSlant(cover, Slant(capsule, static_cast<double>(i) / kCones), tolerance_m_)) {
        return false;
      }
    }
    return true;
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
    if (mirror >= 0 && !is_idle[mirror]) is_idle[i] = false;
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
