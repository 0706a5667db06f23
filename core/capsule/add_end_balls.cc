#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/base/enum_index.h"
#include "core/capsule/build_primitives.h"
#include "core/capsule/mirrored_set.h"
#include "core/geometry/smallest_enclosing.h"

namespace capfit::capsule {
namespace {

using PointsByPart = std::array<std::vector<Eigen::Vector3d>, body::kPartCount>;

// Of head, hands and feet, as far as they are selected.
PointsByPart PointsOfEnds(const body::Body& body, const body::PartSelection& parts) {
  std::array<std::vector<Eigen::Vector3d>*, body::kSegmentCount> place{};
  PointsByPart points;
  for (std::size_t s = 0; s < place.size(); ++s) {
    const body::Part part = body::PartOf(static_cast<body::Segment>(s));
    const bool is_end = static_cast<int>(part) >= body::kChainCount;
    if (is_end && parts.Includes(part)) place[s] = &points[Index(part)];
  }
  const std::span<const Eigen::Vector3d> vertices = body.mesh.vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    std::vector<Eigen::Vector3d>* const own = place[Index(body.vertex_segments[v])];
    if (own != nullptr) own->push_back(vertices[v]);
  }
  return points;
}

Eigen::Vector3d Mirrored(const Eigen::Vector3d& point) {
  return {-point.x(), point.y(), point.z()};
}

double RadiusAround(const Eigen::Vector3d& center, const std::vector<Eigen::Vector3d>& points) {
  double radius = 0.0;
  for (const Eigen::Vector3d& p : points) radius = std::max(radius, (p - center).norm());
  return radius;
}

// The points by stretches of equal length of their longest extent; with a normal, of that within
// the plane across it. Stretches without points are left out.
std::vector<std::vector<Eigen::Vector3d>> Stretches(const std::vector<Eigen::Vector3d>& points,
                                                    int count, const Eigen::Vector3d& normal) {
  if (count == 1) return {points};
  const Eigen::Matrix3d in_plane = Eigen::Matrix3d::Identity() - normal * normal.transpose();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) middle += p;
  middle /= static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) spread += (p - middle) * (p - middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(in_plane * spread * in_plane);
  const Eigen::Vector3d longest = axes.eigenvectors().col(2);
  std::vector<double> places;
  for (const Eigen::Vector3d& p : points) places.push_back(longest.dot(p));
  const auto [low, high] = std::minmax_element(places.begin(), places.end());
  std::vector<std::vector<Eigen::Vector3d>> stretches(count);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double share = *high > *low ? (places[i] - *low) / (*high - *low) : 0.0;
    stretches[std::min(static_cast<int>(share * count), count - 1)].push_back(points[i]);
  }
  std::erase_if(stretches, [](const auto& stretch) { return stretch.empty(); });
  return stretches;
}

void Add(body::Part part, int mirror, const geometry::Sphere& ball, PrimitiveSet& set) {
  set.spheres.push_back(ball);
  set.origins.push_back({part, -1, mirror});
}

void AddAlone(body::Part part, const std::vector<Eigen::Vector3d>& points, int count,
              PrimitiveSet& set) {
  for (const auto& stretch : Stretches(points, count, Eigen::Vector3d::Zero())) {
    Add(part, -1, geometry::SmallestEnclosingBall(stretch), set);
  }
}

// Balls on the mid-plane.
void AddCentred(body::Part part, std::vector<Eigen::Vector3d> points, int count,
                PrimitiveSet& set) {
  const std::size_t own = points.size();
  for (std::size_t i = 0; i < own; ++i) points.push_back(Mirrored(points[i]));
  for (const auto& stretch : Stretches(points, count, Eigen::Vector3d::UnitX())) {
    geometry::Sphere ball = geometry::SmallestEnclosingBall(stretch);
    ball.center_m.x() = 0.0;  // so it is but for rounding
    ball.radius_m = RadiusAround(ball.center_m, stretch);
    Add(part, static_cast<int>(set.spheres.size()), ball, set);
  }
}

