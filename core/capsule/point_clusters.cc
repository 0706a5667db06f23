#include "core/capsule/point_clusters.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/geometry/smallest_enclosing.h"

namespace capfit::capsule {
namespace {

using Points = std::vector<Eigen::Vector3d>;

std::size_t NearestCluster(const Eigen::Vector3d& point, std::span<const PointCluster> clusters) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const double squared = (point - clusters[i].ball.center_m).squaredNorm();
    if (squared >= least) continue;
    least = squared;
    nearest = i;
  }
  return nearest;
}

class ClusterSearch {
 public:
  explicit ClusterSearch(const Eigen::Vector3d& normal)
      : in_plane_(Eigen::Matrix3d::Identity() - normal * normal.transpose()) {}

  std::vector<PointCluster> Find(std::span<const Eigen::Vector3d> points, int count) const {
    std::vector<PointCluster> clusters = {Around(Points(points.begin(), points.end()))};
    while (static_cast<int>(clusters.size()) < count) {
      const auto widest = std::max_element(
          clusters.begin(), clusters.end(),
          [](const auto& a, const auto& b) { return a.ball.radius_m < b.ball.radius_m; });
      auto [low, high] = Halves(*widest);
      if (low.empty() || high.empty()) break;
      *widest = Around(std::move(low));
      clusters.push_back(Around(std::move(high)));
      Reassign(points, clusters);
    }
    return clusters;
  }

 private:
  PointCluster Around(Points points) const {
    geometry::Sphere ball = geometry::SmallestEnclosingBall(points);
    ball.center_m = in_plane_ * ball.center_m;
    return {std::move(points), ball};
  }

  std::pair<Points, Points> Halves(const PointCluster& cluster) const {
    const Eigen::Vector3d axis = LongestExtent(cluster);
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (const Eigen::Vector3d& p : cluster.points_m) {
      least = std::min(least, axis.dot(p));
      most = std::max(most, axis.dot(p));
    }
    std::pair<Points, Points> halves;
    for (const Eigen::Vector3d& p : cluster.points_m) {
      (axis.dot(p) < 0.5 * (least + most) ? halves.first : halves.second).push_back(p);
    }
    return halves;
  }

  // Of the most spread. (From one furthest point to the other E_r ends 1.5 % higher.)
  Eigen::Vector3d LongestExtent(const PointCluster& cluster) const {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& p : cluster.points_m) {
      const Eigen::Vector3d arm = p - cluster.ball.center_m;
      spread += arm * arm.transpose();
    }
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(in_plane_ * spread * in_plane_)
        .eigenvectors()
        .col(2);
  }

  void Reassign(std::span<const Eigen::Vector3d> points,
                std::vector<PointCluster>& clusters) const {
    std::vector<Points> own(clusters.size());
    for (const Eigen::Vector3d& p : points) own[NearestCluster(p, clusters)].push_back(p);
    clusters.clear();
    for (Points& of_one : own) {
      if (!of_one.empty()) clusters.push_back(Around(std::move(of_one)));
    }
  }

  Eigen::Matrix3d in_plane_;
};

}  // namespace

std::vector<PointCluster> ClustersOf(std::span<const Eigen::Vector3d> points_m, int count,
                                     const Eigen::Vector3d& normal) {
  if (points_m.empty()) return {};
  return ClusterSearch(normal).Find(points_m, count);
}

}  // namespace capfit::capsule
