// From the mesh as it came to the checked mesh: mended where that is safe, refused where it is not.
#ifndef CAPFIT_CORE_MESH_PREPARE_MESH_H_
#define CAPFIT_CORE_MESH_PREPARE_MESH_H_

#include <cstddef>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/base/warning.h"
#include "core/formats/mesh_limits.h"
#include "core/formats/polygon_soup.h"
#include "core/mesh/body_mesh.h"

namespace capfit::mesh {

struct PreparedMesh {
  BodyMesh mesh;                  // still in the caller's unit and axes
  std::vector<Warning> warnings;  // every repair, with counts
  double left_out_share = 0.0;    // of the surface's area: parts that were not kept
};

// From any arrays to a mesh that keeps the promises of BodyMesh. A mesh that keeps them already
// passes through without a warning; `vertex_of_source` leads back to the caller's vertices.
// Coordinates that are decimals rounded to floats are taken as the decimals (see
// recover_decimals.h). O(n log n), whatever the faces do: a second or two for two million of any
// kind (docs/mesh_repair.md has a table). Between the steps `observer` may cancel. What is one
// closed, oriented surface as it came takes a short way, on all threads of `pool`.
//
// Steps, each of which warns with a count of what it changed:
//   1. Sizes, finite positions, indices; unused vertices are ignored.          UNUSED_VERTICES
//   2. Triangles (see triangulate_faces.h); degenerate ones are dropped, and
//      of files also faces of one or two corners (from callers: refused).      DEGENERATE_FACES
//   3. Copies of faces are dropped.                                            DUPLICATE_FACES
//   4. Vertices of open edges are welded: equal ones, then those within 1e-5
//      of the used vertices' diagonal. Closed surfaces that touch stay apart.  VERTICES_WELDED
//   5. Loose faces at edges that have two faces already are dropped.           FINS_DROPPED
//   6. At other edges of more than two faces the flattest pairs are joined.    NONMANIFOLD_EDGES
//   7. The part with the largest volume is kept.                               PARTS_LEFT_OUT
//   8. Faces are turned the same way round and outward.                        FACES_TURNED,
//                                                                              INSIDE_OUT
//   9. Holes are closed with triangles between their own vertices.             HOLES_CLOSED
//  10. Vertices in which the surface touches itself are split.                 NONMANIFOLD_VERTICES
//  11. Faces without area (lower than 1e-9 of the diagonal) are mended.        FLAT_FACES
//
// The copies from step 10 are nobody's in `vertex_of_source`. A surface that cuts through itself is
// left as it is.
//
// `is_left_out`: for each face whether it is taken as not there; empty: all are.
//
// INVALID_ARGUMENT names the first offender: "mesh.arrays.triangle_indices[17] is 90210, must be
// below 6890".
// FAILED_PRECONDITION says why there is no body in it: NO_SURFACE, NO_VOLUME, TWO_BODIES (a second
// part of half the volume or more), NOT_ORIENTABLE, HOLE_NOT_CLOSED, OPEN_SURFACE (the holes are
// larger than a third of the surface), NOT_MANIFOLD. CANCELLED where the observer says so.
[[nodiscard]] absl::StatusOr<PreparedMesh> PrepareMesh(const formats::PolygonSoup& soup,
                                                       const formats::MeshLimits& limits = {},
                                                       const ThreadPool& pool = ThreadPool(1),
                                                       const FitObserver& observer = NullObserver(),
                                                       std::span<const char> is_left_out = {});

}  // namespace capfit::mesh

#endif  // CAPFIT_CORE_MESH_PREPARE_MESH_H_
