#include "core/mesh/weld_vertices.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "absl/container/flat_hash_map.h"

namespace capfit::mesh {
namespace {

// Abseil's hash is seeded anew in each process, so nobody can prepare positions that collide. The
// maps are only looked up, never walked, so the seed does not show in the result.

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

std::vector<std::uint32_t> Themselves(std::size_t count) {
  std::vector<std::uint32_t> standing_for(count);
  std::iota(standing_for.begin(), standing_for.end(), 0u);
  return standing_for;
}

// Adding 0.0 turns -0.0 into 0.0.
std::uint64_t BitsOf(double value) { return std::bit_cast<std::uint64_t>(value + 0.0); }

using Cell = std::array<std::int64_t, 3>;

// Cells of twice the tolerance: what is within the tolerance of a point lies in its own cell or in
// those across its nearer faces, eight in all.
class ToleranceGrid {
 public:
  ToleranceGrid(std::span<const Eigen::Vector3d> positions, const Eigen::Vector3d& origin,
                double tolerance)
      : positions_(positions), origin_(origin), tolerance_(tolerance) {}

  void Reserve(std::size_t count) {
    first_in_cell_.reserve(count);
    links_.reserve(count);
  }

  // The nearest added vertex within the tolerance (of equally near ones the lowest), or kNone.
  [[nodiscard]] std::uint32_t FindNear(std::uint32_t vertex) const {
    const Eigen::Vector3d scaled = Scaled(vertex);
    Nearest nearest{kNone, tolerance_ * tolerance_};
    for (int corner = 0; corner < 8; ++corner) {
      Cell cell = CellOf(scaled);
      for (int axis = 0; axis < 3; ++axis) {
        if ((corner >> axis & 1) == 0) continue;
        cell[axis] += scaled[axis] - std::floor(scaled[axis]) < 0.5 ? -1 : 1;
      }
      SearchCell(cell, vertex, nearest);
    }
    return nearest.vertex;
  }

  void Add(std::uint32_t vertex) {
    const auto [entry, is_new] = first_in_cell_.try_emplace(CellOf(Scaled(vertex)), kNone);
    links_.push_back({vertex, entry->second});
    entry->second = static_cast<std::uint32_t>(links_.size() - 1);
  }

 private:
  struct Nearest {
    std::uint32_t vertex;
    double squared;
  };
  struct Link {
    std::uint32_t vertex;
    std::uint32_t next;
  };

  void SearchCell(const Cell& cell, std::uint32_t vertex, Nearest& nearest) const {
    const auto entry = first_in_cell_.find(cell);
    if (entry == first_in_cell_.end()) return;
    for (std::uint32_t k = entry->second; k != kNone; k = links_[k].next) {
      const std::uint32_t other = links_[k].vertex;
      const double squared = (positions_[other] - positions_[vertex]).squaredNorm();
      if (squared < nearest.squared || (squared == nearest.squared && other < nearest.vertex)) {
        nearest = {other, squared};
      }
    }
  }

  [[nodiscard]] Eigen::Vector3d Scaled(std::uint32_t vertex) const {
    return (positions_[vertex] - origin_) / (2.0 * tolerance_);
  }
  static Cell CellOf(const Eigen::Vector3d& scaled) {
    return {static_cast<std::int64_t>(std::floor(scaled.x())),
            static_cast<std::int64_t>(std::floor(scaled.y())),
            static_cast<std::int64_t>(std::floor(scaled.z()))};
  }

  std::span<const Eigen::Vector3d> positions_;
  Eigen::Vector3d origin_;
  double tolerance_;
  absl::flat_hash_map<Cell, std::uint32_t> first_in_cell_;
  std::vector<Link> links_;
};

}  // namespace

std::vector<std::uint32_t> WeldEqual(std::span<const Eigen::Vector3d> positions,
                                     std::span<const std::uint32_t> candidates) {
  std::vector<std::uint32_t> standing_for = Themselves(positions.size());
  absl::flat_hash_map<std::array<std::uint64_t, 3>, std::uint32_t> first_at;
  first_at.reserve(candidates.size() / 4);
  for (const std::uint32_t v : candidates) {
    const Eigen::Vector3d& p = positions[v];
    const auto [entry, is_new] =
        first_at.try_emplace({BitsOf(p.x()), BitsOf(p.y()), BitsOf(p.z())}, v);
    standing_for[v] = entry->second;
  }
  return standing_for;
}

std::vector<std::uint32_t> WeldWithin(std::span<const Eigen::Vector3d> positions,
                                      std::span<const std::uint32_t> candidates, double tolerance) {
  std::vector<std::uint32_t> standing_for = Themselves(positions.size());
  if (candidates.empty()) return standing_for;
  ToleranceGrid grid(positions, positions[candidates.front()], tolerance);
  grid.Reserve(candidates.size());
  for (const std::uint32_t v : candidates) {
    const std::uint32_t near = grid.FindNear(v);
    if (near == kNone) {
      grid.Add(v);
    } else {
      standing_for[v] = near;
    }
  }
  return standing_for;
}

}  // namespace capfit::mesh
