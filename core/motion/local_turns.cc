#include "core/motion/local_turns.h"

#include <Eigen/Dense>
#include <cstddef>
#include <limits>

#include "core/geometry/tapered_capsule.h"
#include "core/tighten/point_grid.h"
#include "core/tighten/set_variables.h"

namespace capfit::motion {
namespace {

// Fewer points than these, summed up by weight, may lie in a line.
constexpr double kLeastWeight = 6.0;

std::size_t NearestAmong(const std::vector<std::size_t>& candidates, std::size_t sphere,
                         const capsule::PrimitiveSet& set) {
  std::size_t nearest = sphere;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t other : candidates) {
    const double distance =
        (set.spheres[other].center_m - set.spheres[sphere].center_m).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    nearest = other;
  }
  return nearest;
}

}  // namespace

LocalTurns::LocalTurns(std::span<const Eigen::Vector3d> rest_m, const capsule::PrimitiveSet& set,
                       const ThreadPool& pool)
    : rest_m_(rest_m),
      weights_(set.spheres.size(), 0.0),
      middles_m_(set.spheres.size(), Eigen::Vector3d::Zero()) {
  const std::vector<capsule::CapsuleEnds> solids = capsule::SolidEnds(set);
  const std::vector<geometry::TaperedCapsule> shapes = capsule::Solids(set);
  const tighten::PointGrid grid(rest_m);
  const tighten::UnionDistances at = grid.DistancesTo(shapes, -1.0, pool);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const int nearest = at.solid[i];
    const double t = shapes[nearest].Locate(grid.point(i)).axis_parameter;
    for (const int end : {0, 1}) {
      const Share share{grid.order()[i], static_cast<std::uint32_t>(solids[nearest][end]),
                        end == 0 ? 1.0 - t : t};
      if (!(share.weight > 0.0)) continue;
      shares_.push_back(share);
      weights_[share.sphere] += share.weight;
      middles_m_[share.sphere] += share.weight * grid.point(i);
    }
  }
  std::vector<std::size_t> firm;
  for (std::size_t s = 0; s < weights_.size(); ++s) {
    if (weights_[s] > 0.0) middles_m_[s] /= weights_[s];
    if (weights_[s] >= kLeastWeight) firm.push_back(s);
  }
  for (std::size_t s = 0; s < weights_.size(); ++s) {
    stands_for_.push_back(weights_[s] >= kLeastWeight ? s : NearestAmong(firm, s, set));
  }
}

std::vector<Eigen::Matrix3d> LocalTurns::At(std::span<const Eigen::Vector3d> now_m) const {
  // The points at rest are relative to their middle: so those now need not be.
  std::vector<Eigen::Matrix3d> products(weights_.size(), Eigen::Matrix3d::Zero());
  for (const Share& share : shares_) {
    products[share.sphere] += share.weight * now_m[share.point] *
                              (rest_m_[share.point] - middles_m_[share.sphere]).transpose();
  }
  std::vector<Eigen::Matrix3d> turns(weights_.size(), Eigen::Matrix3d::Identity());
  for (std::size_t s = 0; s < turns.size(); ++s) {
    if (weights_[s] < kLeastWeight) continue;
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(products[s],
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d signs = Eigen::Vector3d::Ones();
    signs[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant();
    turns[s] = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  }
  for (std::size_t s = 0; s < turns.size(); ++s) turns[s] = turns[stands_for_[s]];
  return turns;
}

}  // namespace capfit::motion
