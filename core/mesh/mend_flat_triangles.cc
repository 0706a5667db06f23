#include "core/mesh/mend_flat_triangles.h"

#include <Eigen/Geometry>  // cross
#include <algorithm>

#include "core/mesh/half_edge_mesh.h"

namespace capfit::mesh {
namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

// Looks at triangles and steps round vertices that one mesh may take: bounds what a wheel of flat
// triangles can cost.
constexpr std::size_t kMostMendingSteps = 20'000'000;

class FlatTriangleMender {
 public:
  FlatTriangleMender(std::span<const Eigen::Vector3d> positions, double tolerance,
                     HalfEdgeMesh& mesh)
      : positions_(positions), tolerance_(tolerance), mesh_(mesh) {
    mesh.request_vertex_status();  // OpenMesh's collapse needs them
    mesh.request_edge_status();
    mesh.request_face_status();
  }

  // Each success leaves fewer flat triangles, so this ends.
  MendedTriangles Run(std::span<const FaceHandle> flat) {
    for (bool mended = true; mended && steps_left_ > 0;) {
      mended = false;
      for (const FaceHandle t : flat) mended |= MendFrom(t);
    }
    return std::move(result_);
  }

 private:
  // The triangle, and what its neighbours make of that: a long row of flat triangles is mended in
  // one go, from whichever end there is a way.
  bool MendFrom(FaceHandle first) {
    bool mended = false;
    open_.push_back(first);
    while (!open_.empty() && steps_left_ > 0) {
      const FaceHandle t = open_.back();
      open_.pop_back();
      --steps_left_;
      mended |= IsStillFlat(t) && Mend(t);
    }
    return mended;
  }

  [[nodiscard]] std::uint32_t Start(HalfedgeHandle h) const { return IndexOf(From(h)); }
  [[nodiscard]] VertexHandle From(HalfedgeHandle h) const { return mesh_.from_vertex_handle(h); }
  [[nodiscard]] HalfedgeHandle Next(HalfedgeHandle h) const {
    return mesh_.next_halfedge_handle(h);
  }
  [[nodiscard]] HalfedgeHandle Opposite(HalfedgeHandle h) const {
    return mesh_.opposite_halfedge_handle(h);
  }
  [[nodiscard]] static std::uint32_t IndexOf(VertexHandle v) {
    return static_cast<std::uint32_t>(v.idx());
  }
  [[nodiscard]] double LengthOf(HalfedgeHandle h) const {
    return (positions_[Start(Next(h))] - positions_[Start(h)]).norm();
  }
  [[nodiscard]] bool IsStillFlat(FaceHandle t) const {
    if (mesh_.status(t).deleted()) return false;
    const HalfedgeHandle h = mesh_.halfedge_handle(t);
    return IsFlat(positions_, {Start(h), Start(Next(h)), Start(Next(Next(h)))}, tolerance_);
  }

  bool Mend(FaceHandle t) {
    HalfedgeHandle shortest = mesh_.halfedge_handle(t);
    HalfedgeHandle longest = shortest;
    for (const HalfedgeHandle h : {Next(shortest), Next(Next(shortest))}) {
      if (LengthOf(h) < LengthOf(shortest)) shortest = h;
      if (LengthOf(h) > LengthOf(longest)) longest = h;
    }
    return LengthOf(shortest) <= tolerance_ ? Merge(shortest) : Flip(longest);
  }

  void Spend(std::size_t steps) { steps_left_ -= std::min(steps, steps_left_); }

  // At most as many as there are steps left.
  [[nodiscard]] std::size_t CountEdgesOf(VertexHandle v) const {
    std::size_t count = 0;
    for (auto h = mesh_.cvoh_iter(v); h.is_valid() && count < steps_left_; ++h) ++count;
    return count;
  }

  [[nodiscard]] int CountEdges(VertexHandle from, VertexHandle to) const {
    int count = 0;
    for (auto v = mesh_.cvv_iter(from); v.is_valid(); ++v) count += *v == to;
    return count;
  }

  bool Flip(HalfedgeHandle h) {
    const VertexHandle apex = mesh_.opposite_vh(h);
    const VertexHandle beyond = mesh_.opposite_he_opposite_vh(h);
    const std::uint32_t c = IndexOf(apex);
    const std::uint32_t d = IndexOf(beyond);
    if (c == d || IsFlat(positions_, {Start(h), d, c}, tolerance_) ||
        IsFlat(positions_, {d, Start(Next(h)), c}, tolerance_)) {
      return false;
    }
    Spend(CountEdgesOf(apex));
    if (steps_left_ == 0 || CountEdges(apex, beyond) > 0) return false;
    mesh_.TurnEdge(h);
    for (const HalfedgeHandle side : {h, Opposite(h)}) {
      open_.push_back(mesh_.face_handle(Opposite(Next(side))));
      open_.push_back(mesh_.face_handle(Opposite(Next(Next(side)))));
    }
    ++result_.flipped;
    return true;
  }

  // Both triangles of the edge vanish; its end with the higher number gives way.
  bool Merge(HalfedgeHandle h) {
    if (Start(h) < Start(Opposite(h))) h = Opposite(h);
    const VertexHandle gone = From(h);
    const VertexHandle kept = From(Opposite(h));
    const std::size_t edges = CountEdgesOf(gone) + CountEdgesOf(kept);
    Spend(edges);
    // The two may share the two neighbours across the edge and no other, or the surface would fold
    // onto itself. OpenMesh sees to that, but not where a second edge joins them, nor where they
    // and the two neighbours are all there is (a tetrahedron).
    if (steps_left_ == 0 || edges < 7 || CountEdges(gone, kept) != 1 || !mesh_.is_collapse_ok(h)) {
      return false;
    }
    for (auto t = mesh_.cvf_iter(gone); t.is_valid(); ++t) open_.push_back(*t);
    mesh_.collapse(h);
    result_.merged.emplace_back(IndexOf(gone), IndexOf(kept));
    return true;
  }

  std::span<const Eigen::Vector3d> positions_;
  double tolerance_;
  HalfEdgeMesh& mesh_;
  std::vector<FaceHandle> open_;  // to be looked at next
  std::size_t steps_left_ = kMostMendingSteps;
  MendedTriangles result_;
};

}  // namespace

bool IsFlat(std::span<const Eigen::Vector3d> positions, const Triangle& triangle,
            double tolerance) {
  const Eigen::Vector3d ab = positions[triangle[1]] - positions[triangle[0]];
  const Eigen::Vector3d ac = positions[triangle[2]] - positions[triangle[0]];
  const double longest_squared =
      std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
  // The height on the longest edge is twice the area through its length.
  return ab.cross(ac).squaredNorm() <= tolerance * tolerance * longest_squared;
}

MendedTriangles MendFlatTriangles(std::span<const Eigen::Vector3d> positions, double tolerance,
                                  Surface& surface) {
  std::vector<FaceHandle> flat;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (IsFlat(positions, surface.triangles[t], tolerance)) flat.emplace_back(static_cast<int>(t));
  }
  if (flat.empty()) return {};
  HalfEdgeMesh mesh(positions.size(), std::exchange(surface, {}));  // never both in memory
  MendedTriangles mended = FlatTriangleMender(positions, tolerance, mesh).Run(flat);
  surface = mesh.ToSurface();
  return mended;
}

}  // namespace capfit::mesh
