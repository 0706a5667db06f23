#include "core/body/intrinsic_frame.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace capfit::body {
namespace {

// Distances here are in units of the square root of the surface's area, 0.75 of the height.

// Pairs that miss their mirror image by more than this count little: a limb in another pose.
constexpr double kMirrorTolerance = 0.008;
constexpr int kRobustIterations = 30;
// The body stands on its soles when "up at rest" is within 15 degrees of the trunk.
constexpr double kMinCosineToTrunk = 0.966;
// Height of the slice at the bottom in which the soles are looked for.
constexpr double kSoleSlice = 0.12;
// What tells front from back: how far it must show to be clear, and its say.
constexpr double kClearToe = 0.06;
constexpr double kToeWeight = 1.0;
constexpr double kClearCalf = 0.010;
constexpr double kCalfWeight = 0.5;
constexpr double kClearElbow = 0.005;
constexpr double kElbowWeight = 0.1;
constexpr double kClearHead = 0.2;  // slope
constexpr double kHeadWeight = 0.5;

// Sums of vertices by level, each vertex shared between the two nearest levels.
class LevelSums {
 public:
  explicit LevelSums(int levels) : moments_(levels, Eigen::Vector3d::Zero()), areas_(levels, 0.0) {}

  // `t` in [0, 1].
  void Add(double t, const Eigen::Vector3d& point, double area) {
    const double at = std::clamp(t, 0.0, 1.0) * static_cast<double>(moments_.size() - 1);
    const std::size_t lower = std::min(static_cast<std::size_t>(at), moments_.size() - 2);
    const double share = at - static_cast<double>(lower);
    moments_[lower] += (1.0 - share) * area * point;
    areas_[lower] += (1.0 - share) * area;
    moments_[lower + 1] += share * area * point;
    areas_[lower + 1] += share * area;
  }
  // Levels that nothing fell into take the place of their predecessor.
  [[nodiscard]] LevelCentroids Centroids() const {
    LevelCentroids centroids(moments_.size(), Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < moments_.size(); ++i) {
      if (areas_[i] > 0.0) {
        centroids[i] = moments_[i] / areas_[i];
      } else if (i > 0) {
        centroids[i] = centroids[i - 1];
      }
    }
    return centroids;
  }

 private:
  std::vector<Eigen::Vector3d> moments_;
  std::vector<double> areas_;
};

LevelCentroids LimbCentroids(std::span<const Eigen::Vector3d> points, std::span<const double> areas,
                             const Extremities& extremities, const Limb& limb) {
  LevelSums sums(kLevels);
  const double reach = std::max(limb.tip_distance - limb.junction, 1e-9);
  for (const std::uint32_t v : limb.vertices) {
    sums.Add((extremities.distance[v] - limb.junction) / reach, points[v], areas[v]);
  }
  return sums.Centroids();
}

LevelCentroids TrunkCentroids(std::span<const Eigen::Vector3d> points,
                              std::span<const double> areas, const Extremities& extremities) {
  std::vector<char> is_limb(points.size(), 0);
  for (const auto& limb : extremities.limbs) {
    if (!limb) continue;
    for (const std::uint32_t v : limb->vertices) is_limb[v] = 1;
  }
  double farthest = 1e-9;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!is_limb[v]) farthest = std::max(farthest, extremities.distance[v]);
  }
  LevelSums sums(kLevels);
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!is_limb[v]) sums.Add(extremities.distance[v] / farthest, points[v], areas[v]);
  }
  return sums.Centroids();
}

struct MirrorPair {
  Eigen::Vector3d a;
  Eigen::Vector3d b;  // mirror image of a; the same point where it lies in the plane
  double weight = 1.0;
};

struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double offset = 0.0;
};

// Minimises sum w |mirror(a) - b|^2: |mirror(a) - b|^2 is a constant plus 4 (n.a)(n.b), so n is
// the eigenvector of the smallest eigenvalue of sum w (a b' + b a'), both seen from their mean.
Plane FitMirror(const std::vector<MirrorPair>& pairs) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double total = 0.0;
  for (const MirrorPair& p : pairs) {
    mean += 0.5 * p.weight * (p.a + p.b);
    total += p.weight;
  }
  mean /= total;
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  for (const MirrorPair& p : pairs) {
    const Eigen::Matrix3d product = (p.a - mean) * (p.b - mean).transpose();
    matrix += p.weight * (product + product.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix);
  Plane plane;
  plane.normal = solver.eigenvectors().col(0);
  plane.offset = plane.normal.dot(mean);
  return plane;
}

