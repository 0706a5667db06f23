#include "tests/bench/sphere_mesh/collapse_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <optional>
#include <queue>
#include <tuple>
#include <vector>

#include "tests/bench/sphere_mesh/directional_width.h"
#include "tests/bench/sphere_mesh/spherical_quadric.h"

namespace capfit::bench {
namespace {

using Eigen::Vector3d;
using geometry::Sphere;

struct Node {
  Sphere sphere;
  SphericalQuadric quadric;
  DirectionalWidth width;
  std::vector<int> neighbours;  // ascending
  std::vector<int> triangles;   // ascending, those that are alive
  int version = 0;              // how often it has changed
  bool is_alive = true;
  int place = 0;  // in the last snapshot
};

struct Candidate {
  double error;
  int a, b;  // a < b
  int version_a, version_b;
  Sphere sphere;

  // The queue's greatest is the one of least error, then of the lowest numbers.
  bool operator<(const Candidate& other) const {
    return std::tie(error, a, b) > std::tie(other.error, other.a, other.b);
  }
};

void Insert(std::vector<int>& sorted, int value) {
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), value);
  if (at == sorted.end() || *at != value) sorted.insert(at, value);
}

void Erase(std::vector<int>& sorted, int value) {
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), value);
  if (at != sorted.end() && *at == value) sorted.erase(at);
}

// The complex of spheres, edges and triangles that shrinks.
class Complex {
 public:
  Complex(const mesh::BodyMesh& mesh, const CollapseOptions& options);

  // Collapses the cheapest edge; false when none is left.
  bool CollapseOne();

  [[nodiscard]] int spheres() const { return spheres_; }
  [[nodiscard]] SphereMesh Snapshot();

 private:
  Node& At(int i) { return nodes_[i]; }
  [[nodiscard]] const Node& At(int i) const { return nodes_[i]; }
  std::array<int, 3>& Corners(int t) { return corners_[t]; }

  void AddTriangle(const mesh::BodyMesh& mesh, std::size_t index);
  void Offer(int a, int b);
  void MergeEdges(int kept, int gone);
  void MergeTriangles(int kept, int gone);
  void RemoveTriangle(int t);
  bool HasTwin(int node, int t);

  CollapseOptions options_;
  std::vector<Node> nodes_;
  std::vector<std::array<int, 3>> corners_;
  std::priority_queue<Candidate> queue_;
  std::vector<int> alive_;  // of the nodes, when last looked at
  int spheres_ = 0;
};

Complex::Complex(const mesh::BodyMesh& mesh, const CollapseOptions& options) : options_(options) {
  nodes_.resize(mesh.vertices().size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) nodes_[i].sphere.center_m = mesh.vertices()[i];
  corners_.resize(mesh.triangles().size());
  for (std::size_t t = 0; t < corners_.size(); ++t) AddTriangle(mesh, t);
  spheres_ = static_cast<int>(nodes_.size());
  alive_.resize(nodes_.size());
  std::iota(alive_.begin(), alive_.end(), 0);
  for (int a = 0; a < spheres_; ++a) {
    for (const int b : At(a).neighbours) {
      if (b > a) Offer(a, b);
    }
  }
}

void Complex::AddTriangle(const mesh::BodyMesh& mesh, std::size_t index) {
  const mesh::Triangle& triangle = mesh.triangles()[index];
  std::array<Vector3d, 3> p;
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = mesh.vertices()[triangle[k]];
    corners_[index][k] = static_cast<int>(triangle[k]);
  }
  const Vector3d doubled = (p[1] - p[0]).cross(p[2] - p[0]);
  const Vector3d normal = doubled.normalized();
  const double third = doubled.norm() / 6.0;
  const Vector3d middle = (p[0] + p[1] + p[2]) / 3.0;
  for (std::size_t k = 0; k < 3; ++k) {
    Node& node = At(corners_[index][k]);
    node.quadric.AddPlane(p[0], normal, third);
    // The corners of the share that belongs to this vertex.
    for (const Vector3d& point : {p[k], Vector3d((p[k] + p[(k + 1) % 3]) / 2.0),
                                  Vector3d((p[k] + p[(k + 2) % 3]) / 2.0), middle}) {
      node.width.Add(point);
    }
    node.triangles.push_back(static_cast<int>(index));
    Insert(node.neighbours, corners_[index][(k + 1) % 3]);
    Insert(node.neighbours, corners_[index][(k + 2) % 3]);
  }
}

