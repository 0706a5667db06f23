#include "core/metrics/solid_images.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace capfit::metrics {
namespace {

using geometry::Sphere;
using geometry::TaperedCapsule;

constexpr double kToleranceM = 1e-9;

// The same for a solid and its image, and as good as never for two others.
double KeyOf(const TaperedCapsule& solid) {
  const auto key = [](const Sphere& s) {
    return 0.61 * s.center_m.y() + 0.37 * s.center_m.z() + 0.23 * s.radius_m;
  };
  return key(solid.a()) + key(solid.b());
}

bool AreImages(const Sphere& a, const Sphere& b) {
  return std::abs(a.center_m.x() + b.center_m.x()) <= kToleranceM &&
         std::abs(a.center_m.y() - b.center_m.y()) <= kToleranceM &&
         std::abs(a.center_m.z() - b.center_m.z()) <= kToleranceM &&
         std::abs(a.radius_m - b.radius_m) <= kToleranceM;
}

bool AreImages(const TaperedCapsule& a, const TaperedCapsule& b) {
  return (AreImages(a.a(), b.a()) && AreImages(a.b(), b.b())) ||
         (AreImages(a.a(), b.b()) && AreImages(a.b(), b.a()));
}

}  // namespace

std::vector<std::int32_t> ImagesByPlace(std::span<const TaperedCapsule> solids) {
  std::vector<double> keys;
  for (const TaperedCapsule& solid : solids) keys.push_back(KeyOf(solid));
  std::vector<std::int32_t> by_key(solids.size());
  std::iota(by_key.begin(), by_key.end(), 0);
  std::sort(by_key.begin(), by_key.end(),
            [&](std::int32_t a, std::int32_t b) { return keys[a] < keys[b]; });
  std::vector<std::int32_t> images;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    // Two ends, and the weights of a key add up to no more than 2.
    constexpr double kReach = 4.0 * kToleranceM;
    auto near = std::lower_bound(by_key.begin(), by_key.end(), keys[k] - kReach,
                                 [&](std::int32_t i, double key) { return keys[i] < key; });
    while (near != by_key.end() && keys[*near] <= keys[k] + kReach &&
           !AreImages(solids[k], solids[*near])) {
      ++near;
    }
    if (near == by_key.end() || keys[*near] > keys[k] + kReach) return {};
    images.push_back(*near);
  }
  return images;
}

}  // namespace capfit::metrics
