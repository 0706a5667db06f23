#include "core/mesh/prepare_mesh.h"

#include <Eigen/Geometry>  // cross
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/chunk_sums.h"
#include "core/base/status.h"
#include "core/formats/recover_decimals.h"
#include "core/formats/soup_checks.h"
#include "core/mesh/close_holes.h"
#include "core/mesh/curve_order.h"
#include "core/mesh/edge_mates.h"
#include "core/mesh/join_triangles.h"
#include "core/mesh/main_part.h"
#include "core/mesh/mend_flat_triangles.h"
#include "core/mesh/one_surface.h"
#include "core/mesh/principal_frame.h"
#include "core/mesh/split_vertices.h"
#include "core/mesh/surface.h"
#include "core/mesh/surface_measures.h"
#include "core/mesh/surface_parts.h"
#include "core/mesh/surface_sums.h"
#include "core/mesh/triangulate_faces.h"
#include "core/mesh/used_vertices.h"

namespace capfit::mesh {
namespace {

// Holes whose filling exceeds this share of the surface leave too little of the body.
constexpr double kLargestHoleShare = 1.0 / 3.0;
// Volume below this share of the diagonal's cube is rounding, not a body (a cylinder 1000 times
// as long as thick has 1e-6).
constexpr double kLeastVolumeShare = 1e-9;

// Triangles lower than this share of the diagonal have no area: 2 nm on a body, which neither text
// nor float coordinates can mean.
constexpr double kFlatShare = 1e-9;

std::string PointText(const Eigen::Vector3d& p) {
  return absl::StrFormat("(%.4g, %.4g, %.4g)", p.x(), p.y(), p.z());
}

// Takes one mesh through the steps, in the order of the functions below.
class MeshMender {
 public:
  // `positions` stand for the soup's own.
  MeshMender(const formats::PolygonSoup& soup, std::span<const char> is_left_out,
             const std::vector<Eigen::Vector3d>& positions, const ThreadPool& pool,
             const FitObserver& observer)
      : soup_(soup),
        is_left_out_(is_left_out),
        positions_(positions),
        pool_(pool),
        observer_(observer) {}

  absl::StatusOr<PreparedMesh> Run() {
    CAPFIT_RETURN_IF_ERROR(CheckCancelled());
    const bool has_triangles_only = is_left_out_.empty() && soup_.HasTrianglesOnly();
    if (!has_triangles_only) Triangulate();
    const std::span<const Triangle> triangles = has_triangles_only
                                                    ? FacesAsTriangles(soup_)
                                                    : std::span<const Triangle>(surface_.triangles);
    if (auto prepared = TakeAsItCame(triangles)) return *std::move(prepared);
    CAPFIT_RETURN_IF_ERROR(CheckCancelled());
    if (has_triangles_only) Triangulate();
    EdgeMates mates = FindEdgeMates(surface_.triangles, positions_.size(), pool_, observer_);
    CAPFIT_RETURN_IF_ERROR(CheckCancelled());
    MeasureUsed();
    Join(std::move(mates));
    CAPFIT_RETURN_IF_ERROR(CheckCancelled());
    if (surface_.triangles.empty()) {
      return Refused(ErrorReason::kNoSurface, absl::StrCat("all ", degenerate_,
                                                           " faces are degenerate: none has three "
                                                           "different vertices"));
    }
    CAPFIT_RETURN_IF_ERROR(KeepMainPart());
    CAPFIT_RETURN_IF_ERROR(CheckCancelled());
    CAPFIT_RETURN_IF_ERROR(CloseAllHoles());
    CAPFIT_RETURN_IF_ERROR(CheckCancelled());
    CAPFIT_RETURN_IF_ERROR(TurnOutward());
    SplitTouchingVertices();
    MendFlat();
    CAPFIT_RETURN_IF_ERROR(CheckCancelled());
    CAPFIT_RETURN_IF_ERROR(CheckManifold());
    BodyMesh mesh =
        MeshOfUsed(positions_, {stand_in_, copied_, merged_}, std::move(surface_), pool_);
    return Finish(std::move(mesh));
  }

 private:
  [[nodiscard]] absl::Status CheckCancelled() const { return capfit::CheckCancelled(observer_); }

