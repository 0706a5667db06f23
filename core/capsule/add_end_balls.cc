#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/capsule/build_primitives.h"
#include "core/capsule/mirrored_set.h"
#include "core/geometry/smallest_enclosing.h"

namespace capfit::capsule {
namespace {

using PointsByPart = std::array<std::vector<Eigen::Vector3d>, body::kPartCount>;

PointsByPart GroupByPart(const body::Body& body) {
  PointsByPart points;
  for (std::size_t v = 0; v < body.vertex_segments.size(); ++v) {
    points[static_cast<std::size_t>(body::PartOf(body.vertex_segments[v]))].push_back(
        body.mesh.vertices()[v]);
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

// One ball on the mid-plane.
void AddCentred(body::Part part, std::vector<Eigen::Vector3d> points, PrimitiveSet& set) {
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i) points.push_back(Mirrored(points[i]));
  geometry::Sphere ball = geometry::SmallestEnclosingBall(points);
  ball.center_m.x() = 0.0;  // so it is but for rounding
  ball.radius_m = RadiusAround(ball.center_m, points);
  Add(part, static_cast<int>(set.spheres.size()), ball, set);
}

// One ball and its exact image, around both sides' points. The two sides of a symmetric body still
// differ a little.
void AddPair(body::Part part, std::vector<Eigen::Vector3d> points,
             const std::vector<Eigen::Vector3d>& others, PrimitiveSet& set) {
  for (const Eigen::Vector3d& p : others) points.push_back(Mirrored(p));
  const geometry::Sphere ball = geometry::SmallestEnclosingBall(points);
  const int index = static_cast<int>(set.spheres.size());
  Add(part, index + 1, ball, set);
  Add(body::MirrorPart(part), index, MirrorImage(ball), set);
}

std::vector<int> SpheresOfPart(const MirroredSet& set, body::Part part) {
  std::vector<int> spheres;
  for (int i = 0; i < set.sphere_count(); ++i) {
    if (set.part(i) == part) spheres.push_back(i);
  }
  return spheres;
}

}  // namespace

void AddEndBalls(const body::Body& body, const body::PartSelection& parts, PrimitiveSet& set) {
  const PointsByPart points = GroupByPart(body);
  for (int index = body::kChainCount; index < body::kPartCount; ++index) {
    const body::Part part = static_cast<body::Part>(index);
    const auto& own = points[static_cast<std::size_t>(part)];
    const auto& others = points[static_cast<std::size_t>(body::MirrorPart(part))];
    if (!parts.Includes(part) || own.empty()) continue;
    if (!body.is_symmetric || others.empty()) {
      Add(part, -1, geometry::SmallestEnclosingBall(own), set);
    } else if (body::MirrorPart(part) == part) {
      AddCentred(part, own, set);
    } else if (part < body::MirrorPart(part)) {
      AddPair(part, own, others, set);
    }
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
  for (int ball = 0; ball < linked.sphere_count(); ++ball) {
    const bool is_ball = static_cast<int>(linked.part(ball)) >= body::kChainCount;
    if (!is_ball || !linked.IsRepresentative(ball)) continue;
    const std::vector<int> chain = SpheresOfPart(linked, ChainAt(linked.part(ball)));
    const int nearest = NearestByGap(linked.spheres(), chain, linked.sphere(ball).center_m).index;
    if (nearest >= 0) linked.AddCapsule(ball, nearest);
  }
  set = linked.set();
}

}  // namespace capfit::capsule
