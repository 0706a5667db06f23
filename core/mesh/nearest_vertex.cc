#include "core/mesh/nearest_vertex.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace capfit::mesh {
namespace {

// A surface passes through about the square of the cells along its longest side.
constexpr double kVerticesPerCell = 2.0;
constexpr int kMostCellsAlong = 256;
// Of a cell: rounding must not carry a vertex beyond the cell that it was put into.
constexpr double kRounding = 1e-6;

}  // namespace

NearestVertex::NearestVertex(std::span<const Eigen::Vector3d> vertices) : given_(vertices) {
  Eigen::Vector3d high = vertices[0];
  low_ = vertices[0];
  for (const Eigen::Vector3d& v : vertices) {
    low_ = low_.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  const double along = std::sqrt(static_cast<double>(vertices.size()) / kVerticesPerCell);
  const double longest = (high - low_).maxCoeff();
  cell_ = longest / std::clamp(along, 1.0, double{kMostCellsAlong});
  if (!(cell_ > 0.0)) cell_ = 1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    size_[k] = static_cast<int>(std::floor((high[axis] - low_[axis]) / cell_)) + 1;
  }
  begin_.assign(std::size_t{1} * size_[0] * size_[1] * size_[2] + 1, 0);
  std::vector<std::uint32_t> cell_of(vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    cell_of[v] = static_cast<std::uint32_t>(IndexOf(CellOf(vertices[v])));
    ++begin_[cell_of[v] + 1];
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  order_.resize(vertices.size());
  vertices_.resize(vertices.size());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const std::uint32_t place = next[cell_of[v]]++;
    order_[place] = static_cast<std::uint32_t>(v);
    vertices_[place] = vertices[v];
  }
}

NearestVertex::Cell NearestVertex::CellOf(const Eigen::Vector3d& point) const {
  Cell cell{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const double at = std::floor((point[axis] - low_[axis]) / cell_);
    cell[k] = static_cast<int>(std::clamp(at, 0.0, static_cast<double>(size_[k] - 1)));
  }
  return cell;
}

std::size_t NearestVertex::IndexOf(const Cell& cell) const {
  return (std::size_t{1} * size_[1] * cell[2] + cell[1]) * size_[0] + cell[0];
}

double NearestVertex::SquaredBeside(const Eigen::Vector3d& point, int axis, int cell) const {
  const double at = point[axis] - low_[axis];
  const double beside = std::max(cell * cell_ - at, at - (cell + 1) * cell_) - kRounding * cell_;
  return beside > 0.0 ? beside * beside : 0.0;
}

std::uint32_t NearestVertex::At(const Eigen::Vector3d& point) const {
  return Search(point, {std::numeric_limits<double>::infinity(), 0});
}

std::uint32_t NearestVertex::At(const Eigen::Vector3d& point, std::uint32_t near) const {
  return Search(point, {(given_[near] - point).squaredNorm(), near});
}

std::uint32_t NearestVertex::Search(const Eigen::Vector3d& point, Best best) const {
  const Cell middle = CellOf(point);
  // What the point lies beside the box is as far from every cell.
  const auto look = [&](const Cell& cell) {
    const std::size_t index = IndexOf(cell);
    for (std::uint32_t i = begin_[index]; i < begin_[index + 1]; ++i) {
      const double squared = (vertices_[i] - point).squaredNorm();
      if (squared > best.squared || (squared == best.squared && order_[i] > best.vertex)) continue;
      best = {squared, order_[i]};
    }
  };
  const int rings = std::max({size_[0], size_[1], size_[2]});
  for (int ring = 0; ring <= rings; ++ring) {
    // Nothing in this ring of cells, nor beyond, is nearer than that.
    const double at_least = (ring - 1) * cell_;
    if (ring > 0 && at_least * at_least > best.squared) break;
    const auto low = [&](std::size_t k) { return std::max(0, middle[k] - ring); };
    const auto high = [&](std::size_t k) { return std::min(size_[k] - 1, middle[k] + ring); };
    for (int z = low(2); z <= high(2); ++z) {
      const double beside_z = SquaredBeside(point, 2, z);
      if (beside_z > best.squared) continue;
      for (int y = low(1); y <= high(1); ++y) {
        const double beside_zy = beside_z + SquaredBeside(point, 1, y);
        const auto look_at = [&](int x) {
          if (beside_zy + SquaredBeside(point, 0, x) <= best.squared) look({x, y, z});
        };
        const bool is_face = std::abs(z - middle[2]) == ring || std::abs(y - middle[1]) == ring;
        if (is_face) {
          for (int x = low(0); x <= high(0); ++x) look_at(x);
          continue;
        }
        if (middle[0] - ring >= 0) look_at(middle[0] - ring);
        if (ring > 0 && middle[0] + ring < size_[0]) look_at(middle[0] + ring);
      }
    }
  }
  return best.vertex;
}

}  // namespace capfit::mesh
