#include "tests/readers/sample_set.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/base/status.h"
#include "core/export/frame.h"
#include "core/formats/read_mesh.h"
#include "core/pipeline/engines.h"

namespace capfit::readers {
namespace {

using exports::ColliderSet;
using nlohmann::json;

double DistanceToSegment(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
                         const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double squared = along.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((point - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (point - a - t * along).norm();
}

// Of the bones (a joint and one below it) the nearest; a joint with none below it is a point.
std::int32_t NearestJoint(const std::vector<formats::NamedJoint>& joints,
                          const Eigen::Vector3d& point) {
  std::int32_t nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto own = static_cast<std::int32_t>(j);
    const std::int32_t parent = joints[j].parent;
    const Eigen::Vector3d& start =
        parent < 0 ? joints[j].position : joints[static_cast<std::size_t>(parent)].position;
    const double distance = DistanceToSegment(point, start, joints[j].position);
    const double to_end = (point - joints[j].position).norm();
    // Where its own end is the nearest place, the joint at that end carries the point.
    const std::int32_t carrier = parent < 0 || to_end <= distance ? own : parent;
    if (distance >= least) continue;
    least = distance;
    nearest = carrier;
  }
  return nearest;
}

void Hang(ColliderSet& set) {
  if (set.joints.empty()) return;
  const auto& spheres = set.primitives.spheres;
  for (const geometry::Sphere& sphere : spheres) {
    set.sphere_joints.push_back(NearestJoint(set.joints, sphere.center_m));
  }
  for (const capsule::CapsuleEnds& ends : set.primitives.capsules) {
    const Eigen::Vector3d middle = 0.5 * (spheres[static_cast<std::size_t>(ends[0])].center_m +
                                          spheres[static_cast<std::size_t>(ends[1])].center_m);
    set.capsule_joints.push_back(NearestJoint(set.joints, middle));
  }
}

json Numbers(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

json Rows(const formats::Placing& placing) {
  json rows = json::array();
  for (int r = 0; r < 3; ++r) {
    rows.push_back({placing(r, 0), placing(r, 1), placing(r, 2), placing(r, 3)});
  }
  return rows;
}

std::int32_t JointAt(const std::vector<std::int32_t>& joints, std::size_t index) {
  return joints.empty() ? -1 : joints[index];
}

json ExpectedSpheres(const ColliderSet& set) {
  const std::vector<std::size_t> lone = LoneSpheres(set);
  json spheres = json::array();
  for (std::size_t i = 0; i < set.sphere_count(); ++i) {
    const geometry::Sphere& sphere = set.primitives.spheres[i];
    spheres.push_back({{"name", set.sphere_names[i]},
                       {"center", Numbers(sphere.center_m)},
                       {"radius", sphere.radius_m},
                       {"joint", JointAt(set.sphere_joints, i)},
                       {"lone", std::binary_search(lone.begin(), lone.end(), i)}});
  }
  return spheres;
}

json ExpectedCapsules(const ColliderSet& set) {
  const std::vector<std::string> names = CapsuleNames(set);
  json capsules = json::array();
  for (std::size_t i = 0; i < set.capsule_count(); ++i) {
    capsules.push_back({{"name", names[i]},
                        {"spheres", set.primitives.capsules[i]},
                        {"joint", JointAt(set.capsule_joints, i)}});
  }
  return capsules;
}

}  // namespace

absl::StatusOr<ColliderSet> SampleSet(const std::string& bytes, const std::string& source,
                                      const pipeline::FitOptions& options) {
  CAPFIT_ASSIGN_OR_RETURN(formats::PolygonSoup soup,
                          formats::ReadMesh(std::as_bytes(std::span(bytes))));
  NullObserver observer;
  CAPFIT_ASSIGN_OR_RETURN(const pipeline::FitResult result,
                          pipeline::Fit(soup, options, ThreadPool(), observer));
  ColliderSet set;
  set.primitives = result.primitives;
  set.sphere_names = result.sphere_names;
  set.body_from_mesh = result.body_from_caller;
  set.joints = std::move(soup.joints);
  set.profile = pipeline::ProfileOf(options);
  set.source = source;
  set.version = result.version;
  Hang(set);
  CAPFIT_RETURN_IF_ERROR(CheckColliderSet(set));
  return set;
}

json Expected(const ColliderSet& set) {
  const geometry::Similarity upright = exports::UprightFromMesh(set);
  formats::Placing upright_from_mesh;
  upright_from_mesh << upright.scale * upright.rotation, upright.translation;
  json joints = json::array();
  for (const formats::NamedJoint& joint : set.joints) {
    joints.push_back({{"name", joint.name},
                      {"parent", joint.parent},
                      {"node", joint.node},
                      {"to_mesh", Rows(joint.to_mesh)}});
  }
  return {{"source", set.source},
          {"spheres", ExpectedSpheres(set)},
          {"capsules", ExpectedCapsules(set)},
          {"joints", joints},
          {"upright_from_mesh", Rows(upright_from_mesh)},
          {"metres_per_unit", upright.scale}};
}

}  // namespace capfit::readers
