// Reads colliders.urdf with urdfdom and compares it with the result: nothing dropped (urdfdom
// leaves out what it does not know and goes on), spheres where they are, and cylinders that enclose
// the cones.
//
//   check_urdf FOLDER
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <limits>
#include <map>
#include <vector>

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

// All links hang on the root, each by one joint.
Found Read(const urdf::ModelInterface& model) {
  Found found;
  for (const auto& [name, link] : model.links_) {
    Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
    if (link->parent_joint) place = Isometry(link->parent_joint->parent_to_joint_origin_transform);
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

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string folder = argv[1];
  const std::string text = capfit::readers::FileText(folder + "/colliders.urdf");
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(text);
  capfit::readers::Failures failures;
  failures.Check(model != nullptr, "urdfdom refuses the file");
  if (!model) return failures.Finish("URDF");
  const Found found = Read(*model);
  failures.Check(found.spheres.size() + found.cylinders.size() == CountOf(text, "<collision "),
                 "urdfdom dropped collisions");
  failures.Check(model->links_.size() == CountOf(text, "<link "), "urdfdom dropped links");
  std::size_t known = 0;
  for (const auto& solid : capfit::readers::ExpectedSolids(folder)) {
    for (std::size_t k = 0; k < solid.sphere_names.size(); ++k) {
      const capfit::geometry::Sphere& end = k == 0 ? solid.hull.a() : solid.hull.b();
      const auto [first, last] = found.spheres.equal_range(InXml(solid.sphere_names[k]));
      failures.Check(first != last, solid.sphere_names[k] + " is missing");
      for (auto it = first; it != last; ++it) {
        failures.Near((it->second.center_m - end.center_m).norm(), 0.0, kTolerance, solid.name);
        failures.Near(it->second.radius_m, end.radius_m, kTolerance, solid.name);
      }
    }
    std::vector<Cylinder> cylinders;
    for (const auto& [name, cylinder] : found.cylinders) {
      if (IsPieceOf(name, InXml(solid.name))) cylinders.push_back(cylinder);
    }
    known += cylinders.size();
    if (solid.sphere_names.size() == 2) CheckCylinders(solid, cylinders, failures);
  }
  failures.Check(known == found.cylinders.size(), "cylinders of no capsule");
  return failures.Finish(std::to_string(found.spheres.size()) + " spheres and " +
                         std::to_string(found.cylinders.size()) + " cylinders in urdfdom");
}
