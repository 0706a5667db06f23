#include "core/body/working_copy.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace capfit::body {
namespace {

constexpr int kBitsPerAxis = 8;

// Spreads the low 8 bits so that two zero bits follow each.
std::uint32_t Spread(std::uint32_t x) {
  x = (x | (x << 8)) & 0x0000F00Fu;
  x = (x | (x << 4)) & 0x000C30C3u;
  return (x | (x << 2)) & 0x00249249u;
}

// Index order by key, equal keys in their old order (two passes of 12 bits).
std::vector<std::uint32_t> SortByKey(const std::vector<std::uint32_t>& keys) {
  std::vector<std::uint32_t> order(keys.size());
  std::vector<std::uint32_t> next(keys.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  for (const int shift : {0, 12}) {
    std::array<std::uint32_t, 4097> start{};
    for (const std::uint32_t key : keys) ++start[((key >> shift) & 0xFFFu) + 1];
    for (std::size_t k = 1; k < start.size(); ++k) start[k] += start[k - 1];
    for (const std::uint32_t i : order) next[start[(keys[i] >> shift) & 0xFFFu]++] = i;
    order.swap(next);
  }
  return order;
}

std::vector<std::uint32_t> CurveKeys(const mesh::BodyMesh& mesh) {
  const double cells = (1u << kBitsPerAxis) - 1;
  const double side =
      std::max((mesh.box_max() - mesh.box_min()).maxCoeff(), std::numeric_limits<double>::min());
  std::vector<std::uint32_t> keys;
  keys.reserve(mesh.vertices().size());
  for (const Eigen::Vector3d& v : mesh.vertices()) {
    const Eigen::Vector3d at = (v - mesh.box_min()) * (cells / side);
    keys.push_back(Spread(static_cast<std::uint32_t>(at.x())) |
                   Spread(static_cast<std::uint32_t>(at.y())) << 1 |
                   Spread(static_cast<std::uint32_t>(at.z())) << 2);
  }
  return keys;
}

// Triangles in the order of their first corners.
std::vector<mesh::Triangle> SortedTriangles(const mesh::BodyMesh& mesh,
                                            const std::vector<std::uint32_t>& mesh_vertex) {
  std::vector<std::uint32_t> rank(mesh_vertex.size());
  for (std::uint32_t i = 0; i < rank.size(); ++i) rank[mesh_vertex[i]] = i;
  std::vector<std::uint32_t> start(rank.size() + 1, 0);
  std::vector<mesh::Triangle> renamed;
  renamed.reserve(mesh.triangles().size());
  for (const mesh::Triangle& t : mesh.triangles()) {
    renamed.push_back({rank[t[0]], rank[t[1]], rank[t[2]]});
    ++start[*std::min_element(renamed.back().begin(), renamed.back().end()) + 1];
  }
  for (std::size_t k = 1; k < start.size(); ++k) start[k] += start[k - 1];
  std::vector<mesh::Triangle> sorted(renamed.size());
  for (const mesh::Triangle& t : renamed)
    sorted[start[*std::min_element(t.begin(), t.end())]++] = t;
  return sorted;
}

}  // namespace

WorkingCopy MakeWorkingCopy(const mesh::BodyMesh& mesh) {
  WorkingCopy copy;
  copy.mesh_vertex = SortByKey(CurveKeys(mesh));
  copy.triangles = SortedTriangles(mesh, copy.mesh_vertex);
  const Eigen::Vector3d middle = 0.5 * (mesh.box_min() + mesh.box_max());
  copy.points.reserve(copy.mesh_vertex.size());
  for (const std::uint32_t v : copy.mesh_vertex) copy.points.push_back(mesh.vertices()[v] - middle);
  copy.vertex_areas.assign(copy.points.size(), 0.0);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double six_volumes = 0.0;
  double area = 0.0;
  for (const mesh::Triangle& t : copy.triangles) {
    const Eigen::Vector3d& a = copy.points[t[0]];
    const Eigen::Vector3d& b = copy.points[t[1]];
    const Eigen::Vector3d& c = copy.points[t[2]];
    const double wedge = a.dot(b.cross(c));
    six_volumes += wedge;
    moment += wedge * (a + b + c) / 4.0;
    const double third = (b - a).cross(c - a).norm() / 6.0;
    area += 3.0 * third;
    for (const std::uint32_t v : t) copy.vertex_areas[v] += third;
  }
  const Eigen::Vector3d centroid = moment / six_volumes;
  copy.centroid = middle + centroid;
  copy.unit = std::sqrt(area);
  for (Eigen::Vector3d& p : copy.points) p = (p - centroid) / copy.unit;
  for (double& a : copy.vertex_areas) a /= area;
  return copy;
}

}  // namespace capfit::body
