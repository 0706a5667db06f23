#include "core/tighten/union_volume.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/random.h"
#include "core/tighten/distance_kernel.h"
#include "core/tighten/solid_table.h"
#include "core/tighten/surface_samples.h"

namespace capfit::tighten {
namespace {

using geometry::Sphere;
using geometry::TaperedCapsule;

// Samples fade out over this many spacings on either side of the border where another solid begins
// to hide them. The gradient follows the set smoothly that way: no sample comes or goes at once.
constexpr double kFade = 0.1;
// Spheres no further from each other, centres and radii together, have one surface.
constexpr double kSamePlace = 2.0;  // in fades
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
  double volume = 0.0;  // flux of the flow below; the shares' sum is the volume
};

class Sampler {
 public:
  Sampler(const capsule::PrimitiveSet& set, const SetVariables& variables, double spacing_m,
          std::uint64_t seed, const FullCells* full)
      : set_(set),
        variables_(variables),
        solids_(variables.solids()),
        shapes_(capsule::Solids(set)),
        table_(shapes_),
        spacing_(spacing_m),
        fade_(kFade * spacing_m),
        half_over_fade_(static_cast<float>(0.5 / fade_)),
        seed_(seed),
        full_(full),
        places_(FindPlaces()) {
    if (set.spheres.empty()) return;
    for (const Sphere& sphere : set.spheres) origin_ += sphere.center_m;
    origin_ /= static_cast<double>(set.spheres.size());
    Eigen::Array3d spread = Eigen::Array3d::Constant(1e-12);
    for (const Sphere& sphere : set.spheres) {
      spread += (sphere.center_m - origin_).array().square() + sphere.radius_m * sphere.radius_m;
    }
    flow_ = spread.inverse() / spread.inverse().sum();
  }

