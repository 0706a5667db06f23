// Watertight triangle meshes of the solids and of their union, for engines that collide with
// meshes.
#ifndef CAPFIT_CORE_EXPORT_MESH_HULLS_H_
#define CAPFIT_CORE_EXPORT_MESH_HULLS_H_

#include "absl/status/statusor.h"
#include "core/base/thread_pool.h"
#include "core/export/collider_set.h"

namespace capfit::exports {

enum class MeshFrame {
  kOfMesh,  // the body's own frame and unit: lies on the file that was fitted, opened beside it
  kYUp      // metres, +Y up, +Z ahead, right-handed
};

struct MeshOptions {
  // Of each solid around its axis, which sets how far the mesh stands out: 0.5 % of the radius at
  // 64, 2 % at 32, 8 % at 16. Range: [8, 256].
  int segments = 32;
  MeshFrame frame = MeshFrame::kYUp;
};

// Each solid (see SolidsOf) as a closed mesh that encloses it: it touches the capsule from outside
// and is nowhere further away than LatheDeviation(segments) times its larger radius. Files, named
// after the set's source:
//   _hulls.obj   one object ("o") and group ("g") a solid, by its name; faces counter-clockwise
//                from outside
//   _hulls.glb   the same, one node and mesh a solid; always metres, +Y up, as glTF says
// Errors: INVALID_ARGUMENT for a set that is not sound, options out of range.
[[nodiscard]] absl::StatusOr<Exported> WriteHulls(const ColliderSet& set,
                                                  const MeshOptions& options = {});

struct UnionOptions {
  // Edges of about this length, in metres. Range: [0.002, 0.05]. Half of it takes four times as
  // many triangles and about eight times as long.
  double cell_m = 0.008;
  MeshFrame frame = MeshFrame::kYUp;
};

// The union of all solids as one closed mesh without inner faces, around it: where the union is
// round vertices are lifted off its surface by as much as faces between them would cut into it (1
// to 2 mm at 8 mm), so that coverage is kept to some hundredths of a millimetre. Creases between
// two solids are filled by up to a cell, and gaps narrower than some cells are bridged
// (solid::MakeSolid). Files "_union.obj" and "_union.glb", as above. About 0.2 s at 8 mm on a body.
// Warnings: UNION_DEVIATION (how far faces were found inside and outside of the union's surface at
// most), and those of MakeSolid. Errors: as above, and those of MakeSolid: FAILED_PRECONDITION
// where the solids are in pieces far from each other.
[[nodiscard]] absl::StatusOr<Exported> WriteUnion(const ColliderSet& set,
                                                  const UnionOptions& options = {},
                                                  const ThreadPool& pool = ThreadPool(1));

}  // namespace capfit::exports

#endif  // CAPFIT_CORE_EXPORT_MESH_HULLS_H_
