#include "core/skinning/linear_precision.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace capfit::skinning {
namespace {

// Rounding a weight below 2^-9 to float moves it by at most 2^-34.
constexpr float kFineWeight = 0x1p-9f;
// The roundings of a row add up to 1e-9 or so: 1e-5 of such a weight.
constexpr float kAmpleWeight = 0x1p-13f;
constexpr double kSumTolerance = 1e-10;
// Of a sparse row's sum, and of its moment as a share of the offsets' size.
constexpr double kMomentTolerance = 5e-11;
// Below this share of the absolute sum, a sum of weights is noise and must not be divided by.
constexpr double kUsableSum = 1e-9;
// Directions in which the vertices' spread is this much smaller than in others count as flat.
constexpr double kSupplyRank = 1e-12;

// The vector (1, (p - c) / scale) of one vertex for four centres.
struct Moments {
  Moments(const Eigen::Vector3d& p, const std::array<Lanes, 3>& center, double inverse_scale)
      : values{Lanes::Ones(), (p.x() - center[0]) * inverse_scale,
               (p.y() - center[1]) * inverse_scale, (p.z() - center[2]) * inverse_scale} {}
  std::array<Lanes, 4> values;
};

std::array<Lanes, 3> ByAxis(const std::array<Eigen::Vector3d, kLanes>& centers) {
  std::array<Lanes, 3> axes;
  for (int axis = 0; axis < 3; ++axis) {
    for (int lane = 0; lane < kLanes; ++lane) axes[axis][lane] = centers[lane][axis];
  }
  return axes;
}

double Extent(std::span<const Eigen::Vector3d> vertices) {
  double extent = 0.0;
  for (const Eigen::Vector3d& p : vertices) {
    extent = std::max(extent, (p - vertices.front()).lpNorm<Eigen::Infinity>());
  }
  return extent;
}

// The weights times these, or their absolute values where they have no usable sum, sum to 1.
struct Scale {
  Lanes of_weight;
  Lanes of_size;
};

Scale ScaleOf(const Lanes& sum, const Lanes& absolute) {
  const auto usable = (sum.abs() > kUsableSum * absolute).eval();
  return {usable.select(sum.inverse(), Lanes::Zero()),
          usable.select(Lanes::Zero(), absolute.inverse())};
}

// What is missing, and how much of it a change of a and b supplies.
struct Defect {
  std::array<Eigen::Matrix4d, kLanes> supply;
  std::array<Eigen::Vector4d, kLanes> missing;
  Scale scale;
};

Defect MeasureDefect(std::span<const Eigen::Vector3d> vertices, const std::array<Lanes, 3>& center,
                     double inverse_scale, const std::vector<Lanes>& weights) {
  // Sums of the weights' moments, and of the squared moments times their absolute values.
  std::array<Lanes, 10> supply;
  std::array<Lanes, 4> present;
  supply.fill(Lanes::Zero());
  present.fill(Lanes::Zero());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Moments m(vertices[i], center, inverse_scale);
    const Lanes weight = weights[i];
    const Lanes size = weight.abs();
    std::size_t entry = 0;
    for (std::size_t row = 0; row < 4; ++row) {
      present[row] += weight * m.values[row];
      const Lanes scaled = size * m.values[row];
      for (std::size_t column = row; column < 4; ++column) {
        supply[entry++] += scaled * m.values[column];
      }
    }
  }
  Defect defect;
  defect.scale = ScaleOf(present[0], supply[0]);
  // The first row of the supply is what absolute values would be present with.
  for (std::size_t k = 0; k < 4; ++k) {
    present[k] = present[k] * defect.scale.of_weight + supply[k] * defect.scale.of_size;
  }
  const Lanes of_supply = defect.scale.of_weight.abs() + defect.scale.of_size;
  for (Lanes& entry : supply) entry *= of_supply;
  for (int lane = 0; lane < kLanes; ++lane) {
    std::size_t entry = 0;
    for (int row = 0; row < 4; ++row) {
      defect.missing[lane][row] = (row == 0 ? 1.0 : 0.0) - present[row][lane];
      for (int column = row; column < 4; ++column, ++entry) {
        defect.supply[lane](row, column) = supply[entry][lane];
        defect.supply[lane](column, row) = supply[entry][lane];
      }
    }
  }
  return defect;
}

// Lays the row on a grid fine enough for a float and gives the difference to the largest weight.
void LayOnGrid(std::span<float> row) {
  const auto largest = std::max_element(row.begin(), row.end(),
                                        [](float a, float b) { return std::abs(a) < std::abs(b); });
  int exponent = 0;
  std::frexp(std::max(1.0f, std::abs(*largest)), &exponent);
  const double step = std::ldexp(1.0, (std::abs(*largest) < 1.0f ? 0 : exponent) - 24);
  double sum = 0.0;
  for (float& weight : row) {
    weight = static_cast<float>(std::nearbyint(weight / step) * step);
    sum += weight;
  }
  *largest = static_cast<float>(*largest + (1.0 - sum));
}

// Four sums side by side: one alone would wait for each addition.
double Sum(std::span<const float> row) {
  Lanes sums = Lanes::Zero();
  std::size_t i = 0;
  for (; i + kLanes <= row.size(); i += kLanes) {
    sums += Eigen::Map<const Eigen::Array<float, kLanes, 1>>(&row[i]).cast<double>();
  }
  double sum = sums.sum();
  for (; i < row.size(); ++i) sum += row[i];
  return sum;
}

