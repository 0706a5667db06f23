#include "tests/readers/sample_set.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <span>

#include "core/base/status.h"
#include "core/export/frame.h"
#include "core/formats/read_mesh.h"
#include "core/pipeline/engines.h"
#include "core/skinning/one_joint.h"

namespace capfit::readers {
namespace {

using exports::ColliderSet;
using nlohmann::json;

json Numbers(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

using Moves = Eigen::Isometry3d;

// Turns of the joints about their own places, by an angle that differs from joint to joint, each
// with all that hangs below it.
class Pose {
 public:
  explicit Pose(const std::vector<formats::NamedJoint>& joints) : joints_(joints) {
    for (std::size_t j = 0; j < joints.size(); ++j) moves_.push_back(MovesOf(j));
  }

  // What the joint has done since rest, in the mesh's frame.
  [[nodiscard]] const Moves& Of(std::size_t joint) const { return moves_[joint]; }
  [[nodiscard]] formats::Placing Posed(std::size_t joint) const {
    formats::Placing posed = moves_[joint].linear() * joints_[joint].to_mesh;
    posed.col(3) += moves_[joint].translation();
    return posed;
  }
  [[nodiscard]] std::vector<formats::Placing> AllPosed() const {
    std::vector<formats::Placing> posed;
    for (std::size_t j = 0; j < moves_.size(); ++j) posed.push_back(Posed(j));
    return posed;
  }

 private:
  [[nodiscard]] Moves MovesOf(std::size_t joint) const {
    Moves moves = Moves::Identity();
    std::int32_t index = static_cast<std::int32_t>(joint);
    for (std::size_t depth = 0; index >= 0 && depth < joints_.size(); ++depth) {
      const formats::NamedJoint& at = joints_[index];
      const Eigen::Vector3d axis(1.0, index % 3 - 1.0, (index * 7) % 5 - 2.0);
      const Eigen::AngleAxisd turn(0.3 + 0.1 * (index % 7), axis.normalized());
      const Eigen::Translation3d place(at.to_mesh.col(3));
      moves = Moves(place * turn * place.inverse()) * moves;
      index = at.parent;
    }
    return moves;
  }

  const std::vector<formats::NamedJoint>& joints_;
  std::vector<Moves> moves_;
};

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

// Where `points`, each on its joint alone, are in the pose.
json Posed(const ColliderSet& set, const Pose& pose, const std::vector<Eigen::Vector3d>& points,
           const std::vector<std::int32_t>& joints) {
  std::vector<Eigen::Vector3d> posed = points;
  if (!set.sphere_joints.empty()) {
    posed = skinning::Apply(skinning::OnOneJoint(points, joints, set.joints), pose.AllPosed());
  }
  json numbers = json::array();
  for (const Eigen::Vector3d& point : posed) numbers.push_back(Numbers(point));
  return numbers;
}

json ExpectedSpheres(const ColliderSet& set, const Pose& pose) {
  std::vector<Eigen::Vector3d> centers;
  for (const geometry::Sphere& sphere : set.primitives.spheres) centers.push_back(sphere.center_m);
  const json posed = Posed(set, pose, centers, set.sphere_joints);
  const std::vector<std::size_t> lone = LoneSpheres(set);
  json spheres = json::array();
  for (std::size_t i = 0; i < set.sphere_count(); ++i) {
    const geometry::Sphere& sphere = set.primitives.spheres[i];
    spheres.push_back({{"name", set.sphere_names[i]},
                       {"center", Numbers(sphere.center_m)},
                       {"posed_center", posed[i]},
                       {"radius", sphere.radius_m},
                       {"joint", JointAt(set.sphere_joints, i)},
                       {"lone", std::binary_search(lone.begin(), lone.end(), i)}});
  }
  return spheres;
}

json ExpectedCapsules(const ColliderSet& set, const Pose& pose) {
  std::vector<Eigen::Vector3d> ends;
  std::vector<std::int32_t> joints;
  for (std::size_t k = 0; k < set.capsule_count(); ++k) {
    for (const int end : set.primitives.capsules[k]) {
      ends.push_back(set.primitives.spheres[end].center_m);
      joints.push_back(JointAt(set.capsule_joints, k));
    }
  }
  const json posed = Posed(set, pose, ends, joints);
  const std::vector<std::string> names = CapsuleNames(set);
  json capsules = json::array();
  for (std::size_t i = 0; i < set.capsule_count(); ++i) {
    capsules.push_back({{"name", names[i]},
                        {"spheres", set.primitives.capsules[i]},
                        {"posed_centers", {posed[2 * i], posed[2 * i + 1]}},
                        {"joint", JointAt(set.capsule_joints, i)}});
  }
  return capsules;
}

// The same movement seen in the upright frame, metres.
json MovedUpright(const Moves& moves, const geometry::Similarity& upright) {
  const Eigen::Matrix3d turn = upright.rotation * moves.linear() * upright.rotation.transpose();
  const Eigen::Quaterniond q(turn);
  return {{"position", Numbers(upright.Apply(moves.translation()) - turn * upright.translation)},
          {"rotation", {q.x(), q.y(), q.z(), q.w()}}};
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
  set.joints = result.joints;
  set.sphere_joints = result.sphere_joints;
  set.capsule_joints = result.capsule_joints;
  set.profile = pipeline::ProfileOf(options);
  set.source = source;
  set.version = result.version;
  CAPFIT_RETURN_IF_ERROR(CheckColliderSet(set));
  return set;
}

json Expected(const ColliderSet& set) {
  const geometry::Similarity upright = exports::UprightFromMesh(set);
  formats::Placing upright_from_mesh;
  upright_from_mesh << upright.scale * upright.rotation, upright.translation;
  const Pose pose(set.joints);
  json joints = json::array();
  for (std::size_t j = 0; j < set.joints.size(); ++j) {
    const formats::NamedJoint& joint = set.joints[j];
    joints.push_back({{"name", joint.name},
                      {"parent", joint.parent},
                      {"node", joint.node},
                      {"to_mesh", Rows(joint.to_mesh)},
                      {"posed", Rows(pose.Posed(j))},
                      {"moved_upright", MovedUpright(pose.Of(j), upright)}});
  }
  return {{"source", set.source},
          {"spheres", ExpectedSpheres(set, pose)},
          {"capsules", ExpectedCapsules(set, pose)},
          {"joints", joints},
          {"upright_from_mesh", Rows(upright_from_mesh)},
          {"metres_per_unit", upright.scale}};
}

}  // namespace capfit::readers
