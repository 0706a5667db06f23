#include "core/body/working_copy.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/base/chunk_sums.h"
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
    return p.x() != q.x() ? p.x() < q.x() : a < b;
  };
  for (auto first = order.begin(); first != order.end();) {
    auto last = first + 1;
    while (last != order.end() && keys[*last] == keys[*first]) ++last;
    if (last - first > 1) std::sort(first, last, comes_first);
    first = last;
  }
  return order;
}

std::vector<std::uint32_t> CurveKeys(const std::vector<Eigen::Vector3d>& points,
                                     const ThreadPool& pool) {
  Eigen::Vector3d low = points.front();
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double cells = (1u << kBitsPerAxis) - 1;
  const double side = std::max((high - low).maxCoeff(), std::numeric_limits<double>::min());
  std::vector<std::uint32_t> keys(points.size());
  pool.ForChunks(points.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Eigen::Vector3d at = (points[v] - low) * (cells / side);
      keys[v] = Spread(static_cast<std::uint32_t>(at.x())) |
                Spread(static_cast<std::uint32_t>(at.y())) << 1 |
                Spread(static_cast<std::uint32_t>(at.z())) << 2;
    }
  });
  return keys;
}

// A triangle with new names for its corners, and its place among the mesh's own.
struct SortedTriangle {
  mesh::Triangle corners;
  std::uint32_t source;

  bool operator<(const SortedTriangle& other) const { return corners < other.corners; }
};

// The mesh's triangles with the ranks of their vertices, the lowest corner first, by that corner.
std::vector<SortedTriangle> RenamedTriangles(const mesh::BodyMesh& mesh,
                                             const std::vector<std::uint32_t>& order,
                                             const ThreadPool& pool) {
  std::vector<std::uint32_t> rank(order.size());
  for (std::uint32_t i = 0; i < rank.size(); ++i) rank[order[i]] = i;
  const std::span<const mesh::Triangle> triangles = mesh.triangles();
  std::vector<SortedTriangle> renamed(triangles.size());
  pool.ForChunks(triangles.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const mesh::Triangle& t = triangles[i];
      mesh::Triangle corners = {rank[t[0]], rank[t[1]], rank[t[2]]};
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      renamed[i] = {corners, static_cast<std::uint32_t>(i)};
    }
  });
  std::vector<std::uint32_t> end(rank.size() + 1, 0);
  for (const SortedTriangle& t : renamed) ++end[t.corners[0]];
  for (std::size_t k = 1; k < end.size(); ++k) end[k] += end[k - 1];
  std::vector<SortedTriangle> sorted(triangles.size());
  // From the back, so that the ends become the starts.
  for (const SortedTriangle& t : renamed) sorted[--end[t.corners[0]]] = t;
  pool.ForChunks(rank.size(), kMeshChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) {
      std::sort(sorted.begin() + end[v], sorted.begin() + end[v + 1]);
    }
  });
  return sorted;
}

// Enters the triangles of vertices in a new order, sorted by their corners in it, and their mates.
void SortTriangles(const mesh::BodyMesh& mesh, const ThreadPool& pool, WorkingCopy& copy) {
  const std::vector<SortedTriangle> sorted = RenamedTriangles(mesh, copy.mesh_vertex, pool);
  copy.triangles.resize(sorted.size());
  copy.mates.resize(3 * sorted.size());
  // Where the first half-edge of each of the mesh's triangles has gone; the others follow it round.
  std::vector<mesh::HalfEdge> gone_to(sorted.size());
  const auto follow = [](mesh::HalfEdge h, std::uint32_t steps) {
    return 3 * (h / 3) + (h + steps) % 3;
  };
  const auto visit = [&](const auto& place) {
    pool.ForChunks(sorted.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) place(static_cast<std::uint32_t>(i), sorted[i]);
    });
  };
  visit([&](std::uint32_t i, const SortedTriangle& t) {
    copy.triangles[i] = t.corners;
    const std::uint32_t first = mesh.triangles()[t.source][0];
    const auto at = std::find_if(t.corners.begin(), t.corners.end(), [&](std::uint32_t corner) {
      return copy.mesh_vertex[corner] == first;
    });
    gone_to[t.source] = 3 * i + static_cast<std::uint32_t>(at - t.corners.begin());
  });
  visit([&](std::uint32_t, const SortedTriangle& t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const mesh::HalfEdge mate = mesh.mates()[3 * t.source + k];
      copy.mates[follow(gone_to[t.source], k)] =
          mate == mesh::kNoMate ? mate : follow(gone_to[mate / 3], mate % 3);
    }
  });
}

struct Moment {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double six_volumes = 0.0;

  Moment& operator+=(const Moment& other) {
    moment += other.moment;
    six_volumes += other.six_volumes;
    return *this;
  }
};

