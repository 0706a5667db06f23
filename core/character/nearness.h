// Which shells are near each other: coarse cells that their triangles touch.
#ifndef CAPFIT_CORE_CHARACTER_NEARNESS_H_
#define CAPFIT_CORE_CHARACTER_NEARNESS_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "absl/container/flat_hash_set.h"
#include "core/character/shells.h"

namespace capfit::character {

// A set of cubic cells.
class CellSet {
 public:
  explicit CellSet(double cell) : cell_(cell) {}

  // All cells that the facet's sampled points lie in; the samples are no further apart than a cell,
  // but for facets of more than 32 cells.
  void Add(const Facet& facet);
  // Whether a cell of the set is the point's own or one of its 26 neighbours: true up to one cell's
  // width, false from four on.
  [[nodiscard]] bool IsNear(const Eigen::Vector3d& point) const;

 private:
  double cell_;
  absl::flat_hash_set<std::uint64_t> cells_;
};

// Shells that hang together over gaps of up to about `gap`, each called by its first shell; what is
// two `gap`s apart never hangs together. Shells that are not `taken` are clusters of their own.
// O(facets).
[[nodiscard]] std::vector<std::uint32_t> ClustersOf(const Shells& shells, double gap,
                                                    const std::vector<char>& taken);

}  // namespace capfit::character

#endif  // CAPFIT_CORE_CHARACTER_NEARNESS_H_
