#include "core/export/table.h"

#include <algorithm>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "core/body/anatomy.h"
#include "core/export/file_text.h"
#include "core/export/frame.h"
#include "core/export/joint_frame.h"

namespace capfit::exports {
namespace {

constexpr char kTableAxis[] = "a capsule is the convex hull of its two spheres";

std::string NameOf(body::Part part) { return std::string(body::PartName(part)); }

std::string Line(const std::vector<std::string>& fields) {
  return absl::StrCat(absl::StrJoin(fields, ","), "\n");
}

std::string JointName(const std::vector<std::string>& names,
                      const std::vector<std::int32_t>& joints, std::size_t index) {
  return joints.empty() ? "" : CsvText(names[joints[index]]);
}

std::string Head(const ColliderSet& set, const std::string& format) {
  return StatementLines(StatementOf(set, format, YUpFrame(), kTableAxis), "# ", "");
}

std::string SphereTable(const ColliderSet& upright) {
  const std::vector<std::size_t> lone = LoneSpheres(upright);
  const std::vector<std::string> joints = JointNames(upright);
  std::string table = Head(upright, "capfit-spheres") +
                      "index,name,part,joint,x_m,y_m,z_m,radius_m,is_lone,"
                      "joint_x_m,joint_y_m,joint_z_m\n";
  const std::vector<Eigen::Vector3d> in_joints = CentersInJoints(upright);
  for (std::size_t i = 0; i < upright.sphere_count(); ++i) {
    const geometry::Sphere& sphere = upright.primitives.spheres[i];
    table += Line(
        {absl::StrCat(i), CsvText(upright.sphere_names[i]),
         NameOf(upright.primitives.origins[i].part), JointName(joints, upright.sphere_joints, i),
         NumberText(sphere.center_m.x()), NumberText(sphere.center_m.y()),
         NumberText(sphere.center_m.z()), NumberText(sphere.radius_m),
         std::binary_search(lone.begin(), lone.end(), i) ? "1" : "0", NumberText(in_joints[i].x()),
         NumberText(in_joints[i].y()), NumberText(in_joints[i].z())});
  }
  return table;
}

std::string CapsuleTable(const ColliderSet& upright) {
  const std::vector<std::string> names = CapsuleNames(upright);
  const std::vector<std::string> joints = JointNames(upright);
  std::string table = Head(upright, "capfit-capsules") +
                      "index,name,part,joint,first_sphere,second_sphere,length_m,first_radius_m,"
                      "second_radius_m,is_sphere\n";
  for (std::size_t k = 0; k < upright.capsule_count(); ++k) {
    const capsule::CapsuleEnds& ends = upright.primitives.capsules[k];
    const geometry::TaperedCapsule hull = upright.primitives.Capsule(k);
    table += Line(
        {absl::StrCat(k), CsvText(names[k]), NameOf(capsule::PartOfCapsule(upright.primitives, k)),
         JointName(joints, upright.capsule_joints, k), absl::StrCat(ends[0]), absl::StrCat(ends[1]),
         NumberText(hull.length_m()), NumberText(hull.a().radius_m), NumberText(hull.b().radius_m),
         hull.IsSphere() ? "1" : "0"});
  }
  return table;
}

}  // namespace

Exported WriteTables(const ColliderSet& set) {
  const ColliderSet upright = Upright(set);
  return {{{"spheres.csv", SphereTable(upright)}, {"capsules.csv", CapsuleTable(upright)}}, {}};
}

}  // namespace capfit::exports
