#include "tests/bench/sphere_mesh/settle_spheres.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/bench/sphere_mesh/sphere_mesh_distance.h"

namespace capfit::bench {
namespace {

using Eigen::Vector3d;

// Of the mean distance at the start: beyond kFar points count as lost, below kNear they weigh no
// more.
constexpr double kFar = 2.0;
constexpr double kNear = 0.1;
constexpr double kFirstDamping = 1e-2;
constexpr double kMostDamping = 1e3;
// Of the mean diagonal element: what keeps spheres that no point pulls at where they are.
constexpr double kHold = 1e-6;

class Settler {
 public:
  Settler(const SphereMesh& mesh, std::span<const Vector3d> points)
      : points_(points), hints_(points.size(), 0) {
    const std::vector<Foot> feet = Locate(mesh);
    double sum = 0.0;
    for (const Foot& foot : feet) sum += std::abs(foot.distance);
    mean_ = sum / static_cast<double>(feet.size());
  }

  [[nodiscard]] SphereMesh Settle(const SphereMesh& mesh, int steps);

 private:
  std::vector<Foot> Locate(const SphereMesh& mesh);
  [[nodiscard]] double Cost(const std::vector<Foot>& feet) const;
  // The derivative of a point's cost over its distance, both ways of the latter.
  [[nodiscard]] double Weight(double distance) const;

  std::span<const Vector3d> points_;
  std::vector<int> hints_;  // the hull that was nearest to each point
  double mean_ = 0.0;       // distance at the start
};

// The normal equations for the changes of the spheres' numbers.
struct Equations {
  Eigen::MatrixXd a;
  Eigen::VectorXd b;
};

Equations Linearise(const std::vector<Foot>& feet, std::span<const double> weights,
                    std::size_t spheres) {
  const auto unknowns = static_cast<Eigen::Index>(4 * spheres);
  Equations equations{Eigen::MatrixXd::Zero(unknowns, unknowns), Eigen::VectorXd::Zero(unknowns)};
  for (std::size_t k = 0; k < feet.size(); ++k) {
    const Foot& foot = feet[k];
    const double weight = weights[k];
    const Eigen::Vector4d n(foot.normal.x(), foot.normal.y(), foot.normal.z(), 1.0);
    const Eigen::Matrix4d nn = weight * n * n.transpose();
    for (std::size_t i = 0; i < 3; ++i) {
      if (foot.shares[i] == 0.0) continue;
      const Eigen::Index row = 4 * foot.spheres[i];
      equations.b.segment<4>(row) += weight * foot.distance * foot.shares[i] * n;
      for (std::size_t j = 0; j < 3; ++j) {
        if (foot.shares[j] == 0.0) continue;
        equations.a.block<4, 4>(row, 4 * foot.spheres[j]) += foot.shares[i] * foot.shares[j] * nn;
      }
    }
  }
  return equations;
}

SphereMesh Moved(const SphereMesh& mesh, const Equations& equations, double damping) {
  Eigen::MatrixXd a = equations.a;
  const double hold = kHold * a.diagonal().mean();
  a.diagonal() *= 1.0 + damping;
  a.diagonal().array() += (1.0 + damping) * hold;
  const Eigen::VectorXd change = a.llt().solve(equations.b);
  SphereMesh moved = mesh;
  for (std::size_t i = 0; i < moved.spheres.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(4 * i);
    moved.spheres[i].center_m += change.segment<3>(at);
    moved.spheres[i].radius_m = std::max(0.0, moved.spheres[i].radius_m + change[at + 3]);
  }
  return moved;
}

std::vector<Foot> Settler::Locate(const SphereMesh& mesh) {
  const SphereMeshDistance distance(mesh);
  std::vector<Foot> feet;
  feet.reserve(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    feet.push_back(distance.Locate(points_[i], hints_[i]));
  }
  return feet;
}

double Settler::Cost(const std::vector<Foot>& feet) const {
  double cost = 0.0;
  for (const Foot& foot : feet) cost += std::atan(std::abs(foot.distance) / (kFar * mean_));
  return cost;
}

double Settler::Weight(double distance) const {
  const double relative = distance / (kFar * mean_);
  return 1.0 / (std::max(std::abs(distance), kNear * mean_) * (1.0 + relative * relative));
}

SphereMesh Settler::Settle(const SphereMesh& mesh, int steps) {
  SphereMesh best = mesh;
  std::vector<Foot> feet = Locate(best);
  double damping = kFirstDamping;
  std::vector<double> weights(points_.size());
  for (int step = 0; step < steps && damping < kMostDamping; ++step) {
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = Weight(feet[i].distance);
    SphereMesh moved = Moved(best, Linearise(feet, weights, best.spheres.size()), damping);
    std::vector<Foot> found = Locate(moved);
    const bool is_better = Cost(found) < Cost(feet);
    damping *= is_better ? 0.3 : 5.0;
    if (!is_better) continue;
    best = std::move(moved);
    feet = std::move(found);
  }
  return best;
}

}  // namespace

std::vector<Vector3d> SurfacePoints(const mesh::BodyMesh& mesh, int count) {
  std::vector<Vector3d> points;
  const double share = mesh.area() / count;
  double next = 0.5 * share, passed = 0.0;
  for (const mesh::Triangle& t : mesh.triangles()) {
    const Vector3d& a = mesh.vertices()[t[0]];
    const Vector3d u = mesh.vertices()[t[1]] - a, v = mesh.vertices()[t[2]] - a;
    passed += 0.5 * u.cross(v).norm();
    for (; next < passed; next += share) {
      // Two irrational steps spread the places within the triangles evenly (R2 sequence).
      const auto i = static_cast<double>(points.size());
      double s = std::fmod(0.7548776662466927 * i, 1.0);
      double w = std::fmod(0.5698402909980532 * i, 1.0);
      if (s + w > 1.0) s = 1.0 - s, w = 1.0 - w;
      points.emplace_back(a + s * u + w * v);
    }
  }
  return points;
}

SphereMesh SettleSpheres(const SphereMesh& mesh, std::span<const Vector3d> points, int steps) {
  return points.empty() ? mesh : Settler(mesh, points).Settle(mesh, steps);
}

}  // namespace capfit::bench
