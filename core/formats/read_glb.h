// glTF 2.0 from memory: GLB, VRM (which is a GLB), and JSON with its buffers inside (.gltf).
#ifndef CAPFIT_CORE_FORMATS_READ_GLB_H_
#define CAPFIT_CORE_FORMATS_READ_GLB_H_

#include <cstddef>
#include <span>

#include "absl/status/statusor.h"
#include "core/formats/mesh_limits.h"
#include "core/formats/polygon_soup.h"

namespace capfit::formats {

// All triangles of the default scene (or of all nodes, where the file has no scene) as a viewer
// shows them before any animation runs, meshes in scene order; primitives that share their vertices
// in the file share them here.
//
// - Node transforms are applied. Skinned vertices stand where the joint nodes stand now, by glTF's
//   rules: the sum of weight * node_to_world(joint) * inverse_bind over up to eight joints; the
//   mesh's own node has no say. Where all joints agree to a hundredth of a millimetre on a body
//   (the bind pose), one transform places them all. A joint whose matrix is none (zeros are common)
//   moves nothing; vertices that no sensible joint holds follow the skin's first joint that has a
//   sensible bind matrix, and where there is none the mesh stands where its node does.
// - Morph targets count with their default weights. KHR_mesh_quantization, sparse accessors,
//   KHR_draco_mesh_compression and EXT_meshopt_compression (codec version 0) are read.
// - `parts`: one for each primitive of triangles that is drawn, named by its node, else its mesh. A
//   primitive that repeats an earlier one of its mesh, vertices and indices, as exporters of
//   several materials do, is a part without faces.
// - `joints`: the nodes that skins of drawn meshes list, then those that VRM 0 or 1 names as human
//   bones, where they stand; `influences`: the strongest four of each vertex, and the joint that a
//   part without skin hangs under.
//
// Coordinates and indices are checked as they are read; INVALID_ARGUMENT (field "mesh.file") names
// the accessor and its row. Refused (UNSUPPORTED_FILE): buffers in other files, and whatever
// extension the file calls required that places or packs geometry in another way, by its name.
// Materials (but for names), textures and animations are skipped unseen, and no other file is
// opened. That is why this reads the JSON itself (nlohmann/json) and not with TinyGLTF, which would
// decode images and open files unless told otherwise, and checks no accessor against its buffer.
//
// O(file). Decoders are asked only for what they can hold: 256 MB in all, and `limits`.
[[nodiscard]] absl::StatusOr<PolygonSoup> ReadGlb(std::span<const std::byte> bytes,
                                                  const MeshLimits& limits);

}  // namespace capfit::formats

#endif  // CAPFIT_CORE_FORMATS_READ_GLB_H_
