#include "core/tighten/cover_target.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "core/mesh/surface_sums.h"

namespace capfit::tighten {

CoverTarget TargetOf(const body::Body& body, const body::PartSelection& parts,
                     const ThreadPool& pool) {
  constexpr std::uint32_t kLeftOut = std::numeric_limits<std::uint32_t>::max();
  CoverTarget target;
  const body::EnclosedSurface surface = body.enclosed();
  if (!body::LeavesOutSome(surface.vertex_segments, parts)) {
    target.points_m = LentOrOwn<Eigen::Vector3d>::Lent(surface.vertices_m);
    target.triangles = LentOrOwn<mesh::Triangle>::Lent(surface.triangles);
    target.vertices.resize(surface.vertices_m.size());
    std::iota(target.vertices.begin(), target.vertices.end(), 0u);
    return target;
  }
  std::vector<std::uint32_t> new_index(surface.vertices_m.size(), kLeftOut);
  target.vertices.reserve(new_index.size());
  for (std::uint32_t v = 0; v < new_index.size(); ++v) {
    if (!parts.Includes(body::PartOf(surface.vertex_segments[v]))) continue;
    new_index[v] = static_cast<std::uint32_t>(target.vertices.size());
    target.vertices.push_back(v);
  }
  const auto put_points = [&] {
    std::vector<Eigen::Vector3d>& points_m = target.points_m.own();
    points_m.reserve(target.vertices.size());
    for (const std::uint32_t v : target.vertices) points_m.push_back(surface.vertices_m[v]);
  };
  const auto put_triangles = [&] {
    std::vector<mesh::Triangle>& triangles = target.triangles.own();
    triangles.reserve(surface.triangles.size());
    for (const mesh::Triangle& t : surface.triangles) {
      const mesh::Triangle kept = {new_index[t[0]], new_index[t[1]], new_index[t[2]]};
      if (kept[0] == kLeftOut || kept[1] == kLeftOut || kept[2] == kLeftOut) continue;
      triangles.push_back(kept);
    }
  };
  pool.ForEach(2, [&](std::size_t half) { half == 0 ? put_triangles() : put_points(); });
  return target;
}

double SizeOf(const CoverTarget& target) {
  const double area = mesh::AreaOf(target.points_m, target.triangles);
  if (area > 0.0) return std::sqrt(area);
  Eigen::Array3d low = target.points_m[0];
  Eigen::Array3d high = low;
  for (const Eigen::Vector3d& p : target.points_m) {
    low = low.min(p.array());
    high = high.max(p.array());
  }
  return std::max((high - low).matrix().norm(), 1e-9);
}

AreaWeights WeightsByArea(const CoverTarget& target) {
  AreaWeights weights{std::vector<double>(target.points_m.size(), 0.0)};
  const double area = mesh::AddVertexAreas(target.points_m, target.triangles, weights.of_point_m2);
  weights.size_m = area > 0.0 ? std::sqrt(area) : SizeOf(target);
  const double least_m2 = 1e-9 * weights.size_m * weights.size_m;
  for (double& weight : weights.of_point_m2) weight += least_m2;
  return weights;
}

}  // namespace capfit::tighten
