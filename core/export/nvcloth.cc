#include "core/export/nvcloth.h"

#include <algorithm>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/export/file_text.h"
#include "core/export/frame.h"

namespace capfit::exports {
namespace {

constexpr char kNvClothAxis[] = "a capsule is the convex hull of its two spheres";
// NvCloth keeps 32-bit masks of which sphere and which capsule a particle is near.
constexpr std::size_t kNvClothLimit = 32;

std::string Carrier(const ColliderSet& set, const std::vector<std::int32_t>& joints,
                    std::size_t index) {
  if (joints.empty()) return "";
  return absl::StrCat(", on ",
                      CommentText(set.joints[static_cast<std::size_t>(joints[index])].name));
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

std::string Document(const ColliderSet& upright) {
  std::string text = "#ifndef CAPFIT_NVCLOTH_COLLIDERS_H_\n#define CAPFIT_NVCLOTH_COLLIDERS_H_\n";
  absl::StrAppend(
      &text, "/*\n",
      StatementLines(StatementOf(upright, "capfit-nvcloth", YUpFrame(), kNvClothAxis), "  ", ""),
      "*/\n#include <stdint.h>\n\nenum {\n  CAPFIT_SPHERE_COUNT = ", upright.sphere_count(),
      ",\n  CAPFIT_CAPSULE_COUNT = ", upright.capsule_count(), "\n};\n");
  absl::StrAppend(&text, "\n/* x, y, z, radius of each sphere, in metres. */\n",
                  "static const float capfit_spheres[",
                  4 * std::max<std::size_t>(1, upright.sphere_count()), "] = {\n",
                  upright.sphere_count() == 0 ? "  0.0f\n" : SphereLines(upright), "};\n");
  absl::StrAppend(
      &text, "\n/* The two spheres of each capsule. */\n", "static const uint32_t capfit_capsules[",
      2 * std::max<std::size_t>(1, upright.capsule_count()), "] = {\n",
      upright.capsule_count() == 0 ? "  0u\n" : CapsuleLines(upright), "};\n\n#endif\n");
  return text;
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
  if (!upright.joints.empty()) {
    exported.warnings.push_back({"RIG_LEFT_OUT",
                                 "the header holds the spheres as the body stood; the joint that "
                                 "carries each is a comment: move them with it"});
  }
  return exported;
}

}  // namespace capfit::exports
