#include "core/mannequin/catmull_clark.h"

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>
#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

namespace capfit::mannequin {
namespace {

using Eigen::Vector3d;
using OpenMesh::EdgeHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

using Point = OpenMesh::Vec3d;
using Mesh = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

// A closed mesh of quads that is subdivided again and again: by OpenMesh, which knows no sharp
// edges and no limits; those are added here.
class Subdivision {
 public:
  explicit Subdivision(const QuadMesh& cage) : quads_(cage.quads) {
    for (const Vector3d& p : cage.vertices) mesh_.add_vertex({p.x(), p.y(), p.z()});
    for (const Quad& q : cage.quads) {
      [[maybe_unused]] const auto face =
          mesh_.add_face({Handle(q[0]), Handle(q[1]), Handle(q[2]), Handle(q[3])});
      assert(face.is_valid());  // the cage is a manifold
    }
    for (const Edge& e : cage.creases) {
      const HalfedgeHandle h = mesh_.find_halfedge(Handle(e[0]), Handle(e[1]));
      if (h.is_valid()) sharp_edges_.push_back(mesh_.edge_handle(h));
    }
  }

  // The children of quad q are 4q .. 4q + 3, at the corners 0 .. 3, and all keep the parent's
  // directions: child corner 0 is the one towards the parent's corner 0.
  [[nodiscard]] const std::vector<Quad>& quads() const { return quads_; }

  void Refine() {
    const auto first_middle = static_cast<int>(mesh_.n_vertices());
    const auto first_half = static_cast<int>(mesh_.n_edges());
    std::vector<MovedVertex> moved =
        SharpVertices([](const Point& p, const Point& sum) { return 0.75 * p + 0.125 * sum; });
    for (const EdgeHandle e : sharp_edges_) {
      moved.emplace_back(VertexHandle(first_middle + e.idx()), mesh_.calc_edge_midpoint(e));
    }
    std::vector<Quad> children = Children();
    subdivider_(mesh_, 1);
    for (const auto& [vertex, point] : moved) mesh_.set_point(vertex, point);
    // The second halves of the split edges follow all edges in the same order.
    const std::vector<EdgeHandle> halves = sharp_edges_;
    for (const EdgeHandle e : halves) sharp_edges_.emplace_back(first_half + e.idx());
    quads_ = std::move(children);
  }

  // Where the vertices end up after infinitely many steps.
  [[nodiscard]] std::vector<Vector3d> LimitPoints() const {
    std::vector<Vector3d> points;
    points.reserve(mesh_.n_vertices());
    for (const VertexHandle v : mesh_.vertices()) points.push_back(ToEigen(SmoothLimit(v)));
    const auto sharp =
        SharpVertices([](const Point& p, const Point& sum) { return (4.0 * p + sum) / 6.0; });
    for (const auto& [vertex, point] : sharp) points[Index(vertex)] = ToEigen(point);
    return points;
  }

 private:
  using MovedVertex = std::pair<VertexHandle, Point>;

  static VertexHandle Handle(std::uint32_t vertex) {
    return VertexHandle(static_cast<int>(vertex));
  }
  static Vector3d ToEigen(const Point& p) { return {p[0], p[1], p[2]}; }
  template <typename AnyHandle>
  static std::uint32_t Index(AnyHandle handle) {
    return static_cast<std::uint32_t>(handle.idx());
  }

  // The vertices on which sharp edges meet, moved by a rule for their place and the sum of what is
  // at the other ends of those edges. Where only one ends it ends smoothly.
  template <typename Rule>
  [[nodiscard]] std::vector<MovedVertex> SharpVertices(const Rule& rule) const {
    std::map<VertexHandle, std::pair<Point, int>> ends;  // sum, count
    for (const EdgeHandle e : sharp_edges_) {
      for (const int side : {0, 1}) {
        const HalfedgeHandle h = mesh_.halfedge_handle(e, side);
        auto& [sum, count] =
            ends.try_emplace(mesh_.from_vertex_handle(h), Point(0.0, 0.0, 0.0), 0).first->second;
        sum += mesh_.point(mesh_.to_vertex_handle(h));
        ++count;
      }
    }
    std::vector<MovedVertex> moved;
    for (const auto& [v, end] : ends) {
      if (end.second >= 2) moved.emplace_back(v, rule(mesh_.point(v), end.first));
    }
    return moved;
  }

