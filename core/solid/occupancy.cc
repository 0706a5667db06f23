#include "core/solid/occupancy.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace capfit::solid {
namespace {

// Gaps narrower than this share of a step are cracks between shells that are meant to touch.
constexpr double kCrackShare = 0.75;
// A line tells of a sheet or a crack where it passes both of its sides this steeply (as cosine).
// Any plane is passed as steeply along some axis; what is passed flatter is the bulge of a thick
// part that the line grazes.
constexpr float kSteep = 0.5f;

// A shell that is thinner than this in the mean, in steps, is a plate or a cloth; and how wide the
// space under it may be. A hand is 15 mm thick in the mean, cells have 4 to 6 mm.
constexpr double kSheetThickness = 1.6;
constexpr double kSheetGap = 4.0;

// Goes along the lines of one axis.
class LineReader {
 public:
  LineReader(const NodeGrid& grid, int axis, const Shells& shells,
             std::span<const Eigen::Vector3f> normals)
      : grid_(grid), axis_(axis), shells_(shells), normals_(normals) {}

  // fill(first, end): nodes along the axis inside of the line's intervals.
  template <typename Fill>
  void Inside(std::span<const Passage> line, const Fill& fill) const {
    for (std::size_t i = 0; i + 1 < line.size(); i += 2) {
      fill(FirstAt(line[i].along), FirstAt(line[i + 1].along));
    }
  }

  // crack(node): nodes of the line in cracks and under sheets; sheet(node): the line passes a whole
  // sheet between the node and the one before it.
  template <typename Crack, typename Sheet>
  void Between(std::span<const Passage> line, const Crack& crack, const Sheet& sheet) const {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Passage& a = line[i];
      const Passage& b = line[i + 1];
      const double steps = (b.along - a.along) / grid_.step;
      if (steps >= (i % 2 == 0 ? 1.0 : kSheetGap)) continue;
      if (!AreOpposed(normals_[a.triangle], normals_[b.triangle], axis_, kSteep)) continue;
      const std::uint32_t first = FirstAt(a.along);
      const std::uint32_t end = FirstAt(b.along);
      if (i % 2 == 0) {
        if (first == end) sheet(first);
      } else if (steps < kCrackShare || IsUnderSheet(a, b)) {
        for (std::uint32_t node = first; node < end; ++node) crack(node);
      }
    }
  }

 private:
  [[nodiscard]] bool IsUnderSheet(const Passage& a, const Passage& b) const {
    const std::uint32_t one = shells_.shell_of_triangle[a.triangle];
    const std::uint32_t other = shells_.shell_of_triangle[b.triangle];
    return one != other && (IsSheet(one) || IsSheet(other));
  }
  [[nodiscard]] bool IsSheet(std::uint32_t shell) const {
    return 2.0 * shells_.volumes[shell] < kSheetThickness * grid_.step * shells_.areas[shell];
  }
  [[nodiscard]] std::uint32_t FirstAt(double along) const {
    return FirstNodeAt(grid_, axis_, along);
  }

  const NodeGrid& grid_;
  int axis_;
  const Shells& shells_;
  std::span<const Eigen::Vector3f> normals_;
};

// What lines tell of the space between their nodes.
struct Marks {
  std::vector<GridNode> cracks;  // nodes to fill
  std::vector<GridNode> sheets;  // there is one between each of these and the node before it
};

// The node before on the axis.
GridNode Before(GridNode node, int axis) {
  --(axis == 0 ? node.u : axis == 1 ? node.v : node.w);
  return node;
}

// Gives each sheet a node, unless one beside it is inside already.
void AddSheets(const std::array<std::vector<Marks>, 3>& marks, NodeSet& inside) {
  std::vector<GridNode> added;
  for (int axis = 0; axis < 3; ++axis) {
    for (const Marks& row : marks[axis]) {
      for (const GridNode& node : row.sheets) {
        const GridNode before = Before(node, axis);
        if (!inside.Has(node.u, node.v, node.w) && !inside.Has(before.u, before.v, before.w)) {
          added.push_back(before);
        }
      }
    }
  }
  for (const GridNode& node : added) inside.Add(node.u, node.v, node.w);
}

}  // namespace

NodeSet FindOccupied(const NodeGrid& grid, const Shells& shells,
                     const std::array<GridLines, 3>& lines,
                     std::span<const Eigen::Vector3f> normals, const ThreadPool& pool) {
  NodeSet inside(grid);
  std::array<std::vector<Marks>, 3> marks;
  for (int axis = 0; axis < 3; ++axis) {
    const LineReader reader(grid, axis, shells, normals);
    marks[axis].resize(lines[axis].rows.size());
    pool.ForEach(lines[axis].rows.size(), [&](std::size_t row) {
      for (std::size_t column = 0; column < lines[axis].columns(); ++column) {
        const std::span<const Passage> line = lines[axis].Line(row, column);
        if (line.empty()) continue;
        if (axis == 0) {
          std::uint64_t* const words = inside.words().data() + grid.WordAt(0, column, row);
          reader.Inside(line, [&](std::uint32_t first, std::uint32_t end) {
            SetBits(words, first, end, true);
          });
        }
        const auto add_to = [&](std::vector<GridNode>& nodes) {
          return [&nodes, axis, row, column](std::uint32_t along) {
            nodes.push_back(NodeOnLine(axis, row, column, along));
          };
        };
        Marks& found = marks[axis][row];
        reader.Between(line, add_to(found.cracks), add_to(found.sheets));
      }
    });
  }
  for (const auto& of_axis : marks) {
    for (const Marks& row : of_axis) {
      for (const GridNode& node : row.cracks) inside.Add(node.u, node.v, node.w);
    }
  }
  AddSheets(marks, inside);
  return inside;
}

}  // namespace capfit::solid
