#include "core/metrics/part_lengths.h"

#include <algorithm>

#include "core/base/enum_index.h"
#include "core/capsule/build_primitives.h"

namespace capfit::metrics {
namespace {

using body::Part;
using geometry::Interval;

// What is not fitted hands on to the chain that it hangs on.
std::size_t HomeOf(Part part, const std::array<bool, body::kPartCount>& is_fitted) {
  for (const Part one : {part, capsule::ChainAt(part)}) {
    if (is_fitted[Index(one)]) return Index(one);
  }
  const auto first = std::find(is_fitted.begin(), is_fitted.end(), true);
  return first == is_fitted.end() ? 0 : static_cast<std::size_t>(first - is_fitted.begin());
}

// Length of what the interval shares with a list of disjoint rising ones. `from`: the first of them
// that may reach it; moves on with rising intervals.
double CommonFrom(const Interval& interval, std::span<const Interval> list, std::size_t& from) {
  while (from < list.size() && list[from].end <= interval.begin) ++from;
  double length = 0.0;
  for (std::size_t i = from; i < list.size() && list[i].begin < interval.end; ++i) {
    length += std::min(list[i].end, interval.end) - std::max(list[i].begin, interval.begin);
  }
  return length;
}

}  // namespace

PartLengths::PartLengths(const std::array<bool, body::kPartCount>& has_part,
                         std::span<const geometry::TaperedCapsule> solids,
                         std::span<const SolidParts> solid_parts, const ColumnGrid& grid)
    : is_fitted_(has_part), solids_(solids), solid_parts_(solid_parts), grid_(grid) {
  for (std::size_t p = 0; p < home_.size(); ++p) {
    home_[p] = HomeOf(static_cast<Part>(p), is_fitted_);
  }
}

PartNumbers PartLengths::ByHome(const PartNumbers& numbers) const {
  PartNumbers sums{};
  for (std::size_t p = 0; p < sums.size(); ++p) sums[home_[p]] += numbers[p];
  return sums;
}

Volumes PartLengths::OfRow(std::size_t row, const BodyRows::Cuts& cuts,
                           const RowIntervals& set) const {
  Volumes lengths;
  double in_image = 0.0;
  const std::size_t columns = grid_.x.size();
  for (std::size_t i = 0; i < columns; ++i) {
    const std::span<const Interval> set_here = set.Column(i);
    const Column column = {grid_.x[i],    grid_.y[row],        set_here,
                           set.Labels(i), cuts.body.Column(i), cuts.body.Labels(i)};
    AddFitted(cuts.fitted().Column(i), cuts.fitted().Labels(i), set_here,
              /*is_body=*/!cuts.some, lengths);
    if (set_here.empty()) continue;
    if (cuts.some) AddInside(column, lengths);
    AddOutside(column, lengths);
    // A column has in common with its image what that has with it.
    const std::size_t image = columns - 1 - i;
    if (i > image) continue;
    in_image += (i < image ? 2.0 : 1.0) * CommonLength(set_here, set.Column(image));
  }
  const PartNumbers flux = ByHome(cuts.fitted_flux);
  for (std::size_t p = 0; p < flux.size(); ++p) lengths.parts[p].fitted_flux = flux[p];
  // Rounding must not leave a share of -1e-17.
  lengths.mirror_xor = 2.0 * std::max(0.0, set.Length() - in_image);
  return lengths;
}

void PartLengths::AddFitted(std::span<const Interval> fitted, std::span<const std::int32_t> parts,
                            std::span<const Interval> set, bool is_body, Volumes& lengths) const {
  std::size_t from = 0;
  for (std::size_t k = 0; k < fitted.size(); ++k) {
    const double length = fitted[k].end - fitted[k].begin;
    const double covered = CommonFrom(fitted[k], set, from);
    PartVolumes& part = At(parts[k], lengths);
    part.fitted += length;
    if (is_body) part.set += covered;
    const double uncovered = length - covered;
    // Rounding: where the set's intervals abut, the sum may differ in the last digit.
    if (uncovered > 1e-12 * length) part.uncovered += uncovered;
  }
}

void PartLengths::AddInside(const Column& column, Volumes& lengths) const {
  std::size_t from = 0;
  for (std::size_t k = 0; k < column.body.size(); ++k) {
    At(column.body_parts[k], lengths).set += CommonFrom(column.body[k], column.set, from);
  }
}

void PartLengths::AddOutside(const Column& column, Volumes& lengths) const {
  for (std::size_t first = 0; first < column.set.size();) {
    std::size_t last = first + 1;
    while (last < column.set.size() && column.set[last].begin == column.set[last - 1].end) ++last;
    AddOutside(column, first, last, lengths);
    first = last;
  }
}

void PartLengths::AddOutside(const Column& column, std::size_t first, std::size_t last,
                             Volumes& lengths) const {
  const double end = column.set[last - 1].end;
  Stretch stretch;
  stretch.interval.begin = column.set[first].begin;
  for (std::size_t b = 0; b < column.body.size() && column.body[b].begin < end; ++b) {
    if (column.body[b].end <= stretch.interval.begin) continue;
    stretch.interval.end = column.body[b].begin;
    stretch.end_part = column.body_parts[b];
    AddStretch(column, first, last, stretch, lengths);
    stretch = {{column.body[b].end, column.body[b].end}, column.body_parts[b], -1};
  }
  stretch.interval.end = end;
  AddStretch(column, first, last, stretch, lengths);
}

void PartLengths::AddStretch(const Column& column, std::size_t first, std::size_t last,
                             const Stretch& stretch, Volumes& lengths) const {
  const auto add = [&](std::int32_t part, double length) {
    PartVolumes& volumes = At(part, lengths);
    volumes.outside += length;
    volumes.set += length;
  };
  const auto is_fitted = [&](std::int32_t part) { return part >= 0 && is_fitted_[part]; };
  const double length = stretch.interval.end - stretch.interval.begin;
  if (length <= 0.0) return;
  const bool has_begin = is_fitted(stretch.begin_part);
  const bool has_end = is_fitted(stretch.end_part);
  if (has_begin) add(stretch.begin_part, has_end ? 0.5 * length : length);
  if (has_end) add(stretch.end_part, has_begin ? 0.5 * length : length);
  if (has_begin || has_end) return;
  for (std::size_t k = first; k < last; ++k) {
    const double low = std::max(column.set[k].begin, stretch.interval.begin);
    const double high = std::min(column.set[k].end, stretch.interval.end);
    if (high <= low) continue;
    add(PartOfSolid(column.solids[k], {column.x, column.y, 0.5 * (low + high)}), high - low);
  }
}

std::int32_t PartLengths::PartOfSolid(std::int32_t solid, const Eigen::Vector3d& at_m) const {
  const auto& [a, b] = solid_parts_[solid];
  if (a == b) return static_cast<std::int32_t>(a);
  const double along = solids_[solid].Locate(at_m).axis_parameter;
  return static_cast<std::int32_t>(along < 0.5 ? a : b);
}

}  // namespace capfit::metrics
