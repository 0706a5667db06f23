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

  // mark(node): sheets and cracks of the line that lie between nodes.
  template <typename Mark>
  void Between(std::span<const Passage> line, const Mark& mark) const {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Passage& a = line[i];
      const Passage& b = line[i + 1];
      const double steps = (b.along - a.along) / grid_.step;
      if (steps >= (i % 2 == 0 ? 1.0 : kSheetGap)) continue;
      if (!AreOpposed(normals_[a.triangle], normals_[b.triangle], axis_, kSteep)) continue;
      const std::uint32_t first = FirstAt(a.along);
      const std::uint32_t end = FirstAt(b.along);
      if (i % 2 == 0) {
        if (first == end) mark(NearestTo(0.5 * (a.along + b.along)));
      } else if (steps < kCrackShare || IsUnderSheet(a, b)) {
        for (std::uint32_t node = first; node < end; ++node) mark(node);
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
  [[nodiscard]] std::uint32_t NearestTo(double along) const {
    const double node = std::round((along - grid_.low[axis_]) / grid_.step);
    return static_cast<std::uint32_t>(std::clamp(node, 1.0, grid_.size[axis_] - 2.0));
  }

  const NodeGrid& grid_;
  int axis_;
  const Shells& shells_;
  std::span<const Eigen::Vector3f> normals_;
};

// Sets bits [first, end) of a column.
void FillColumn(std::uint64_t* words, std::uint32_t first, std::uint32_t end) {
  while (first < end) {
    const std::uint32_t stop = std::min(end, (first / 64 + 1) * 64);
    const std::uint32_t count = stop - first;
    const std::uint64_t ones = count == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
    words[first / 64] |= ones << (first % 64);
    first = stop;
  }
}

}  // namespace

NodeSet FindOccupied(const NodeGrid& grid, const Shells& shells,
                     const std::array<GridLines, 3>& lines,
                     std::span<const Eigen::Vector3f> normals, const ThreadPool& pool) {
  NodeSet inside(grid);
  std::array<std::vector<std::vector<GridNode>>, 3> marks;
  for (int axis = 0; axis < 3; ++axis) {
    const LineReader reader(grid, axis, shells, normals);
    marks[axis].resize(lines[axis].rows.size());
    pool.ForEach(lines[axis].rows.size(), [&](std::size_t row) {
      const std::size_t columns = lines[axis].columns();
      for (std::size_t column = 0; column < columns; ++column) {
        const std::span<const Passage> line = lines[axis].Line(row, column);
        if (line.empty()) continue;
        if (axis == 0) {
          std::uint64_t* const words = inside.words().data() + grid.WordAt(0, column, row);
          reader.Inside(line, [&](std::uint32_t first, std::uint32_t end) {
            FillColumn(words, first, end);
          });
        }
        reader.Between(line, [&](std::uint32_t along) {
          marks[axis][row].push_back(NodeOnLine(axis, row, column, along));
        });
      }
    });
  }
  for (const auto& of_axis : marks) {
    for (const auto& of_row : of_axis) {
      for (const GridNode& node : of_row) inside.Add(node.u, node.v, node.w);
    }
  }
  return inside;
}

}  // namespace capfit::solid