  // (n^2 p + 4 sum of neighbours + sum of the corners across the quads) / (n (n + 5)).
  [[nodiscard]] Point SmoothLimit(VertexHandle v) const {
    Point neighbours(0.0, 0.0, 0.0);
    Point across(0.0, 0.0, 0.0);
    double n = 0.0;
    for (auto h = mesh_.cvoh_iter(v); h.is_valid(); ++h, ++n) {
      neighbours += mesh_.point(mesh_.to_vertex_handle(*h));
      across += mesh_.point(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(*h)));
    }
    return (n * n * mesh_.point(v) + 4.0 * neighbours + across) / (n * (n + 5.0));
  }

  // With OpenMesh's numbers: to the vertices come one for each edge, then one for each quad.
  [[nodiscard]] std::vector<Quad> Children() const {
    const auto edge_start = static_cast<std::uint32_t>(mesh_.n_vertices());
    const auto quad_start = static_cast<std::uint32_t>(edge_start + mesh_.n_edges());
    std::vector<Quad> children;
    children.reserve(4 * quads_.size());
    for (const Quad& v : quads_) {
      HalfedgeHandle h = mesh_.find_halfedge(Handle(v[0]), Handle(v[1]));
      const std::uint32_t c = quad_start + Index(mesh_.face_handle(h));
      Quad e;
      for (std::uint32_t& middle : e) {
        middle = edge_start + Index(mesh_.edge_handle(h));
        h = mesh_.next_halfedge_handle(h);
      }
      children.push_back({v[0], e[0], c, e[3]});
      children.push_back({e[0], v[1], e[1], c});
      children.push_back({c, e[1], v[2], e[2]});
      children.push_back({e[3], c, e[2], v[3]});
    }
    return children;
  }

  Mesh mesh_;
  OpenMesh::Subdivider::Uniform::CatmullClarkT<Mesh, double> subdivider_;
  std::vector<Quad> quads_;
  std::vector<EdgeHandle> sharp_edges_;
};

}  // namespace

SmoothSurface::SmoothSurface(const QuadMesh& cage, int levels) : size_((1 << levels) + 1) {
  Subdivision fine(cage);
  for (int level = 0; level < levels; ++level) fine.Refine();
  points_ = fine.LimitPoints();
  const std::size_t size = size_;
  grid_.resize(cage.quads.size() * size * size);
  for (std::size_t q = 0; q < fine.quads().size(); ++q) {
    // The base-4 digits of q tell the way down from the cage's face: corner 0 .. 3 at each level.
    std::size_t i = 0;
    std::size_t j = 0;
    for (int level = 0; level < levels; ++level) {
      const std::size_t corner = (q >> (2 * level)) & 3;
      i |= (corner == 1 || corner == 2 ? 1 : 0) << level;
      j |= (corner >= 2 ? 1 : 0) << level;
    }
    const std::size_t face = q >> (2 * levels);
    std::uint32_t* const base = &grid_[(face * size + i) * size + j];
    base[0] = fine.quads()[q][0];
    base[size] = fine.quads()[q][1];
    base[size + 1] = fine.quads()[q][2];
    base[1] = fine.quads()[q][3];
  }
}

Vector3d SmoothSurface::At(std::size_t face, double u, double v) const {
  const int cells = size_ - 1;
  const int i = std::min(static_cast<int>(u * cells), cells - 1);
  const int j = std::min(static_cast<int>(v * cells), cells - 1);
  const double s = u * cells - i;
  const double t = v * cells - j;
  return (1 - s) * ((1 - t) * GridPoint(face, i, j) + t * GridPoint(face, i, j + 1)) +
         s * ((1 - t) * GridPoint(face, i + 1, j) + t * GridPoint(face, i + 1, j + 1));
}

}  // namespace capfit::mannequin
