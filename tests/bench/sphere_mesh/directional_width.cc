#include "tests/bench/sphere_mesh/directional_width.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace capfit::bench {
namespace {

// A spiral of equal areas on the upper half sphere.
template <std::size_t kCount>
std::array<Eigen::Vector3f, kCount> HalfSphere() {
  std::array<Eigen::Vector3f, kCount> directions;
  const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (std::size_t i = 0; i < kCount; ++i) {
    const double z = (static_cast<double>(i) + 0.5) / static_cast<double>(kCount);
    const double around = turn * static_cast<double>(i);
    const double radius = std::sqrt(1.0 - z * z);
    directions[i] =
        Eigen::Vector3d(radius * std::cos(around), radius * std::sin(around), z).cast<float>();
  }
  return directions;
}

}  // namespace

DirectionalWidth::DirectionalWidth() {
  low_.fill(std::numeric_limits<float>::infinity());
  high_.fill(-std::numeric_limits<float>::infinity());
}

void DirectionalWidth::Add(const Eigen::Vector3d& point) {
  static const auto directions = HalfSphere<kDirections>();
  const Eigen::Vector3f p = point.cast<float>();
  for (std::size_t i = 0; i < kDirections; ++i) {
    const float along = directions[i].dot(p);
    low_[i] = std::min(low_[i], along);
    high_[i] = std::max(high_[i], along);
  }
}

void DirectionalWidth::Add(const DirectionalWidth& other) {
  for (std::size_t i = 0; i < kDirections; ++i) {
    low_[i] = std::min(low_[i], other.low_[i]);
    high_[i] = std::max(high_[i], other.high_[i]);
  }
}

double DirectionalWidth::LeastWith(const DirectionalWidth& other) const {
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < kDirections; ++i) {
    least = std::min(least, std::max(high_[i], other.high_[i]) - std::min(low_[i], other.low_[i]));
  }
  return std::max(0.0F, least);
}

}  // namespace capfit::bench
