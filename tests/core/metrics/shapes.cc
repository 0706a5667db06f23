#include "tests/core/metrics/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

namespace capfit::test_shapes {
namespace {

using Eigen::Vector3d;
using Key = std::array<int, 3>;

// Vertices that share a place on an integer lattice are one vertex.
class LatticeMesh {
 public:
  std::uint32_t Vertex(const Key& key, const Vector3d& position) {
    const auto [it, is_new] = index_.try_emplace(key, static_cast<std::uint32_t>(vertices_.size()));
    if (is_new) vertices_.push_back(position);
    return it->second;
  }
  void Quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangles_.push_back({a, b, c});
    triangles_.push_back({a, c, d});
  }
  mesh::BodyMesh Finish() && { return MeshOf(std::move(vertices_), std::move(triangles_)); }

 private:
  std::map<Key, std::uint32_t> index_;
  std::vector<Vector3d> vertices_;
  std::vector<mesh::Triangle> triangles_;
};

// The squares of the cells' faces that no other cell shares; cells of side 1.
mesh::BodyMesh SurfaceOfCells(const std::vector<Key>& cells) {
  LatticeMesh mesh;
  for (const Key& cell : cells) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        Key beyond = cell;
        beyond[axis] += side == 1 ? 1 : -1;
        if (std::find(cells.begin(), cells.end(), beyond) != cells.end()) continue;
        std::array<std::uint32_t, 4> corners{};
        for (int k = 0; k < 4; ++k) {
          Key corner = cell;
          corner[axis] += side;
          corner[(axis + 1) % 3] += (k == 1 || k == 2) ? 1 : 0;
          corner[(axis + 2) % 3] += (k == 2 || k == 3) ? 1 : 0;
          corners[k] = mesh.Vertex(corner, Vector3d(corner[0], corner[1], corner[2]));
        }
        if (side == 0) std::reverse(corners.begin(), corners.end());
        mesh.Quad(corners[0], corners[1], corners[2], corners[3]);
      }
    }
  }
  return std::move(mesh).Finish();
}

}  // namespace

mesh::BodyMesh MeshOf(std::vector<Vector3d> vertices, std::vector<mesh::Triangle> triangles) {
  std::vector<std::int32_t> sources(vertices.size());
  std::iota(sources.begin(), sources.end(), 0);
  return mesh::BodyMesh(std::move(vertices), std::move(triangles), std::move(sources));
}

mesh::BodyMesh Box(const Vector3d& low, const Vector3d& high, int steps) {
  LatticeMesh mesh;
  const auto vertex = [&](const Key& key) {
    const Vector3d share = Vector3d(key[0], key[1], key[2]) / steps;
    return mesh.Vertex(key, low + share.cwiseProduct(high - low));
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {0, steps}) {
      for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
          std::array<std::uint32_t, 4> corners{};
          for (int k = 0; k < 4; ++k) {
            Key key{};
            key[axis] = side;
            key[(axis + 1) % 3] = i + ((k == 1 || k == 2) ? 1 : 0);
            key[(axis + 2) % 3] = j + ((k == 2 || k == 3) ? 1 : 0);
            corners[k] = vertex(key);
          }
          if (side == 0) std::reverse(corners.begin(), corners.end());
          mesh.Quad(corners[0], corners[1], corners[2], corners[3]);
        }
      }
    }
  }
  return std::move(mesh).Finish();
}

mesh::BodyMesh Ball(const geometry::Sphere& sphere, int levels) {
  std::vector<Vector3d> v = {Vector3d::UnitX(),  -Vector3d::UnitX(), Vector3d::UnitY(),
                             -Vector3d::UnitY(), Vector3d::UnitZ(),  -Vector3d::UnitZ()};
  std::vector<mesh::Triangle> t = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                   {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [it, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(v.size()));
      if (is_new) v.push_back((v[a] + v[b]).normalized());
      return it->second;
    };
    std::vector<mesh::Triangle> finer;
    for (const auto& [a, b, c] : t) {
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    t = std::move(finer);
  }
  for (Vector3d& p : v) p = sphere.center_m + sphere.radius_m * p;
  return MeshOf(std::move(v), std::move(t));
}

mesh::BodyMesh Capsule(const geometry::Sphere& a, const geometry::Sphere& b, int around,
                       int per_cap) {
  const Vector3d axis = (b.center_m - a.center_m).normalized();
  const Vector3d e = axis.unitOrthogonal();
  const Vector3d f = axis.cross(e);
  // Angle from -axis at which the cone leaves the spheres.
  const double sine = (a.radius_m - b.radius_m) / (b.center_m - a.center_m).norm();
  const double leave = std::numbers::pi / 2 + std::asin(sine);
  std::vector<Vector3d> v = {a.center_m - a.radius_m * axis};
  const auto ring = [&](const geometry::Sphere& sphere, double angle) {
    for (int k = 0; k < around; ++k) {
      const double turn = 2 * std::numbers::pi * k / around;
      v.push_back(sphere.center_m +
                  sphere.radius_m * (-std::cos(angle) * axis +
                                     std::sin(angle) * (std::cos(turn) * e + std::sin(turn) * f)));
    }
  };
  for (int k = 1; k <= per_cap; ++k) ring(a, leave * k / per_cap);
  for (int k = 0; k < per_cap; ++k) {
    ring(b, leave + (std::numbers::pi - leave) * k / per_cap);
  }
  v.push_back(b.center_m + b.radius_m * axis);
  std::vector<mesh::Triangle> t;
  const auto n = static_cast<std::uint32_t>(around);
  const auto rings = static_cast<std::uint32_t>(2 * per_cap);
  const auto at = [&](std::uint32_t r, std::uint32_t k) { return 1 + r * n + k % n; };
  for (std::uint32_t k = 0; k < n; ++k) {
    t.push_back({0, at(0, k + 1), at(0, k)});
    t.push_back({at(rings - 1, k), at(rings - 1, k + 1), static_cast<std::uint32_t>(v.size() - 1)});
    for (std::uint32_t r = 0; r + 1 < rings; ++r) {
      t.push_back({at(r, k), at(r, k + 1), at(r + 1, k)});
      t.push_back({at(r, k + 1), at(r + 1, k + 1), at(r + 1, k)});
    }
  }
  return MeshOf(std::move(v), std::move(t));
}

mesh::BodyMesh Bracket() { return SurfaceOfCells({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}); }

double WindingNumber(const mesh::BodyMesh& mesh, const Vector3d& point) {
  double angle = 0.0;
  for (const mesh::Triangle& t : mesh.triangles()) {
    const Vector3d a = mesh.vertices()[t[0]] - point;
    const Vector3d b = mesh.vertices()[t[1]] - point;
    const Vector3d c = mesh.vertices()[t[2]] - point;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)),
                            la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (4 * std::numbers::pi);
}

}  // namespace capfit::test_shapes
