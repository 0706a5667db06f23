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
constexpr double kMirrorTolerance = 0.012;
constexpr double kFirstTolerance = 0.10;
constexpr int kRobustIterations = 30;
// Rings of trunk and head lie near one line and say little about how the plane is turned.
constexpr double kSelfPairWeight = 0.3;
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
// What tells front from back: how far it must show to be clear, and its say.
constexpr double kClearToe = 0.06;
constexpr double kToeWeight = 1.0;
constexpr double kClearCalf = 0.010;
constexpr double kCalfWeight = 0.5;
constexpr double kClearElbow = 0.005;
constexpr double kElbowWeight = 0.1;
constexpr double kClearReach = 0.10;
constexpr double kReachWeight = 0.3;
constexpr double kClearHead = 0.2;  // slope
constexpr double kHeadWeight = 0.5;
constexpr double kClearFace = 0.02;
constexpr double kFaceWeight = 0.3;

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

// 1 for each vertex of a limb.
std::vector<char> LimbMask(std::size_t count, const Extremities& extremities) {
  std::vector<char> is_limb(count, 0);
  for (const auto& limb : extremities.limbs) {
    if (!limb) continue;
    for (const std::uint32_t v : limb->vertices) is_limb[v] = 1;
  }
  return is_limb;
}