  void Triangulate() {
    TriangulatedFaces faces =
        is_left_out_.empty()
            ? TriangulateFaces(soup_, positions_)
            : TriangulateFaces(formats::WithFaces(soup_, is_left_out_, 0), positions_);
    surface_.triangles = std::move(faces.triangles);
    degenerate_ = faces.degenerate;
  }

  // What all of the steps below would leave as it is; else nothing, and they may begin.
  // Degenerate triangles are flat.
  std::optional<PreparedMesh> TakeAsItCame(std::span<const Triangle> triangles) {
    if (degenerate_ > 0 || !MayBeClosed(triangles.size())) return std::nullopt;
    const SurfaceMeasures measures = Measure(positions_, triangles, pool_);
    diagonal_ = measures.diagonal();
    if (!(measures.volume > LeastVolume())) return std::nullopt;
    // A flat one, no longer than the diagonal, has half of this area at most.
    const double flat_area = kFlatShare * diagonal_ * diagonal_;
    if (measures.least_triangle_area <= flat_area && HasFlat(triangles)) return std::nullopt;
    const PrincipalFrame frame = FindPrincipalFrame(positions_, measures, pool_);
    const std::vector<Eigen::Vector3d> snapped = SnappedPoints(positions_, frame, pool_);
    CurveOrder order = OrderAlongCurve(snapped, triangles, pool_, observer_);
    if (observer_.IsCancelled()) return std::nullopt;
    EdgeMates mates =
        FindEdgeMates(order.triangles, positions_.size(), pool_, observer_, order.first_triangle);
    if (mates.mate.empty() || !mates.IsClosedAndOriented()) return std::nullopt;
    // Both stay where they are when the mesh takes them over, and neither task changes them.
    const std::span<const Triangle> in_order = order.triangles;
    const std::span<const HalfEdge> its_mates = mates.mate;
    bool is_one_surface = false;
    std::optional<BodyMesh> mesh;
    pool_.ForEach(2, [&](std::size_t half) {
      if (half == 0) is_one_surface = IsOneSurface(in_order, its_mates, positions_.size(), pool_);
      if (half == 1) {
        std::vector<std::int32_t> places(order.rank.begin(), order.rank.end());
        mesh.emplace(positions_, snapped, std::move(order), std::move(mates.mate),
                     std::move(places), measures, frame, pool_);
      }
    });
    if (!is_one_surface) return std::nullopt;
    return Finish(*std::move(mesh));
  }

  // By Euler's formula: a closed surface without handles has two vertices more than half as many as
  // triangles, one with handles fewer. An open one, or with seams, has more.
  [[nodiscard]] bool MayBeClosed(std::size_t triangles) const {
    return triangles > 0 && triangles % 2 == 0 && 2 * positions_.size() <= triangles + 4;
  }

  [[nodiscard]] bool HasFlat(std::span<const Triangle> triangles) const {
    const auto flat_in = [&](std::size_t begin, std::size_t end) {
      return std::count_if(
          triangles.begin() + begin, triangles.begin() + end,
          [this](const Triangle& t) { return IsFlat(positions_, t, kFlatShare * diagonal_); });
    };
    return SumOverChunks(pool_, triangles.size(), std::ptrdiff_t{0}, flat_in) > 0;
  }

  // Only vertices that faces use count for the size of the mesh.
  void MeasureUsed() {
    std::vector<char> used(positions_.size(), 0);
    for (const Triangle& t : surface_.triangles) used[t[0]] = used[t[1]] = used[t[2]] = 1;
    Eigen::AlignedBox3d box;
    for (std::size_t v = 0; v < used.size(); ++v) {
      if (used[v] != 0) box.extend(positions_[v]);
    }
    if (!is_left_out_.empty()) {  // what only the faces left out use is not unused
      for (const std::uint32_t v : formats::WithFaces(soup_, is_left_out_, 1).face_vertices) {
        used[v] = 1;
      }
    }
    unused_ = std::count(used.begin(), used.end(), 0);
    diagonal_ = surface_.triangles.empty() ? 0.0 : box.diagonal().norm();
    if (unused_ > 0) {
      Warn("UNUSED_VERTICES", unused_, absl::StrCat(unused_, " vertices belong to no face"));
    }
  }

