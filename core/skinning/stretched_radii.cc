#include "core/skinning/stretched_radii.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace capfit::skinning {
namespace {

double Within(double factor) {
  return std::isfinite(factor) ? std::clamp(factor, kLeastStretch, kMostStretch) : 1.0;
}

// The sum of weight * distance of a sphere's vertices.
double MeanDistance(const SparseWeights& weights, std::size_t sphere, const CarriedCenters& pose) {
  double sum = 0.0;
  for (std::size_t i = weights.RowBegin(sphere); i < weights.row_ends[sphere]; ++i) {
    sum += static_cast<double>(weights.weights[i]) *
           (pose.vertices[weights.vertices[i]] - pose.centers[sphere]).norm();
  }
  return sum;
}

double MeanDistance(const DenseWeights& weights, std::size_t sphere, const CarriedCenters& pose) {
  const std::span<const float> row = weights.Row(sphere);
  double sum = 0.0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] == 0.0F) continue;
    sum += static_cast<double>(row[i]) * (pose.vertices[i] - pose.centers[sphere]).norm();
  }
  return sum;
}

template <typename Weights>
std::vector<double> StretchOf(const Weights& weights, const CarriedCenters& rest,
                              const CarriedCenters& now) {
  std::vector<double> factors;
  for (std::size_t s = 0; s < rest.centers.size(); ++s) {
    const double at_rest = MeanDistance(weights, s, rest);
    factors.push_back(at_rest > 0.0 ? Within(MeanDistance(weights, s, now) / at_rest) : 1.0);
  }
  return factors;
}

}  // namespace

std::vector<double> Stretch(const SparseWeights& weights, const CarriedCenters& rest,
                            const CarriedCenters& now) {
  return StretchOf(weights, rest, now);
}

std::vector<double> Stretch(const DenseWeights& weights, const CarriedCenters& rest,
                            const CarriedCenters& now) {
  return StretchOf(weights, rest, now);
}

std::vector<double> Stretch(const BoneWeights& weights, std::span<const formats::Placing> rest,
                            std::span<const formats::Placing> now) {
  std::vector<double> factors;
  for (std::size_t s = 0; s < weights.sphere_count(); ++s) {
    double factor = 0.0;
    for (std::size_t i = weights.RowBegin(s); i < weights.row_ends[s]; ++i) {
      const std::size_t joint = weights.joints[i];
      factor += static_cast<double>(weights.weights[i]) *
                std::cbrt(std::abs(now[joint].leftCols<3>().determinant() /
                                   rest[joint].leftCols<3>().determinant()));
    }
    factors.push_back(Within(factor));
  }
  return factors;
}

}  // namespace capfit::skinning
