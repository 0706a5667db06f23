#include "core/refine/enclosing/added_capsule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>

namespace capfit::refine {
namespace {

using geometry::TaperedCapsule;
using Vec3 = Eigen::Vector3d;

// Along and around a tie, where its volume is sampled.
constexpr int kAlong = 8, kAround = 8, kAcross = 4;

TaperedCapsule ImageOf(const TaperedCapsule& capsule) {
  const auto image = [](geometry::Sphere sphere) {
    sphere.center_m.x() = -sphere.center_m.x();
    return sphere;
  };
  return {image(capsule.a()), image(capsule.b())};
}

// Points within a tie, from `origin_m`, their coordinates apart.
struct TieSamples {
  static constexpr std::size_t kCount = std::size_t{kAlong} * kAround * kAcross;

  TieSamples(const TaperedCapsule& tie, const Vec3& origin_m) {
    const Vec3 side = tie.axis().unitOrthogonal();
    const Vec3 up = tie.axis().cross(side);
    std::size_t next = 0;
    for (int i = 0; i < kAlong; ++i) {
      const double t = (i + 0.5) / kAlong;
      const Vec3 center = (1 - t) * tie.a().center_m + t * tie.b().center_m - origin_m;
      const double radius = (1 - t) * tie.a().radius_m + t * tie.b().radius_m;
      const double area_m2 = std::numbers::pi * radius * radius;
      for (int j = 0; j < kAround; ++j) {
        const double angle = 2.0 * std::numbers::pi * (j + 0.5 * (i % 2)) / kAround;
        const Vec3 out = std::cos(angle) * side + std::sin(angle) * up;
        for (int m = 0; m < kAcross; ++m, ++next) {
          // Equal areas across.
          const Vec3 p = center + radius * std::sqrt((m + 0.5) / kAcross) * out;
          x[next] = static_cast<float>(p.x());
          y[next] = static_cast<float>(p.y());
          z[next] = static_cast<float>(p.z());
          volume_m3[next] = area_m2 * tie.length_m() / kCount;
        }
      }
    }
  }

  std::array<float, kCount> x, y, z;
  std::array<double, kCount> volume_m3;  // that each stands for
};

}  // namespace

OutsidePoints::OutsidePoints(const tighten::PointGrid& grid, const std::vector<double>& distances_m,
                             const std::vector<double>& areas_m2, double allowed_m)
    : allowed_m_(static_cast<float>(allowed_m)) {
  for (const tighten::PointGrid::Block& block : grid.blocks()) {
    Run run{x_.size(), 0, block.center, block.reach, 0.0};
    for (std::uint32_t i = block.begin; i < block.end; ++i) {
      if (distances_m[i] <= allowed_m) continue;
      const Eigen::Vector3f p = (grid.point(i) - block.center).cast<float>();
      x_.push_back(p.x()), y_.push_back(p.y()), z_.push_back(p.z());
      area_.push_back(static_cast<float>(areas_m2[grid.order()[i]]));
      out_.push_back(static_cast<float>(distances_m[i] - allowed_m));
      run.furthest_m = std::max(run.furthest_m, distances_m[i]);
    }
    run.end = x_.size();
    if (run.end > run.begin) runs_.push_back(run);
  }
}

double OutsidePoints::TakenInBy(const TaperedCapsule& capsule, bool with_image) const {
  const tighten::DistanceKernel own(capsule);
  const std::optional<tighten::DistanceKernel> image =
      with_image ? std::optional(tighten::DistanceKernel(ImageOf(capsule))) : std::nullopt;
  std::array<float, tighten::PointGrid::kMaxBlock> distances_m;
  double sum = 0.0;
  for (const Run& run : runs_) {
    distances_m.fill(std::numeric_limits<float>::max());
    bool is_near = false;
    for (const tighten::DistanceKernel* solid : {&own, image ? &*image : nullptr}) {
      if (solid == nullptr) continue;
      const Vec3& c = run.center;
      const double at_center = solid->SignedDistance(c.x(), c.y(), c.z());
      if (at_center - run.reach >= run.furthest_m) continue;  // nearer to others
      is_near = true;
      const tighten::FloatKernel kernel = tighten::KernelAround(*solid, run.center);
      for (std::size_t i = run.begin; i < run.end; ++i) {
        float& least = distances_m[i - run.begin];
        least = std::min(least, kernel.SignedDistance(x_[i], y_[i], z_[i]));
      }
    }
    if (is_near) sum += TakenIn(run, distances_m.data());
  }
  return sum;
}

double OutsidePoints::TakenIn(const Run& run, const float* distances_m) const {
  double sum = 0.0;
  for (std::size_t i = run.begin; i < run.end; ++i) {
    const float still_out = std::max(0.0f, distances_m[i - run.begin] - allowed_m_);
    sum += double{area_[i] * std::max(0.0f, out_[i] - still_out)};
  }
  return sum;
}

double VolumeOutside(const TaperedCapsule& tie, const std::vector<TaperedCapsule>& shapes) {
  const Vec3 middle = 0.5 * (tie.a().center_m + tie.b().center_m);
  const double reach = 0.5 * tie.length_m() + std::max(tie.a().radius_m, tie.b().radius_m);
  const TieSamples samples(tie, middle);
  std::array<float, TieSamples::kCount> nearest;
  nearest.fill(std::numeric_limits<float>::max());
  for (const TaperedCapsule& shape : shapes) {
    if (shape.SignedDistance(middle) >= reach) continue;
    const tighten::FloatKernel kernel =
        tighten::KernelAround(tighten::DistanceKernel(shape), middle);
    for (std::size_t i = 0; i < TieSamples::kCount; ++i) {
      nearest[i] =
          std::min(nearest[i], kernel.SignedDistance(samples.x[i], samples.y[i], samples.z[i]));
    }
  }
  double volume = 0.0;
  for (std::size_t i = 0; i < TieSamples::kCount; ++i) {
    if (nearest[i] > 0.0f) volume += samples.volume_m3[i];
  }
  return volume;
}

}  // namespace capfit::refine
