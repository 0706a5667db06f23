#include "core/tighten/row_table.h"

#include <cstdint>

namespace capfit::tighten {

// A counting sort, as groups are few.
std::vector<std::size_t> RowsByGroup(const PenaltyProgram& program) {
  const std::vector<PenaltyRow>& rows = program.rows;
  const Eigen::Index width = program.gradient.size() / 4 + 1;
  const auto key = [width](const PenaltyRow& row) {
    const int b = row.first[1] < 0 ? 0 : row.first[1] / 4 + 1;
    return row.first[0] / 4 * width + b;
  };
  std::vector<std::uint32_t> begin(width * width + 1, 0);
  for (const PenaltyRow& row : rows) ++begin[key(row) + 1];
  for (std::size_t k = 1; k < begin.size(); ++k) begin[k] += begin[k - 1];
  std::vector<std::size_t> order(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) order[begin[key(rows[i])]++] = i;
  return order;
}

}  // namespace capfit::tighten
