#include "core/mesh/close_holes.h"

#include <Eigen/Geometry>  // cross
#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "absl/container/flat_hash_set.h"
#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/mesh/half_edge_mesh.h"
#include "core/mesh/surface_sums.h"
#include "core/mesh/triangulate_loop.h"

namespace capfit::mesh {
namespace {

// Not OpenMesh's triangulate: it cuts fans, of 42 to 77 % more area on necks, wrists and waists.
//
// The filling of least area costs n^3 / 6 steps of some nanoseconds. A loop of 400 edges (a waist
// cut through 100,000 triangles) takes about 0.1 s; a mesh may ask for four of these in all. What
// is beyond is filled by cutting ears.
constexpr std::size_t kLongestExactLoop = 400;
constexpr std::size_t kExactSteps = 45'000'000;

class HoleCloser {
 public:
  HoleCloser(std::span<const Eigen::Vector3d> positions, HalfEdgeMesh& mesh)
      : positions_(positions), mesh_(mesh) {}

  absl::StatusOr<ClosedHoles> Run() {
    const std::vector<Rim> rims = mesh_.FindRims();
    NoteEdges(rims);
    for (const Rim& rim : rims) CAPFIT_RETURN_IF_ERROR(Close(rim));
    return report_;
  }

 private:
  static std::uint64_t Key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  }
  [[nodiscard]] std::uint32_t Start(OpenMesh::HalfedgeHandle h) const {
    return static_cast<std::uint32_t>(mesh_.from_vertex_handle(h).idx());
  }

  // All edges between two vertices of holes: no filling may use one again.
  void NoteEdges(const std::vector<Rim>& rims) {
    std::vector<bool> on_hole(positions_.size(), false);
    for (const Rim& rim : rims) {
      for (const OpenMesh::HalfedgeHandle h : rim) on_hole[Start(h)] = true;
    }
    for (const OpenMesh::EdgeHandle edge : mesh_.edges()) {
      const std::uint32_t a = Start(mesh_.halfedge_handle(edge, 0));
      const std::uint32_t b = Start(mesh_.halfedge_handle(edge, 1));
      if (on_hole[a] && on_hole[b]) edges_.insert(Key(a, b));
    }
  }

  absl::Status Close(const Rim& rim) {
    if (rim.size() == 2) {
      mesh_.ZipRim(rim);
      return absl::OkStatus();
    }
    std::vector<std::uint32_t> corners;
    std::vector<Eigen::Vector3d> points;
    for (const OpenMesh::HalfedgeHandle h : rim) {
      corners.push_back(Start(h));
      points.push_back(positions_[corners.back()]);
    }
    const std::optional<std::vector<Triangle>> filling = Fill(corners, points);
    if (!filling.has_value()) {
      return Refused(ErrorReason::kHoleNotClosed,
                     absl::StrCat("a hole of ", rim.size(),
                                  " edges cannot be closed with the vertices around it; close "
                                  "it in a modelling program"));
    }
    Report(points, *filling);
    for (const Triangle& t : *filling) {
      for (int k = 0; k < 3; ++k) edges_.insert(Key(corners[t[k]], corners[t[(k + 1) % 3]]));
    }
    mesh_.FillRim(rim, *filling);
    return absl::OkStatus();
  }

  std::optional<std::vector<Triangle>> Fill(const std::vector<std::uint32_t>& corners,
                                            const std::vector<Eigen::Vector3d>& points) {
    const MayJoin may_join = [&](std::uint32_t i, std::uint32_t k) {
      return !edges_.contains(Key(corners[i], corners[k]));
    };
    const std::size_t n = corners.size();
    const std::size_t steps = n * n * n / 6;
    if (n > kLongestExactLoop || steps > steps_left_) {
      std::optional<std::vector<Triangle>> ears = FillByCuttingEars(points, may_join);
      if (ears.has_value()) std::reverse(ears->begin(), ears->end());  // as FillRim wants them
      return ears;
    }
    steps_left_ -= steps;
    return FillBySmallestArea(points, may_join);
  }

  void Report(const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& filling) {
    ++report_.holes;
    for (const Triangle& t : filling) {
      report_.area += Area(points, t);
    }
    double perimeter = (points.front() - points.back()).norm();
    Eigen::Vector3d from_first = Eigen::Vector3d::Zero();
    for (std::size_t i = 1; i < points.size(); ++i) {
      perimeter += (points[i] - points[i - 1]).norm();
      from_first += points[i] - points[0];
    }
    if (perimeter <= report_.longest_perimeter) return;
    report_.longest_perimeter = perimeter;
    report_.largest_middle = points[0] + from_first / static_cast<double>(points.size());
  }

  std::span<const Eigen::Vector3d> positions_;
  HalfEdgeMesh& mesh_;
  absl::flat_hash_set<std::uint64_t> edges_;
  std::size_t steps_left_ = kExactSteps;
  ClosedHoles report_;
};

}  // namespace

absl::StatusOr<ClosedHoles> CloseHoles(std::span<const Eigen::Vector3d> positions,
                                       Surface& surface) {
  HalfEdgeMesh mesh(positions.size(), std::exchange(surface, {}));  // never both in memory
  CAPFIT_ASSIGN_OR_RETURN(const ClosedHoles closed, HoleCloser(positions, mesh).Run());
  surface = mesh.ToSurface();
  return closed;
}

}  // namespace capfit::mesh
