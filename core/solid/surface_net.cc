#include "core/solid/surface_net.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/base/chunk_sums.h"

namespace capfit::solid {
namespace {

// How strongly a vertex is held at the mean of its cell's crossings, beside each plane's pull of 1:
// little, so that edges stay sharp, but enough where all planes are nearly one.
constexpr float kHold = 0.15f;
// Vertices keep this share of a step away from their cell's sides, and so from each other.
constexpr float kMargin = 0.04f;

// Where an edge between two nodes is crossed; t < 0: nothing known.
struct EdgePoint {
  float t = -1.0f;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

class NetBuilder {
 public:
  NetBuilder(const NodeGrid& grid, const NodeSet& set, const ThreadPool& pool)
      : grid_(grid),
        set_(set),
        pool_(pool),
        cells_(grid),
        edges_{NodeSet(grid), NodeSet(grid), NodeSet(grid)},
        stride_{0, grid.words_per_column(), grid.words_per_column() * grid.size[1]} {
    FindCellsAndEdges();
  }

  void TakeCrossings(const std::array<GridLines, 3>& lines,
                     std::span<const Eigen::Vector3f> normals) {
    for (int axis = 0; axis < 3; ++axis) {
      points_[axis].resize(edge_numbers_[axis].count());
      pool_.ForEach(lines[axis].rows.size(), [&](std::size_t row) {
        const std::size_t columns = lines[axis].rows[row].begin.size() - 1;
        for (std::size_t column = 0; column < columns; ++column) {
          TakeLine(axis, row, column, lines[axis].Line(row, column), normals);
        }
      });
    }
  }

  NetSurface Build() {
    NetSurface net;
    net.vertices.resize(cell_numbers_.count());
    ForEachWord([&](std::size_t i, std::size_t k, std::size_t v, std::size_t w) {
      std::uint32_t number = cell_numbers_.FirstOf(i);
      ForEachBit(cells_.words()[i], [&](unsigned bit) {
        net.vertices[number++] = VertexOf(static_cast<std::uint32_t>(64 * k + bit), v, w);
      });
    });
    std::size_t first = 0;
    for (int axis = 0; axis < 3; ++axis) {
      net.triangles.resize(2 * (first + edge_numbers_[axis].count()));
      ForEachWord([&](std::size_t i, std::size_t k, std::size_t v, std::size_t w) {
        std::size_t number = first + edge_numbers_[axis].FirstOf(i);
        ForEachBit(edges_[axis].words()[i], [&](unsigned bit) {
          AddQuad(axis, static_cast<std::uint32_t>(64 * k + bit), v, w, number++, net);
        });
      });
      first += edge_numbers_[axis].count();
    }
    return net;
  }

 private:
  // visit(word, k, v, w) for all words of the grid, the columns of each w in one task.
  template <typename Visit>
  void ForEachWord(const Visit& visit) const {
    pool_.ForEach(grid_.size[2] - 1, [&](std::size_t w) {
      std::size_t i = grid_.WordAt(0, 0, w);
      for (std::size_t v = 0; v + 1 < grid_.size[1]; ++v) {
        for (std::size_t k = 0; k < grid_.words_per_column(); ++k) visit(i++, k, v, w);
      }
    });
  }

  void FindCellsAndEdges() {
    ForEachWord([&](std::size_t i, std::size_t, std::size_t, std::size_t) {
      const std::vector<std::uint64_t>& words = set_.words();
      const std::size_t j = i + stride_[1];
      const std::size_t k = i + stride_[2];
      const std::size_t l = j + stride_[2];
      const std::uint64_t any = words[i] | words[j] | words[k] | words[l];
      const std::uint64_t all = words[i] & words[j] & words[k] & words[l];
      const std::uint64_t next_any =
          set_.NextWord(i) | set_.NextWord(j) | set_.NextWord(k) | set_.NextWord(l);
      const std::uint64_t next_all =
          set_.NextWord(i) & set_.NextWord(j) & set_.NextWord(k) & set_.NextWord(l);
      cells_.words()[i] = (any | next_any) & ~(all & next_all);
      edges_[0].words()[i] = words[i] ^ set_.NextWord(i);
      edges_[1].words()[i] = words[i] ^ words[j];
      edges_[2].words()[i] = words[i] ^ words[k];
    });
    cell_numbers_ = NodeNumbers(cells_);
    for (int axis = 0; axis < 3; ++axis) edge_numbers_[axis] = NodeNumbers(edges_[axis]);
  }

  void TakeLine(int axis, std::size_t row, std::size_t column, std::span<const Passage> line,
                std::span<const Eigen::Vector3f> normals) {
    for (std::size_t n = 0; n < line.size(); ++n) {
      const double place = (line[n].along - grid_.low[axis]) / grid_.step;
      const double from = std::ceil(place) - 1.0;
      if (from < 0.0 || from + 1.0 >= grid_.size[axis]) continue;
      std::array<std::size_t, 3> at;
      at[axis] = static_cast<std::size_t>(from);
      at[(axis + 1) % 3] = column;
      at[(axis + 2) % 3] = row;
      const auto u = static_cast<std::uint32_t>(at[0]);
      if (!edges_[axis].Has(u, at[1], at[2])) continue;
      // Of several passages on one edge the outermost counts: the last way out, the first way in.
      const bool is_out = set_.Has(u, at[1], at[2]);
      EdgePoint& point = points_[axis][EdgeNumber(axis, u, at[1], at[2])];
      if ((n % 2 == 1) != is_out || (!is_out && point.t >= 0.0f)) continue;
      point = {static_cast<float>(place - from), normals[line[n].triangle]};
    }
  }