LevelCentroids TrunkCentroids(std::span<const Eigen::Vector3d> points,
                              std::span<const double> areas, const Extremities& extremities,
                              const std::vector<char>& is_limb) {
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

// Geman-McClure: what misses by much more than the tolerance counts as a constant.
double RobustCost(const Plane& plane, const std::vector<MirrorPair>& pairs, double tolerance) {
  double cost = 0.0;
  for (const MirrorPair& pair : pairs) {
    const double ratio = MirrorError(plane, pair) / tolerance;
    cost += pair.weight * ratio * ratio / (1.0 + ratio * ratio);
  }
  return cost;
}

// Iteratively reweighted: what does not mirror loses its say. Starts wide, so that a limb in
// another pose does not capture the plane.
Plane FitMirrorRobustly(Plane plane, const std::vector<MirrorPair>& pairs) {
  std::vector<MirrorPair> reweighted = pairs;
  double tolerance = kFirstTolerance;
  for (int i = 0; i < kRobustIterations; ++i) {
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const double ratio = MirrorError(plane, pairs[k]) / tolerance;
      const double falloff = 1.0 + ratio * ratio;
      reweighted[k].weight = pairs[k].weight / (falloff * falloff);
    }
    plane = FitMirror(reweighted);
    tolerance = std::max(0.75 * tolerance, kMirrorTolerance);
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

void AddPairs(const Rings& rings, Tip a, Tip b, int levels, std::vector<MirrorPair>& pairs) {
  if (!rings.limb(a) || !rings.limb(b)) return;
  for (int i = 0; i < levels; ++i) {
    pairs.push_back({(*rings.limb(a))[i], (*rings.limb(b))[i], 1.0});
  }
}

// The best of several starts: everything; the legs; the arms; the roots of the limbs, which stay
// put when a body walks or waves.
Plane SymmetryPlane(const Rings& rings) {
  std::vector<MirrorPair> legs, arms, roots, all;
  AddPairs(rings, Tip::kFootA, Tip::kFootB, kLevels, legs);
  AddPairs(rings, Tip::kHandA, Tip::kHandB, kLevels, arms);
  AddPairs(rings, Tip::kFootA, Tip::kFootB, kLevels / 4, roots);
  AddPairs(rings, Tip::kHandA, Tip::kHandB, kLevels / 4, roots);
  all = legs;
  all.insert(all.end(), arms.begin(), arms.end());
  for (const Eigen::Vector3d& c : rings.trunk) all.push_back({c, c, kSelfPairWeight});
  if (rings.limb(Tip::kHead)) {
    for (const Eigen::Vector3d& c : *rings.limb(Tip::kHead)) {
      all.push_back({c, c, kSelfPairWeight});
    }
  }
  Plane best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (const std::vector<MirrorPair>* start : {&all, &legs, &arms, &roots}) {
    if (start->empty()) continue;
    const Plane plane = FitMirrorRobustly(FitMirror(*start), all);
    const double cost = RobustCost(plane, all, kMirrorTolerance);
    if (cost >= best_cost) continue;
    best_cost = cost;
    best = plane;
  }
  return best;
}

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

// The direction in which the trunk is widest, across its own axis, and by how much it is wider than
// deep (ratio of standard deviations).
struct TrunkWidth {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double ratio = 1.0;
};

TrunkWidth MeasureTrunk(std::span<const Eigen::Vector3d> points, std::span<const double> areas,
                        const std::vector<char>& is_limb, const Eigen::Vector3d& axis) {
  TrunkWidth width;
  double total = 0.0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (is_limb[v]) continue;
    width.center += areas[v] * points[v];
    total += areas[v];
  }
  if (total <= 0.0) return width;
  width.center /= total;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (is_limb[v]) continue;
    Eigen::Vector3d across = points[v] - width.center;
    across -= across.dot(axis) * axis;
    covariance += areas[v] / total * across * across.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  width.direction = solver.eigenvectors().col(2);
  width.ratio = std::sqrt(solver.eigenvalues()[2] / std::max(solver.eigenvalues()[1], 1e-12));
  return width;
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
                                        const Extremities& extremities, const Eigen::Vector3d& up,
                                        const Eigen::Vector3d& forward) {
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
    if (normal.dot(up) < kMinCosineToTrunk) continue;
    const double ground = normal.dot(hull[i].x() * forward + hull[i].y() * up);
    if (StandsOn(points, extremities, normal, ground)) return normal;
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

// The same for arms (the elbow stands out to the back, and hands reach to the front rather than to
// the back) and the head (it leans to the front, and stands out over the neck there).
double ArmFacing(const LevelCentroids& arm, const Eigen::Vector3d& forward) {
  const double elbow = Bulge(arm[kLevels / 8], arm[kLevels / 2], arm[kLevels * 5 / 6], forward);
  const double reach = (arm[kLevels * 5 / 6] - arm[kLevels / 8]).dot(forward);
  return kReachWeight * Clear(reach, kClearReach) - kElbowWeight * Clear(elbow, kClearElbow);
}

double HeadFacing(const LevelCentroids& head, const Eigen::Vector3d& tip, const Eigen::Vector3d& up,
                  const Eigen::Vector3d& forward) {
  const Eigen::Vector3d reach = tip - head.front();
  const Eigen::Vector3d& neck = head[kLevels / 4];
  const double face = (head[kLevels * 5 / 8] - neck).dot(forward);
  return kHeadWeight * Clear(reach.dot(forward) / std::max(reach.dot(up), 1e-3), kClearHead) +
         kFaceWeight * Clear(face, kClearFace);
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

// From the hips to the neck.
Eigen::Vector3d TrunkAxis(const Rings& rings, const std::optional<RigEnds>& rig) {
  const Eigen::Vector3d axis = TrunkDirection(rings).normalized();
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

IntrinsicFrame FindIntrinsicFrame(std::span<const Eigen::Vector3d> points,
                                  std::span<const double> vertex_areas,
                                  const Extremities& extremities,
                                  const std::optional<Eigen::Vector3d>& up,
                                  const std::optional<RigEnds>& rig) {
  Rings rings;
  for (int i = 0; i < kTipCount; ++i) {
    if (!extremities.limbs[i]) continue;
    rings.limbs[i] = LimbCentroids(points, vertex_areas, extremities, *extremities.limbs[i]);
  }
  const std::vector<char> is_limb = LimbMask(points.size(), extremities);
  rings.trunk = TrunkCentroids(points, vertex_areas, extremities, is_limb);
  Plane plane = SymmetryPlane(rings);
  IntrinsicFrame frame;
  const Eigen::Vector3d trunk = TrunkAxis(rings, rig);
  const TrunkWidth width = MeasureTrunk(points, vertex_areas, is_limb, trunk);
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
    const auto at_rest = UpAtRest(points, extremities, frame.up, frame.left.cross(frame.up));
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
