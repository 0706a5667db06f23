#include "core/body/intrinsic_frame.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/chunk_sums.h"
#include "core/body/facing.h"
#include "core/body/rings.h"

namespace capfit::body {
namespace {

// Distances here are in units of the square root of the surface's area, 0.75 of the height.

// The body stands on its soles when "up at rest" is within 6 degrees of the trunk.
constexpr double kMinCosineToTrunk = 0.9945;
// Axes of the surface that lie farther than this (20 degrees) from a skeleton's are mistaken.
constexpr double kTakenCosineToRig = 0.94;
constexpr double kSoleTolerance = 0.02;
// A trunk this much wider than deep says by itself where left and right are, to within the angle of
// this cosine (5 degrees).
constexpr double kClearlyWide = 1.2;
constexpr double kMinCosineToWidth = 0.996;
// Height of the slice at the bottom in which the soles are looked for.
constexpr double kSoleSlice = 0.12;

// Where head or arm begins: the first rings may hold a piece of the neighbour. Legs are far enough
// apart, and further down a thigh may already point forward.
Eigen::Vector3d Root(const LevelCentroids& limb, bool is_leg) {
  if (is_leg) return 0.5 * (limb[0] + limb[1]);
  return (limb[2] + limb[3] + limb[4] + limb[5]) / 4.0;
}

// From where the legs come together to where head and arms do; without legs or without head and
// arms, from or to the trunk's middle.
Eigen::Vector3d TrunkDirection(const Rings& rings) {
  const auto roots = [&](std::initializer_list<Tip> tips) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
    for (const Tip tip : tips) {
      if (!rings.limb(tip)) continue;
      sum += Root(*rings.limb(tip), tip == Tip::kFootA || tip == Tip::kFootB);
      ++count;
    }
    return count > 0 ? std::optional<Eigen::Vector3d>(sum / count) : std::nullopt;
  };
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& c : rings.trunk) middle += c / static_cast<double>(kLevels);
  const Eigen::Vector3d top = rings.limb(Tip::kHead)
                                  ? rings.limb(Tip::kHead)->front()
                                  : roots({Tip::kHandA, Tip::kHandB}).value_or(middle);
  return top - roots({Tip::kFootA, Tip::kFootB}).value_or(middle);
}

// Of what is not left out, as seen along an axis.
struct Spread {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // across the axis
};

Spread SpreadAcross(const Eigen::Vector3d& axis, std::span<const Eigen::Vector3d> points,
                    std::span<const double> areas, const std::vector<char>& is_left_out) {
  Spread spread;
  double total = 0.0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (is_left_out[v]) continue;
    spread.center += areas[v] * points[v];
    total += areas[v];
  }
  if (total <= 0.0) return spread;
  spread.center /= total;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (is_left_out[v]) continue;
    Eigen::Vector3d across = points[v] - spread.center;
    across -= across.dot(axis) * axis;
    spread.covariance += areas[v] / total * across * across.transpose();
  }
  return spread;
}

// The direction in which the trunk is widest, across its own axis, and by how much it is wider than
// deep (ratio of standard deviations).
struct TrunkWidth {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double ratio = 1.0;
};

TrunkWidth MeasureTrunk(std::span<const Eigen::Vector3d> points, std::span<const double> areas,
                        const std::vector<char>& is_limb, const Eigen::Vector3d& axis) {
  const Spread spread = SpreadAcross(axis, points, areas, is_limb);
  if (spread.covariance.isZero(0.0)) return {};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread.covariance);
  const double ratio =
      std::sqrt(solver.eigenvalues()[2] / std::max(solver.eigenvalues()[1], 1e-12));
  return {solver.eigenvectors().col(2), spread.center, ratio};
}

// A point seen along the left axis: forward and up.
using Profile = Eigen::Vector2d;

double Cross(const Profile& o, const Profile& a, const Profile& b) {
  return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
}

