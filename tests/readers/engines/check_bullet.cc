// Builds the shapes of bullet_colliders.json in Bullet (double precision) and compares its
// distances with the result's own, outside, where Bullet's are exact: at rest and posed.
//
//   check_bullet FOLDER
#include <BulletCollision/CollisionShapes/btMultiSphereShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

#include <array>
#include <memory>
#include <vector>

#include "tests/readers/engines/expected_solids.h"

namespace {

using nlohmann::json;

constexpr double kTolerance = 1e-6;

btVector3 VectorOf(const json& n) {
  return {n.at(0).get<double>(), n.at(1).get<double>(), n.at(2).get<double>()};
}

btTransform TransformOf(const json& position, const json& rotation) {
  const btQuaternion turn(rotation.at(0).get<double>(), rotation.at(1).get<double>(),
                          rotation.at(2).get<double>(), rotation.at(3).get<double>());
  return btTransform(turn, VectorOf(position));
}

std::unique_ptr<btConvexInternalShape> ShapeOf(const json& shape) {
  if (shape.at("shape") == "btSphereShape") {
    return std::make_unique<btSphereShape>(shape.at("radius").get<double>());
  }
  std::array<btVector3, 2> positions{};
  std::array<btScalar, 2> radii{};
  for (std::size_t k = 0; k < 2; ++k) {
    positions[k] = VectorOf(shape.at("positions").at(k));
    radii[k] = shape.at("radii").at(k).get<double>();
  }
  auto made = std::make_unique<btMultiSphereShape>(positions.data(), radii.data(), 2);
  made->setMargin(0.0);  // Bullet's own 4 cm lie inside of the radii, and some are smaller
  return made;
}

btTransform BulletTransform(const Eigen::Isometry3d& place) {
  const Eigen::Quaterniond q(place.linear());
  const Eigen::Vector3d& p = place.translation();
  return btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), btVector3(p.x(), p.y(), p.z()));
}

// Where the joint carries the shape.
btTransform PlaceOf(const json& root, const json& shape, const capfit::readers::JointMoves& moves) {
  const btTransform local = TransformOf(shape.at("joint_position"), shape.at("joint_rotation"));
  const int joint = shape.at("joint").get<int>();
  if (joint < 0) return local;
  const json& frame = root.at("joints").at(static_cast<std::size_t>(joint));
  return BulletTransform(moves.Of(joint)) *
         TransformOf(frame.at("position"), frame.at("rotation")) * local;
}

// Returns the number of distances compared.
int Compare(const std::string& folder, const json& root, capfit::readers::When when,
            capfit::readers::Failures& failures) {
  const auto solids = capfit::readers::ExpectedSolids(folder, when);
  const capfit::readers::JointMoves moves(folder, when);
  failures.Check(root.at("shapes").size() == solids.size(), "the number of shapes");
  int points = 0;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const std::string& name = solids[i].name;
    const capfit::geometry::TaperedCapsule& hull = solids[i].hull;
    const json& shape = root.at("shapes").at(i);
    failures.Check(shape.at("name") == name, name + " is not at its place");
    const auto made = ShapeOf(shape);
    const btTransform place = PlaceOf(root, shape, moves);
    for (const Eigen::Vector3d& surface : capfit::readers::SurfacePoints(hull, 60)) {
      const Eigen::Vector3d point = surface + 0.05 * hull.Locate(surface).normal;
      btGjkEpaSolver2::sResults results;
      const double distance = btGjkEpaSolver2::SignedDistance(
          btVector3(point.x(), point.y(), point.z()), 0.0, made.get(), place, results);
      failures.Near(distance, hull.SignedDistance(point), kTolerance, name);
      ++points;
    }
  }
  return points;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string folder = argv[1];
  const json root = capfit::readers::FileJson(folder + "/bullet_colliders.json");
  capfit::readers::Failures failures;
  const int points = Compare(folder, root, capfit::readers::When::kAtRest, failures) +
                     Compare(folder, root, capfit::readers::When::kPosed, failures);
  return failures.Finish(std::to_string(root.at("shapes").size()) + " shapes in Bullet, " +
                         std::to_string(points) + " distances at rest and posed");
}
