#include "core/export/usd_colliders.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/export/file_text.h"
#include "core/export/frame.h"
#include "core/export/gltf_extras.h"
#include "core/export/joint_frame.h"
#include "core/export/solids.h"
#include "core/export/uniform_pieces.h"
#include "core/export/usd_text.h"

namespace capfit::exports {
namespace {

// One prim: a solid, or a piece of one, between two spheres.
struct UsdCollider {
  std::string name;
  const Solid* solid = nullptr;
  geometry::TaperedCapsule hull;
};

std::vector<UsdCollider> CollidersOf(const Solid& solid, const UsdOptions& options) {
  if (options.is_tapered) return {{solid.name, &solid, solid.hull}};
  std::vector<UsdCollider> colliders;
  for (const UniformPiece& piece : UniformPieces(solid.hull, options.max_overshoot_m)) {
    colliders.push_back(
        {solid.name, &solid,
         geometry::TaperedCapsule({piece.a, piece.radius_m}, {piece.b, piece.radius_m})});
  }
  if (colliders.size() == 1) return colliders;
  for (std::size_t k = 0; k < colliders.size(); ++k)
    absl::StrAppend(&colliders[k].name, "_", k + 1);
  return colliders;
}

class UsdWriter {
 public:
  UsdWriter(const ColliderSet& upright, const UsdOptions& options)
      : set_(upright), options_(options), solids_(SolidsOf(upright)) {}

  Exported Run() {
    std::map<std::int32_t, std::vector<UsdCollider>> of_joint;
    for (const Solid& solid : solids_) {
      for (UsdCollider& collider : CollidersOf(solid, options_)) {
        of_joint[solid.joint].push_back(std::move(collider));
      }
    }
    std::vector<std::string> names;
    for (const auto& [joint, colliders] : of_joint) names.push_back(UsdIdentifier(NameOf(joint)));
    names = UniqueNames(std::move(names), "joint");
    WriteHeader();
    std::size_t index = 0;
    for (const auto& [joint, colliders] : of_joint) WriteJoint(names[index++], joint, colliders);
    text_ += "}\n";
    Exported exported;
    exported.files.push_back({FileStem(set_) + "_colliders.usda", std::move(text_)});
    if (!options_.is_tapered) exported.warnings.push_back(Replaced());
    return exported;
  }

 private:
  void Line(int depth, const std::string& text) {
    text_.append(4 * depth, ' ');
    text_ += text + "\n";
  }

  void WriteHeader() {
    Line(0, "#usda 1.0");
    Line(0, "(");
    Line(1, "customLayerData = {");
    for (const auto& [key, value] : StatementOf(
             set_, "usd", YUpFrame(), "capsules along +Y, the first sphere at the bottom")) {
      Line(2, "string " + key + " = " + UsdString(value));
    }
    Line(1, "}");
    Line(1, "defaultPrim = \"Colliders\"");
    Line(1, "metersPerUnit = 1");
    Line(1, "upAxis = \"Y\"");
    Line(0, ")");
    Line(0, "");
    Line(0, "def Xform \"Colliders\"");
    Line(0, "{");
  }

  [[nodiscard]] std::string NameOf(std::int32_t joint) const {
    return joint < 0 ? "body" : set_.joints[joint].name;
  }

  void WriteJoint(const std::string& prim, std::int32_t joint,
                  const std::vector<UsdCollider>& colliders) {
    const Eigen::Isometry3d frame = JointFrame(set_, joint);
    Line(1, "def Xform \"" + prim + "\"");
    Line(1, "{");
    if (joint >= 0) Line(2, "custom string capfit:joint = " + UsdString(NameOf(joint)));
    WritePlace(frame);
    std::vector<std::string> names;
    for (const UsdCollider& collider : colliders) names.push_back(UsdIdentifier(collider.name));
    names = UniqueNames(std::move(names), "collider");
    for (std::size_t k = 0; k < colliders.size(); ++k) {
      text_ += "\n";
      WriteCollider(colliders[k], names[k], frame.inverse());
    }
    Line(1, "}");
  }

