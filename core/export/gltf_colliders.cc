#include "core/export/gltf_colliders.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/export/frame.h"
#include "core/export/gltf_document.h"
#include "core/export/gltf_extras.h"
#include "core/export/gltf_preview.h"
#include "core/export/joint_nodes.h"
#include "core/export/lathe.h"
#include "core/export/solids.h"
#include "core/formats/read_mesh.h"

namespace capfit::exports {
namespace {

using nlohmann::json;

constexpr int kPreviewSegments = 20;
constexpr const char* kShapes = "KHR_implicit_shapes";
constexpr const char* kBodies = "KHR_physics_rigid_bodies";

json ShapeOf(const Solid& solid) {
  if (solid.IsBall()) {
    return {{"type", "sphere"}, {"sphere", {{"radius", solid.ball().radius_m}}}};
  }
  return {{"type", "capsule"},
          {"capsule",
           {{"height", solid.hull.length_m()},
            {"radiusBottom", solid.hull.a().radius_m},
            {"radiusTop", solid.hull.b().radius_m}}}};
}

// A file of its own has no nodes that the joints could be.
ColliderSet WithoutJoints(ColliderSet set) {
  set.joints.clear();
  set.sphere_joints.clear();
  set.capsule_joints.clear();
  return set;
}

Warning RigLeftOut() {
  return {"RIG_LEFT_OUT",
          "the body came with joints but not as a glTF file: the colliders stand alone, on none"};
}

class GltfWriter {
 public:
  GltfWriter(const ColliderSet& set, GltfDocument document, const GltfOptions& options)
      : set_(set), document_(std::move(document)), options_(options), preview_(document_) {}

  absl::StatusOr<Exported> Run() {
    CAPFIT_ASSIGN_OR_RETURN(JointNodes joints, JointNodes::Create(set_, document_));
    for (const Solid& solid : SolidsOf(set_)) AddCollider(solid, joints);
    Exported exported;
    exported.warnings = std::move(joints).TakeWarnings();
    AddExtras(set_, document_.root(), exported.warnings);
    CAPFIT_ASSIGN_OR_RETURN(std::string bytes, document_.Bytes());
    exported.files.push_back({FileStem(set_) + "_colliders.glb", std::move(bytes)});
    return exported;
  }

 private:
  void AddCollider(const Solid& solid, JointNodes& joints) {
    const std::size_t index = joints.AddNode(solid.name, solid.Place(), solid.joint);
    const std::size_t shape = AddShape(solid);
    json& node = document_.root()["nodes"][index];
    document_.Extension(node, kBodies)["collider"] = {{"geometry", {{"shape", shape}}}};
    node["extras"]["capfit"] = ExtrasOf(solid);
    if (!options_.has_preview) return;
    const LatheMesh mesh = Lathe(solid, kPreviewSegments, LatheKind::kOnSurface);
    node["mesh"] = preview_.AddMesh(solid.name, mesh.vertices, mesh.normals, mesh.triangles);
  }

  std::size_t AddShape(const Solid& solid) {
    json& shapes = document_.Extension(document_.root(), kShapes)["shapes"];
    if (!shapes.is_array()) shapes = json::array();
    shapes.push_back(ShapeOf(solid));
    return shapes.size() - 1;
  }

  const ColliderSet& set_;
  GltfDocument document_;
  GltfOptions options_;
  GltfPreview preview_;
};

}  // namespace

absl::StatusOr<Exported> WriteGltf(const ColliderSet& set, std::span<const std::byte> original,
                                   const GltfOptions& options) {
  CAPFIT_RETURN_IF_ERROR(CheckColliderSet(set));
  if (formats::FormatFromBytes(original) == formats::MeshFormat::kGlb) {
    CAPFIT_ASSIGN_OR_RETURN(GltfDocument document, GltfDocument::Open(original));
    CAPFIT_ASSIGN_OR_RETURN(Exported exported, GltfWriter(set, std::move(document), options).Run());
    AddUnitWarning(set, exported.warnings);
    return exported;
  }
  const ColliderSet upright = WithoutJoints(Upright(set));
  CAPFIT_ASSIGN_OR_RETURN(Exported exported, GltfWriter(upright, GltfDocument(), options).Run());
  if (!set.joints.empty()) exported.warnings.push_back(RigLeftOut());
  return exported;
}

}  // namespace capfit::exports
