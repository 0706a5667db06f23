#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/base/enum_index.h"
#include "core/capsule/build_primitives.h"
#include "core/capsule/mirrored_set.h"
#include "core/capsule/point_clusters.h"

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

void Add(body::Part part, int mirror, const geometry::Sphere& ball, PrimitiveSet& set) {
  set.spheres.push_back(ball);
  set.origins.push_back({part, -1, mirror});
}

void AddAlone(body::Part part, const std::vector<Eigen::Vector3d>& points, int count,
              PrimitiveSet& set) {
  for (const auto& cluster : ClustersOf(points, count, Eigen::Vector3d::Zero())) {
    Add(part, -1, cluster.ball, set);
  }
}

// Balls on the mid-plane.
void AddCentred(body::Part part, std::vector<Eigen::Vector3d> points, int count,
                PrimitiveSet& set) {
  const std::size_t own = points.size();
  for (std::size_t i = 0; i < own; ++i) points.push_back(Mirrored(points[i]));
  for (const auto& cluster : ClustersOf(points, count, Eigen::Vector3d::UnitX())) {
    geometry::Sphere ball = cluster.ball;
    ball.radius_m = RadiusAround(ball.center_m, cluster.points_m);
    Add(part, static_cast<int>(set.spheres.size()), ball, set);
  }
}

// Balls and their exact images, around both sides' points. The two sides of a symmetric body still
// differ a little.
void AddPairs(body::Part part, std::vector<Eigen::Vector3d> points,
              const std::vector<Eigen::Vector3d>& others, int count, PrimitiveSet& set) {
  for (const Eigen::Vector3d& p : others) points.push_back(Mirrored(p));
  for (const auto& cluster : ClustersOf(points, count, Eigen::Vector3d::Zero())) {
    const int index = static_cast<int>(set.spheres.size());
    Add(part, index + 1, cluster.ball, set);
    Add(body::MirrorPart(part), index, MirrorImage(cluster.ball), set);
  }
}

std::vector<int> SpheresOfPart(const MirroredSet& set, body::Part part) {
  std::vector<int> spheres;
  for (int i = 0; i < set.sphere_count(); ++i) {
    if (set.part(i) == part) spheres.push_back(i);
  }
  return spheres;
}

// By capsules between the nearest, from the first on (Prim 1957).
void JoinAsTree(const std::vector<int>& balls, MirroredSet& set) {
  std::vector<int> joined = {balls.front()};
  std::vector<int> open(balls.begin() + 1, balls.end());
  while (!open.empty()) {
    const auto [from, to] = LeastGap(set.spheres(), joined, open);
    set.AddCapsule(from, to);
    joined.push_back(to);
    std::erase(open, to);
  }
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
    JoinAsTree(balls, linked);
    const CapsuleEnds best =
        LeastGap(linked.spheres(), balls, SpheresOfPart(linked, ChainAt(part)));
    if (best[0] >= 0) linked.AddCapsule(best[0], best[1]);
  }
  set = linked.set();
}

}  // namespace capfit::capsule