  void Join(EdgeMates mates) {
    JoinedTriangles joined = JoinTriangles(positions_, std::move(surface_.triangles),
                                           std::move(mates), kWeldShare * diagonal_, observer_);
    surface_ = std::move(joined.surface);
    stand_in_ = std::move(joined.stand_in);
    duplicates_ = joined.duplicates;
    degenerate_ += joined.degenerate;
    welded_ = joined.welded;
    if (joined.fins > 0) {
      Warn("FINS_DROPPED", static_cast<std::int64_t>(joined.fins),
           absl::StrCat(joined.fins, " loose faces at edges that already have two were dropped"));
    }
    if (joined.crowded > 0) {
      Warn("NONMANIFOLD_EDGES", static_cast<std::int64_t>(joined.crowded),
           absl::StrCat(joined.crowded,
                        " edges belong to more than two faces; the flattest pairs were joined"));
    }
  }

  absl::Status KeepMainPart() {
    CAPFIT_ASSIGN_OR_RETURN(const MainPart main,
                            mesh::KeepMainPart(positions_, LeastVolume(), surface_));
    turned_ = main.turned;
    left_out_share_ = main.left_out_share;
    if (main.parts_left_out > 0) {
      Warn("PARTS_LEFT_OUT", static_cast<std::int64_t>(main.parts_left_out),
           absl::StrCat(main.parts_left_out, " separate parts (", main.faces_left_out,
                        " faces) were left out; the part with the largest volume was kept"));
    }
    return absl::OkStatus();
  }

  [[nodiscard]] double LeastVolume() const {
    return kLeastVolumeShare * diagonal_ * diagonal_ * diagonal_;
  }

  absl::Status CloseAllHoles() {
    if (std::find(surface_.mate.begin(), surface_.mate.end(), kNoMate) == surface_.mate.end()) {
      return absl::OkStatus();
    }
    own_triangles_ = surface_.triangles.size();
    const double own_area = AreaOf(positions_, surface_.triangles);
    CAPFIT_ASSIGN_OR_RETURN(const ClosedHoles closed, CloseHoles(positions_, surface_));
    if (closed.holes == 0) return absl::OkStatus();
    const std::string what =
        absl::StrFormat("%d holes (the largest is %.3g round, near %s)", closed.holes,
                        closed.longest_perimeter, PointText(closed.largest_middle));
    if (closed.area > kLargestHoleShare * own_area) {
      return Refused(ErrorReason::kOpenSurface,
                     absl::StrFormat("the surface is not closed: filling its %s would take "
                                     "%.0f %% of its area; close it in a modelling program",
                                     what, 100.0 * closed.area / own_area));
    }
    Warn("HOLES_CLOSED", static_cast<std::int64_t>(closed.holes), what + " were closed");
    return absl::OkStatus();
  }

  [[nodiscard]] double Volume() const {
    const Eigen::Vector3d& origin = positions_[surface_.triangles.front()[0]];
    double volume = 0.0;
    for (const Triangle& t : surface_.triangles) {
      volume += SignedVolume(positions_[t[0]] - origin, positions_[t[1]] - origin,
                             positions_[t[2]] - origin);
    }
    return volume;
  }

  absl::Status TurnOutward() {
    const double volume = Volume();
    CAPFIT_RETURN_IF_ERROR(CheckEnclosedVolume(volume, LeastVolume(), 1));
    const std::size_t own = own_triangles_ > 0 ? own_triangles_ : surface_.triangles.size();
    if (volume < 0.0) {
      TurnInsideOut(surface_);
      turned_ = own - turned_;
    }
    if (turned_ == own) {
      Warn("INSIDE_OUT", static_cast<std::int64_t>(turned_), "all faces were turned outward");
    } else if (turned_ > 0) {
      Warn("FACES_TURNED", static_cast<std::int64_t>(turned_),
           absl::StrCat(turned_, " of ", own, " faces were turned to face outward"));
    }
    return absl::OkStatus();
  }

  void SplitTouchingVertices() {
    copied_ = SplitVertices(positions_.size(), surface_);
    if (copied_.empty()) return;
    Warn("NONMANIFOLD_VERTICES", static_cast<std::int64_t>(copied_.size()),
         absl::StrCat("the surface touches itself in ", copied_.size(),
                      " vertices; each was split in two"));
  }