double MirrorError(const Plane& plane, const MirrorPair& pair) {
  const Eigen::Vector3d image =
      pair.a - 2.0 * (plane.normal.dot(pair.a) - plane.offset) * plane.normal;
  return (image - pair.b).norm();
}

// Iteratively reweighted (Geman-McClure): what does not mirror loses its say. Starts wide, so that
// a limb in another pose cannot capture the plane.
Plane FitMirrorRobustly(std::vector<MirrorPair> pairs) {
  const std::vector<MirrorPair> given = pairs;
  Plane plane = FitMirror(pairs);
  double tolerance = 32.0 * kMirrorTolerance;
  for (int i = 0; i < kRobustIterations; ++i) {
    tolerance = std::max(0.7 * tolerance, kMirrorTolerance);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const double ratio = MirrorError(plane, given[k]) / tolerance;
      pairs[k].weight = given[k].weight / ((1.0 + ratio * ratio) * (1.0 + ratio * ratio));
    }
    plane = FitMirror(pairs);
  }
  return plane;
}

struct Rings {
  std::array<std::optional<LevelCentroids>, kTipCount> limbs;
  LevelCentroids trunk;

  [[nodiscard]] const std::optional<LevelCentroids>& limb(Tip tip) const {
    return limbs[static_cast<std::size_t>(tip)];
  }
};

Plane SymmetryPlane(const Rings& rings) {
  std::vector<MirrorPair> pairs;
  for (const auto& [a, b] :
       {std::pair(Tip::kHandA, Tip::kHandB), std::pair(Tip::kFootA, Tip::kFootB)}) {
    if (!rings.limb(a) || !rings.limb(b)) continue;
    for (int i = 0; i < kLevels; ++i) {
      pairs.push_back({(*rings.limb(a))[i], (*rings.limb(b))[i], 1.0});
    }
  }
  for (const Eigen::Vector3d& c : rings.trunk) pairs.push_back({c, c, 1.0});
  if (rings.limb(Tip::kHead)) {
    for (const Eigen::Vector3d& c : *rings.limb(Tip::kHead)) pairs.push_back({c, c, 1.0});
  }
  return FitMirrorRobustly(std::move(pairs));
}

// From where the legs come together to where head and arms do; without legs or without head and
// arms, from or to the trunk's middle.
Eigen::Vector3d TrunkDirection(const Rings& rings) {
  const auto roots = [&](std::initializer_list<Tip> tips) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
    for (const Tip tip : tips) {
      if (!rings.limb(tip)) continue;
      sum += rings.limb(tip)->front();
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

// Up, if the body (centroid at the origin) is put down on its soles and left to itself: across the
// edge of the underside that the centroid stands over.
std::optional<Eigen::Vector3d> UpAtRest(std::span<const Eigen::Vector3d> points,
                                        const Eigen::Vector3d& up, const Eigen::Vector3d& forward) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p : points) lowest = std::min(lowest, up.dot(p));
  std::vector<Profile> low;
  for (const Eigen::Vector3d& p : points) {
    if (up.dot(p) < lowest + kSoleSlice) low.emplace_back(forward.dot(p), up.dot(p));
  }
  const std::vector<Profile> hull = Underside(std::move(low));
  for (std::size_t i = 0; i + 1 < hull.size(); ++i) {
    const Profile edge = hull[i + 1] - hull[i];
    if (edge.dot(hull[i]) > 0.0 || edge.dot(hull[i + 1]) < 0.0) continue;  // centroid not over it
    const Eigen::Vector3d normal = (edge.x() * up - edge.y() * forward).normalized();
    if (normal.dot(up) >= kMinCosineToTrunk) return normal;
  }
  return std::nullopt;
}

// How far `middle` stands out to the front of the straight line between the two ends.
double Bulge(const Eigen::Vector3d& a, const Eigen::Vector3d& middle, const Eigen::Vector3d& b,
             const Eigen::Vector3d& forward) {
  const Eigen::Vector3d chord = b - a;
  const double share = (middle - a).dot(chord) / std::max(chord.squaredNorm(), 1e-12);
  return (middle - a - share * chord).dot(forward);
}

