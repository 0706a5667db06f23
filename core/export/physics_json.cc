#include "core/export/physics_json.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <limits>

#include "absl/strings/str_cat.h"
#include "core/export/ball_warnings.h"
#include "core/export/file_text.h"
#include "core/export/frame.h"
#include "core/export/joint_frame.h"
#include "core/export/json_text.h"
#include "core/export/lathe.h"
#include "core/export/solids.h"

namespace capfit::exports {
namespace {

using Json = nlohmann::ordered_json;

constexpr char kShapeAxis[] =
    "a shape lies along its own +Y, its bottom sphere at -Y, its top sphere at +Y";
// Around a hull for Rapier: 1.7 % of the radius too large, 300 points. Twice as many segments
// are four times as many points.
constexpr int kHullSegments = 24;
// Points are rounded to floats, which is how Rapier keeps them; so much is added to stay outside.
constexpr double kFloatRounding = 1e-6;

Json Numbers(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

// Of the two quaternions of a turn the one with w >= 0.
Json QuaternionJson(const Eigen::Matrix3d& turn) {
  Eigen::Quaterniond q(turn);
  if (q.w() < 0.0) q.coeffs() *= -1.0;
  return Json::array({q.x(), q.y(), q.z(), q.w()});
}

Json Place(const Eigen::Isometry3d& place, const std::string& prefix, Json json) {
  json[prefix + "position"] = Numbers(place.translation());
  json[prefix + "rotation"] = QuaternionJson(place.linear());
  return json;
}

Json JointsJson(const ColliderSet& upright) {
  const std::vector<std::string> names = JointNames(upright);
  Json joints = Json::array();
  for (std::size_t j = 0; j < names.size(); ++j) {
    joints.push_back(Place(JointFrame(upright, static_cast<std::int32_t>(j)), "",
                           {{"name", names[j]}, {"parent", upright.joints[j].parent}}));
  }
  return joints;
}

// What all three engines ask of a shape.
Json CommonOf(const ColliderSet& upright, const Solid& solid) {
  Json spheres = Json::array({upright.sphere_names[solid.spheres[0]]});
  if (solid.capsule.has_value()) spheres.push_back(upright.sphere_names[solid.spheres[1]]);
  const Eigen::Isometry3d place = solid.Place();
  Json shape = {{"name", solid.name}, {"spheres", spheres}, {"joint", solid.joint}};
  shape = Place(place, "", std::move(shape));
  return Place(JointFrame(upright, solid.joint).inverse() * place, "joint_", std::move(shape));
}

Json JoltShape(const Solid& solid) {
  if (solid.IsBall()) return {{"shape", "Sphere"}, {"radius", solid.ball().radius_m}};
  return {{"shape", "TaperedCapsule"},
          {"half_height", 0.5 * solid.hull.length_m()},
          {"top_radius", solid.hull.b().radius_m},
          {"bottom_radius", solid.hull.a().radius_m}};
}

Json BulletShape(const Solid& solid) {
  if (solid.IsBall()) return {{"shape", "btSphereShape"}, {"radius", solid.ball().radius_m}};
  const Eigen::Vector3d top(0.0, 0.5 * solid.hull.length_m(), 0.0);
  return {{"shape", "btMultiSphereShape"},
          {"positions", Json::array({Numbers(-top), Numbers(top)})},
          {"radii", {solid.hull.a().radius_m, solid.hull.b().radius_m}}};
}

double LargerRadius(const Solid& solid) {
  return std::max(solid.hull.a().radius_m, solid.hull.b().radius_m);
}

double Deviation(const Solid& solid) {
  return (LatheDeviation(kHullSegments) + 2.0 * kFloatRounding) * LargerRadius(solid);
}

bool IsUniform(const Solid& solid) { return solid.hull.a().radius_m == solid.hull.b().radius_m; }

double NearestFloat(double number) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return static_cast<double>(static_cast<float>(std::clamp(number, -kLargest, kLargest)));
}

Json HullShape(const Solid& solid) {
  Json points = Json::array();
  for (const Eigen::Vector3d& vertex :
       Lathe(solid, kHullSegments, LatheKind::kEnclosing).vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      const double outer = vertex[axis] * (1.0 + kFloatRounding);
      points.push_back(NearestFloat(outer));
    }
  }
  return {{"shape", "convexHull"}, {"deviation", Deviation(solid)}, {"points", points}};
}

Json RapierShape(const Solid& solid) {
  if (solid.IsBall()) return {{"shape", "ball"}, {"radius", solid.ball().radius_m}};
  if (!IsUniform(solid)) return HullShape(solid);
  return {{"shape", "capsule"},
          {"half_height", 0.5 * solid.hull.length_m()},
          {"radius", solid.hull.a().radius_m}};
}

std::vector<Warning> HullWarnings(const std::vector<Solid>& solids) {
  double largest = 0.0;
  std::int64_t count = 0;
  for (const Solid& solid : solids) {
    if (solid.IsBall() || IsUniform(solid)) continue;
    ++count;
    largest = std::max(largest, Deviation(solid));
  }
  if (count == 0) return {};
  return {{"CAPSULES_REPLACED",
           absl::StrCat("Rapier has no tapered capsule: ", count,
                        " became convex hulls around it, up to ", largest, " m too large"),
           count}};
}

Exported Write(const ColliderSet& set, const std::string& engine,
               const std::function<Json(const Solid&)>& shape_of) {
  const ColliderSet upright = Upright(set);
  Json root = StatementJson(StatementOf(set, "capfit-" + engine, YUpFrame(), kShapeAxis));
  root["joints"] = JointsJson(upright);
  root["shapes"] = Json::array();
  for (const Solid& solid : SolidsOf(upright)) {
    Json shape = CommonOf(upright, solid);
    shape.update(shape_of(solid));
    root["shapes"].push_back(std::move(shape));
  }
  return {{{engine + "_colliders.json", JsonText(root)}}, {}};
}

}  // namespace

Exported WriteJolt(const ColliderSet& set) {
  Exported exported = Write(set, "jolt", JoltShape);
  exported.warnings = BallWarnings(SolidsOf(set), "Jolt");
  return exported;
}

Exported WriteBullet(const ColliderSet& set) {
  Exported exported = Write(set, "bullet", BulletShape);
  exported.warnings = BallWarnings(SolidsOf(set), "Bullet");
  return exported;
}

Exported WriteRapier(const ColliderSet& set) {
  Exported exported = Write(set, "rapier", RapierShape);
  const std::vector<Solid> solids = SolidsOf(Upright(set));
  exported.warnings = HullWarnings(solids);
  Append(BallWarnings(solids, "Rapier"), exported.warnings);
  return exported;
}

}  // namespace capfit::exports
