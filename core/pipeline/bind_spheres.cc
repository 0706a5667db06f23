#include "core/pipeline/bind_spheres.h"

#include <cstdint>
#include <optional>
#include <utility>

#include "core/skinning/mean_value_coordinates.h"
#include "core/skinning/one_joint.h"

namespace capfit::pipeline {
namespace {

// Nothing where the body's mesh is the surface that came.
std::optional<skinning::Carriers> CarriersOf(const body::Body& body) {
  if (!body.shells) return std::nullopt;
  return skinning::Carriers{body.shells->vertices_m, body.shells->nearest_of_mesh,
                            body.shells->vertex_of_source};
}

void HangOnJoints(const formats::PolygonSoup& soup, const body::Body& body, bool wants_weights,
                  std::span<const Eigen::Vector3d> centers, const skinning::SparseWeights& sparse,
                  FitResult& result) {
  std::optional<skinning::BoneWeights> bones = skinning::BonesOfSparse(sparse, centers, soup);
  if (!bones) return;
  skinning::OneJoint one = skinning::ChooseJoints(*bones, soup.joints, result.primitives.capsules);
  result.sphere_joints = std::move(one.of_sphere);
  result.capsule_joints = std::move(one.of_capsule);
  for (const double drift : one.sphere_drift) {
    result.sphere_joint_drift_m.push_back(body.body_from_caller.scale * drift);
  }
  if (wants_weights) result.bone_weights = *std::move(bones);
}

}  // namespace

bool HasRig(const formats::PolygonSoup& soup) {
  return !soup.joints.empty() && soup.influences.size() == soup.positions.size();
}

std::vector<Eigen::Vector3d> CentersOf(const capsule::PrimitiveSet& set) {
  std::vector<Eigen::Vector3d> centers;
  centers.reserve(set.spheres.size());
  for (const geometry::Sphere& sphere : set.spheres) centers.push_back(sphere.center_m);
  return centers;
}

skinning::SparseWeights BindSparse(const body::Body& body,
                                   std::span<const Eigen::Vector3d> centers_m,
                                   const ThreadPool& pool, const FitObserver& observer) {
  std::vector<std::uint8_t> parts;
  parts.reserve(body.vertex_segments.size());
  for (const body::Segment segment : body.vertex_segments) {
    parts.push_back(static_cast<std::uint8_t>(segment));
  }
  return skinning::SparseMeanValueWeights(body.mesh, centers_m, pool, observer, parts,
                                          CarriersOf(body));
}

void BindSpheres(const formats::PolygonSoup& soup, const body::Body& body,
                 const capsule::PrimitiveSet& set, SkinningMode mode, const ThreadPool& pool,
                 const FitObserver& observer, FitResult& result) {
  // In the body frame, near the origin: the coordinates do not depend on the frame, digits do.
  const std::vector<Eigen::Vector3d> centers_m = CentersOf(set);
  if (mode == SkinningMode::kDense) {
    result.weights =
        skinning::MeanValueWeights(body.mesh, centers_m, pool, observer, CarriersOf(body));
  }
  if (mode != SkinningMode::kSparse && !HasRig(soup)) return;
  // What follows from the weights of few vertices, which are quick.
  skinning::SparseWeights sparse = BindSparse(body, centers_m, pool, observer);
  const std::vector<Eigen::Vector3d> centers = CentersOf(result.primitives);
  skinning::MakeExact(soup.positions, centers, sparse);
  if (HasRig(soup)) {
    HangOnJoints(soup, body, mode == SkinningMode::kBones, centers, sparse, result);
  }
  if (mode == SkinningMode::kSparse) result.sparse_weights = std::move(sparse);
}

}  // namespace capfit::pipeline