// The underside of the convex hull, from back to front (Andrew's chain).
std::vector<Profile> Underside(std::vector<Profile> points) {
  std::sort(points.begin(), points.end(), [](const Profile& a, const Profile& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  std::vector<Profile> hull;
  for (const Profile& p : points) {
    while (hull.size() >= 2 && Cross(hull[hull.size() - 2], hull.back(), p) <= 0.0) hull.pop_back();
    hull.push_back(p);
  }
  return hull;
}

struct Lowest {
  double height = std::numeric_limits<double>::infinity();

  Lowest& operator+=(const Lowest& other) {
    height = std::min(height, other.height);
    return *this;
  }
};

struct Profiles {
  std::vector<Profile> list;

  Profiles& operator+=(const Profiles& more) {
    list.insert(list.end(), more.list.begin(), more.list.end());
    return *this;
  }
};

// Whether both legs reach down to the ground, so that no foot is in the air.
bool StandsOn(std::span<const Eigen::Vector3d> points, const Extremities& extremities,
              const Eigen::Vector3d& up, double ground) {
  for (const Tip tip : {Tip::kFootA, Tip::kFootB}) {
    if (!extremities.limb(tip)) return false;
    double lowest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t v : extremities.limb(tip)->vertices) {
      lowest = std::min(lowest, up.dot(points[v]));
    }
    if (lowest > ground + kSoleTolerance) return false;
  }
  return true;
}

// Up, if the body (centroid at the origin) is put down on its soles and left to itself: across the
// edge of the underside that the centroid stands over.
std::optional<Eigen::Vector3d> UpAtRest(std::span<const Eigen::Vector3d> points,
                                        const CoarseSurface& coarse, const Extremities& extremities,
                                        const ThreadPool& pool, const Eigen::Vector3d& up,
                                        const Eigen::Vector3d& forward) {
  const auto lowest_of = [&](std::size_t begin, std::size_t end) {
    Lowest lowest;
    for (std::size_t i = begin; i < end; ++i) lowest += {up.dot(points[i])};
    return lowest;
  };
  const double lowest = SumOverChunks(pool, points.size(), Lowest{}, lowest_of).height;
  // Only what is on the underside of its chunk can be on that of all.
  const auto underside_of = [&](std::size_t begin, std::size_t end) {
    std::vector<Profile> low;
    for (const Eigen::Vector3d& p : points.subspan(begin, end - begin)) {
      if (up.dot(p) < lowest + kSoleSlice) low.emplace_back(forward.dot(p), up.dot(p));
    }
    return Profiles{Underside(std::move(low))};
  };
  const std::vector<Profile> hull =
      Underside(SumOverChunks(pool, points.size(), Profiles{}, underside_of).list);
  for (std::size_t i = 0; i + 1 < hull.size(); ++i) {
    const Profile edge = hull[i + 1] - hull[i];
    if (edge.dot(hull[i]) > 0.0 || edge.dot(hull[i + 1]) < 0.0) continue;  // centroid not over it
    const Eigen::Vector3d normal = (edge.x() * up - edge.y() * forward).normalized();
    if (normal.dot(up) < kMinCosineToTrunk) continue;
    const double ground = normal.dot(hull[i].x() * forward + hull[i].y() * up);
    if (StandsOn(coarse.points, extremities, normal, ground)) return normal;
  }
  return std::nullopt;
}

// Whether limb `a` of a pair lies to the left of `b`; of the plane, where one of them is missing.
bool IsLeft(const Rings& rings, Tip a, Tip b, const IntrinsicFrame& frame) {
  double x = 0.0;
  for (const auto& [tip, sign] : {std::pair(a, 1.0), std::pair(b, -1.0)}) {
    if (!rings.limb(tip)) continue;
    for (const Eigen::Vector3d& c : *rings.limb(tip)) {
      x += sign * (frame.left.dot(c) - frame.plane_offset);
    }
  }
  return x > 0.0;
}

// Of a body without legs: where trunk and head are longest in the symmetry plane, towards the head.
// The trunk's middle and where the head begins are too near to each other to tell.
Eigen::Vector3d UpperBodyAxis(const CoarseSurface& coarse, const Extremities& extremities,
                              const Eigen::Vector3d& left) {
  constexpr std::array kHands = {Tip::kHandA, Tip::kHandB};
  const Spread spread = SpreadAcross(left, coarse.points, coarse.areas,
                                     LimbMask(coarse.points.size(), extremities, kHands));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread.covariance);
  const Eigen::Vector3d axis = solver.eigenvectors().col(2);
  const Eigen::Vector3d& crown = coarse.points[extremities.limb(Tip::kHead)->tip];
  return axis.dot(crown - spread.center) < 0.0 ? Eigen::Vector3d(-axis) : axis;
}