  [[nodiscard]] std::uint32_t EdgeNumber(int axis, std::uint32_t u, std::size_t v,
                                         std::size_t w) const {
    const std::size_t i = grid_.WordAt(u / 64, v, w);
    return edge_numbers_[axis].Of(i, edges_[axis].words()[i], u % 64);
  }

  [[nodiscard]] std::uint32_t CellNumber(std::uint32_t u, std::size_t v, std::size_t w) const {
    const std::size_t i = grid_.WordAt(u / 64, v, w);
    return cell_numbers_.Of(i, cells_.words()[i], u % 64);
  }

  // Visits the crossings on the cell's twelve edges: visit(place in the cell, normal or 0).
  template <typename Visit>
  void ForEachCrossing(std::uint32_t u, std::size_t v, std::size_t w, const Visit& visit) const {
    for (int axis = 0; axis < 3; ++axis) {
      for (std::uint32_t side = 0; side < 4; ++side) {
        std::array<std::uint32_t, 3> at = {0, 0, 0};
        at[(axis + 1) % 3] = side % 2;
        at[(axis + 2) % 3] = side / 2;
        if (!edges_[axis].Has(u + at[0], v + at[1], w + at[2])) continue;
        const EdgePoint& point =
            points_[axis][EdgeNumber(axis, u + at[0], v + at[1], w + at[2])];
        Eigen::Vector3f place(static_cast<float>(at[0]), static_cast<float>(at[1]),
                              static_cast<float>(at[2]));
        place[axis] = point.t < 0.0f ? 0.5f : point.t;
        visit(place, point.normal);
      }
    }
  }

  [[nodiscard]] Eigen::Vector3d VertexOf(std::uint32_t u, std::size_t v, std::size_t w) const {
    Eigen::Matrix3f pull = Eigen::Matrix3f::Zero();
    Eigen::Vector3f pulled = Eigen::Vector3f::Zero();
    Eigen::Vector3f mean = Eigen::Vector3f::Zero();
    float count = 0.0f;
    ForEachCrossing(u, v, w, [&](const Eigen::Vector3f& place, const Eigen::Vector3f& normal) {
      pull += normal * normal.transpose();
      pulled += normal * normal.dot(place);
      mean += place;
      count += 1.0f;
    });
    mean /= count;
    const Eigen::Vector3f at =
        mean + (pull + kHold * Eigen::Matrix3f::Identity()).inverse() * (pulled - pull * mean);
    const Eigen::Vector3f kept = at.cwiseMax(kMargin).cwiseMin(1.0f - kMargin);
    const Eigen::Vector3d corner(u, static_cast<double>(v), static_cast<double>(w));
    return grid_.ToCaller(grid_.low + grid_.step * (corner + kept.cast<double>()));
  }

  // The four cells around an edge, counter-clockwise as seen from the edge's end.
  void AddQuad(int axis, std::uint32_t u, std::size_t v, std::size_t w, std::size_t number,
               NetSurface& net) const {
    std::array<std::uint32_t, 4> quad;
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
      std::array<std::uint32_t, 3> back = {0, 0, 0};
      back[(axis + 1) % 3] = corner == 0 || corner == 3 ? 1 : 0;
      back[(axis + 2) % 3] = corner < 2 ? 1 : 0;
      quad[corner] = CellNumber(u - back[0], v - back[1], w - back[2]);
    }
    if (!set_.Has(u, v, w)) std::swap(quad[1], quad[3]);
    const std::vector<Eigen::Vector3d>& at = net.vertices;
    const std::size_t cut = (at[quad[0]] - at[quad[2]]).squaredNorm() <=
                                    (at[quad[1]] - at[quad[3]]).squaredNorm()
                                ? 0
                                : 1;
    net.triangles[2 * number] = {quad[cut], quad[cut + 1], quad[cut + 2]};
    net.triangles[2 * number + 1] = {quad[cut], quad[cut + 2], quad[(cut + 3) % 4]};
  }

  const NodeGrid& grid_;
  const NodeSet& set_;
  const ThreadPool& pool_;
  NodeSet cells_;                 // by their first node
  std::array<NodeSet, 3> edges_;  // by their first node, along each axis
  NodeNumbers cell_numbers_;
  std::array<NodeNumbers, 3> edge_numbers_;
  std::array<std::vector<EdgePoint>, 3> points_;
  std::array<std::size_t, 3> stride_;  // words to the next column along v and w
};

}  // namespace

NetSurface ExtractSurface(const NodeGrid& grid, const NodeSet& set,
                          const std::array<GridLines, 3>& lines,
                          std::span<const Eigen::Vector3f> normals, const ThreadPool& pool) {
  NetBuilder builder(grid, set, pool);
  builder.TakeCrossings(lines, normals);
  return builder.Build();
}

}  // namespace capfit::solid
