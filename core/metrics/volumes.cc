#include "core/metrics/volumes.h"

#include <algorithm>
#include <optional>

#include "core/metrics/boundary_distance.h"
#include "core/metrics/column_grid.h"
#include "core/metrics/part_lengths.h"

namespace capfit::metrics {
namespace {

// Rows that one task takes together.
constexpr std::size_t kRowsPerChunk = 4;

void Add(const PartVolumes& more, double area, PartVolumes& sum) {
  sum.fitted += area * more.fitted;
  sum.set += area * more.set;
  sum.outside += area * more.outside;
  sum.uncovered += area * more.uncovered;
  sum.fitted_flux += area * more.fitted_flux;
}

// The columns tell the volume of a part only as well as they hit its outline, but the flux through
// its surface is known: the volume has the same error. What is covered and what is not share it.
void Correct(double exact_flux, PartVolumes& part) {
  if (!(part.fitted > 0.0)) return;
  const double fitted = std::max(0.0, part.fitted + exact_flux - part.fitted_flux);
  const double factor = fitted / part.fitted;
  part.set += (factor - 1.0) * (part.fitted - part.uncovered);
  part.uncovered *= factor;
  part.fitted = fitted;
}

}  // namespace

std::vector<SolidParts> PartsOfSolids(const capsule::PrimitiveSet& set) {
  std::vector<SolidParts> parts;
  std::vector<bool> is_used(set.spheres.size(), false);
  const auto part = [&](int sphere) { return set.origins[sphere].part; };
  for (const capsule::CapsuleEnds& ends : set.capsules) {
    parts.push_back({part(ends[0]), part(ends[1])});
    for (const int end : ends) is_used[end] = true;
  }
  for (std::size_t i = 0; i < is_used.size(); ++i) {
    if (!is_used[i]) parts.push_back({set.origins[i].part, set.origins[i].part});
  }
  return parts;
}

Volumes MeasureVolumes(const CutBody& body, std::span<const geometry::TaperedCapsule> solids,
                       std::span<const SolidParts> solid_parts, const ThreadPool& pool,
                       const FitObserver& observer) {
  const FittedSurface& fitted = body.fitted;
  Eigen::AlignedBox3d box;
  for (const geometry::TaperedCapsule& solid : solids) box.extend(BoxOf(solid));
  const std::optional<WiderGrid> wider = Widen(body.grid, box);
  if (!wider) {
    for (const Eigen::Vector3d& p : fitted.points_m) box.extend(p);
    const ColumnGrid all = MakeColumnGrid(box, static_cast<int>(body.grid.x.size()));
    return MeasureVolumes({fitted, all, BodyRows(fitted, all, pool)}, solids, solid_parts, pool,
                          observer);
  }
  const ColumnGrid& grid = wider->grid;
  const SolidRows solid_rows(solids, grid);
  const PartLengths lengths(fitted.has_part, solids, solid_parts, grid);

  std::vector<Volumes> by_row(grid.y.size());
  pool.ForChunks(grid.y.size(), kRowsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end && !observer.IsCancelled(); ++row) {
      by_row[row] = lengths.OfRow(row, body.rows.Cut(row, wider->margin), solid_rows.Cut(row));
    }
  });
  const PartNumbers exact_flux = lengths.ByHome(fitted.flux);
  Volumes total;
  for (const Volumes& row : by_row) {
    for (std::size_t p = 0; p < total.parts.size(); ++p) {
      Add(row.parts[p], grid.cell_area(), total.parts[p]);
    }
    total.mirror_xor += grid.cell_area() * row.mirror_xor;
  }
  double set_by_columns = 0.0;
  for (std::size_t p = 0; p < total.parts.size(); ++p) {
    set_by_columns += total.parts[p].set;
    Correct(exact_flux[p], total.parts[p]);
    Add(total.parts[p], 1.0, total.all);
  }
  // What columns miss of the set they miss of its image as well.
  if (set_by_columns > 0.0) total.mirror_xor *= total.all.set / set_by_columns;
  return total;
}

}  // namespace capfit::metrics