// Of the volume, in the mesh's frame.
Eigen::Vector3d CentroidOf(const mesh::BodyMesh& mesh, const ThreadPool& pool) {
  const Eigen::Vector3d middle = 0.5 * (mesh.box_min() + mesh.box_max());
  const auto part = [&](std::size_t begin, std::size_t end) {
    Moment sum;
    for (const mesh::Triangle& t : mesh.triangles().subspan(begin, end - begin)) {
      const Eigen::Vector3d a = mesh.vertices()[t[0]] - middle;
      const Eigen::Vector3d b = mesh.vertices()[t[1]] - middle;
      const Eigen::Vector3d c = mesh.vertices()[t[2]] - middle;
      const double wedge = a.dot(b.cross(c));
      sum.six_volumes += wedge;
      sum.moment += wedge * (a + b + c) / 4.0;
    }
    return sum;
  };
  const Moment total = SumOverChunks(pool, mesh.triangles().size(), Moment{}, part);
  return middle + total.moment / total.six_volumes;
}

// Adds up term(point).
template <typename Sum, typename Term>
Sum SumOf(std::span<const Eigen::Vector3d> points, const ThreadPool& pool, const Sum& zero,
          const Term& term) {
  return SumOverChunks(pool, points.size(), zero, [&](std::size_t begin, std::size_t end) {
    Sum sum = zero;
    for (const Eigen::Vector3d& p : points.subspan(begin, end - begin)) sum += term(p);
    return sum;
  });
}

// Rows: the directions in which the points spread most, second most and least; right-handed. The
// first and the more lopsided of the others point to where the points reach out farther.
Eigen::Matrix3d PrincipalAxes(std::span<const Eigen::Vector3d> points, const ThreadPool& pool) {
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  const Eigen::Vector3d mean =
      SumOf(points, pool, zero, [](const Eigen::Vector3d& p) { return p; }) /
      static_cast<double>(points.size());
  const Eigen::Matrix3d no_products = Eigen::Matrix3d::Zero();
  const Eigen::Matrix3d products =
      SumOf(points, pool, no_products, [&](const Eigen::Vector3d& p) -> Eigen::Matrix3d {
        return (p - mean) * (p - mean).transpose();
      });
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(products);
  Eigen::Matrix3d axes = solver.eigenvectors().rowwise().reverse().transpose();
  const Eigen::Vector3d cubes =
      SumOf(points, pool, zero, [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
        const Eigen::Vector3d at = axes * (p - mean);
        return at.cwiseProduct(at).cwiseProduct(at);
      });
  const int lopsided = std::abs(cubes[1]) >= std::abs(cubes[2]) ? 1 : 2;
  for (const int k : {0, lopsided}) {
    if (cubes[k] < 0.0) axes.row(k) = -axes.row(k);
  }
  if (axes.determinant() < 0.0) axes.row(3 - lopsided) = -axes.row(3 - lopsided);
  return axes;
}

void AddAreas(const ThreadPool& pool, WorkingCopy& copy) {
  std::vector<double> thirds(copy.triangles.size());
  pool.ForChunks(thirds.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const mesh::Triangle& t = copy.triangles[i];
      const Eigen::Vector3d& a = copy.points[t[0]];
      thirds[i] = (copy.points[t[1]] - a).cross(copy.points[t[2]] - a).norm() / 6.0;
    }
  });
  copy.vertex_areas.assign(copy.points.size(), 0.0);
  double area = 0.0;
  for (std::size_t i = 0; i < thirds.size(); ++i) {
    area += 3.0 * thirds[i];
    for (const std::uint32_t v : copy.triangles[i]) copy.vertex_areas[v] += thirds[i];
  }
  for (double& a : copy.vertex_areas) a /= area;
}

}  // namespace

WorkingCopy MakeWorkingCopy(const mesh::BodyMesh& mesh, const ThreadPool& pool) {
  WorkingCopy copy;
  copy.centroid = CentroidOf(mesh, pool);
  copy.unit = std::sqrt(mesh.area());
  const std::size_t count = mesh.vertices().size();
  std::vector<Eigen::Vector3d> points(count);
  const auto for_each_vertex = [&](const auto& visit) {
    pool.ForChunks(count, kMeshChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) visit(v);
    });
  };
  for_each_vertex(
      [&](std::size_t v) { points[v] = (mesh.vertices()[v] - copy.centroid) / copy.unit; });
  copy.axes = PrincipalAxes(points, pool);
  for_each_vertex([&](std::size_t v) { points[v] = Snap(copy.axes * points[v], kCoordinateGrid); });
  copy.mesh_vertex = SortByKey(CurveKeys(points, pool), points);
  SortTriangles(mesh, pool, copy);
  copy.points.resize(count);
  for_each_vertex([&](std::size_t v) { copy.points[v] = points[copy.mesh_vertex[v]]; });
  AddAreas(pool, copy);
  return copy;
}

}  // namespace capfit::body
