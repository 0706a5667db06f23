#include "core/export/urdf.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <set>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/export/file_text.h"
#include "core/export/frame.h"
#include "core/export/joint_frame.h"
#include "core/export/solids.h"

namespace capfit::exports {
namespace {

constexpr char kCylinderAxis[] = "cylinders along their own +Z, centred";
constexpr char kRoot[] = "capfit";

// Turns about the fixed x, y and z axes, in this order, as URDF has them: Rz(yaw) Ry(pitch)
// Rx(roll).
Eigen::Vector3d RollPitchYaw(const Eigen::Matrix3d& turn) {
  const double across = std::hypot(turn(0, 0), turn(1, 0));
  const double pitch = std::atan2(-turn(2, 0), across);
  // Where x points straight up or down roll and yaw are one turn: all of it goes to the yaw.
  if (across < 1e-12) return {0.0, pitch, std::atan2(-turn(0, 1), turn(1, 1))};
  return {std::atan2(turn(2, 1), turn(2, 2)), pitch, std::atan2(turn(1, 0), turn(0, 0))};
}

std::string OriginText(const Eigen::Isometry3d& place) {
  return absl::StrCat("<origin xyz=\"", NumbersText(place.translation()), "\" rpy=\"",
                      NumbersText(RollPitchYaw(place.linear())), "\"/>");
}

class UrdfWriter {
 public:
  UrdfWriter(const ColliderSet& set, const UrdfOptions& options)
      : options_(options),
        upright_(Upright(set)),
        statement_(StatementOf(set, "capfit-urdf", ZUpFrame(), kCylinderAxis)) {}

  Exported Run() {
    for (const Solid& solid : SolidsOf(upright_)) Add(solid);
    std::string xml = "<?xml version=\"1.0\"?>\n<!--\n";
    absl::StrAppend(&xml, StatementLines(statement_, "  ", ""), "-->\n<robot name=\"", kRoot,
                    "\">\n  <link name=\"", kRoot, "\">\n", collisions_[-1], "  </link>\n");
    // The root link has a name of its own.
    std::vector<std::string> names = JointNames(upright_);
    names.insert(names.begin(), kRoot);
    names = UniqueNames(std::move(names), "joint");
    for (const auto& [joint, collisions] : collisions_) {
      if (joint >= 0) absl::StrAppend(&xml, Link(names[joint + 1], joint));
    }
    return {{{"colliders.urdf", xml + "</robot>\n"}}, Warnings()};
  }

 private:
  std::string Link(const std::string& name, std::int32_t joint) {
    const std::string xml_name = XmlText(name);
    return absl::StrCat("  <link name=\"", xml_name, "\">\n", collisions_[joint],
                        "  </link>\n  <joint name=\"", xml_name, "\" type=\"floating\">\n    ",
                        OriginText(JointFrameIn(ZUpFrame(), upright_, joint)),
                        "\n    <parent link=\"", kRoot, "\"/>\n    <child link=\"", xml_name,
                        "\"/>\n  </joint>\n");
  }

  void Add(const Solid& solid) {
    AddSphere(solid, solid.spheres[0]);
    if (!solid.capsule.has_value()) return;
    AddSphere(solid, solid.spheres[1]);
    const std::vector<UniformPiece> cylinders = ConeCylinders(solid.hull, options_.max_overshoot_m);
    for (std::size_t k = 0; k < cylinders.size(); ++k) {
      AddCylinder(solid, absl::StrCat(solid.name, "_", k + 1), cylinders[k]);
    }
    ++capsule_count_;
    cylinder_count_ += static_cast<std::int64_t>(cylinders.size());
  }

  void AddSphere(const Solid& solid, std::size_t index) {
    if (!is_written_.insert({solid.joint, index}).second) return;
    const geometry::Sphere& sphere = upright_.primitives.spheres[index];
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    place.translation() = ToLink(solid.joint) * sphere.center_m;
    AddCollision(solid.joint, upright_.sphere_names[index], place,
                 absl::StrCat("<sphere radius=\"", NumberText(sphere.radius_m), "\"/>"));
  }

  void AddCylinder(const Solid& solid, const std::string& name, const UniformPiece& piece) {
    const Eigen::Isometry3d to_link = ToLink(solid.joint);
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    place.translation() = to_link * (0.5 * (piece.a + piece.b)).eval();
    place.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(),
                                                        to_link.linear() * solid.hull.axis())
                         .toRotationMatrix();
    AddCollision(solid.joint, name, place,
                 absl::StrCat("<cylinder radius=\"", NumberText(piece.radius_m), "\" length=\"",
                              NumberText((piece.b - piece.a).norm()), "\"/>"));
  }

  // From the upright frame to that of the link that carries `joint`. The root's own is the file's.
  [[nodiscard]] Eigen::Isometry3d ToLink(std::int32_t joint) const {
    if (joint < 0) return JointFrameIn(ZUpFrame(), upright_, -1);
    return JointFrame(upright_, joint).inverse();
  }

  void AddCollision(std::int32_t joint, const std::string& name, const Eigen::Isometry3d& place,
                    const std::string& geometry) {
    absl::StrAppend(&collisions_[joint], "    <collision name=\"", XmlText(name), "\">",
                    OriginText(place), "<geometry>", geometry, "</geometry></collision>\n");
  }

  [[nodiscard]] std::vector<Warning> Warnings() const {
    if (capsule_count_ == 0) return {};
    return {{"CAPSULES_REPLACED",
             absl::StrCat("URDF has no capsule: ", capsule_count_, " became spheres and ",
                          cylinder_count_, " cylinders that enclose them, up to ",
                          options_.max_overshoot_m, " m too large"),
             capsule_count_}};
  }

  const UrdfOptions options_;
  const ColliderSet upright_;
  const Statement statement_;
  std::map<std::int32_t, std::string> collisions_;  // of each joint
  std::set<std::pair<std::int32_t, std::size_t>> is_written_;
  std::int64_t capsule_count_ = 0;
  std::int64_t cylinder_count_ = 0;
};

}  // namespace

absl::StatusOr<Exported> WriteUrdf(const ColliderSet& set, const UrdfOptions& options) {
  CAPFIT_RETURN_IF_ERROR(CheckOvershoot(options.max_overshoot_m));
  return UrdfWriter(set, options).Run();
}

}  // namespace capfit::exports
