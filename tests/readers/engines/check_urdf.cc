// Reads colliders.urdf with urdfdom and compares it with the result: nothing dropped (urdfdom
// leaves out what it does not know and goes on), spheres where they are, and cylinders that enclose
// the cones; the same with the links moved to a pose.
//
//   check_urdf FOLDER
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "core/export/file_text.h"
#include "tests/readers/engines/expected_solids.h"

namespace {

using capfit::geometry::TaperedCapsule;
using Vec3 = Eigen::Vector3d;

constexpr double kTolerance = 1e-6;
constexpr double kOvershootM = 0.005;  // kDefaultOvershootM

Eigen::Isometry3d Isometry(const urdf::Pose& pose) {
  double x = 0, y = 0, z = 0, w = 0;
  pose.rotation.getQuaternion(x, y, z, w);
  return Eigen::Translation3d(pose.position.x, pose.position.y, pose.position.z) *
         Eigen::Quaterniond(w, x, y, z);
}

// From Z up, X ahead.
Vec3 Upright(const Vec3& p) { return {p.y(), p.z(), p.x()}; }

struct Cylinder {
  Vec3 center;
  Vec3 axis;
  double radius = 0.0;
  double half = 0.0;

  [[nodiscard]] bool Contains(const Vec3& p, double tolerance) const {
    const double along = (p - center).dot(axis);
    const double across = (p - center - along * axis).norm();
    return std::abs(along) <= half + tolerance && across <= radius + tolerance;
  }
  [[nodiscard]] std::vector<Vec3> Rim() const {
    const Vec3 u = axis.unitOrthogonal();
    const Vec3 v = axis.cross(u);
    std::vector<Vec3> points;
    for (int i = 0; i < 24; ++i) {
      const Vec3 out = radius * (std::cos(i * 0.2618) * u + std::sin(i * 0.2618) * v);
      points.push_back(center + out + half * axis);
      points.push_back(center + out - half * axis);
    }
    return points;
  }
};

struct Found {
  std::multimap<std::string, capfit::geometry::Sphere> spheres;
  std::multimap<std::string, Cylinder> cylinders;
};

void Add(const urdf::Collision& collision, const Eigen::Isometry3d& link, Found& found) {
  const Eigen::Isometry3d place = link * Isometry(collision.origin);
  const Vec3 center = Upright(place.translation());
  if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(collision.geometry.get())) {
    found.spheres.insert({collision.name, {center, sphere->radius}});
  }
  if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(collision.geometry.get())) {
    found.cylinders.insert(
        {collision.name,
         {center, Upright(place.linear().col(2)), cylinder->radius, 0.5 * cylinder->length}});
  }
}

// A movement of the upright frame, in the file's.
Eigen::Isometry3d InFile(const Eigen::Isometry3d& upright) {
  Eigen::Matrix3d turn;
  turn << 0, 1, 0, 0, 0, 1, 1, 0, 0;  // as Upright
  const Eigen::Isometry3d to_upright(turn);
  return to_upright.inverse() * upright * to_upright;
}

// The result's joint of each link: those that carry something, in the file's order of links.
std::map<std::string, int> JointsOfLinks(
    const urdf::ModelInterface& model, const std::string& text,
    const std::vector<capfit::readers::ExpectedSolid>& solids) {
  std::map<std::size_t, std::string> in_order;
  for (const auto& [name, link] : model.links_) {
    if (!link->parent_joint) continue;
    const std::string tag = "<link name=\"" + capfit::exports::XmlText(name) + "\"";
    in_order.emplace(text.find(tag), name);
  }
  std::set<int> joints;
  for (const auto& solid : solids) joints.insert(solid.joint);
  joints.erase(-1);
  std::map<std::string, int> joint_of;
  auto joint = joints.begin();
  for (const auto& [at, name] : in_order) {
    if (joint != joints.end()) joint_of[name] = *joint++;
  }
  return joint_of;
}

// All links hang on the root, each by one floating joint, which the pose moves.
Found Read(const urdf::ModelInterface& model, const std::map<std::string, int>& joint_of,
           const capfit::readers::JointMoves& moves) {
  Found found;
  for (const auto& [name, link] : model.links_) {
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    if (link->parent_joint) {
      const auto joint = joint_of.find(name);
      place = InFile(moves.Of(joint == joint_of.end() ? -1 : joint->second)) *
              Isometry(link->parent_joint->parent_to_joint_origin_transform);
    }
    for (const auto& collision : link->collision_array) Add(*collision, place, found);
  }
  return found;
}

