// The points that must be inside, and which capsule each lies deepest in.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_COVER_POINTS_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_COVER_POINTS_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/refine/graph/cone.h"

namespace capfit::refine {

struct CoverPoint {
  Eigen::Vector3f position_m = Eigen::Vector3f::Zero();
  float allowed_m = 0.0f;  // how far it may stick out
};

// Neighbours in space lie together, in blocks with a bounding ball each.
struct CoverPoints {
  struct Block {
    int begin = 0;
    int end = 0;
    Eigen::Vector3f center_m = Eigen::Vector3f::Zero();
    float radius_m = 0.0f;
  };
  std::vector<float> x, y, z, allowed;
  std::vector<Block> blocks;

  [[nodiscard]] int size() const { return static_cast<int>(x.size()); }
  [[nodiscard]] CoverPoint At(int i) const {
    const auto k = static_cast<std::size_t>(i);
    return {{x[k], y[k], z[k]}, allowed[k]};
  }
};

// Sorts the points along a space-filling curve. O(n log n). Points must lie within 8 m of the
// origin.
[[nodiscard]] CoverPoints MakeCoverPoints(std::vector<CoverPoint> points);

// Of each cell of `cell_m` only the points that are furthest out along one of 26 directions:
// hulls that hold these hold nearly all.
[[nodiscard]] std::vector<CoverPoint> ThinOut(std::span<const CoverPoint> points, double cell_m);

// For each point the cone it lies deepest in (the lowest index among equals), and how far it sticks
// out of that beyond what is allowed (negative inside).
struct Deepest {
  std::vector<float> excess_m;
  std::vector<int> cone;
  [[nodiscard]] double SumOutside() const;  // sum of the positive excesses
};
[[nodiscard]] Deepest FindDeepest(const CoverPoints& points, const std::vector<Cone>& cones);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_COVER_POINTS_H_
