#include "core/body/symmetry_plane.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <vector>

namespace capfit::body {
namespace {

// Pairs that miss their mirror image by more than this count little: a limb in another pose.
constexpr double kMirrorTolerance = 0.012;
constexpr double kFirstTolerance = 0.10;
constexpr int kRobustIterations = 30;
// Rings of trunk and head lie near one line and say little about how the plane is turned.
constexpr double kSelfPairWeight = 0.3;

struct MirrorPair {
  Eigen::Vector3d a;
  Eigen::Vector3d b;  // mirror image of a; the same point where it lies in the plane
  double weight = 1.0;
};

// Minimises sum w |mirror(a) - b|^2: |mirror(a) - b|^2 is a constant plus 4 (n.a)(n.b), so n is
// the eigenvector of the smallest eigenvalue of sum w (a b' + b a'), both seen from their mean.
MirrorPlane FitMirror(const std::vector<MirrorPair>& pairs) {
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
  MirrorPlane plane;
  plane.normal = solver.eigenvectors().col(0);
  plane.offset = plane.normal.dot(mean);
  return plane;
}

double MirrorError(const MirrorPlane& plane, const MirrorPair& pair) {
  const Eigen::Vector3d image =
      pair.a - 2.0 * (plane.normal.dot(pair.a) - plane.offset) * plane.normal;
  return (image - pair.b).norm();
}

// Geman-McClure: what misses by much more than the tolerance counts as a constant.
double RobustCost(const MirrorPlane& plane, const std::vector<MirrorPair>& pairs,
                  double tolerance) {
  double cost = 0.0;
  for (const MirrorPair& pair : pairs) {
    const double ratio = MirrorError(plane, pair) / tolerance;
    cost += pair.weight * ratio * ratio / (1.0 + ratio * ratio);
  }
  return cost;
}

// Iteratively reweighted: what does not mirror loses its say. Starts wide, so that a limb in
// another pose does not capture the plane.
MirrorPlane FitMirrorRobustly(MirrorPlane plane, const std::vector<MirrorPair>& pairs) {
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

void AddPairs(const Rings& rings, Tip a, Tip b, int levels, std::vector<MirrorPair>& pairs) {
  if (!rings.limb(a) || !rings.limb(b)) return;
  for (int i = 0; i < levels; ++i) {
    pairs.push_back({(*rings.limb(a))[i], (*rings.limb(b))[i], 1.0});
  }
}

}  // namespace

// The best of several starts: everything; the legs; the arms; the roots of the limbs, which stay
// put when a body walks or waves.
MirrorPlane SymmetryPlane(const Rings& rings) {
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
  MirrorPlane best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (const std::vector<MirrorPair>* start : {&all, &legs, &arms, &roots}) {
    if (start->empty()) continue;
    const MirrorPlane plane = FitMirrorRobustly(FitMirror(*start), all);
    const double cost = RobustCost(plane, all, kMirrorTolerance);
    if (cost >= best_cost) continue;
    best_cost = cost;
    best = plane;
  }
  return best;
}

}  // namespace capfit::body