void Complex::Offer(int a, int b) {
  if (a > b) std::swap(a, b);
  const Node& first = At(a);
  const Node& second = At(b);
  SphericalQuadric quadric = first.quadric;
  quadric += second.quadric;
  // Unbounded still needs an end that numbers bear: far beyond any body.
  const double widest = 1e3 * (first.sphere.center_m - second.sphere.center_m).norm();
  const double max_radius = options_.radius_bound > 0.0
                                ? options_.radius_bound * first.width.LeastWith(second.width)
                                : widest;
  const std::optional<Sphere> best = quadric.Minimise(max_radius);
  const Sphere sphere =
      best ? *best
           : quadric.MinimiseOnSegment(first.sphere.center_m, second.sphere.center_m, max_radius);
  queue_.push({quadric.Error(sphere), a, b, first.version, second.version, sphere});
}

void Complex::RemoveTriangle(int t) {
  for (const int corner : Corners(t)) Erase(At(corner).triangles, t);
}

bool Complex::HasTwin(int node, int t) {
  std::array<int, 3> wanted = Corners(t);
  std::sort(wanted.begin(), wanted.end());
  return std::any_of(At(node).triangles.begin(), At(node).triangles.end(), [&](int other) {
    std::array<int, 3> found = Corners(other);
    std::sort(found.begin(), found.end());
    return other != t && found == wanted;
  });
}

// Triangles on the edge become edges; those that coincide become one.
void Complex::MergeTriangles(int kept, int gone) {
  const std::vector<int> moved = At(gone).triangles;
  for (const int t : moved) {
    std::array<int, 3>& corners = Corners(t);
    if (std::find(corners.begin(), corners.end(), kept) != corners.end()) {
      RemoveTriangle(t);
      continue;
    }
    std::replace(corners.begin(), corners.end(), gone, kept);
    Insert(At(kept).triangles, t);
    if (HasTwin(kept, t)) RemoveTriangle(t);
  }
  At(gone).triangles.clear();
}

void Complex::MergeEdges(int kept, int gone) {
  for (const int other : At(gone).neighbours) {
    Erase(At(other).neighbours, gone);
    if (other == kept) continue;
    Insert(At(kept).neighbours, other);
    Insert(At(other).neighbours, kept);
  }
  At(gone).neighbours.clear();
}

bool Complex::CollapseOne() {
  while (!queue_.empty()) {
    const Candidate candidate = queue_.top();
    queue_.pop();
    Node& kept = At(candidate.a);
    Node& gone = At(candidate.b);
    if (!kept.is_alive || !gone.is_alive || kept.version != candidate.version_a ||
        gone.version != candidate.version_b) {
      continue;
    }
    kept.sphere = candidate.sphere;
    kept.quadric += gone.quadric;
    kept.width.Add(gone.width);
    ++kept.version;
    gone.is_alive = false;
    --spheres_;
    MergeTriangles(candidate.a, candidate.b);
    MergeEdges(candidate.a, candidate.b);
    for (const int other : kept.neighbours) Offer(candidate.a, other);
    return true;
  }
  return false;
}

SphereMesh Complex::Snapshot() {
  std::erase_if(alive_, [&](int i) { return !At(i).is_alive; });
  SphereMesh mesh;
  for (std::size_t i = 0; i < alive_.size(); ++i) {
    At(alive_[i]).place = static_cast<int>(i);
    mesh.spheres.push_back(At(alive_[i]).sphere);
  }
  for (const int i : alive_) {
    for (const int j : At(i).neighbours) {
      if (j > i) mesh.edges.push_back({At(i).place, At(j).place});
    }
    for (const int t : At(i).triangles) {
      const auto [a, b, c] = Corners(t);
      if (a == i) mesh.triangles.push_back({At(a).place, At(b).place, At(c).place});
    }
  }
  return mesh;
}

}  // namespace

std::vector<SphereMesh> CollapseEdges(const mesh::BodyMesh& mesh, int most_spheres,
                                      const CollapseOptions& options) {
  Complex complex(mesh, options);
  std::vector<SphereMesh> series;
  do {
    if (complex.spheres() <= most_spheres) series.push_back(complex.Snapshot());
  } while (complex.CollapseOne());
  return series;
}

}  // namespace capfit::bench
