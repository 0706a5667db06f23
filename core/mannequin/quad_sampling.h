// From a smooth surface to a mesh with a wanted number of faces.
#ifndef CAPFIT_CORE_MANNEQUIN_QUAD_SAMPLING_H_
#define CAPFIT_CORE_MANNEQUIN_QUAD_SAMPLING_H_

#include <vector>

#include "core/mannequin/catmull_clark.h"
#include "core/mannequin/quad_mesh.h"

namespace capfit::mannequin {

// How often each face of a cage is divided: faces[f] along its edges 0-1 and 2-3 (first) and along
// 1-2 and 3-0 (second). Edges that face each other across a quad are divided alike, all along the
// strip of quads, so that the pieces fit without hanging vertices.
struct Divisions {
  std::vector<std::array<int, 2>> faces;
  int quad_count = 0;
  int largest = 1;  // of all divisions
};

// The divisions that come nearest to `quads` faces in all with pieces as even as possible. `shape`
// tells the lengths of the edges. At least one piece for each face of the cage.
[[nodiscard]] Divisions ChooseDivisions(const QuadMesh& cage, const SmoothSurface& shape,
                                        int quads);

// Samples the smooth surface over the faces of `cage` (the first of those that `surface` was made
// from) with these divisions. Vertices of the cage with x == 0 and points between two such on an
// edge come out with x == 0 exactly.
[[nodiscard]] QuadMesh Sample(const QuadMesh& cage, const SmoothSurface& surface,
                              const Divisions& divisions);

}  // namespace capfit::mannequin

#endif  // CAPFIT_CORE_MANNEQUIN_QUAD_SAMPLING_H_
