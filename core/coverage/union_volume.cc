#include "core/coverage/union_volume.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/random.h"

namespace capfit::coverage {
namespace {

using geometry::Sphere;
using geometry::TaperedCapsule;

// Samples fade out over this many spacings on either side of the border where another solid begins
// to hide them. The gradient follows the set smoothly that way: no sample comes or goes at once.
constexpr double kFade = 0.1;
constexpr int kMinRings = 2;
constexpr int kMinRingPoints = 8;
constexpr int kMinSpherePoints = 24;
constexpr int kMaxCount = 4096;

int CountFor(double length, double spacing, int least) {
  return std::clamp(static_cast<int>(std::lround(length / spacing)), least, kMaxCount);
}

// What one solid or sphere contributes.
struct Share {
  Eigen::Vector4d a = Eigen::Vector4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  double area = 0.0;
  double moment = 0.0;  // integral of (point - origin) . normal
};

class Sampler {
 public:
  Sampler(const capsule::PrimitiveSet& set, const std::vector<Solid>& solids, double spacing_m,
          std::uint64_t seed)
      : set_(set),
        solids_(solids),
        shapes_(ShapesOf(solids, set)),
        spacing_(spacing_m),
        fade_(kFade * spacing_m),
        seed_(seed) {
    for (const Sphere& sphere : set.spheres) origin_ += sphere.center_m;
    if (!set.spheres.empty()) origin_ /= static_cast<double>(set.spheres.size());
  }

  Share Slant(std::size_t index) const {
    Share share;
    const TaperedCapsule& capsule = shapes_[index];
    if (capsule.IsSphere()) return share;
    Random random(seed_ ^ (index * 0x9E3779B9u));
    const std::vector<const TaperedCapsule*> others = Neighbours(
        0.5 * (capsule.a().center_m + capsule.b().center_m),
        0.5 * capsule.length_m() + std::max(capsule.a().radius_m, capsule.b().radius_m), &capsule);
    const double slant_length = capsule.length_m() * capsule.cos_half_angle();
    const int rings = CountFor(slant_length, spacing_, kMinRings);
    for (int ring = 0; ring < rings; ++ring) {
      const double t = (ring + random.NextUnit()) / rings;
      Ring(capsule, t, slant_length / rings, random.NextUnit(), others, share);
    }
    return share;
  }

  // The caps of a sphere, once however many capsules share it.
  Share Caps(std::size_t index) const {
    Share share;
    const Sphere& sphere = set_.spheres[index];
    const Surroundings around = SurroundingsOf(index);
    const double area = 4.0 * std::numbers::pi * sphere.radius_m * sphere.radius_m;
    const int count = CountFor(area, spacing_ * spacing_, kMinSpherePoints);
    Random random(seed_ ^ (~index * 0x9E3779B9u));
    const double turn = random.NextUnit();
    for (int i = 0; i < count; ++i) {
      const double z = 1.0 - 2.0 * (i + 0.5) / count;
      const double angle = 2.0 * std::numbers::pi * (i / std::numbers::phi + turn);
      const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
      const Eigen::Vector3d normal(r * std::cos(angle), r * std::sin(angle), z);
      double seen = 1.0;
      for (const Cut& cut : around.cuts) {
        seen *= Seen(sphere.radius_m * (cut.sine - normal.dot(cut.axis)));
      }
      if (seen == 0.0) continue;
      Add(sphere.center_m + sphere.radius_m * normal, normal, seen * area / count, 0.0,
          around.others, share);
    }
    return share;
  }

  VolumeGradient Combine(const std::vector<Solid>& solids, const std::vector<Share>& slants,
                         const std::vector<Share>& caps) const {
    VolumeGradient result;
    result.by_sphere.assign(set_.spheres.size(), Eigen::Vector4d::Zero());
    for (std::size_t k = 0; k < solids.size(); ++k) {
      result.by_sphere[static_cast<std::size_t>(solids[k].ends[0])] += slants[k].a;
      result.by_sphere[static_cast<std::size_t>(solids[k].ends[1])] += slants[k].b;
      result.area_m2 += slants[k].area;
      result.volume_m3 += slants[k].moment / 3.0;
    }
    for (std::size_t i = 0; i < caps.size(); ++i) {
      result.by_sphere[i] += caps[i].a;
      result.area_m2 += caps[i].area;
      result.volume_m3 += caps[i].moment / 3.0;
    }
    return result;
  }

 private:
  // A capsule hides the part of its end sphere beyond the circle where they touch: there both run
  // on smoothly, so that their distance tells nothing.
  struct Cut {
    Eigen::Vector3d axis;  // into the capsule
    double sine;           // of the normals on the circle
  };
  struct Surroundings {
    std::vector<Cut> cuts;
    std::vector<const TaperedCapsule*> others;
  };