// XML has no control characters.
std::string InXml(std::string name) {
  for (char& c : name) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '_';
  }
  return name;
}

bool IsPieceOf(const std::string& name, const std::string& capsule) {
  return name.size() > capsule.size() + 1 &&
         name.compare(0, capsule.size() + 1, capsule + "_") == 0 &&
         std::all_of(name.begin() + static_cast<std::ptrdiff_t>(capsule.size()) + 1, name.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

void CheckCylinders(const capfit::readers::ExpectedSolid& solid,
                    const std::vector<Cylinder>& cylinders, capfit::readers::Failures& failures) {
  for (const Vec3& point : capfit::readers::SurfacePoints(solid.hull, 100)) {
    const bool is_in =
        SignedDistance(solid.hull.a(), point) <= kTolerance ||
        SignedDistance(solid.hull.b(), point) <= kTolerance ||
        std::any_of(cylinders.begin(), cylinders.end(),
                    [&](const Cylinder& cylinder) { return cylinder.Contains(point, kTolerance); });
    failures.Check(is_in, solid.name + " is not covered");
  }
  for (const Cylinder& cylinder : cylinders) {
    for (const Vec3& point : cylinder.Rim()) {
      failures.Check(solid.hull.SignedDistance(point) <= kOvershootM + kTolerance,
                     solid.name + ": a cylinder is too large");
    }
  }
}

std::size_t CountOf(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++count;
  }
  return count;
}

// A sphere that ends capsules on several joints stands in the link of each.
void CheckSphere(const Found& found, const std::string& name,
                 const capfit::geometry::Sphere& wanted, capfit::readers::Failures& failures) {
  double nearest = std::numeric_limits<double>::infinity();
  const auto [first, last] = found.spheres.equal_range(InXml(name));
  for (auto it = first; it != last; ++it) {
    nearest = std::min(nearest, (it->second.center_m - wanted.center_m).norm());
    failures.Near(it->second.radius_m, wanted.radius_m, kTolerance, name);
  }
  failures.Near(nearest, 0.0, kTolerance, name + " has no sphere there");
}

void CheckSolids(const Found& found, const std::vector<capfit::readers::ExpectedSolid>& solids,
                 capfit::readers::Failures& failures) {
  std::size_t known = 0;
  for (const auto& solid : solids) {
    for (std::size_t k = 0; k < solid.sphere_names.size(); ++k) {
      CheckSphere(found, solid.sphere_names[k], k == 0 ? solid.hull.a() : solid.hull.b(), failures);
    }
    std::vector<Cylinder> cylinders;
    for (const auto& [name, cylinder] : found.cylinders) {
      if (IsPieceOf(name, InXml(solid.name))) cylinders.push_back(cylinder);
    }
    known += cylinders.size();
    if (solid.sphere_names.size() == 2) CheckCylinders(solid, cylinders, failures);
  }
  failures.Check(known == found.cylinders.size(), "cylinders of no capsule");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string folder = argv[1];
  const std::string text = capfit::readers::FileText(folder + "/colliders.urdf");
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(text);
  capfit::readers::Failures failures;
  failures.Check(model != nullptr, "urdfdom refuses the file");
  if (!model) return failures.Finish("URDF");
  failures.Check(model->links_.size() == CountOf(text, "<link "), "urdfdom dropped links");
  Found found;
  for (const auto when : {capfit::readers::When::kAtRest, capfit::readers::When::kPosed}) {
    const auto solids = capfit::readers::ExpectedSolids(folder, when);
    found = Read(*model, JointsOfLinks(*model, text, solids),
                 capfit::readers::JointMoves(folder, when));
    failures.Check(found.spheres.size() + found.cylinders.size() == CountOf(text, "<collision "),
                   "urdfdom dropped collisions");
    CheckSolids(found, solids, failures);
  }
  return failures.Finish(std::to_string(found.spheres.size()) + " spheres and " +
                         std::to_string(found.cylinders.size()) +
                         " cylinders in urdfdom, at rest and posed");
}
