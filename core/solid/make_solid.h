// One closed surface round a character of many shells.
#ifndef CAPFIT_CORE_SOLID_MAKE_SOLID_H_
#define CAPFIT_CORE_SOLID_MAKE_SOLID_H_

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/base/warning.h"
#include "core/mesh/body_mesh.h"

namespace capfit::solid {

struct SolidOptions {
  // The area of all shells is cut into squares of this number: their side is that of the cells the
  // space is cut into. 64,000 give cells of 6 mm on a dressed adult and about as many triangles;
  // four times as many halve the cells.
  std::size_t squares = 64'000;
};

struct Solid {
  mesh::BodyMesh mesh;  // in the caller's frame and unit; `vertex_of_source` is empty
  double cell = 0.0;    // side of a cell, in the caller's unit
  std::vector<Warning> warnings;
};

// The outer surface of all that the triangles surround together, as one closed surface that keeps
// the promises of BodyMesh. They may be any number of shells: open, overlapping, nested, doubled,
// turned inside out, cutting through themselves or each other.
//
// Each shell is closed across its holes (as a sleeve is at its ends) and turned outward by its own
// volume; what is inside of any of them is inside. Besides are inside: what all of them enclose
// together (a body deleted under its clothes, the mouth), cracks narrower than three quarters of a
// cell, the space of up to four cells under plates and linings, and gaps up to 2 % of the diagonal
// between pieces that nothing else joins. Limbs stay apart where the gap between them is wider than
// a cell. Sheets thinner than a cell are given about a cell's thickness.
//
// Of smooth surface the result is within about 0.1 mm in the median at cells of 6 mm (0.5 mm for
// 95 %); ridges, hems and fingers within half a cell. Original vertices may lie outside of it by as
// much. Same bits for any number of threads. About 35 ms for 64k triangles on two threads and
// O(triangles + squares); at most 100 MB for the grid, whatever the coordinates: then cells are
// larger.
//
// `triangles`: corners below positions.size(), which are finite; ones with two equal corners are
// left out. Warnings: GAPS_BRIDGED (nodes of the grid), PARTS_LEFT_OUT (pieces too far away).
// FAILED_PRECONDITION: NO_SURFACE, NO_VOLUME (nothing thicker than some cells), TWO_BODIES (a
// second piece, too far away to be joined, has half of the first one's volume or more). CANCELLED
// where `observer` says so.
[[nodiscard]] absl::StatusOr<Solid> MakeSolid(std::span<const Eigen::Vector3d> positions,
                                              std::span<const mesh::Triangle> triangles,
                                              const SolidOptions& options = {},
                                              const ThreadPool& pool = ThreadPool(1),
                                              const FitObserver& observer = NullObserver());

}  // namespace capfit::solid

#endif  // CAPFIT_CORE_SOLID_MAKE_SOLID_H_
