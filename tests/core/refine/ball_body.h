// The simplest body to fit: a ball.
#ifndef CAPFIT_TESTS_CORE_REFINE_BALL_BODY_H_
#define CAPFIT_TESTS_CORE_REFINE_BALL_BODY_H_

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "core/body/body.h"

namespace capfit::refine {

// A ball of rings and segments around `center`, its lower half labelled as a foot.
inline body::Body BallBody(const Eigen::Vector3d& center, double radius_m) {
  constexpr int kRings = 48, kSegments = 96;
  std::vector<Eigen::Vector3d> vertices = {center + Eigen::Vector3d(0, radius_m, 0)};
  for (int i = 1; i < kRings; ++i) {
    const double polar = std::numbers::pi * i / kRings;
    for (int k = 0; k < kSegments; ++k) {
      const double around = 2.0 * std::numbers::pi * (k + 0.5) / kSegments;
      vertices.push_back(center + radius_m * Eigen::Vector3d(std::sin(polar) * std::sin(around),
                                                             std::cos(polar),
                                                             std::sin(polar) * std::cos(around)));
    }
  }
  vertices.push_back(center - Eigen::Vector3d(0, radius_m, 0));
  std::vector<mesh::Triangle> triangles;
  const auto at = [](int ring, int k) {
    return static_cast<std::uint32_t>(1 + (ring - 1) * kSegments + k % kSegments);
  };
  const auto last = static_cast<std::uint32_t>(vertices.size() - 1);
  for (int k = 0; k < kSegments; ++k) {
    triangles.push_back({0, at(1, k), at(1, k + 1)});
    triangles.push_back({last, at(kRings - 1, k + 1), at(kRings - 1, k)});
    for (int i = 1; i + 1 < kRings; ++i) {
      triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  std::vector<body::Segment> segments;
  for (const Eigen::Vector3d& v : vertices) {
    segments.push_back(v.y() < center.y() ? body::Segment::kLeftFoot : body::Segment::kTorso);
  }
  std::vector<std::int32_t> source(vertices.size());
  for (std::size_t i = 0; i < source.size(); ++i) source[i] = static_cast<std::int32_t>(i);
  body::Body body{mesh::BodyMesh(std::move(vertices), std::move(triangles), std::move(source)),
                  {},
                  2.0 * radius_m,
                  true,
                  {},
                  std::move(segments),
                  {},
                  {}};
  return body;
}

inline body::PartSelection AllParts() {
  body::PartSelection parts;
  parts.head = parts.hands = parts.feet = true;
  return parts;
}

}  // namespace capfit::refine

#endif  // CAPFIT_TESTS_CORE_REFINE_BALL_BODY_H_