double Clear(double value, double clear) { return std::clamp(value / clear, -1.0, 1.0); }

// Positive when the leg says that `forward` is the front: toes reach out to the front, the calf
// bulges to the back.
double LegFacing(const LevelCentroids& leg, const Eigen::Vector3d& tip,
                 const Eigen::Vector3d& forward) {
  const Eigen::Vector3d& shin = leg[kLevels * 2 / 3];
  const Eigen::Vector3d down = (shin - leg[kLevels / 3]).normalized();
  const Eigen::Vector3d reach = tip - shin;
  const double toe = (reach - reach.dot(down) * down).dot(forward);
  const double calf =
      Bulge(leg[kLevels * 7 / 16], leg[kLevels * 5 / 8], leg[kLevels * 3 / 4], forward);
  return kToeWeight * Clear(toe, kClearToe) - kCalfWeight * Clear(calf, kClearCalf);
}

// The same for arms (the elbow stands out to the back) and the head (it leans to the front).
double ArmFacing(const LevelCentroids& arm, const Eigen::Vector3d& forward) {
  const double elbow = Bulge(arm[kLevels / 8], arm[kLevels / 2], arm[kLevels * 5 / 6], forward);
  return -kElbowWeight * Clear(elbow, kClearElbow);
}

double HeadFacing(const LevelCentroids& head, const Eigen::Vector3d& tip, const Eigen::Vector3d& up,
                  const Eigen::Vector3d& forward) {
  const Eigen::Vector3d reach = tip - head.front();
  return kHeadWeight * Clear(reach.dot(forward) / std::max(reach.dot(up), 1e-3), kClearHead);
}

double Facing(const Rings& rings, std::span<const Eigen::Vector3d> points,
              const Extremities& extremities, const Eigen::Vector3d& up,
              const Eigen::Vector3d& forward) {
  double evidence = 0.0;
  for (const Tip tip : {Tip::kFootA, Tip::kFootB}) {
    if (!rings.limb(tip)) continue;
    evidence += LegFacing(*rings.limb(tip), points[extremities.limb(tip)->tip], forward);
  }
  for (const Tip tip : {Tip::kHandA, Tip::kHandB}) {
    if (rings.limb(tip)) evidence += ArmFacing(*rings.limb(tip), forward);
  }
  if (rings.limb(Tip::kHead)) {
    evidence +=
        HeadFacing(*rings.limb(Tip::kHead), points[extremities.limb(Tip::kHead)->tip], up, forward);
  }
  return evidence;
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

IntrinsicFrame FindIntrinsicFrame(std::span<const Eigen::Vector3d> points,
                                  std::span<const double> vertex_areas,
                                  const Extremities& extremities,
                                  const std::optional<Eigen::Vector3d>& up) {
  Rings rings;
  for (int i = 0; i < kTipCount; ++i) {
    if (!extremities.limbs[i]) continue;
    rings.limbs[i] = LimbCentroids(points, vertex_areas, extremities, *extremities.limbs[i]);
  }
  rings.trunk = TrunkCentroids(points, vertex_areas, extremities);
  const Plane plane = SymmetryPlane(rings);
  IntrinsicFrame frame;
  frame.left = plane.normal;
  frame.plane_offset = plane.offset;
  const Eigen::Vector3d trunk = TrunkDirection(rings).normalized();
  if (up) {
    frame.up = *up;
    frame.left = (plane.normal - plane.normal.dot(*up) * *up).normalized();
  } else {
    frame.up = (trunk - trunk.dot(frame.left) * frame.left).normalized();
    const auto at_rest = UpAtRest(points, frame.up, frame.left.cross(frame.up));
    if (at_rest) frame.up = *at_rest;
  }
  frame.up_agreement = frame.up.dot(trunk);
  frame.forward = frame.left.cross(frame.up);
  frame.first_hand_is_left = IsLeft(rings, Tip::kHandA, Tip::kHandB, frame);
  frame.first_foot_is_left = IsLeft(rings, Tip::kFootA, Tip::kFootB, frame);
  const double facing = Facing(rings, points, extremities, frame.up, frame.forward);
  frame.facing_trust = std::min(1.0, std::abs(facing));
  return facing < 0.0 ? TurnedAbout(frame) : frame;
}

}  // namespace capfit::body
