#include "core/mesh/half_edge_mesh.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace capfit::mesh {
namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

VertexHandle VertexOf(std::uint32_t index) { return VertexHandle(static_cast<int>(index)); }

// Walks along the rims; whatever comes back to a vertex is cut off as a rim by itself.
class RimFinder {
 public:
  explicit RimFinder(HalfEdgeMesh& mesh)
      : mesh_(mesh), place_on_path_(mesh.n_vertices(), kNotOnPath), used_(mesh.n_edges(), false) {}

  std::vector<Rim> Run() {
    std::vector<std::pair<int, HalfedgeHandle>> outside;  // with the vertex where it begins
    for (const HalfedgeHandle h : mesh_.halfedges()) {
      if (mesh_.is_boundary(h)) outside.emplace_back(mesh_.from_vertex_handle(h).idx(), h);
    }
    std::sort(outside.begin(), outside.end());
    for (const auto& [vertex, h] : outside) {
      if (!IsUsed(h)) WalkFrom(h);
    }
    return std::move(rims_);
  }

 private:
  static constexpr std::uint32_t kNotOnPath = 0xFFFFFFFFu;

  std::vector<bool>::reference IsUsed(HalfedgeHandle h) {
    return used_[mesh_.edge_handle(h).idx()];
  }
  std::uint32_t& PlaceOfStart(HalfedgeHandle h) {
    return place_on_path_[mesh_.from_vertex_handle(h).idx()];
  }

  void WalkFrom(HalfedgeHandle first) {
    HalfedgeHandle h = first;
    do {
      IsUsed(h) = true;
      PlaceOfStart(h) = static_cast<std::uint32_t>(path_.size());
      path_.push_back(h);
      h = mesh_.next_halfedge_handle(h);
      if (PlaceOfStart(h) != kNotOnPath) CutOffRim(PlaceOfStart(h), h);
    } while (h != first);
  }

  // The path from `place` on is back where it began, and would go on with `next`.
  void CutOffRim(std::uint32_t place, HalfedgeHandle next) {
    mesh_.set_next_halfedge_handle(path_.back(), path_[place]);
    rims_.emplace_back(path_.begin() + place, path_.end());
    for (const HalfedgeHandle h : rims_.back()) PlaceOfStart(h) = kNotOnPath;
    path_.resize(place);
    if (!path_.empty()) mesh_.set_next_halfedge_handle(path_.back(), next);
  }

  HalfEdgeMesh& mesh_;
  std::vector<std::uint32_t> place_on_path_;  // of each vertex
  std::vector<bool> used_;                    // edges
  Rim path_;
  std::vector<Rim> rims_;
};

}  // namespace

HalfEdgeMesh::HalfEdgeMesh(std::size_t vertex_count, const Surface& surface) {
  // The two half-edges of an edge lie side by side: of a rim's edge the second is outside.
  std::vector<HalfedgeHandle> handles(surface.mate.size());
  int edges = 0;
  for (HalfEdge h = 0; h < handles.size(); ++h) {
    const HalfEdge mate = surface.mate[h];
    if (mate < h) continue;  // has been seen
    handles[h] = HalfedgeHandle(2 * edges);
    if (mate != kNoMate) handles[mate] = HalfedgeHandle(2 * edges + 1);
    ++edges;
  }
  resize(vertex_count, edges, surface.triangles.size());
  LinkTriangles(surface, handles);
  LinkRims(surface, handles);
}

void HalfEdgeMesh::LinkTriangles(const Surface& surface, std::span<const HalfedgeHandle> handles) {
  for (HalfEdge h = 0; h < handles.size(); ++h) {
    const FaceHandle face(static_cast<int>(h / 3));
    set_face_handle(handles[h], face);
    set_vertex_handle(handles[h], VertexOf(EndOf(surface.triangles, h)));
    set_next_halfedge_handle(handles[h], handles[NextInTriangle(h)]);
    set_halfedge_handle(VertexOf(StartOf(surface.triangles, h)), handles[h]);
    if (h % 3 == 0) set_halfedge_handle(face, handles[h]);
  }
}

// From one side of each open fan of triangles to its other side.
void HalfEdgeMesh::LinkRims(const Surface& surface, std::span<const HalfedgeHandle> handles) {
  for (HalfEdge h = 0; h < handles.size(); ++h) {
    if (surface.mate[h] != kNoMate) continue;
    HalfEdge arriving = PreviousInTriangle(h);
    while (surface.mate[arriving] != kNoMate) arriving = PreviousInTriangle(surface.mate[arriving]);
    const HalfedgeHandle outside = opposite_halfedge_handle(handles[h]);
    const HalfedgeHandle next = opposite_halfedge_handle(handles[arriving]);
    const VertexHandle vertex = VertexOf(StartOf(surface.triangles, h));
    set_vertex_handle(outside, vertex);
    set_next_halfedge_handle(outside, next);
    set_halfedge_handle(vertex, next);  // OpenMesh knows a vertex of a rim by that
  }
}

