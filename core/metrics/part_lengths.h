// Which part of the body each stretch of a column belongs to.
#ifndef CAPFIT_CORE_METRICS_PART_LENGTHS_H_
#define CAPFIT_CORE_METRICS_PART_LENGTHS_H_

#include <array>
#include <span>

#include "core/body/anatomy.h"
#include "core/geometry/tapered_capsule.h"
#include "core/metrics/column_grid.h"
#include "core/metrics/volumes.h"

namespace capfit::metrics {

// Adds up the lengths of a row by the rules that Volumes states.
class PartLengths {
 public:
  // `has_part`: the parts that are fitted. Keeps references.
  PartLengths(const std::array<bool, body::kPartCount>& has_part,
              std::span<const geometry::TaperedCapsule> solids,
              std::span<const SolidParts> solid_parts, const ColumnGrid& grid);

  // Lengths in place of volumes, summed over the columns of the row. `all` is left empty.
  [[nodiscard]] Volumes OfRow(std::size_t row, const BodyRows::Cuts& cuts,
                              const RowIntervals& set) const;

  // What the parts have, added up by the fitted part that stands for each.
  [[nodiscard]] PartNumbers ByHome(const PartNumbers& numbers) const;

 private:
  // A column, with the intervals of the set and of the body in it.
  struct Column {
    double x = 0.0;
    double y = 0.0;
    std::span<const geometry::Interval> set;
    std::span<const std::int32_t> solids;
    std::span<const geometry::Interval> body;
    std::span<const std::int32_t> body_parts;
  };
  // A stretch of the set outside the body, and the body's parts at its ends; -1: no body there.
  struct Stretch {
    geometry::Interval interval;
    std::int32_t begin_part = -1;
    std::int32_t end_part = -1;
  };

  [[nodiscard]] PartVolumes& At(std::int32_t part, Volumes& lengths) const {
    return lengths.parts[home_[part]];
  }
  // `is_body`: what is fitted is the whole body; then AddInside is done by this.
  void AddFitted(std::span<const geometry::Interval> fitted, std::span<const std::int32_t> parts,
                 std::span<const geometry::Interval> set, bool is_body, Volumes& lengths) const;
  // What the set has inside the body, and outside.
  void AddInside(const Column& column, Volumes& lengths) const;
  void AddOutside(const Column& column, Volumes& lengths) const;
  // What sticks out of the body of the set's intervals [first, last), which abut.
  void AddOutside(const Column& column, std::size_t first, std::size_t last,
                  Volumes& lengths) const;
  void AddStretch(const Column& column, std::size_t first, std::size_t last, const Stretch& stretch,
                  Volumes& lengths) const;
  [[nodiscard]] std::int32_t PartOfSolid(std::int32_t solid, const Eigen::Vector3d& at_m) const;

  std::array<bool, body::kPartCount> is_fitted_;
  std::array<std::size_t, body::kPartCount> home_{};  // the fitted part that stands for each
  std::span<const geometry::TaperedCapsule> solids_;
  std::span<const SolidParts> solid_parts_;
  const ColumnGrid& grid_;
};

}  // namespace capfit::metrics

#endif  // CAPFIT_CORE_METRICS_PART_LENGTHS_H_
