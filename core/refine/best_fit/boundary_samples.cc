#include "core/refine/best_fit/boundary_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

// Cosines and sines of angles in equal steps from 0.
struct Turns {
  Turns(int count, double step) : cosine(count), sine(count) {
    for (int i = 0; i < count; ++i) {
      cosine[i] = static_cast<float>(std::cos(step * i));
      sine[i] = static_cast<float>(std::sin(step * i));
    }
  }
  std::vector<float> cosine, sine;
};

// Once around in a multiple of kLane steps.
const Turns& CircleOf(int count) {
  static const std::vector<Turns> circles = [] {
    std::vector<Turns> all;
    for (int n = BoundarySamples::kLane; n <= BoundarySamples::kMost; n += BoundarySamples::kLane) {
      all.emplace_back(n, kTwoPi / n);
    }
    return all;
  }();
  return circles[count / BoundarySamples::kLane - 1];
}

const Turns& GoldenTurns() {
  static const Turns turns(BoundarySamples::kMost, kTwoPi * kGoldenShare);
  return turns;
}

}  // namespace

int BoundarySamples::CountFor(double wanted) {
  return kLane * std::clamp(static_cast<int>(wanted / kLane + 0.5), 1, kMost / kLane);
}

void BoundarySamples::PlaceRing(int count, const Eigen::Vector3f& center_m, float radius_m,
                                const std::array<float, 2>& slope, const Frame& frame) {
  count_ = count;
  frame_ = frame;
  const Turns& circle = CircleOf(count);
  const float* cosine = circle.cosine.data();
  const float* sine = circle.sine.data();
  const float across = slope[1];
  for (int i = 0; i < count; ++i) {
    u_[i] = slope[0];
    v_[i] = across * cosine[i];
    w_[i] = across * sine[i];
  }
  PlacePoints(center_m, radius_m);
}

void BoundarySamples::PlaceSpiral(int count, const geometry::Sphere& sphere, float top,
                                  double phase, const Frame& frame) {
  count_ = count;
  frame_ = frame;
  const float* cosine = GoldenTurns().cosine.data();
  const float* sine = GoldenTurns().sine.data();
  const float step = (1.0f + top) / static_cast<float>(count);
  const float first = static_cast<float>(phase) * step - 1.0f;
  for (int i = 0; i < count; ++i) {
    const float u = first + step * static_cast<float>(i);
    const float rest = 1.0f - u * u;
    const float across = std::sqrt(rest > 0.0f ? rest : 0.0f);
    u_[i] = u;
    v_[i] = across * cosine[i];
    w_[i] = across * sine[i];
  }
  PlacePoints(sphere.center_m.cast<float>(), static_cast<float>(sphere.radius_m));
}

void BoundarySamples::PlacePoints(const Eigen::Vector3f& center_m, float radius_m) {
  const Eigen::Vector3f a = radius_m * frame_.axis, p = radius_m * frame_.first,
                        q = radius_m * frame_.second;
  const float ax = a.x(), ay = a.y(), az = a.z(), px = p.x(), py = p.y(), pz = p.z(), qx = q.x(),
              qy = q.y(), qz = q.z(), cx = center_m.x(), cy = center_m.y(), cz = center_m.z();
  for (int i = 0; i < count_; ++i) {
    const float u = u_[i], v = v_[i], w = w_[i];
    x_[i] = cx + u * ax + v * px + w * qx;
    y_[i] = cy + u * ay + v * py + w * qy;
    z_[i] = cz + u * az + v * pz + w * qz;
    clear_[i] = 1.0f;
  }
}

void BoundarySamples::HideBehind(const Cone& other) {
  const Cone cone = other;
  for (int i = 0; i < count_; ++i) {
    const float distance = cone.SignedDistance(x_[i], y_[i], z_[i]);
    clear_[i] = distance < clear_[i] ? distance : clear_[i];
  }
}

void BoundarySamples::HideBeyond(const Eigen::Vector3f& axis, float height) {
  const float u = axis.dot(frame_.axis), v = axis.dot(frame_.first), w = axis.dot(frame_.second);
  for (int i = 0; i < count_; ++i) {
    const float below = height - (u_[i] * u + v_[i] * v + w_[i] * w);
    clear_[i] = below < clear_[i] ? below : clear_[i];
  }
}

bool BoundarySamples::IsAnySeen() const {
  std::array<float, kLane> most;
  most.fill(-1.0f);
  for (int first = 0; first < count_; first += kLane) {
    for (int k = 0; k < kLane; ++k) {
      most[k] = clear_[first + k] > most[k] ? clear_[first + k] : most[k];
    }
  }
  return *std::max_element(most.begin(), most.end()) >= 0.0f;
}

BoundarySamples::Sums BoundarySamples::Collect(const OccupancyGrid* body) {
  if (!IsAnySeen()) return {};
  if (body != nullptr) {
    SampleCost(*body, x_.data(), y_.data(), z_.data(), count_, weight_.data());
  } else {
    std::fill_n(weight_.begin(), count_, 1.0f);
  }
  // A sum for each place in a register: the order of additions is the same whatever the compiler
  // makes of it.
  alignas(32) std::array<float, kLane> seen{}, sum{}, su{}, sv{}, sw{};
  for (int first = 0; first < count_; first += kLane) {
    for (int k = 0; k < kLane; ++k) {
      const int i = first + k;
      const float shown = clear_[i] >= 0.0f ? 1.0f : 0.0f;
      const float weight = shown * weight_[i];
      seen[k] += shown;
      sum[k] += weight;
      su[k] += weight * u_[i];
      sv[k] += weight * v_[i];
      sw[k] += weight * w_[i];
    }
  }
  const auto total = [](std::array<float, kLane>& lane) {
    for (int half = kLane / 2; half > 0; half /= 2) {
      for (int k = 0; k < half; ++k) lane[k] += lane[k + half];
    }
    return lane[0];
  };
  Sums sums;
  sums.seen = total(seen);
  sums.force.head<3>() =
      (total(su) * frame_.axis + total(sv) * frame_.first + total(sw) * frame_.second)
          .cast<double>();
  sums.force[3] = total(sum);
  return sums;
}

}  // namespace capfit::refine
