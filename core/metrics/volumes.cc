#include "core/metrics/volumes.h"

#include <algorithm>
#include <optional>

#include "core/metrics/column_grid.h"
#include "core/metrics/part_lengths.h"

namespace capfit::metrics {
namespace {

// Rows that one task takes together.
constexpr std::size_t kRowsPerChunk = 4;

Eigen::AlignedBox3d BoxOf(const geometry::TaperedCapsule& solid) {
  Eigen::AlignedBox3d box;
  for (const geometry::Sphere& end : {solid.a(), solid.b()}) {
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(end.radius_m);
    box.extend(Eigen::Vector3d(end.center_m - reach));
    box.extend(Eigen::Vector3d(end.center_m + reach));
  }
  return box;
}

// What is left out, then the skin, then the caps over the cuts.
BodyTriangles AllTriangles(const FittedSurface& fitted) {
  BodyTriangles all;
  all.triangles = fitted.left_out;
  all.triangles.insert(all.triangles.end(), fitted.triangles.begin(), fitted.triangles.end());
  for (const auto* parts : {&fitted.left_out_parts, &fitted.parts}) {
    for (const body::Part part : *parts) all.labels.push_back(static_cast<std::uint8_t>(part));
  }
  all.fitted_begin = fitted.left_out.size();
  all.body_end = all.fitted_begin + fitted.skin_count;
  return all;
}

void Add(const PartVolumes& more, double area, PartVolumes& sum) {
  sum.fitted += area * more.fitted;
  sum.set += area * more.set;
  sum.outside += area * more.outside;
  sum.uncovered += area * more.uncovered;
}

}  // namespace

std::vector<SolidParts> PartsOfSolids(const capsule::PrimitiveSet& set) {
  std::vector<SolidParts> parts;
  std::vector<bool> is_used(set.spheres.size(), false);
  const auto part = [&](int sphere) { return set.origins[static_cast<std::size_t>(sphere)].part; };
  for (const capsule::CapsuleEnds& ends : set.capsules) {
    parts.push_back({part(ends[0]), part(ends[1])});
    for (const int end : ends) is_used[static_cast<std::size_t>(end)] = true;
  }
  for (std::size_t i = 0; i < is_used.size(); ++i) {
    if (!is_used[i]) parts.push_back({set.origins[i].part, set.origins[i].part});
  }
  return parts;
}

Volumes MeasureVolumes(const mesh::BodyMesh& mesh, const FittedSurface& fitted,
                       std::span<const geometry::TaperedCapsule> solids,
                       std::span<const SolidParts> solid_parts, int columns,
                       const ThreadPool& pool) {
  Eigen::AlignedBox3d box(mesh.box_min(), mesh.box_max());
  for (const geometry::TaperedCapsule& solid : solids) box.extend(BoxOf(solid));
  const ColumnGrid grid = MakeColumnGrid(box, columns);
  const BodyTriangles triangles = AllTriangles(fitted);
  const TriangleRows rows(fitted.points_m, triangles, grid);
  const PartLengths lengths(fitted.has_part, solids, solid_parts, grid);

  std::vector<Volumes> by_row(grid.y.size());
  pool.ForChunks(grid.y.size(), kRowsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const TriangleRows::Cuts cuts = rows.Cut(row);
      by_row[row] = lengths.OfRow(row, cuts, CutSolids(solids, grid, row));
    }
  });
  Volumes total;
  for (const Volumes& row : by_row) {
    for (std::size_t p = 0; p < total.parts.size(); ++p) {
      Add(row.parts[p], grid.cell_area(), total.parts[p]);
    }
    total.mirror_xor += grid.cell_area() * row.mirror_xor;
  }
  for (const PartVolumes& part : total.parts) Add(part, 1.0, total.all);
  return total;
}

}  // namespace capfit::metrics
