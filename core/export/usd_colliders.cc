#include "core/export/usd_colliders.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
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
    WriteHeader();
    for (const auto& [joint, colliders] : of_joint) WriteJoint(joint, colliders);
    text_ += "}\n";
    Exported exported;
    exported.files.push_back({FileStem(set_) + "_colliders.usda", std::move(text_)});
    if (!options_.is_tapered) exported.warnings.push_back(Replaced());
    return exported;
  }

 private:
  void Line(int depth, const std::string& text) {
    text_.append(static_cast<std::size_t>(4 * depth), ' ');
    text_ += text + "\n";
  }

  void WriteHeader() {
    Line(0, "#usda 1.0");
    Line(0, "(");
    Line(1, "customLayerData = {");
    Line(2, "string capfit = " + UsdString(set_.version));
    Line(2, "string frame = " + UsdString(std::string(YUpFrame().name)));
    Line(2, std::string("string profile = ") +
                (options_.is_tapered ? "\"tangent_hull\"" : "\"uniform_radius\""));
    Line(2, "string source = " + UsdString(set_.source));
    Line(1, "}");
    Line(1, "defaultPrim = \"Colliders\"");
    Line(1, "metersPerUnit = 1");
    Line(1, "upAxis = \"Y\"");
    Line(0, ")");
    Line(0, "");
    Line(0, "def Xform \"Colliders\"");
    Line(0, "{");
  }

  void WriteJoint(std::int32_t joint, const std::vector<UsdCollider>& colliders) {
    const std::string name = joint < 0 ? "body" : set_.joints[static_cast<std::size_t>(joint)].name;
    const Eigen::Isometry3d frame = JointFrame(set_, joint);
    Line(1, "def Xform \"" + joint_names_.Add(name.empty() ? "joint" : name) + "\"");
    Line(1, "{");
    if (joint >= 0) Line(2, "custom string capfit:joint = " + UsdString(name));
    WritePlace(frame);
    UsdNames names;
    for (const UsdCollider& collider : colliders) {
      text_ += "\n";
      WriteCollider(collider, names.Add(collider.name), frame.inverse());
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
    Line(3, "double radius = " + UsdNumber(radius_m));
  }

  void WriteCapsule(const UsdCollider& collider) {
    const double low_m = collider.hull.a().radius_m;
    const double high_m = collider.hull.b().radius_m;
    const double half_m = 0.5 * collider.hull.length_m();
    Line(3, "uniform token axis = \"Y\"");
    WriteExtent(std::max(low_m, high_m), -half_m - low_m, half_m + high_m);
    Line(3, "double height = " + UsdNumber(collider.hull.length_m()));
    if (!options_.is_tapered) return Line(3, "double radius = " + UsdNumber(low_m));
    Line(3, "double radiusBottom = " + UsdNumber(low_m));
    Line(3, "double radiusTop = " + UsdNumber(high_m));
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
  UsdNames joint_names_;
  std::string text_;
};

}  // namespace

absl::StatusOr<Exported> WriteUsd(const ColliderSet& set, const UsdOptions& options) {
  CAPFIT_RETURN_IF_ERROR(CheckColliderSet(set));
  if (!(options.max_overshoot_m >= kMinOvershootM && options.max_overshoot_m <= kMaxOvershootM)) {
    return OutOfRange("max_overshoot_m", options.max_overshoot_m, kMinOvershootM, kMaxOvershootM);
  }
  const ColliderSet upright = Upright(set);
  return UsdWriter(upright, options).Run();
}

}  // namespace capfit::exports
