#include "core/export/nvcloth.h"

#include <algorithm>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/export/file_text.h"
#include "core/export/frame.h"
#include "core/export/joint_frame.h"

namespace capfit::exports {
namespace {

constexpr char kNvClothAxis[] = "a capsule is the convex hull of its two spheres";
// NvCloth keeps 32-bit masks of which sphere and which capsule a particle is near.
constexpr std::size_t kNvClothLimit = 32;

std::string Carrier(const ColliderSet& set, const std::vector<std::int32_t>& joints,
                    std::size_t index) {
  if (joints.empty()) return "";
  return absl::StrCat(", on ", CommentText(set.joints[joints[index]].name));
}

std::string SphereLines(const ColliderSet& upright) {
  std::string lines;
  for (std::size_t i = 0; i < upright.sphere_count(); ++i) {
    const geometry::Sphere& sphere = upright.primitives.spheres[i];
    lines += " ";
    for (const double number :
         {sphere.center_m.x(), sphere.center_m.y(), sphere.center_m.z(), sphere.radius_m}) {
      absl::StrAppend(&lines, " ", FloatText(number), "f,");
    }
    absl::StrAppend(&lines, " /* ", i, " ", CommentText(upright.sphere_names[i]),
                    Carrier(upright, upright.sphere_joints, i), " */\n");
  }
  return lines;
}

std::string CapsuleLines(const ColliderSet& upright) {
  const std::vector<std::string> names = CapsuleNames(upright);
  std::string lines;
  for (std::size_t k = 0; k < upright.capsule_count(); ++k) {
    const capsule::CapsuleEnds& ends = upright.primitives.capsules[k];
    absl::StrAppend(&lines, "  ", ends[0], "u, ", ends[1], "u, /* ", k, " ");
    absl::StrAppend(&lines, CommentText(names[k]), Carrier(upright, upright.capsule_joints, k),
                    " */\n");
  }
  return lines;
}

std::string JointLines(const ColliderSet& upright) {
  std::string lines;
  for (const std::string& name : JointNames(upright)) {
    absl::StrAppend(&lines, "  ", CStringText(name), ",\n");
  }
  return lines;
}

std::string SphereJointLines(const ColliderSet& upright) {
  std::string lines;
  for (std::size_t i = 0; i < upright.sphere_count(); ++i) {
    absl::StrAppend(&lines, "  ", upright.sphere_joints.empty() ? -1 : upright.sphere_joints[i],
                    ",\n");
  }
  return lines;
}

std::string OffsetLines(const ColliderSet& upright) {
  std::string lines;
  for (const Eigen::Vector3d& center : CentersInJoints(upright)) {
    absl::StrAppend(&lines, "  ", FloatText(center.x()), "f, ", FloatText(center.y()), "f, ",
                    FloatText(center.z()), "f,\n");
  }
  return lines;
}

// Of `count` times `per_entry` entries; one of `nothing` where there are none.
std::string Array(const std::string& comment, const std::string& declaration, std::size_t count,
                  std::size_t per_entry, const std::string& lines, const std::string& nothing) {
  return absl::StrCat("\n/* ", comment, " */\nstatic const ", declaration, "[",
                      per_entry * std::max<std::size_t>(1, count), "] = {\n",
                      count == 0 ? absl::StrCat("  ", nothing, "\n") : lines, "};\n");
}

std::string Document(const ColliderSet& upright) {
  const std::size_t spheres = upright.sphere_count();
  const std::size_t capsules = upright.capsule_count();
  const std::size_t joints = upright.joints.size();
  return absl::StrCat(
      "#ifndef CAPFIT_NVCLOTH_COLLIDERS_H_\n#define CAPFIT_NVCLOTH_COLLIDERS_H_\n/*\n",
      StatementLines(StatementOf(upright, "capfit-nvcloth", YUpFrame(), kNvClothAxis), "  ", ""),
      "*/\n#include <stdint.h>\n\nenum {\n  CAPFIT_SPHERE_COUNT = ", spheres,
      ",\n  CAPFIT_CAPSULE_COUNT = ", capsules, ",\n  CAPFIT_JOINT_COUNT = ", joints, "\n};\n",
      Array("x, y, z, radius of each sphere, in metres.", "float capfit_spheres", spheres, 4,
            SphereLines(upright), "0.0f"),
      Array("The two spheres of each capsule.", "uint32_t capfit_capsules", capsules, 2,
            CapsuleLines(upright), "0u"),
      Array("The skeleton's joints.", "char* const capfit_joint_names", joints, 1,
            JointLines(upright), "\"\""),
      Array("The joint that carries each sphere; -1: none.", "int32_t capfit_sphere_joints",
            spheres, 1, SphereJointLines(upright), "-1"),
      Array("x, y, z of each sphere in its joint's own frame (turned and moved, not scaled), in "
            "metres.",
            "float capfit_sphere_offsets", spheres, 3, OffsetLines(upright), "0.0f"),
      "\n#endif\n");
}

void WarnOfLimit(const std::string& what, std::size_t count, std::vector<Warning>& warnings) {
  if (count <= kNvClothLimit) return;
  warnings.push_back({"COLLIDER_LIMIT",
                      absl::StrCat(count, " ", what, ", but NvCloth takes at most ", kNvClothLimit,
                                   ": fit again with engine nvcloth"),
                      static_cast<std::int64_t>(count)});
}

// NvCloth skips a capsule whose squared length is at most the squared difference of the radii; it
// reckons in floats.
bool IsSkipped(const geometry::TaperedCapsule& hull) {
  const auto length = static_cast<float>(hull.length_m());
  const float difference =
      static_cast<float>(hull.a().radius_m) - static_cast<float>(hull.b().radius_m);
  return length * length <= difference * difference;
}

void WarnOfSkipped(const ColliderSet& upright, std::vector<Warning>& warnings) {
  std::int64_t count = 0;
  std::size_t first = 0;
  for (std::size_t k = upright.capsule_count(); k-- > 0;) {
    if (!IsSkipped(upright.primitives.Capsule(k))) continue;
    ++count;
    first = k;
  }
  if (count == 0) return;
  warnings.push_back({"INNER_SPHERES",
                      absl::StrCat(count, " capsules, the first '", CapsuleNames(upright)[first],
                                   "', have one sphere inside the other: NvCloth skips them, and "
                                   "the spheres alone are the same solid"),
                      count});
}

}  // namespace

Exported WriteNvCloth(const ColliderSet& set) {
  const ColliderSet upright = Upright(set);
  Exported exported{{{"nvcloth_colliders.h", Document(upright)}}, {}};
  WarnOfLimit("spheres", upright.sphere_count(), exported.warnings);
  WarnOfLimit("capsules", upright.capsule_count(), exported.warnings);
  WarnOfSkipped(upright, exported.warnings);
  return exported;
}

}  // namespace capfit::exports
