#include "core/pipeline/bind_spheres.h"

#include <cstdint>

namespace capfit::pipeline {

bool HasRig(const formats::PolygonSoup& soup) {
  return !soup.joints.empty() && soup.influences.size() == soup.positions.size();
}

std::vector<Eigen::Vector3d> CentersOf(const capsule::PrimitiveSet& set) {
  std::vector<Eigen::Vector3d> centers;
  centers.reserve(set.spheres.size());
  for (const geometry::Sphere& sphere : set.spheres) centers.push_back(sphere.center_m);
  return centers;
}

std::optional<skinning::Carriers> CarriersOf(const body::Body& body) {
  if (!body.shells) return std::nullopt;
  return skinning::Carriers{body.shells->vertices_m, body.shells->nearest_of_mesh,
                            body.shells->vertex_of_source};
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

}  // namespace capfit::pipeline