// A weight of which the rounding of a whole row is a small part, or else the largest of the fine
// ones; nothing where all are coarse.
float* FindFineWeight(std::span<float> row) {
  float* largest = nullptr;
  for (float& weight : row) {
    const float size = std::abs(weight);
    if (size == 0.0f || size >= kFineWeight) continue;
    if (size >= kAmpleWeight) return &weight;
    if (largest == nullptr || size > std::abs(*largest)) largest = &weight;
  }
  return largest;
}

// The vector (1, offset / scale) of each.
std::vector<Eigen::Vector4d> ScaledMoments(std::span<const Eigen::Vector3d> offsets) {
  double scale = 0.0;
  for (const Eigen::Vector3d& offset : offsets) scale = std::max(scale, offset.norm());
  const double inverse = scale > 0.0 ? 1.0 / scale : 0.0;
  std::vector<Eigen::Vector4d> moments;
  moments.reserve(offsets.size());
  for (const Eigen::Vector3d& offset : offsets) {
    moments.emplace_back(1.0, inverse * offset.x(), inverse * offset.y(), inverse * offset.z());
  }
  return moments;
}

Eigen::Vector4d Missing(const std::vector<Eigen::Vector4d>& moments,
                        const std::vector<float>& weights) {
  Eigen::Vector4d missing(1.0, 0.0, 0.0, 0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    missing -= static_cast<double>(weights[i]) * moments[i];
  }
  return missing;
}

// Four that span the space: each the one that adds most to it for its size, or for the root of it.
std::array<std::size_t, 4> FourSmall(const std::vector<Eigen::Vector4d>& moments,
                                     std::span<const double> weights, bool is_strict) {
  std::vector<Eigen::Vector4d> left;
  left.reserve(moments.size());
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const double size = std::abs(weights[i]);
    left.push_back(moments[i] / (is_strict ? size : std::sqrt(size)));
  }
  std::array<std::size_t, 4> chosen{};
  for (std::size_t& one : chosen) {
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (left[i].squaredNorm() > left[one].squaredNorm()) one = i;
    }
    const Eigen::Vector4d direction = left[one].normalized();
    for (Eigen::Vector4d& of : left) of -= direction.dot(of) * direction;
  }
  return chosen;
}

}  // namespace

void MakeLinearlyPrecise(std::span<const Eigen::Vector3d> vertices,
                         const std::array<Eigen::Vector3d, kLanes>& centers,
                         std::vector<Lanes>& weights) {
  const std::array<Lanes, 3> center = ByAxis(centers);
  const double inverse_scale = 1.0 / Extent(vertices);
  const Defect defect = MeasureDefect(vertices, center, inverse_scale, weights);
  const Scale scale = defect.scale;
  std::array<Lanes, 4> change;
  for (int lane = 0; lane < kLanes; ++lane) {
    // Few vertices (a centre on a face) supply only part of the space: the rest is left as it is.
    Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix4d> solver;
    solver.setThreshold(kSupplyRank);
    solver.compute(defect.supply[lane]);
    const Eigen::Vector4d solution = solver.solve(defect.missing[lane]);
    for (std::size_t k = 0; k < 4; ++k) change[k][lane] = solution[static_cast<Eigen::Index>(k)];
  }
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Moments m(vertices[i], center, inverse_scale);
    const Lanes factor =
        change[0] + change[1] * m.values[1] + change[2] * m.values[2] + change[3] * m.values[3];
    const Lanes weight = weights[i] * scale.of_weight + weights[i].abs() * scale.of_size;
    weights[i] = weight + weight.abs() * factor;
  }
}

void MendFloatSum(std::span<float> row) {
  const double sum = Sum(row);
  if (std::abs(1.0 - sum) <= kSumTolerance) return;
  if (float* const fine = FindFineWeight(row)) {
    *fine = static_cast<float>(*fine + (1.0 - sum));
    if (std::abs(1.0 - Sum(row)) <= kSumTolerance) return;
  }
  LayOnGrid(row);
}

std::vector<float> RoundPrecisely(std::span<const Eigen::Vector3d> offsets,
                                  std::span<const double> weights) {
  std::vector<float> best(weights.begin(), weights.end());
  if (weights.size() < 4) return best;
  const std::vector<Eigen::Vector4d> moments = ScaledMoments(offsets);
  const std::vector<float> rounded = best;
  const Eigen::Vector4d missing = Missing(moments, rounded);
  double least = missing.norm();
  for (const bool is_strict : {true, false}) {
    if (least < kMomentTolerance) break;
    const std::array<std::size_t, 4> four = FourSmall(moments, weights, is_strict);
    Eigen::Matrix4d supply;
    for (int k = 0; k < 4; ++k) supply.col(k) = moments[four[k]];
    const Eigen::Vector4d change = supply.fullPivLu().solve(missing);
    std::vector<float> mended = rounded;
    for (int k = 0; k < 4; ++k) {
      float& weight = mended[four[k]];
      weight = static_cast<float>(weight + change[k]);
    }
    const double left = Missing(moments, mended).norm();
    if (!(left < least)) continue;
    least = left;
    best = std::move(mended);
  }
  return best;
}

}  // namespace capfit::skinning
