#include "core/mesh/plane_cutter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace capfit::mesh {
namespace {

constexpr std::size_t kGroupSize = 8;
constexpr std::size_t kBlocksPerTask = 64;
constexpr std::size_t kUsualPieces = 256;
// Rounding must not lose a triangle that just touches the plane.
constexpr double kBoxSlack = 1.000001;
constexpr double kRounding = 1e-12;

struct Bounds {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;

  void Add(const Eigen::Vector3d& least, const Eigen::Vector3d& most) {
    low = low.cwiseMin(least);
    high = high.cwiseMax(most);
  }
};

}  // namespace

PlaneCutter::PlaneCutter(std::span<const Eigen::Vector3d> points,
                         std::span<const Triangle> triangles, const ThreadPool& pool)
    : points_(points), triangles_(triangles) {
  groups_.resize((triangles.size() + kGroupSize - 1) / kGroupSize);
  blocks_.resize((groups_.size() + kGroupSize - 1) / kGroupSize);
  pool.ForChunks(blocks_.size(), kBlocksPerTask, [this](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      Bounds block;
      for (std::size_t g = b * kGroupSize; g < std::min((b + 1) * kGroupSize, groups_.size());
           ++g) {
        Bounds group;
        for (std::size_t i = g * kGroupSize; i < std::min((g + 1) * kGroupSize, triangles_.size());
             ++i) {
          for (const std::uint32_t v : triangles_[i]) group.Add(points_[v], points_[v]);
        }
        groups_[g] = {0.5 * (group.low + group.high), 0.5 * (group.high - group.low)};
        block.Add(groups_[g].center - groups_[g].half, groups_[g].center + groups_[g].half);
      }
      blocks_[b] = {0.5 * (block.low + block.high), 0.5 * (block.high - block.low)};
    }
  });
}

// What a plane meets next to what it touches is as good as chance: what it meets is listed without
// branches, then visited.
std::vector<CutPiece> PlaneCutter::Cut(const Eigen::Vector3d& origin,
                                       const Eigen::Vector3d& normal) const {
  std::vector<CutPiece> pieces;
  pieces.reserve(kUsualPieces);
  const Eigen::Vector3d steepness = kBoxSlack * normal.cwiseAbs();
  const double offset = normal.dot(origin);
  const auto touches = [&](const Box& box) {
    return std::abs(normal.dot(box.center) - offset) <= steepness.dot(box.half) + kRounding;
  };
  std::array<std::size_t, kGroupSize> touched;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    if (!touches(blocks_[b])) continue;
    const std::size_t last_group = std::min((b + 1) * kGroupSize, groups_.size());
    std::size_t count = 0;
    for (std::size_t g = b * kGroupSize; g < last_group; ++g) {
      touched[count] = g;
      count += touches(groups_[g]) ? 1 : 0;
    }
    for (std::size_t i = 0; i < count; ++i) CutGroup(touched[i], origin, normal, pieces);
  }
  return pieces;
}

void PlaneCutter::CutGroup(std::size_t group, const Eigen::Vector3d& origin,
                           const Eigen::Vector3d& normal, std::vector<CutPiece>& pieces) const {
  struct Passed {
    std::size_t triangle;
    std::size_t above;
    std::array<double, 3> heights;
  };
  std::array<Passed, kGroupSize> passed;
  std::size_t count = 0;
  const auto height = [&](std::uint32_t v) { return normal.dot(points_[v] - origin); };
  const std::size_t last = std::min((group + 1) * kGroupSize, triangles_.size());
  for (std::size_t i = group * kGroupSize; i < last; ++i) {
    const Triangle& t = triangles_[i];
    const std::array<double, 3> heights = {height(t[0]), height(t[1]), height(t[2])};
    const std::size_t above = CornersAbove(heights);
    passed[count] = {i, above, heights};
    count += ((above != 0) & (above != 7)) ? 1 : 0;
  }
  for (std::size_t i = 0; i < count; ++i) {
    CutPassedTriangle(points_, triangles_[passed[i].triangle], passed[i].heights, passed[i].above,
                      pieces);
  }
}

}  // namespace capfit::mesh
