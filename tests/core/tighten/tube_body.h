// Bodies made of bent, flattened tubes, with sets that nearly fit them: what coverage is tested on.
#ifndef CAPFIT_TESTS_CORE_TIGHTEN_TUBE_BODY_H_
#define CAPFIT_TESTS_CORE_TIGHTEN_TUBE_BODY_H_

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "core/base/random.h"
#include "core/tighten/cover_target.h"

namespace capfit::tighten {

struct TubeBody {
  CoverTarget target;
  capsule::PrimitiveSet set;
};

inline Eigen::Vector3d Mirrored(const Eigen::Vector3d& p) { return {-p.x(), p.y(), p.z()}; }

// Adds a closed tube along a path: rings of `around` points, flattened in z, closed by two points.
inline void AddTube(const std::vector<Eigen::Vector3d>& path, const std::vector<double>& radii_m,
                    double flatness, int around, CoverTarget& target) {
  const auto first = static_cast<std::uint32_t>(target.points_m.size());
  const auto rings = static_cast<std::uint32_t>(path.size());
  const auto n = static_cast<std::uint32_t>(around);
  const Eigen::Vector3d along = (path.back() - path.front()).normalized();
  Eigen::Vector3d u = along.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Vector3d v = along.cross(u);
  for (std::size_t i = 0; i < path.size(); ++i) {
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * std::numbers::pi * k / around;
      target.points_m.own().push_back(
          path[i] + radii_m[i] * (std::cos(angle) * u + flatness * std::sin(angle) * v));
    }
  }
  target.points_m.own().push_back(path.front());
  target.points_m.own().push_back(path.back());
  const std::uint32_t ends[2] = {first + rings * n, first + rings * n + 1};
  const std::uint32_t last = first + (rings - 1) * n;
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t next = (k + 1) % n;
    for (std::uint32_t i = 0; i + 1 < rings; ++i) {
      const std::uint32_t a = first + i * n;
      target.triangles.own().push_back({a + k, a + next, a + n + k});
      target.triangles.own().push_back({a + next, a + n + next, a + n + k});
    }
    target.triangles.own().push_back({first + next, first + k, ends[0]});
    target.triangles.own().push_back({last + k, last + next, ends[1]});
  }
}

// A trunk with two arms and two legs, symmetric but for `asymmetry_m` of noise, with one centred
// sphere at each end of the trunk and mirrored spheres for the limbs.
inline TubeBody MakeTubeBody(std::uint64_t seed, double asymmetry_m, int around = 20) {
  Random random(seed);
  TubeBody body;
  const auto tube = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, double ra, double rb,
                        double flatness, bool is_mirrored) {
    std::vector<Eigen::Vector3d> path;
    std::vector<double> radii;
    const double bulge = random.NextIn(-0.15, 0.3);
    for (int i = 0; i <= 12; ++i) {
      const double t = i / 12.0;
      path.push_back((1 - t) * a + t * b);
      radii.push_back(((1 - t) * ra + t * rb) * (1 + bulge * std::sin(std::numbers::pi * t)));
    }
    AddTube(path, radii, flatness, around, body.target);
    if (!is_mirrored) return;
    for (Eigen::Vector3d& p : path) p = Mirrored(p);
    AddTube(path, radii, flatness, around, body.target);
  };
  const auto centred = [&](const Eigen::Vector3d& c, double r) {
    const int index = static_cast<int>(body.set.spheres.size());
    body.set.spheres.push_back({c, r});
    body.set.origins.push_back({body::Part::kTorso, -1, index});
    return index;
  };
  const auto paired = [&](const Eigen::Vector3d& c, double r) {
    const int index = static_cast<int>(body.set.spheres.size());
    body.set.spheres.push_back({c, r});
    body.set.spheres.push_back({Mirrored(c), r});
    body.set.origins.push_back({body::Part::kLeftArm, -1, index + 1});
    body.set.origins.push_back({body::Part::kRightArm, -1, index});
    return index;
  };
  const Eigen::Vector3d hip(0, 0.9, 0), neck(0, 1.4, 0.02);
  const Eigen::Vector3d shoulder(0.17, 1.33, 0), hand(random.NextIn(0.4, 0.7), 1.0, 0.05);
  const Eigen::Vector3d leg(0.1, 0.85, 0), foot(random.NextIn(0.1, 0.2), 0.1, 0.01);
  tube(hip, neck, 0.16, 0.13, 0.65, false);
  tube(shoulder, hand, 0.05, 0.03, 0.9, true);
  tube(leg, foot, 0.08, 0.04, 0.95, true);
  for (Eigen::Vector3d& p : body.target.points_m.own()) {
    for (int k = 0; k < 3; ++k) p[k] += random.NextIn(-asymmetry_m, asymmetry_m);
  }
  const int hip_ball = centred(hip, 0.13), neck_ball = centred(neck, 0.12);
  const int chest = paired({0.07, 1.25, 0.0}, 0.1), belly = paired({0.06, 1.0, 0.0}, 0.1);
  const int arm = paired(shoulder, 0.05), wrist = paired(hand, 0.03);
  const int thigh = paired(leg, 0.07), ankle = paired(foot, 0.04);
  for (int side = 0; side < 2; ++side) {
    body.set.capsules.push_back({neck_ball, chest + side});
    body.set.capsules.push_back({hip_ball, belly + side});
    body.set.capsules.push_back({chest + side, belly + side});
    body.set.capsules.push_back({chest + side, arm + side});
    body.set.capsules.push_back({arm + side, wrist + side});
    body.set.capsules.push_back({belly + side, thigh + side});
    body.set.capsules.push_back({thigh + side, ankle + side});
  }
  body.set.capsules.push_back({chest, chest + 1});  // a bar between two images
  return body;
}

// Whether every sphere is the exact image of its partner.
inline bool IsExactlyMirrored(const capsule::PrimitiveSet& set) {
  for (std::size_t i = 0; i < set.spheres.size(); ++i) {
    if (set.origins[i].mirror < 0) continue;
    const geometry::Sphere& image = set.spheres[set.origins[i].mirror];
    if (Mirrored(set.spheres[i].center_m) != image.center_m) return false;
    if (set.spheres[i].radius_m != image.radius_m) return false;
  }
  return true;
}

inline double DistanceToUnion(const capsule::PrimitiveSet& set, const Eigen::Vector3d& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const geometry::TaperedCapsule& solid : capsule::Solids(set)) {
    least = std::min(least, solid.SignedDistance(point));
  }
  return least;
}

}  // namespace capfit::tighten

#endif  // CAPFIT_TESTS_CORE_TIGHTEN_TUBE_BODY_H_
