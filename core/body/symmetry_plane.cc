#include "core/body/symmetry_plane.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
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

Eigen::Vector3d ImageOf(const Eigen::Vector3d& point, const MirrorPlane& plane) {
  return point - 2.0 * (plane.normal.dot(point) - plane.offset) * plane.normal;
}

double MirrorError(const MirrorPlane& plane, const MirrorPair& pair) {
  return (ImageOf(pair.a, plane) - pair.b).norm();
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

// Sharpening: where images lie further off the surface than this, they count little, at first and
// last.
constexpr double kFirstOffSurface = 0.012;
constexpr double kLastOffSurface = 0.003;
constexpr int kSharpenings = 6;
// As many nodes tell the plane to a fraction of a millimetre.
constexpr std::size_t kSharpeners = 1000;
constexpr std::size_t kSharpenerChunk = 250;
// An image and the surface beside it look the same way, to within 45 degrees.
constexpr double kSameSideCosine = 0.7;

std::vector<Eigen::Vector3d> NodeNormals(const CoarseSurface& surface) {
  std::vector<Eigen::Vector3d> normals(surface.points.size(), Eigen::Vector3d::Zero());
  for (const mesh::Triangle& t : surface.triangles) {
    const Eigen::Vector3d& a = surface.points[t[0]];
    const Eigen::Vector3d normal = (surface.points[t[1]] - a).cross(surface.points[t[2]] - a);
    for (const std::uint32_t node : t) normals[node] += normal;
  }
  for (Eigen::Vector3d& normal : normals) normal.stableNormalize();
  return normals;
}

// A node and the one that lies beside its image.
struct ImagePair {
  std::size_t node = 0;
  std::uint32_t beside = 0;
};

class Sharpener {
 public:
  explicit Sharpener(const MirrorSurface& surface) : surface_(surface) {}

  void FindPairs(const MirrorPlane& plane, const ThreadPool& pool) {
    const bool is_first = pairs_.empty();
    const std::size_t stride = std::max<std::size_t>(1, surface_.points.size() / kSharpeners);
    pairs_.resize((surface_.points.size() + stride - 1) / stride);
    pool.ForChunks(pairs_.size(), kSharpenerChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Eigen::Vector3d image = ImageOf(surface_.points[i * stride], plane);
        const mesh::NearestVertex& nearest = surface_.nearest;
        pairs_[i] = {i * stride,
                     is_first ? nearest.At(image) : nearest.At(image, pairs_[i].beside)};
      }
    });
  }

  // A step of Gauss and Newton: two turns of the plane's normal, and its offset.
  [[nodiscard]] MirrorPlane Step(const MirrorPlane& plane, double tolerance,
                                 const ThreadPool& pool) const {
    const Eigen::Vector3d first = plane.normal.unitOrthogonal();
    const Eigen::Vector3d second = plane.normal.cross(first);
    std::vector<Slopes> parts((pairs_.size() + kSharpenerChunk - 1) / kSharpenerChunk);
    pool.ForChunks(pairs_.size(), kSharpenerChunk, [&](std::size_t begin, std::size_t end) {
      parts[begin / kSharpenerChunk] = SlopesOf(std::span(pairs_).subspan(begin, end - begin),
                                                plane, {first, second}, tolerance);
    });
    Slopes sum;
    for (const Slopes& part : parts) {
      sum.matrix += part.matrix;
      sum.gradient += part.gradient;
    }
    const Eigen::Vector3d change = -sum.matrix.ldlt().solve(sum.gradient);
    if (!change.allFinite()) return plane;
    return {(plane.normal + change[0] * first + change[1] * second).normalized(),
            plane.offset + change[2]};
  }

 private:
  struct Slopes {
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  };

  [[nodiscard]] Slopes SlopesOf(std::span<const ImagePair> pairs, const MirrorPlane& plane,
                                const std::array<Eigen::Vector3d, 2>& turns,
                                double tolerance) const {
    const auto& [first, second] = turns;
    Slopes sum;
    for (const auto& [node, beside] : pairs) {
      const Eigen::Vector3d& point = surface_.points[node];
      const Eigen::Vector3d& own = surface_.normals[node];
      const Eigen::Vector3d& normal = surface_.normals[beside];
      const double along = plane.normal.dot(normal);
      if (own.dot(normal) - 2.0 * along * plane.normal.dot(own) < kSameSideCosine) continue;
      const double off = normal.dot(ImageOf(point, plane) - surface_.points[beside]);
      const double falloff = 1.0 + off * off / (tolerance * tolerance);
      const double weight = surface_.areas[node] / (falloff * falloff);
      const double height = plane.normal.dot(point) - plane.offset;
      const Eigen::Vector3d slope(-2.0 * (first.dot(point) * along + height * normal.dot(first)),
                                  -2.0 * (second.dot(point) * along + height * normal.dot(second)),
                                  2.0 * along);
      sum.matrix += weight * slope * slope.transpose();
      sum.gradient += weight * off * slope;
    }
    return sum;
  }

  const MirrorSurface& surface_;
  std::vector<ImagePair> pairs_;
};

}  // namespace

MirrorSurface::MirrorSurface(const CoarseSurface& surface)
    : points(surface.points),
      normals(NodeNormals(surface)),
      areas(surface.areas),
      nearest(points) {}

MirrorPlane SharpenedPlane(const MirrorPlane& plane, const MirrorSurface& surface,
                           const ThreadPool& pool) {
  Sharpener sharpener(surface);
  MirrorPlane sharp = plane;
  double tolerance = kFirstOffSurface;
  for (int i = 0; i < kSharpenings; ++i) {
    // What lies beside an image hardly changes once the plane is near.
    if (i % (kSharpenings / 2) == 0) sharpener.FindPairs(sharp, pool);
    sharp = sharpener.Step(sharp, tolerance, pool);
    tolerance = std::max(0.5 * tolerance, kLastOffSurface);
  }
  return sharp;
}

// The best of several starts: everything; the legs; the arms; the roots of the limbs, which stay
// put when a body walks or waves.
MirrorPlane SymmetryPlane(const Rings& rings, const ThreadPool& pool) {
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
  struct Found {
    MirrorPlane plane;
    double cost = std::numeric_limits<double>::infinity();
  };
  const std::array<const std::vector<MirrorPair>*, 4> starts = {&all, &legs, &arms, &roots};
  std::array<Found, 4> found;
  pool.ForEach(starts.size(), [&](std::size_t i) {
    if (starts[i]->empty()) return;
    const MirrorPlane plane = FitMirrorRobustly(FitMirror(*starts[i]), all);
    found[i] = {plane, RobustCost(plane, all, kMirrorTolerance)};
  });
  const auto is_better = [](const Found& a, const Found& b) { return a.cost < b.cost; };
  return std::min_element(found.begin(), found.end(), is_better)->plane;
}

}  // namespace capfit::body