  Share Slant(std::size_t index) const {
    Share share;
    const TaperedCapsule& capsule = shapes_[index];
    if (capsule.IsSphere()) return share;
    Random random(seed_ ^ (index * 0x9E3779B9u));
    const Eigen::Vector3d middle = 0.5 * (capsule.a().center_m + capsule.b().center_m);
    const double reach =
        0.5 * capsule.length_m() + std::max(capsule.a().radius_m, capsule.b().radius_m);
    const Slanted slanted = {capsule, middle, NeighboursOf(middle, reach, index)};
    const double slant_length = capsule.length_m() * capsule.cos_half_angle();
    const int rings = CountFor(slant_length, spacing_, kMinRings);
    Hiding hiding;
    for (int ring = 0; ring < rings; ++ring) {
      const double t = (ring + random.NextUnit()) / rings;
      Ring(slanted, {t, slant_length / rings, random.NextUnit()}, hiding, share);
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
    Turner turner(2.0 * std::numbers::pi * random.NextUnit(),
                  2.0 * std::numbers::pi / std::numbers::phi);
    const auto radius = static_cast<float>(sphere.radius_m);
    Samples samples;
    Samples seen;  // where no cut is: few of them on a sphere between capsules
    const auto finish = [&] {
      seen.FillUp();
      for (const FloatKernel& other : around.others) HideBehind(other, seen);
      Collect(seen, sphere.center_m, area / count, 0.0, share);
    };
    for (int i = 0; i < count; ++i, turner.Next()) {
      const double z = 1.0 - 2.0 * (i + 0.5) / count;
      const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
      const Eigen::Vector3d normal(r * turner.cosine, r * turner.sine, z);
      samples.Add(normal.cast<float>(), Eigen::Vector3f::Zero(), radius);
      if (!samples.IsFull() && i + 1 < count) continue;
      samples.FillUp();
      for (const Cut& cut : around.cuts) Hide(cut, radius, samples);
      samples.MoveSeen(seen, finish);
    }
    finish();
    return share;
  }

  // `slants` and `caps` of what is no image of an earlier one.
  VolumeGradient Combine(const std::vector<Share>& slants, const std::vector<Share>& caps) const {
    VolumeGradient result;
    result.by_sphere.assign(set_.spheres.size(), Eigen::Vector4d::Zero());
    const auto add = [&](const Share& share) {
      result.area_m2 += share.area;
      result.volume_m3 += share.volume;
    };
    for (std::size_t k = 0; k < solids_.size(); ++k) {
      const auto [first, second] = solids_[k];
      const std::size_t image = variables_.image_of_solid(k);
      const Share& share = slants[std::min(k, image)];
      add(share);
      if (image >= k) {
        result.by_sphere[first] += share.a;
        result.by_sphere[second] += share.b;
      } else {
        const bool in_order = std::cmp_equal(variables_.image_of_sphere(solids_[image][0]), first);
        result.by_sphere[first] += Mirrored(in_order ? share.a : share.b);
        result.by_sphere[second] += Mirrored(in_order ? share.b : share.a);
      }
    }
    for (std::size_t i = 0; i < caps.size(); ++i) {
      const std::size_t image = variables_.image_of_sphere(i);
      const Share& share = caps[std::min(i, image)];
      add(share);
      result.by_sphere[i] += image >= i ? share.a : Mirrored(share.a);
    }
    return result;
  }

 private:
  static Eigen::Vector4d Mirrored(const Eigen::Vector4d& x) { return {-x[0], x[1], x[2], x[3]}; }

  // A solid that may hide part of a capsule. Where the two share an end sphere both run on smoothly
  // into it, each in turn at distance 0 from the other: there only what lies past the joint hides.
  struct Neighbour {
    FloatKernel kernel;    // as seen from the capsule's middle
    float joint_m = 0.0f;  // where the solid leaves the shared sphere, along the kernel's axis
    float way = 0.0f;      // 1 or -1: to where on that axis; 0: no shared sphere
  };

  // A capsule with what is around it.
  struct Slanted {
    const TaperedCapsule& capsule;
    Eigen::Vector3d middle;
    std::vector<Neighbour> others;
  };

  // Samples around a capsule at an axis parameter.
  struct RingPlace {
    double t;
    double width;  // of the slant that they stand for
    double turn;   // of the first one, in steps
  };

  // What may hide parts of a ring; kept from ring to ring for its memory.
  struct Hiding {
    std::vector<const FloatKernel*> near;
    std::vector<const Neighbour*> joined;
  };

  // Of all solids from a place.
  std::vector<double> DistancesFrom(const Eigen::Vector3d& place) const {
    std::vector<double> distances;
    table_.DistancesFrom(place, distances);
    return distances;
  }

  // A capsule hides the part of its end sphere beyond the circle where they touch: there both run
  // on smoothly, so that their distance tells nothing.
  struct Cut {
    Eigen::Vector3f axis;  // into the capsule
    float sine;            // of the normals on the circle
  };
  struct Surroundings {
    std::vector<Cut> cuts;
    std::vector<FloatKernel> others;  // as seen from the sphere's centre
  };

  // By sphere: the first one that it coincides with, or itself.
  std::vector<int> FindPlaces() const {
    const std::vector<Sphere>& spheres = set_.spheres;
    std::vector<int> places(spheres.size());
    for (std::size_t j = 0; j < spheres.size(); ++j) {
      places[j] = static_cast<int>(j);
      for (std::size_t i = 0; i < j; ++i) {
        const double apart_m = (spheres[j].center_m - spheres[i].center_m).norm() +
                               std::abs(spheres[j].radius_m - spheres[i].radius_m);
        if (apart_m > kSamePlace * fade_) continue;
        places[j] = places[i];
        break;
      }
    }
    return places;
  }
  int PlaceOf(int sphere) const { return places_[sphere]; }

  Surroundings SurroundingsOf(std::size_t sphere_index) const {
    const Sphere& sphere = set_.spheres[sphere_index];
    const std::vector<double> distances = DistancesFrom(sphere.center_m);
    Surroundings around;
    const int place = places_[sphere_index];
    for (std::size_t j = 0; j < places_.size(); ++j) {
      if (j == sphere_index || places_[j] != place) continue;
      // Each hides half of the other, however many capsules that has.
      const TaperedCapsule other(set_.spheres[j], set_.spheres[j]);
      around.others.push_back(KernelAround(DistanceKernel(other), sphere.center_m));
    }
    for (std::size_t k = 0; k < shapes_.size(); ++k) {
      const TaperedCapsule& shape = shapes_[k];
      const bool is_first = PlaceOf(solids_[k][0]) == place;
      const bool is_second = PlaceOf(solids_[k][1]) == place;
      if (is_first && is_second) continue;
      if (is_first || is_second) {
        const double way = is_first ? 1.0 : -1.0;
        if (!shape.IsSphere()) {
          around.cuts.push_back({(way * shape.axis()).cast<float>(),
                                 static_cast<float>(way * shape.sin_half_angle())});
          continue;
        }
        // Swallowed by this sphere: nothing else is there.
        if (std::max(shape.a().radius_m, shape.b().radius_m) <= sphere.radius_m) continue;
      }
      if (distances[k] < sphere.radius_m + fade_) {
        around.others.push_back(KernelAround(table_.kernel(k), sphere.center_m));
      }
    }
    return around;
  }

  // Share of a sample that is seen at a distance from a solid.
  float Seen(float distance_m) const {
    float u = 0.5f + half_over_fade_ * distance_m;
    u = u > 0.0f ? u : 0.0f;
    u = u < 1.0f ? u : 1.0f;
    return u * u * (3.0f - 2.0f * u);
  }

  // Solids other than `self` that reach into a ball.
  std::vector<Neighbour> NeighboursOf(const Eigen::Vector3d& center, double reach,
                                      std::size_t self) const {
    const capsule::CapsuleEnds& own = solids_[self];
    const auto is_shared = [&](int end) {
      return PlaceOf(end) == PlaceOf(own[0]) || PlaceOf(end) == PlaceOf(own[1]);
    };
    const std::vector<double> distances = DistancesFrom(center);
    std::vector<Neighbour> near;
    for (std::size_t k = 0; k < shapes_.size(); ++k) {
      if (k == self || distances[k] >= reach + fade_) continue;
      const bool shares_a = is_shared(solids_[k][0]);
      const bool shares_b = is_shared(solids_[k][1]);
      const TaperedCapsule& shape = shapes_[k];
      Neighbour neighbour{KernelAround(table_.kernel(k), center)};
      if (shape.IsSphere()) {
        // Nothing of a capsule lies within its own end sphere.
        if (shape.a().radius_m >= shape.b().radius_m ? shares_a : shares_b) continue;
      } else if (shares_a != shares_b) {
        neighbour.joint_m = shares_a ? neighbour.kernel.lowest : neighbour.kernel.highest;
        neighbour.way = shares_a ? 1.0f : -1.0f;
      }
      near.push_back(neighbour);
    }
    return near;
  }

  void Ring(const Slanted& slanted, const RingPlace& place, Hiding& hiding, Share& share) const {
    const TaperedCapsule& capsule = slanted.capsule;
    const double t = place.t;
    const Eigen::Vector3d axis_point = (1 - t) * capsule.a().center_m + t * capsule.b().center_m;
    const Eigen::Vector3f center = (axis_point - slanted.middle).cast<float>();
    const double radius = (1 - t) * capsule.a().radius_m + t * capsule.b().radius_m;
    std::vector<const FloatKernel*>& near = hiding.near;
    std::vector<const Neighbour*>& joined = hiding.joined;
    near.clear();
    joined.clear();
    for (const Neighbour& other : slanted.others) {
      const float distance = other.kernel.SignedDistance(center.x(), center.y(), center.z());
      if (distance < -radius - fade_) return;  // hides the ring
      if (distance >= radius + fade_) continue;
      if (other.way == 0.0f) {
        near.push_back(&other.kernel);
      } else {
        joined.push_back(&other);
      }
    }
    const double girth = 2.0 * std::numbers::pi * radius * capsule.cos_half_angle();
    const int count = CountFor(girth, spacing_, kMinRingPoints);
    const Eigen::Vector3d first = capsule.cos_half_angle() * capsule.axis().unitOrthogonal();
    const Eigen::Vector3d second = capsule.axis().cross(first);
    const Eigen::Vector3d along = capsule.sin_half_angle() * capsule.axis();
    Turner turner(2.0 * std::numbers::pi * place.turn / count, 2.0 * std::numbers::pi / count);
    Samples samples;
    for (int i = 0; i < count; ++i, turner.Next()) {
      const Eigen::Vector3d normal = along + turner.cosine * first + turner.sine * second;
      samples.Add(normal.cast<float>(), center, static_cast<float>(radius));
      if (!samples.IsFull() && i + 1 < count) continue;
      samples.FillUp();
      for (const FloatKernel* other : near) HideBehind(*other, samples);
      for (const Neighbour* other : joined) HideBehindJoined(*other, samples);
      Collect(samples, slanted.middle, girth * place.width / count, t, share);
    }
  }

  void Hide(const Cut& cut, float radius, Samples& samples) const {
    samples.Hide([&](std::size_t i) {
      const float along = samples.nx[i] * cut.axis.x() + samples.ny[i] * cut.axis.y() +
                          samples.nz[i] * cut.axis.z();
      return Seen(radius * (cut.sine - along));
    });
  }

  void HideBehind(const FloatKernel& other, Samples& samples) const {
    samples.Hide([&](std::size_t i) {
      return Seen(other.SignedDistance(samples.x[i], samples.y[i], samples.z[i]));
    });
  }

  void HideBehindJoined(const Neighbour& other, Samples& samples) const {
    const auto fade = static_cast<float>(fade_);
    samples.Hide([&](std::size_t i) {
      const auto [distance, foot] = other.kernel.Locate(samples.x[i], samples.y[i], samples.z[i]);
      const float past_joint = Seen(other.way * (foot - other.joint_m) - fade);
      return 1.0f - past_joint * (1.0f - Seen(distance));
    });
  }

  // Adds what is still seen of the samples, each of that area, and starts them anew. `from`: where
  // they are seen from.
  void Collect(Samples& samples, const Eigen::Vector3d& from, double area, double t,
               Share& share) const {
    const Eigen::Array3d offset = from - origin_;
    Eigen::Array4d speed = Eigen::Array4d::Zero();
    Eigen::Array3d flux = Eigen::Array3d::Zero();
    double seen_area = 0.0;
    for (int i = 0; i < samples.count; ++i) {
      const Eigen::Array3d normal(samples.nx[i], samples.ny[i], samples.nz[i]);
      const Eigen::Array3d point(samples.x[i], samples.y[i], samples.z[i]);
      const double seen = samples.seen[i];
      if (seen == 0.0) continue;
      seen_area += seen;
      const bool is_in_hollow = full_ != nullptr && full_->Holds(from + point.matrix());
      const double side = is_in_hollow ? -seen : seen;
      speed += side * Eigen::Array4d(normal.x(), normal.y(), normal.z(), 1.0);
      flux += side * normal * (point + offset);
    }
    speed *= area;
    flux *= area;
    share.volume += (flux * flow_).sum();
    share.a += (1 - t) * speed.matrix();
    share.b += t * speed.matrix();
    share.area += area * seen_area;
    samples.count = 0;
  }

  const capsule::PrimitiveSet& set_;
  const SetVariables& variables_;
  const std::vector<capsule::CapsuleEnds>& solids_;
  std::vector<TaperedCapsule> shapes_;
  SolidTable table_;  // of the same solids
  double spacing_;
  double fade_;
  float half_over_fade_;
  std::uint64_t seed_;
  const FullCells* full_;    // or nullptr
  std::vector<int> places_;  // by sphere; equal for those that coincide
  // The volume is the flux of flow_ * (point - origin_) through the surface, whose divergence is 1.
  // It flows along the axis in which the set is thinnest, mostly: what the samples of one solid
  // miss or count twice weighs by its distance from the origin along the flow.
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  Eigen::Array3d flow_ = Eigen::Array3d::Constant(1.0 / 3.0);
};

}  // namespace

VolumeGradient UnionVolumeGradient(const capsule::PrimitiveSet& set, const SetVariables& variables,
                                   double spacing_m, std::uint64_t seed, const ThreadPool& pool,
                                   const FullCells* full) {
  const Sampler sampler(set, variables, spacing_m, seed, full);
  const std::size_t solids = variables.solids().size();
  std::vector<Share> slants(solids);
  std::vector<Share> caps(set.spheres.size());
  pool.ForEach(solids + set.spheres.size(), [&](std::size_t i) {
    if (i < solids) {
      if (variables.image_of_solid(i) >= i) slants[i] = sampler.Slant(i);
    } else if (const std::size_t k = i - solids; variables.image_of_sphere(k) >= k) {
      caps[k] = sampler.Caps(k);
    }
  });
  return sampler.Combine(slants, caps);
}

}  // namespace capfit::tighten