  Surroundings SurroundingsOf(std::size_t sphere_index) const {
    const Sphere& sphere = set_.spheres[sphere_index];
    const int self = static_cast<int>(sphere_index);
    Surroundings around;
    for (std::size_t k = 0; k < shapes_.size(); ++k) {
      const TaperedCapsule& shape = shapes_[k];
      const bool is_first = solids_[k].ends[0] == self;
      if (is_first || solids_[k].ends[1] == self) {
        const double way = is_first ? 1.0 : -1.0;
        if (!shape.IsSphere()) {
          around.cuts.push_back({way * shape.axis(), way * shape.sin_half_angle()});
          continue;
        }
        // Swallowed by this sphere: nothing else is there.
        if (std::max(shape.a().radius_m, shape.b().radius_m) <= sphere.radius_m) continue;
      }
      if (shape.SignedDistance(sphere.center_m) < sphere.radius_m + fade_) {
        around.others.push_back(&shape);
      }
    }
    return around;
  }

  // Share of a sample that is seen at a distance from a solid.
  double Seen(double distance_m) const {
    const double u = std::clamp(0.5 + 0.5 * distance_m / fade_, 0.0, 1.0);
    return u * u * (3.0 - 2.0 * u);
  }

  // Solids other than `self` that reach into a ball.
  std::vector<const TaperedCapsule*> Neighbours(const Eigen::Vector3d& center, double reach,
                                                const TaperedCapsule* self) const {
    std::vector<const TaperedCapsule*> near;
    for (const TaperedCapsule& shape : shapes_) {
      if (&shape != self && shape.SignedDistance(center) < reach + fade_) near.push_back(&shape);
    }
    return near;
  }

  void Ring(const TaperedCapsule& capsule, double t, double width, double turn,
            const std::vector<const TaperedCapsule*>& others, Share& share) const {
    const Eigen::Vector3d center = (1 - t) * capsule.a().center_m + t * capsule.b().center_m;
    const double radius = (1 - t) * capsule.a().radius_m + t * capsule.b().radius_m;
    std::vector<const TaperedCapsule*> near;
    for (const TaperedCapsule* other : others) {
      const double distance = other->SignedDistance(center);
      if (distance < -radius - fade_) return;  // hides the ring
      if (distance < radius + fade_) near.push_back(other);
    }
    const double girth = 2.0 * std::numbers::pi * radius * capsule.cos_half_angle();
    const int count = CountFor(girth, spacing_, kMinRingPoints);
    const Eigen::Vector3d first = capsule.axis().unitOrthogonal();
    const Eigen::Vector3d second = capsule.axis().cross(first);
    for (int i = 0; i < count; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + turn) / count;
      const Eigen::Vector3d normal =
          capsule.sin_half_angle() * capsule.axis() +
          capsule.cos_half_angle() * (std::cos(angle) * first + std::sin(angle) * second);
      Add(center + radius * normal, normal, girth * width / count, t, near, share);
    }
  }

  void Add(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double area, double t,
           const std::vector<const TaperedCapsule*>& others, Share& share) const {
    for (const TaperedCapsule* other : others) {
      area *= Seen(other->SignedDistance(point));
      if (area == 0.0) return;
    }
    const Eigen::Vector4d speed(normal.x(), normal.y(), normal.z(), 1.0);
    share.a += area * (1 - t) * speed;
    share.b += area * t * speed;
    share.area += area;
    share.moment += area * normal.dot(point - origin_);
  }

  const capsule::PrimitiveSet& set_;
  const std::vector<Solid>& solids_;
  std::vector<TaperedCapsule> shapes_;
  double spacing_;
  double fade_;
  std::uint64_t seed_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
};

}  // namespace

VolumeGradient UnionVolumeGradient(const capsule::PrimitiveSet& set,
                                   const std::vector<Solid>& solids, double spacing_m,
                                   std::uint64_t seed, const ThreadPool& pool) {
  const Sampler sampler(set, solids, spacing_m, seed);
  std::vector<Share> slants(solids.size());
  std::vector<Share> caps(set.spheres.size());
  pool.ForEach(solids.size() + set.spheres.size(), [&](std::size_t i) {
    if (i < solids.size()) {
      slants[i] = sampler.Slant(i);
    } else {
      caps[i - solids.size()] = sampler.Caps(i - solids.size());
    }
  });
  return sampler.Combine(solids, slants, caps);
}

}  // namespace capfit::coverage
