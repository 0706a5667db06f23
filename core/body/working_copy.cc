#include "core/body/working_copy.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/body/snap.h"

namespace capfit::body {
namespace {

constexpr int kBitsPerAxis = 8;

// Spreads the low 8 bits so that two zero bits follow each.
std::uint32_t Spread(std::uint32_t x) {
  x = (x | (x << 8)) & 0x0000F00Fu;
  x = (x | (x << 4)) & 0x000C30C3u;
  return (x | (x << 2)) & 0x00249249u;
}

// Index order by key, equal keys by place (two passes of 12 bits).
std::vector<std::uint32_t> SortByKey(const std::vector<std::uint32_t>& keys,
                                     const std::vector<Eigen::Vector3d>& points) {
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
  const auto comes_first = [&](std::uint32_t a, std::uint32_t b) {
    const Eigen::Vector3d& p = points[a];
    const Eigen::Vector3d& q = points[b];
    if (p.y() != q.y()) return p.y() < q.y();
    if (p.z() != q.z()) return p.z() < q.z();
    return p.x() < q.x();
  };
  for (auto first = order.begin(); first != order.end();) {
    auto last = first + 1;
    while (last != order.end() && keys[*last] == keys[*first]) ++last;
    if (last - first > 1) std::stable_sort(first, last, comes_first);
    first = last;
  }
  return order;
}

std::vector<std::uint32_t> CurveKeys(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d low = points.front();
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double cells = (1u << kBitsPerAxis) - 1;
  const double side = std::max((high - low).maxCoeff(), std::numeric_limits<double>::min());
  std::vector<std::uint32_t> keys;
  keys.reserve(points.size());
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d at = (p - low) * (cells / side);
    keys.push_back(Spread(static_cast<std::uint32_t>(at.x())) |
                   Spread(static_cast<std::uint32_t>(at.y())) << 1 |
                   Spread(static_cast<std::uint32_t>(at.z())) << 2);
  }
  return keys;
}

// Triangles of vertices in a new order, sorted by their corners in it, the lowest corner first.
std::vector<mesh::Triangle> SortedTriangles(std::span<const mesh::Triangle> triangles,
                                            const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> rank(order.size());
  for (std::uint32_t i = 0; i < rank.size(); ++i) rank[order[i]] = i;
  std::vector<std::uint32_t> end(rank.size() + 1, 0);
  for (const mesh::Triangle& t : triangles) ++end[std::min({rank[t[0]], rank[t[1]], rank[t[2]]})];
  for (std::size_t k = 1; k < end.size(); ++k) end[k] += end[k - 1];
  std::vector<mesh::Triangle> sorted(triangles.size());
  // From the back, so that the ends become the starts.
  for (const mesh::Triangle& t : triangles) {
    mesh::Triangle renamed = {rank[t[0]], rank[t[1]], rank[t[2]]};
    std::rotate(renamed.begin(), std::min_element(renamed.begin(), renamed.end()), renamed.end());
    sorted[--end[renamed[0]]] = renamed;
  }
  for (std::size_t v = 0; v < rank.size(); ++v) {
    std::sort(sorted.begin() + end[v], sorted.begin() + end[v + 1]);
  }
  return sorted;
}

// Of the volume, in the mesh's frame.
Eigen::Vector3d CentroidOf(const mesh::BodyMesh& mesh) {
  const Eigen::Vector3d middle = 0.5 * (mesh.box_min() + mesh.box_max());
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double six_volumes = 0.0;
  for (const mesh::Triangle& t : mesh.triangles()) {
    const Eigen::Vector3d a = mesh.vertices()[t[0]] - middle;
    const Eigen::Vector3d b = mesh.vertices()[t[1]] - middle;
    const Eigen::Vector3d c = mesh.vertices()[t[2]] - middle;
    const double wedge = a.dot(b.cross(c));
    six_volumes += wedge;
    moment += wedge * (a + b + c) / 4.0;
  }
  return middle + moment / six_volumes;
}

// Rows: the directions in which the points spread most, second most and least; right-handed. The
// first and the more lopsided of the others point to where the points reach out farther.
Eigen::Matrix3d PrincipalAxes(std::span<const Eigen::Vector3d> points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) products += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(products);
  Eigen::Matrix3d axes = solver.eigenvectors().rowwise().reverse().transpose();
  Eigen::Vector3d cubes = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d at = axes * (p - mean);
    cubes += at.cwiseProduct(at).cwiseProduct(at);
  }
  const int lopsided = std::abs(cubes[1]) >= std::abs(cubes[2]) ? 1 : 2;
  for (const int k : {0, lopsided}) {
    if (cubes[k] < 0.0) axes.row(k) = -axes.row(k);
  }
  if (axes.determinant() < 0.0) axes.row(3 - lopsided) = -axes.row(3 - lopsided);
  return axes;
}

void AddAreas(WorkingCopy& copy) {
  copy.vertex_areas.assign(copy.points.size(), 0.0);
  double area = 0.0;
  for (const mesh::Triangle& t : copy.triangles) {
    const Eigen::Vector3d& a = copy.points[t[0]];
    const double third = (copy.points[t[1]] - a).cross(copy.points[t[2]] - a).norm() / 6.0;
    area += 3.0 * third;
    for (const std::uint32_t v : t) copy.vertex_areas[v] += third;
  }
  for (double& a : copy.vertex_areas) a /= area;
}

}  // namespace

WorkingCopy MakeWorkingCopy(const mesh::BodyMesh& mesh) {
  WorkingCopy copy;
  copy.centroid = CentroidOf(mesh);
  copy.unit = std::sqrt(mesh.area());
  std::vector<Eigen::Vector3d> points;
  points.reserve(mesh.vertices().size());
  for (const Eigen::Vector3d& v : mesh.vertices())
    points.push_back((v - copy.centroid) / copy.unit);
  copy.axes = PrincipalAxes(points);
  for (Eigen::Vector3d& p : points) p = Snap(copy.axes * p, kCoordinateGrid);
  copy.mesh_vertex = SortByKey(CurveKeys(points), points);
  copy.triangles = SortedTriangles(mesh.triangles(), copy.mesh_vertex);
  copy.points.reserve(points.size());
  for (const std::uint32_t v : copy.mesh_vertex) copy.points.push_back(points[v]);
  AddAreas(copy);
  return copy;
}

}  // namespace capfit::body
