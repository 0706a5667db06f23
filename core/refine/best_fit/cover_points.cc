#include "core/refine/best_fit/cover_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

constexpr int kBlockSize = 48;
constexpr float kOffset = 8.0f;        // makes all coordinates positive
constexpr float kCurveCells = 256.0f;  // per metre

// Spreads 21 bits so that two zero bits follow each.
std::uint64_t Spread(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffffull;
  v = (v | v << 16) & 0x1f0000ff0000ffull;
  v = (v | v << 8) & 0x100f00f00f00f00full;
  v = (v | v << 4) & 0x10c30c30c30c30c3ull;
  return (v | v << 2) & 0x1249249249249249ull;
}

std::uint64_t CurveKey(const Eigen::Vector3f& p) {
  const auto cell = [](float v) {
    return static_cast<std::uint64_t>(std::max(0.0f, (v + kOffset) * kCurveCells));
  };
  return Spread(cell(p.x())) | Spread(cell(p.y())) << 1 | Spread(cell(p.z())) << 2;
}

CoverPoints::Block Bound(const CoverPoints& points, int begin, int end) {
  CoverPoints::Block block{begin, end, {}, 0.0f};
  Eigen::Vector3f low = points.At(begin).position_m, high = low;
  for (int i = begin; i < end; ++i) {
    low = low.cwiseMin(points.At(i).position_m);
    high = high.cwiseMax(points.At(i).position_m);
  }
  block.center_m = 0.5f * (low + high);
  for (int i = begin; i < end; ++i) {
    block.radius_m = std::max(block.radius_m, (points.At(i).position_m - block.center_m).norm());
  }
  return block;
}

}  // namespace

CoverPoints MakeCoverPoints(std::vector<CoverPoint> points) {
  std::vector<std::pair<std::uint64_t, int>> order(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    order[i] = {CurveKey(points[i].position_m), static_cast<int>(i)};
  }
  std::sort(order.begin(), order.end());
  CoverPoints result;
  for (const auto& [key, index] : order) {
    const CoverPoint& p = points[U(index)];
    result.x.push_back(p.position_m.x());
    result.y.push_back(p.position_m.y());
    result.z.push_back(p.position_m.z());
    result.allowed.push_back(p.allowed_m);
  }
  for (int begin = 0; begin < result.size(); begin += kBlockSize) {
    result.blocks.push_back(Bound(result, begin, std::min(result.size(), begin + kBlockSize)));
  }
  return result;
}

std::vector<CoverPoint> ThinOut(std::span<const CoverPoint> points, double cell_m) {
  constexpr int kDirections = 26;
  std::array<Eigen::Vector3f, kDirections> directions;
  int count = 0;
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3f d(static_cast<float>(i % 3 - 1), static_cast<float>(i / 3 % 3 - 1),
                            static_cast<float>(i / 9 - 1));
    if (d.squaredNorm() > 0.0f) directions[U(count++)] = d.normalized();
  }
  std::vector<std::pair<std::uint64_t, int>> cells(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f q =
        points[i].position_m / static_cast<float>(cell_m) + Eigen::Vector3f::Constant(100'000.0f);
    const auto part = [](float v) { return static_cast<std::uint64_t>(v) & 0x1fffff; };
    cells[i] = {part(q.x()) << 42 | part(q.y()) << 21 | part(q.z()), static_cast<int>(i)};
  }
  std::sort(cells.begin(), cells.end());
  std::vector<CoverPoint> kept;
  for (std::size_t begin = 0; begin < cells.size();) {
    std::size_t end = begin;
    while (end < cells.size() && cells[end].first == cells[begin].first) ++end;
    std::vector<int> chosen;
    for (const Eigen::Vector3f& d : directions) {
      int best = cells[begin].second;
      for (std::size_t k = begin; k < end; ++k) {
        const int i = cells[k].second;
        if (points[U(i)].position_m.dot(d) > points[U(best)].position_m.dot(d)) best = i;
      }
      chosen.push_back(best);
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    for (const int i : chosen) kept.push_back(points[U(i)]);
    begin = end;
  }
  return kept;
}

double Deepest::SumOutside() const {
  double sum = 0.0;
  for (const float e : excess_m) sum += std::max(0.0f, e);
  return sum;
}

Deepest FindDeepest(const CoverPoints& points, const std::vector<Cone>& cones) {
  Deepest result;
  result.excess_m.assign(points.x.size(), std::numeric_limits<float>::max());
  result.cone.assign(points.x.size(), -1);
  std::vector<float> distance(cones.size());
  for (const CoverPoints::Block& block : points.blocks) {
    float least = std::numeric_limits<float>::max();
    for (std::size_t j = 0; j < cones.size(); ++j) {
      distance[j] =
          SignedDistance(cones[j], block.center_m.x(), block.center_m.y(), block.center_m.z());
      least = std::min(least, distance[j]);
    }
    for (std::size_t j = 0; j < cones.size(); ++j) {
      if (distance[j] > least + 2.0f * block.radius_m) continue;
      const Cone cone = cones[j];
      const int index = static_cast<int>(j);
      for (std::size_t i = U(block.begin); i < U(block.end); ++i) {
        const float d = SignedDistance(cone, points.x[i], points.y[i], points.z[i]);
        const bool deeper = d < result.excess_m[i];
        result.excess_m[i] = deeper ? d : result.excess_m[i];
        result.cone[i] = deeper ? index : result.cone[i];
      }
    }
  }
  for (std::size_t i = 0; i < points.x.size(); ++i) result.excess_m[i] -= points.allowed[i];
  return result;
}

}  // namespace capfit::refine