// From the hips to the neck.
Eigen::Vector3d TrunkAxis(const CoarseSurface& coarse, const Extremities& extremities,
                          const Rings& rings, const MirrorPlane& plane,
                          const std::optional<RigEnds>& rig) {
  const bool has_legs = extremities.limb(Tip::kFootA) || extremities.limb(Tip::kFootB);
  const Eigen::Vector3d axis = !has_legs && extremities.limb(Tip::kHead)
                                   ? UpperBodyAxis(coarse, extremities, plane.normal)
                                   : TrunkDirection(rings).normalized();
  return rig && !(rig->up.dot(axis) >= kTakenCosineToRig) ? rig->up : axis;
}

}  // namespace

IntrinsicFrame TurnedAbout(const IntrinsicFrame& frame) {
  IntrinsicFrame turned = frame;
  turned.left = -frame.left;
  turned.plane_offset = -frame.plane_offset;
  turned.forward = -frame.forward;
  turned.first_hand_is_left = !frame.first_hand_is_left;
  turned.first_foot_is_left = !frame.first_foot_is_left;
  return turned;
}

IntrinsicFrame FindIntrinsicFrame(const WorkingCopy& copy, const CoarseSurface& coarse,
                                  const MirrorSurface* mirror, const Extremities& extremities,
                                  const ThreadPool& pool, const std::optional<Eigen::Vector3d>& up,
                                  const std::optional<RigEnds>& rig) {
  const std::span<const Eigen::Vector3d> points = coarse.points;
  const std::vector<char> is_limb = LimbMask(points.size(), extremities);
  const Rings rings = RingsOf(points, coarse.areas, extremities, is_limb);
  MirrorPlane plane = SymmetryPlane(rings, pool);
  if (mirror != nullptr) plane = SharpenedPlane(plane, *mirror, pool);
  IntrinsicFrame frame;
  const Eigen::Vector3d trunk = TrunkAxis(coarse, extremities, rings, plane, rig);
  const TrunkWidth width = MeasureTrunk(points, coarse.areas, is_limb, trunk);
  const Eigen::Vector3d across = (plane.normal - plane.normal.dot(trunk) * trunk).normalized();
  if (width.ratio > kClearlyWide && std::abs(width.direction.dot(across)) < kMinCosineToWidth) {
    // Limbs in stride can mirror each other in a plane that is turned against the trunk.
    plane = {width.direction, width.direction.dot(width.center)};
  }
  if (rig && std::abs(rig->left.dot(plane.normal)) < kTakenCosineToRig) {
    plane = {rig->left, rig->left.dot(rig->middle)};
  }
  frame.left = plane.normal;
  frame.plane_offset = plane.offset;
  if (up) {
    frame.up = *up;
    frame.left = (plane.normal - plane.normal.dot(*up) * *up).normalized();
  } else {
    frame.up = (trunk - trunk.dot(frame.left) * frame.left).normalized();
    const auto at_rest =
        UpAtRest(copy.points, coarse, extremities, pool, frame.up, frame.left.cross(frame.up));
    if (at_rest) frame.up = *at_rest;
  }
  frame.forward = frame.left.cross(frame.up);
  frame.first_hand_is_left = IsLeft(rings, Tip::kHandA, Tip::kHandB, frame);
  frame.first_foot_is_left = IsLeft(rings, Tip::kFootA, Tip::kFootB, frame);
  const double facing = Facing(rings, points, extremities, frame.up, frame.forward);
  frame.facing_trust = std::min(1.0, std::abs(facing));
  return facing < 0.0 ? TurnedAbout(frame) : frame;
}

}  // namespace capfit::body