// Balls and their exact images, around both sides' points. The two sides of a symmetric body still
// differ a little.
void AddPairs(body::Part part, std::vector<Eigen::Vector3d> points,
              const std::vector<Eigen::Vector3d>& others, int count, PrimitiveSet& set) {
  for (const Eigen::Vector3d& p : others) points.push_back(Mirrored(p));
  for (const auto& stretch : Stretches(points, count, Eigen::Vector3d::Zero())) {
    const geometry::Sphere ball = geometry::SmallestEnclosingBall(stretch);
    const int index = static_cast<int>(set.spheres.size());
    Add(part, index + 1, ball, set);
    Add(body::MirrorPart(part), index, MirrorImage(ball), set);
  }
}

std::vector<int> SpheresOfPart(const MirroredSet& set, body::Part part) {
  std::vector<int> spheres;
  for (int i = 0; i < set.sphere_count(); ++i) {
    if (set.part(i) == part) spheres.push_back(i);
  }
  return spheres;
}

}  // namespace

int EndBalls::Of(body::Part part) const {
  switch (part) {
    case body::Part::kHead:
      return head;
    case body::Part::kLeftHand:
    case body::Part::kRightHand:
      return hand;
    case body::Part::kLeftFoot:
    case body::Part::kRightFoot:
      return foot;
    default:
      return 0;
  }
}

PrimitiveSet MakeEndBalls(const body::Body& body, const body::PartSelection& parts,
                          const EndBalls& balls) {
  PrimitiveSet set;
  const PointsByPart points = PointsOfEnds(body, parts);
  for (int index = body::kChainCount; index < body::kPartCount; ++index) {
    const body::Part part = static_cast<body::Part>(index);
    const auto& own = points[Index(part)];
    const auto& others = points[Index(body::MirrorPart(part))];
    if (own.empty()) continue;
    if (!body.is_symmetric || others.empty()) {
      AddAlone(part, own, balls.Of(part), set);
    } else if (body::MirrorPart(part) == part) {
      AddCentred(part, own, balls.Of(part), set);
    } else if (part < body::MirrorPart(part)) {
      AddPairs(part, own, others, balls.Of(part), set);
    }
  }
  return set;
}

void AddBalls(const PrimitiveSet& balls, PrimitiveSet& set) {
  const int before = static_cast<int>(set.spheres.size());
  set.spheres.insert(set.spheres.end(), balls.spheres.begin(), balls.spheres.end());
  for (SphereOrigin origin : balls.origins) {
    if (origin.mirror >= 0) origin.mirror += before;
    set.origins.push_back(origin);
  }
}

body::Part ChainAt(body::Part ball) {
  switch (ball) {
    case body::Part::kLeftHand:
      return body::Part::kLeftArm;
    case body::Part::kRightHand:
      return body::Part::kRightArm;
    case body::Part::kLeftFoot:
      return body::Part::kLeftLeg;
    case body::Part::kRightFoot:
      return body::Part::kRightLeg;
    default:
      return body::Part::kTorso;
  }
}

void LinkEndBalls(PrimitiveSet& set) {
  MirroredSet linked(std::move(set), /*is_mirrored=*/true);
  for (int index = body::kChainCount; index < body::kPartCount; ++index) {
    const body::Part part = static_cast<body::Part>(index);
    const std::vector<int> balls = SpheresOfPart(linked, part);
    if (balls.empty() || !linked.IsRepresentative(balls.front())) continue;
    for (std::size_t i = 1; i < balls.size(); ++i) linked.AddCapsule(balls[i - 1], balls[i]);
    const CapsuleEnds best =
        LeastGap(linked.spheres(), balls, SpheresOfPart(linked, ChainAt(part)));
    if (best[0] >= 0) linked.AddCapsule(best[0], best[1]);
  }
  set = linked.set();
}

}  // namespace capfit::capsule