  void WritePlace(const Eigen::Isometry3d& place, int depth = 2) {
    Line(depth, "quatd xformOp:orient = " + UsdQuaternion(Eigen::Quaterniond(place.linear())));
    Line(depth, "double3 xformOp:translate = " + UsdVector(place.translation()));
    Line(depth, "uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:orient\"]");
  }

  void WriteCollider(const UsdCollider& collider, const std::string& name,
                     const Eigen::Isometry3d& to_joint) {
    const bool is_ball = collider.hull.IsSphere();
    const char* type = is_ball ? "Sphere" : options_.is_tapered ? "Capsule_1" : "Capsule";
    Line(2, absl::StrCat("def ", type, " \"", name, "\" ("));
    Line(3, "prepend apiSchemas = [\"PhysicsCollisionAPI\"]");
    Line(2, ")");
    Line(2, "{");
    is_ball ? WriteBall(collider) : WriteCapsule(collider);
    Line(3, "uniform token purpose = \"guide\"");
    Line(3, "custom string capfit:name = " + UsdString(collider.solid->name));
    Line(3, "custom int[] capfit:spheres = " + SpheresOf(*collider.solid));
    Solid placed = *collider.solid;
    placed.hull = collider.hull;
    WritePlace(to_joint * placed.Place(), 3);
    Line(2, "}");
  }

  static std::string SpheresOf(const Solid& solid) {
    if (!solid.capsule.has_value()) return absl::StrCat("[", solid.spheres[0], "]");
    return absl::StrCat("[", solid.spheres[0], ", ", solid.spheres[1], "]");
  }

  void WriteBall(const UsdCollider& collider) {
    const double radius_m = std::max(collider.hull.a().radius_m, collider.hull.b().radius_m);
    WriteExtent(radius_m, -radius_m, radius_m);
    Line(3, "double radius = " + NumberText(radius_m));
  }

  void WriteCapsule(const UsdCollider& collider) {
    const double low_m = collider.hull.a().radius_m;
    const double high_m = collider.hull.b().radius_m;
    const double half_m = 0.5 * collider.hull.length_m();
    Line(3, "uniform token axis = \"Y\"");
    WriteExtent(std::max(low_m, high_m), -half_m - low_m, half_m + high_m);
    Line(3, "double height = " + NumberText(collider.hull.length_m()));
    if (!options_.is_tapered) return Line(3, "double radius = " + NumberText(low_m));
    Line(3, "double radiusBottom = " + NumberText(low_m));
    Line(3, "double radiusTop = " + NumberText(high_m));
  }

  void WriteExtent(double across_m, double low_m, double high_m) {
    Line(3, "float3[] extent = [" + UsdVector({-across_m, low_m, -across_m}) + ", " +
                UsdVector({across_m, high_m, across_m}) + "]");
  }

  [[nodiscard]] Warning Replaced() const {
    std::size_t pieces = 0;
    for (const Solid& solid : solids_) pieces += CollidersOf(solid, options_).size();
    return {"CAPSULES_REPLACED",
            absl::StrCat("USD's Capsule has one radius: ", solids_.size(), " solids became ",
                         pieces, ", which contain them and are up to ",
                         1e3 * options_.max_overshoot_m, " mm larger"),
            static_cast<std::int64_t>(pieces)};
  }

  const ColliderSet& set_;
  UsdOptions options_;
  std::vector<Solid> solids_;
  std::string text_;
};

}  // namespace

absl::StatusOr<Exported> WriteUsd(const ColliderSet& set, const UsdOptions& options) {
  CAPFIT_RETURN_IF_ERROR(CheckColliderSet(set));
  CAPFIT_RETURN_IF_ERROR(CheckOvershoot(options.max_overshoot_m));
  const ColliderSet upright = Upright(set);
  return UsdWriter(upright, options).Run();
}

}  // namespace capfit::exports