std::vector<Rim> HalfEdgeMesh::FindRims() { return RimFinder(*this).Run(); }

void HalfEdgeMesh::FillRim(const Rim& rim, std::span<const Triangle> filling) {
  Rim from = rim;  // of each place on the rim: what leaves it, as far as it is left
  const auto first_face = static_cast<int>(n_faces());
  for (std::size_t i = 0; i < filling.size(); ++i) new_face();
  for (std::size_t i = filling.size(); i-- > 0;) {
    const std::uint32_t start = filling[i][0];
    from[start] = CutOffCorner(from[start], FaceHandle(first_face + static_cast<int>(i)));
  }
}

// Adds the triangle of a rim's half-edge and the next one. Gives the half-edge that takes their
// place on the rim, or, where the triangle was all of it, nothing of use.
HalfedgeHandle HalfEdgeMesh::CutOffCorner(HalfedgeHandle to_corner, FaceHandle face) {
  const HalfedgeHandle from_corner = next_halfedge_handle(to_corner);
  const HalfedgeHandle after = next_halfedge_handle(from_corner);
  const HalfedgeHandle before = prev_halfedge_handle(to_corner);
  const HalfedgeHandle back =
      after == before ? after
                      : new_edge(to_vertex_handle(from_corner), from_vertex_handle(to_corner));
  if (after != before) {
    set_next_halfedge_handle(before, opposite_halfedge_handle(back));
    set_next_halfedge_handle(opposite_halfedge_handle(back), after);
  }
  set_next_halfedge_handle(from_corner, back);
  set_next_halfedge_handle(back, to_corner);
  for (const HalfedgeHandle h : {to_corner, from_corner, back}) set_face_handle(h, face);
  set_halfedge_handle(face, to_corner);
  return opposite_halfedge_handle(back);
}

void HalfEdgeMesh::ZipRim(const Rim& rim) {
  // The outside of one edge takes the place of the inside of the other, which nobody knows of then.
  const HalfedgeHandle stays = rim[0];
  const HalfedgeHandle goes = opposite_halfedge_handle(rim[1]);
  const FaceHandle face = face_handle(goes);
  set_next_halfedge_handle(stays, next_halfedge_handle(goes));
  set_next_halfedge_handle(prev_halfedge_handle(goes), stays);
  set_face_handle(stays, face);
  if (halfedge_handle(face) == goes) set_halfedge_handle(face, stays);
}

void HalfEdgeMesh::TurnEdge(HalfedgeHandle h) {
  // (a, b, c) and (b, a, d) become (d, c, a) and (c, d, b).
  const HalfedgeHandle back = opposite_halfedge_handle(h);
  const HalfedgeHandle bc = next_halfedge_handle(h);
  const HalfedgeHandle ca = next_halfedge_handle(bc);
  const HalfedgeHandle ad = next_halfedge_handle(back);
  const HalfedgeHandle db = next_halfedge_handle(ad);
  const FaceHandle face = face_handle(h);
  const FaceHandle face_back = face_handle(back);
  set_halfedge_handle(from_vertex_handle(h), ad);
  set_halfedge_handle(from_vertex_handle(back), bc);
  set_vertex_handle(h, to_vertex_handle(bc));
  set_vertex_handle(back, to_vertex_handle(ad));
  for (const auto& [first, second] : {std::pair{h, ca}, {ca, ad}, {ad, h}}) {
    set_next_halfedge_handle(first, second);
    set_face_handle(first, face);
  }
  for (const auto& [first, second] : {std::pair{back, db}, {db, bc}, {bc, back}}) {
    set_next_halfedge_handle(first, second);
    set_face_handle(first, face_back);
  }
  set_halfedge_handle(face, h);
  set_halfedge_handle(face_back, back);
}

Surface HalfEdgeMesh::ToSurface() const {
  Surface surface;
  surface.triangles.reserve(n_faces());
  std::vector<HalfEdge> names(n_halfedges(), kNoMate);
  for (const FaceHandle face : all_faces()) {
    if (has_face_status() && status(face).deleted()) continue;
    Triangle corners;
    HalfedgeHandle h = halfedge_handle(face);
    for (std::uint32_t& corner : corners) {
      names[h.idx()] =
          static_cast<HalfEdge>(3 * surface.triangles.size() + (&corner - corners.data()));
      corner = static_cast<std::uint32_t>(from_vertex_handle(h).idx());
      h = next_halfedge_handle(h);
    }
    surface.triangles.push_back(corners);
  }
  surface.mate.resize(3 * surface.triangles.size());
  for (std::size_t h = 0; h < names.size(); ++h) {
    if (names[h] != kNoMate) surface.mate[names[h]] = names[h ^ 1];
  }
  return surface;
}

}  // namespace capfit::mesh
