#include "core/export/unreal.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "core/export/ball_warnings.h"
#include "core/export/file_text.h"
#include "core/export/frame.h"
#include "core/export/json_text.h"
#include "core/export/solids.h"
#include "core/export/unreal_script.h"

namespace capfit::exports {
namespace {

using UnrealJson = nlohmann::ordered_json;

constexpr char kUnrealAxis[] =
    "tapered capsules along their own +Z, Radius0 (the first sphere) at +Z; Length between centres";

UnrealJson Centimetres(const Eigen::Vector3d& upright_m) {
  const Eigen::Vector3d point = UnrealFrame().Point(upright_m);
  return UnrealJson::array({point.x(), point.y(), point.z()});
}

UnrealJson Direction(const Eigen::Vector3d& upright) {
  const Eigen::Vector3d direction = UnrealFrame().from_upright * upright;
  return UnrealJson::array({direction.x(), direction.y(), direction.z()});
}

UnrealJson UnrealShape(const Solid& solid) {
  UnrealJson shape = {{"name", solid.name}, {"bone", solid.joint}};
  if (solid.IsBall()) {
    shape["kind"] = "sphere";
    shape["center"] = Centimetres(solid.ball().center_m);
    shape["radius"] = UnrealFrame().Length(solid.ball().radius_m);
    return shape;
  }
  shape["kind"] = "tapered";
  shape["center"] = Centimetres(0.5 * (solid.hull.a().center_m + solid.hull.b().center_m));
  shape["axis"] = Direction(-solid.hull.axis());
  shape["radius0"] = UnrealFrame().Length(solid.hull.a().radius_m);
  shape["radius1"] = UnrealFrame().Length(solid.hull.b().radius_m);
  shape["length"] = UnrealFrame().Length(solid.hull.length_m());
  return shape;
}

// A string of Python that has the JSON in it, whatever names there are: JsonText is ASCII, and
// without single quotes three of them cannot end it early.
std::string PythonLiteral(const UnrealJson& json) {
  return absl::StrCat("r'''", absl::StrReplaceAll(JsonText(json), {{"'", "\\u0027"}}), "'''");
}

}  // namespace

Exported WriteUnreal(const ColliderSet& set) {
  const ColliderSet upright = Upright(set);
  const std::vector<Solid> solids = SolidsOf(upright);
  const Statement statement = StatementOf(set, "capfit-unreal", UnrealFrame(), kUnrealAxis);
  UnrealJson data = StatementJson(statement);
  data["bones"] = UnrealJson::array();
  for (const formats::NamedJoint& joint : upright.joints) {
    data["bones"].push_back({{"name", joint.name},
                             {"parent", joint.parent},
                             {"position", Centimetres(joint.position)}});
  }
  data["shapes"] = UnrealJson::array();
  for (const Solid& solid : solids) data["shapes"].push_back(UnrealShape(solid));
  Exported exported;
  exported.files = {
      {"unreal_physics_asset.py",
       absl::StrCat("# Makes the physics asset of a skeletal mesh; see main() at the end.\n#\n",
                    StatementLines(statement, "#   ", ""), "import json\n\nDATA = json.loads(",
                    PythonLiteral(data), ")\n", std::string(UnrealScript()))}};
  exported.warnings = BallWarnings(solids, "Unreal");
  if (set.joints.empty()) {
    exported.warnings.push_back(
        {"NO_RIG", "the mesh came without a rig: all shapes hang on the skeleton's root bone"});
  }
  return exported;
}

}  // namespace capfit::exports
