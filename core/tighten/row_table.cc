#include "core/tighten/row_table.h"

#include <algorithm>

namespace capfit::tighten {
namespace {

// Rows of a part at least: fewer are done sooner than another thread takes them up. (The search
// solves programmes of a thousand or two, several side by side; those of a single set have up to
// ten times as many.)
constexpr Eigen::Index kRowsInPart = 512;
constexpr Eigen::Index kMostRowParts = 4;

std::vector<RowPart> PartsOf(std::span<const RowGroup> groups, Eigen::Index rows) {
  const Eigen::Index count = std::clamp<Eigen::Index>(rows / kRowsInPart, 1, kMostRowParts);
  std::vector<RowPart> parts;
  std::size_t next = 0;
  for (Eigen::Index i = 1; i <= count; ++i) {
    const std::size_t begin = next;
    while (next < groups.size() && groups[next].end * count <= rows * i) ++next;
    parts.push_back({begin, next});
  }
  return parts;
}

}  // namespace

// A counting sort, as groups are few. Rows are looked at once: they fill more than a cache.
RowLayout LayOutRows(const PenaltyProgram& program, Eigen::Index lane) {
  const Eigen::Index width = program.gradient.size() / 4 + 1;  // 0: no second
  std::vector<std::uint32_t> keys;
  std::vector<std::uint32_t> next(width * width, 0);
  for (const RowBatch& batch : program.batches) {
    for (const PenaltyRow& row : batch.rows) {
      const int b = row.first[1] < 0 ? 0 : row.first[1] / 4 + 1;
      keys.push_back(static_cast<std::uint32_t>(row.first[0] / 4 * width + b));
      ++next[keys.back()];
    }
  }
  RowLayout layout;
  std::size_t sorted = 0;
  for (Eigen::Index key = 0; key < width * width; ++key) {
    const std::uint32_t count = next[key];
    if (count == 0) continue;
    next[key] = static_cast<std::uint32_t>(sorted);
    const Eigen::Index end = layout.size + (count + lane - 1) / lane * lane;
    const auto b = static_cast<int>(key % width);
    layout.groups.push_back({layout.size, end, static_cast<int>(key / width * 4),
                             b == 0 ? -1 : 4 * (b - 1), sorted, count});
    layout.size = end;
    sorted += count;
  }
  layout.order.resize(sorted);
  auto key = keys.begin();
  for (std::uint32_t batch = 0; batch < program.batches.size(); ++batch) {
    const std::size_t rows = program.batches[batch].rows.size();
    for (std::uint32_t i = 0; i < rows; ++i) layout.order[next[*key++]++] = {batch, i};
  }
  layout.parts = PartsOf(layout.groups, layout.size);
  return layout;
}

}  // namespace capfit::tighten
