#include "core/solid/surface_net.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/base/chunk_sums.h"
#include "core/solid/block_corners.h"
#include "core/solid/plane_sum.h"

namespace capfit::solid {
namespace {

// Cells are taken together where all their crossings' planes pass this near to the common vertex,
// in steps: 1 mm in cells of 5 mm, and a tenth of that in the mean.
constexpr float kFlat = 0.2f;
// And where all normals are within 37 degrees of the first (as cosine).
constexpr float kAlike = 0.8f;

// How far beyond the node inside the surface is where no shell passes the edge, in steps: little,
// as such nodes were added to what the shells enclose.
constexpr float kUnknown = 0.2f;

// Where blocks taken together meet in an edge of more than two triangles, which none of the bodies
// at hand does, they are taken apart again; a round or two do.
constexpr int kMostRounds = 8;

// Where an edge between two nodes is crossed; t < 0: nothing known.
struct EdgePoint {
  float t = -1.0f;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

struct Crossing {
  Eigen::Vector3f place;
  Eigen::Vector3f normal;
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
        const std::size_t columns = lines[axis].columns();
        for (std::size_t column = 0; column < columns; ++column) {
          TakeLine(axis, row, column, lines[axis].Line(row, column), normals);
        }
      });
    }
  }

  // Takes flat blocks of eight cells together, but those that hold one of the cells `apart`.
  void MergeFlatBlocks(std::span<const std::uint32_t> apart) {
    leader_.resize(cell_numbers_.count());
    places_.resize(cell_numbers_.count());
    keep_apart_.assign(cell_numbers_.count(), 0);
    for (const std::uint32_t cell : apart) keep_apart_[cell] = 1;
    pool_.ForEach((grid_.size[2] - 1) / 2, [&](std::size_t pair) {
      for (std::size_t v = 0; v + 2 < grid_.size[1]; v += 2) {
        for (std::size_t k = 0; k < grid_.words_per_column(); ++k) PlaceBlocks(k, v, 2 * pair);
      }
    });
  }

  NetSurface Build() {
    NetSurface net;
    NumberVertices(net);
    std::vector<std::vector<mesh::Triangle>> slabs(3 * std::size_t{grid_.size[2]});
    pool_.ForEach(grid_.size[2] - 1, [&](std::size_t w) {
      for (int axis = 0; axis < 3; ++axis) AddQuads(axis, w, net, slabs[3 * w + axis]);
    });
    std::vector<std::size_t> first(slabs.size() + 1, 0);
    for (std::size_t i = 0; i < slabs.size(); ++i) first[i + 1] = first[i] + slabs[i].size();
    net.triangles.resize(first.back());
    pool_.ForEach(slabs.size(), [&](std::size_t i) {
      std::copy(slabs[i].begin(), slabs[i].end(), net.triangles.begin() + first[i]);
    });
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
  void ForEachCrossing(const GridNode& cell, const Visit& visit) const {
    for (int axis = 0; axis < 3; ++axis) {
      for (std::uint32_t side = 0; side < 4; ++side) {
        std::array<std::uint32_t, 3> at = {0, 0, 0};
        at[(axis + 1) % 3] = side % 2;
        at[(axis + 2) % 3] = side / 2;
        const std::uint32_t u = cell.u + at[0];
        const std::size_t i = grid_.WordAt(u / 64, cell.v + at[1], cell.w + at[2]);
        const std::uint64_t word = edges_[axis].words()[i];
        if ((word >> (u % 64) & 1u) == 0) continue;
        const EdgePoint& point = points_[axis][edge_numbers_[axis].Of(i, word, u % 64)];
        Eigen::Vector3f place(static_cast<float>(at[0]), static_cast<float>(at[1]),
                              static_cast<float>(at[2]));
        const bool is_first_inside = set_.Has(u, cell.v + at[1], cell.w + at[2]);
        place[axis] = point.t >= 0.0f ? point.t : is_first_inside ? kUnknown : 1.0f - kUnknown;
        visit(place, point.normal);
      }
    }
  }

  // Blocks of two cells a side from word k of the cells' columns at (v, w), which are even.
  void PlaceBlocks(std::size_t k, std::size_t v, std::size_t w) {
    std::array<std::uint64_t, 4> words;
    std::uint64_t any = 0;
    for (std::size_t side = 0; side < 4; ++side) {
      words[side] = cells_.words()[grid_.WordAt(k, v + side % 2, w + side / 2)];
      any |= words[side];
    }
    constexpr std::uint64_t kEven = 0x5555555555555555u;
    ForEachBit((any | any >> 1) & kEven, [&](unsigned bit) {
      Block block = {{static_cast<std::uint32_t>(64 * k + bit), static_cast<std::uint32_t>(v),
                      static_cast<std::uint32_t>(w)}};
      for (std::uint32_t side = 0; side < 4; ++side) {
        const std::size_t i = grid_.WordAt(k, v + side % 2, w + side / 2);
        for (std::uint32_t up = 0; up < 2; ++up) {
          if ((words[side] >> (bit + up) & 1u) == 0) continue;
          block.cells[block.count] = cell_numbers_.Of(i, words[side], bit + up);
          block.corners[block.count++] = 4 * (side / 2) + 2 * (side % 2) + up;
        }
      }
      if (!PlaceTogether(block)) PlaceApart(block);
    });
  }

  // Up to eight cells with a common corner.
  struct Block {
    GridNode low;
    std::array<std::uint32_t, 8> cells{};    // their numbers
    std::array<std::uint32_t, 8> corners{};  // which of the eight: 4 * w + 2 * v + u
    std::size_t count = 0;
  };

  [[nodiscard]] static GridNode CellOf(const Block& block, std::size_t i) {
    const std::uint32_t corner = block.corners[i];
    return {block.low.u + corner % 2, block.low.v + corner / 2 % 2, block.low.w + corner / 4};
  }

  void PlaceApart(const Block& block) {
    for (std::size_t i = 0; i < block.count; ++i) {
      PlaneSum planes;
      const GridNode cell = CellOf(block, i);
      ForEachCrossing(cell, [&](const Eigen::Vector3f& place, const Eigen::Vector3f& normal) {
        planes.Add(place, normal);
      });
      leader_[block.cells[i]] = block.cells[i];
      places_[block.cells[i]] = ToCaller(cell, planes.Nearest(1.0f));
    }
  }

  bool PlaceTogether(const Block& block) {
    if (block.count < 2 || !IsSimple(block.low)) return false;
    PlaneSum planes;
    bool may_merge = true;
    for (std::size_t i = 0; i < block.count; ++i) {
      may_merge = may_merge && keep_apart_[block.cells[i]] == 0;
    }
    std::array<Crossing, 8 * 12> crossings;
    std::size_t count = 0;
    for (std::size_t i = 0; i < block.count && may_merge; ++i) {
      const GridNode cell = CellOf(block, i);
      const Eigen::Vector3f corner(static_cast<float>(cell.u - block.low.u),
                                   static_cast<float>(cell.v - block.low.v),
                                   static_cast<float>(cell.w - block.low.w));
      ForEachCrossing(cell, [&](const Eigen::Vector3f& place, const Eigen::Vector3f& normal) {
        // Where nothing is known the normal is 0, and this is false too.
        may_merge = may_merge && normal.dot(count == 0 ? normal : crossings[0].normal) > kAlike;
        crossings[count++] = {place + corner, normal};
        planes.Add(place + corner, normal);
      });
    }
    if (!may_merge) return false;
    const Eigen::Vector3f at = planes.Nearest(2.0f);
    for (std::size_t i = 0; i < count; ++i) {
      const Crossing& c = crossings[i];
      if (std::abs(c.normal.dot(at - c.place)) > kFlat) return false;
    }
    for (std::size_t i = 0; i < block.count; ++i) leader_[block.cells[i]] = block.cells[0];
    places_[block.cells[0]] = ToCaller(block.low, at);
    return true;
  }

  // Whether the boundary passes the block's 27 nodes in a single sheet that its eight corners tell
  // of alone: every node between corners is as one of them.
  [[nodiscard]] bool IsSimple(const GridNode& low) const {
    std::uint64_t in = 0;
    for (std::uint32_t w = 0; w < 3; ++w) {
      for (std::uint32_t v = 0; v < 3; ++v) {
        const std::size_t i = set_.WordOf(low.u, low.v + v, low.w + w);
        std::uint64_t three = set_.words()[i] >> (low.u % 64);
        if (low.u % 64 == 62) three |= set_.words()[i + 1] << 2;
        in |= (three & 7u) << (4 * (v + 4 * w));
      }
    }
    return IsOneSheetToldByCorners(in);
  }

  [[nodiscard]] Eigen::Vector3d ToCaller(const GridNode& corner, const Eigen::Vector3f& at) const {
    const Eigen::Vector3d nodes = Eigen::Vector3d(corner.u, corner.v, corner.w) + at.cast<double>();
    return grid_.ToCaller(grid_.low + grid_.step * nodes);
  }

  // From here on `leader_` is the vertex of each cell.
  void NumberVertices(NetSurface& net) {
    std::vector<std::uint32_t> number(leader_.size());
    for (std::uint32_t cell = 0; cell < leader_.size(); ++cell) {
      if (leader_[cell] != cell) continue;
      number[cell] = static_cast<std::uint32_t>(net.vertices.size());
      net.vertices.push_back(places_[cell]);
      net.cells.push_back(cell);
    }
    for (std::uint32_t& leader : leader_) leader = number[leader];
  }

  void AddQuads(int axis, std::size_t w, const NetSurface& net,
                std::vector<mesh::Triangle>& triangles) const {
    for (std::size_t v = 0; v + 1 < grid_.size[1]; ++v) {
      for (std::size_t k = 0; k < grid_.words_per_column(); ++k) {
        ForEachBit(edges_[axis].words()[grid_.WordAt(k, v, w)], [&](unsigned bit) {
          AddQuad(axis, static_cast<std::uint32_t>(64 * k + bit), v, w, net, triangles);
        });
      }
    }
  }

  // The four cells around an edge, counter-clockwise as seen from the edge's end.
  void AddQuad(int axis, std::uint32_t u, std::size_t v, std::size_t w, const NetSurface& net,
               std::vector<mesh::Triangle>& triangles) const {
    std::array<std::uint32_t, 4> quad;
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
      std::array<std::uint32_t, 3> back = {0, 0, 0};
      back[(axis + 1) % 3] = corner == 0 || corner == 3 ? 1 : 0;
      back[(axis + 2) % 3] = corner < 2 ? 1 : 0;
      quad[corner] = leader_[CellNumber(u - back[0], v - back[1], w - back[2])];
    }
    if (!set_.Has(u, v, w)) std::swap(quad[1], quad[3]);
    const std::vector<Eigen::Vector3d>& at = net.vertices;
    const std::size_t cut =
        (at[quad[0]] - at[quad[2]]).squaredNorm() <= (at[quad[1]] - at[quad[3]]).squaredNorm() ? 0
                                                                                               : 1;
    AddTriangle({quad[cut], quad[cut + 1], quad[cut + 2]}, triangles);
    AddTriangle({quad[cut], quad[cut + 2], quad[(cut + 3) % 4]}, triangles);
  }

  static void AddTriangle(const mesh::Triangle& t, std::vector<mesh::Triangle>& triangles) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  }

  const NodeGrid& grid_;
  const NodeSet& set_;
  const ThreadPool& pool_;
  NodeSet cells_;                 // by their first node
  std::array<NodeSet, 3> edges_;  // by their first node, along each axis
  NodeNumbers cell_numbers_;
  std::array<NodeNumbers, 3> edge_numbers_;
  std::array<std::vector<EdgePoint>, 3> points_;
  std::vector<std::uint32_t> leader_;    // of each cell: whose vertex is its own
  std::vector<Eigen::Vector3d> places_;  // of the leaders' vertices
  std::vector<char> keep_apart_;         // of each cell
  std::array<std::size_t, 3> stride_;    // words to the next column along v and w
};

}  // namespace

NetSurface ExtractSurface(const NodeGrid& grid, const NodeSet& set,
                          const std::array<GridLines, 3>& lines,
                          std::span<const Eigen::Vector3f> normals, const ThreadPool& pool) {
  NetBuilder builder(grid, set, pool);
  builder.TakeCrossings(lines, normals);
  std::vector<std::uint32_t> apart;
  for (int round = 0;; ++round) {
    builder.MergeFlatBlocks(apart);
    NetSurface net = builder.Build();
    mesh::EdgeMates mates = mesh::FindEdgeMates(net.triangles, net.vertices.size(), pool);
    if (mates.IsClosedAndOriented()) {
      net.mates = std::move(mates.mate);
      return net;
    }
    if (round == kMostRounds) return net;
    for (const mesh::HalfEdge h : mates.crowded) {
      for (const std::uint32_t v : net.triangles[h / 3]) apart.push_back(net.cells[v]);
    }
  }
}

}  // namespace capfit::solid