  void MendFlat() {
    std::vector<Eigen::Vector3d> with_copies;
    std::span<const Eigen::Vector3d> positions = positions_;
    if (!copied_.empty()) {
      with_copies = positions_;
      for (const std::uint32_t v : copied_) with_copies.push_back(positions_[v]);
      positions = with_copies;
    }
    // By the size of what was kept: a mended mesh that comes again is held against the same.
    Eigen::AlignedBox3d kept;
    for (const Triangle& t : surface_.triangles) {
      for (const std::uint32_t v : t) kept.extend(positions[v]);
    }
    MendedTriangles mended =
        MendFlatTriangles(positions, kFlatShare * kept.diagonal().norm(), surface_);
    const std::size_t count = mended.flipped + mended.merged.size();
    if (count == 0) return;
    Warn("FLAT_FACES", static_cast<std::int64_t>(count),
         absl::StrCat(count, " faces without area were mended: ", mended.flipped,
                      " edges were turned, ", mended.merged.size(),
                      " vertices merged with their neighbours"));
    merged_ = std::move(mended.merged);
  }

  absl::Status CheckManifold() const {
    // A mesh that took no repair was checked as it came.
    if (warnings_.empty() && degenerate_ + duplicates_ + welded_ == 0) return absl::OkStatus();
    const EdgeMates mates = FindEdgeMates(surface_.triangles, positions_.size() + copied_.size());
    if (mates.IsClosedAndOriented()) return absl::OkStatus();
    return Refused(ErrorReason::kNotManifold,
                   absl::StrCat("the surface cannot be taken apart at ",
                                mates.crowded_sizes.size() + mates.misdirected,
                                " edges where it touches itself; mend it in a modelling "
                                "program"));
  }

  PreparedMesh Finish(BodyMesh mesh) {
    WarnOfDropped();
    return {std::move(mesh), std::move(warnings_), left_out_share_};
  }

  void WarnOfDropped() {
    if (welded_ > 0) {
      Warn("VERTICES_WELDED", static_cast<std::int64_t>(welded_),
           absl::StrCat(welded_, " vertices were copies of others and were merged with them"));
    }
    if (duplicates_ > 0) {
      Warn("DUPLICATE_FACES", static_cast<std::int64_t>(duplicates_),
           absl::StrCat(duplicates_, " faces were copies of others and were dropped"));
    }
    if (degenerate_ > 0) {
      Warn("DEGENERATE_FACES", static_cast<std::int64_t>(degenerate_),
           absl::StrCat(degenerate_, " faces without three different vertices were dropped"));
    }
  }

  void Warn(std::string code, std::int64_t count, std::string message) {
    warnings_.push_back({std::move(code), std::move(message), count});
  }

  const formats::PolygonSoup& soup_;
  std::span<const char> is_left_out_;
  const std::vector<Eigen::Vector3d>& positions_;
  const ThreadPool& pool_;
  const FitObserver& observer_;
  double diagonal_ = 0.0;
  Surface surface_;
  std::vector<std::uint32_t> stand_in_;  // of each vertex after welding; empty: itself
  std::vector<std::uint32_t> copied_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> merged_;
  std::vector<Warning> warnings_;
  std::int64_t unused_ = 0;
  std::size_t degenerate_ = 0;
  std::size_t duplicates_ = 0;
  std::size_t welded_ = 0;
  std::size_t turned_ = 0;
  double left_out_share_ = 0.0;
  std::size_t own_triangles_ = 0;  // before holes were closed; 0: there were none
};

}  // namespace

absl::StatusOr<PreparedMesh> PrepareMesh(const formats::PolygonSoup& soup,
                                         const formats::MeshLimits& limits, const ThreadPool& pool,
                                         const FitObserver& observer,
                                         std::span<const char> is_left_out) {
  CAPFIT_RETURN_IF_ERROR(formats::CheckSoup(soup, limits, pool));
  const std::vector<Eigen::Vector3d> decimals =
      formats::RecoverDecimalsOfFloats(soup.positions, pool);
  const std::vector<Eigen::Vector3d>& positions = decimals.empty() ? soup.positions : decimals;
  return MeshMender(soup, is_left_out, positions, pool, observer).Run();
}

}  // namespace capfit::mesh
