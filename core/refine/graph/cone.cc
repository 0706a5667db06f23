#include "core/refine/graph/cone.h"

#include <algorithm>
#include <utility>

namespace capfit::refine {
namespace {

// Below this difference, in metres, a capsule counts as swallowed by its larger end.
constexpr double kSwallowedM = 1e-6;

Cone SphereCone(const geometry::Sphere& sphere, int index, int other) {
  Cone cone;
  cone.ax = static_cast<float>(sphere.center_m.x());
  cone.ay = static_cast<float>(sphere.center_m.y());
  cone.az = static_cast<float>(sphere.center_m.z());
  cone.radius = static_cast<float>(sphere.radius_m);
  cone.node_a = index;
  cone.node_b = other;
  return cone;
}

}  // namespace

Cone MakeCone(const capsule::MirroredSet& graph, int a, int b) {
  const geometry::Sphere& first = graph.sphere(a);
  const geometry::Sphere& second = graph.sphere(b);
  const Eigen::Vector3d between = second.center_m - first.center_m;
  const double length = between.norm();
  if (length <= std::abs(first.radius_m - second.radius_m) + kSwallowedM) {
    return second.radius_m > first.radius_m ? SphereCone(second, b, a) : SphereCone(first, a, b);
  }
  Cone cone = SphereCone(first, a, b);
  cone.is_sphere = false;
  const double sine = (first.radius_m - second.radius_m) / length;
  const double cosine = std::sqrt(1.0 - sine * sine);
  cone.ux = static_cast<float>(between.x() / length);
  cone.uy = static_cast<float>(between.y() / length);
  cone.uz = static_cast<float>(between.z() / length);
  cone.highest = static_cast<float>(length);
  cone.radius_slope = static_cast<float>(-sine);
  cone.foot_slope = static_cast<float>(sine / cosine);
  cone.sin_half = static_cast<float>(sine);
  cone.cos_half = static_cast<float>(cosine);
  return cone;
}

std::vector<Cone> ConesOf(const capsule::MirroredSet& graph) {
  std::vector<Cone> cones;
  FindCones(graph, cones);
  return cones;
}

void FindCones(const capsule::MirroredSet& graph, std::vector<Cone>& cones) {
  cones.clear();
  std::vector<char> used(graph.spheres().size(), 0);
  for (const capsule::CapsuleEnds& e : graph.capsules()) {
    cones.push_back(MakeCone(graph, e[0], e[1]));
    used[e[0]] = used[e[1]] = 1;
  }
  for (int v = 0; v < graph.sphere_count(); ++v) {
    if (!used[v]) cones.push_back(MakeCone(graph, v, v));
  }
}

std::vector<int> ImagesOfCones(const capsule::MirroredSet& graph) {
  std::vector<int> images;
  for (int e = 0; e < graph.capsule_count(); ++e) images.push_back(graph.ImageOfCapsule(e));
  const std::vector<bool> used = capsule::UsedSpheres(graph.set());
  std::vector<int> cone_of(used.size(), -1);
  int next = graph.capsule_count();
  for (int v = 0; v < graph.sphere_count(); ++v) {
    if (!used[v]) cone_of[v] = next++;
  }
  for (int v = 0; v < graph.sphere_count(); ++v) {
    if (!used[v]) images.push_back(cone_of[graph.ImageOf(v)]);
  }
  return images;
}

ConeFoot Locate(const Cone& cone, const Eigen::Vector3d& point_m) {
  const Eigen::Vector3d axis(cone.ux, cone.uy, cone.uz);
  const Eigen::Vector3d p = point_m - Eigen::Vector3d(cone.ax, cone.ay, cone.az);
  const double along = p.dot(axis);
  const double across = std::sqrt(std::max(0.0, p.squaredNorm() - along * along));
  const double foot =
      std::clamp(along - across * cone.foot_slope, 0.0, static_cast<double>(cone.highest));
  const Eigen::Vector3d offset = p - foot * axis;
  ConeFoot result;
  result.radius_m = cone.radius + cone.radius_slope * foot;
  if (const double norm = offset.norm(); norm > 1e-9) result.normal = offset / norm;
  return result;
}

}  // namespace capfit::refine
