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
#include "core/mesh/edge_mates.h"
#include "core/mesh/join_triangles.h"
#include "core/mesh/mend_flat_triangles.h"
#include "core/mesh/one_surface.h"
#include "core/mesh/overlap.h"
#include "core/mesh/split_vertices.h"
#include "core/mesh/surface.h"
#include "core/mesh/surface_parts.h"
#include "core/mesh/triangulate_faces.h"

namespace capfit::mesh {
namespace {

// Share of the diagonal within which open edges are joined: 0.02 mm on a body, far above the
// rounding of float files, far below the gap between two fingers.
constexpr double kWeldShare = 1e-5;
// A second part of this share of the main part's volume is no accessory: it may be the body.
constexpr double kRivalShare = 0.5;
// A body has an inner wall or two; more large parts in each other are something else.
constexpr std::size_t kMostInnerWalls = 4;
// Holes whose filling exceeds this share of the surface leave too little of the body.
constexpr double kLargestHoleShare = 1.0 / 3.0;
// Volume below this share of the diagonal's cube is rounding, not a body (a cylinder 1000 times
// as long as thick has 1e-6).
constexpr double kLeastVolumeShare = 1e-9;

// Triangles lower than this share of the diagonal have no area: 2 nm on a body, which neither text
// nor float coordinates can mean.
constexpr double kFlatShare = 1e-9;

// Overlap above this share of the volume is more than lips or armpits that touch.
constexpr double kTellingOverlap = 1e-3;

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

struct Box {
  Eigen::Vector3d min = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d max = Eigen::Vector3d::Constant(-1e300);

  void Add(const Eigen::Vector3d& point) {
    min = min.cwiseMin(point);
    max = max.cwiseMax(point);
  }
  [[nodiscard]] double diagonal() const { return (max - min).norm(); }
  [[nodiscard]] bool Holds(const Box& other) const {
    return (other.min.array() >= min.array()).all() && (other.max.array() <= max.array()).all();
  }
};

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
        observer_(observer) {
    Triangulate();
  }

  absl::StatusOr<PreparedMesh> Run() {
    EdgeMates mates = FindEdgeMates(surface_.triangles, positions_.size(), pool_);
    if (degenerate_ == 0 && !mates.mate.empty() && mates.IsClosedAndOriented()) {
      if (std::optional<PreparedMesh> prepared = TakeAsItCame(mates)) return *std::move(prepared);
    }
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
    BodyMesh mesh = MeshOfUsed();
    const Overlap overlap = MeasureOverlap(mesh);
    return Finish(std::move(mesh), overlap);
  }

 private:
  [[nodiscard]] absl::Status CheckCancelled() const {
    if (!observer_.IsCancelled()) return absl::OkStatus();
    return Refused(ErrorReason::kCancelled, "cancelled while the mesh was mended");
  }

  void Triangulate() {
    TriangulatedFaces faces =
        is_left_out_.empty()
            ? TriangulateFaces(soup_, positions_)
            : TriangulateFaces(formats::WithFaces(soup_, is_left_out_, 0), positions_);
    surface_.triangles = std::move(faces.triangles);
    degenerate_ = faces.degenerate;
  }

  // What all of the steps below would leave as it is; else nothing, and they may begin. The
  // triangles are closed and oriented.
  std::optional<PreparedMesh> TakeAsItCame(EdgeMates& mates) {
    std::vector<std::int32_t> themselves(positions_.size());
    std::iota(themselves.begin(), themselves.end(), 0);
    BodyMesh mesh(positions_, std::move(surface_.triangles), std::move(themselves),
                  std::move(mates.mate), pool_);
    diagonal_ = mesh.diagonal();
    bool is_fine = false;
    Overlap overlap;
    pool_.ForEach(2, [&](std::size_t check) {
      if (check == 0) overlap = MeasureOverlap(mesh);
      if (check == 1) {
        is_fine = mesh.volume() > LeastVolume() &&
                  IsOneSurface(mesh.triangles(), mesh.mates(), positions_.size(), pool_) &&
                  !HasFlat(mesh.triangles());
      }
    });
    if (is_fine) return Finish(std::move(mesh), overlap);
    surface_.triangles.assign(mesh.triangles().begin(), mesh.triangles().end());
    mates.mate.assign(mesh.mates().begin(), mesh.mates().end());
    return std::nullopt;
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
    Box box;
    for (std::size_t v = 0; v < used.size(); ++v) {
      if (used[v] != 0) box.Add(positions_[v]);
    }
    if (!is_left_out_.empty()) {  // what only the faces left out use is not unused
      for (const std::uint32_t v : formats::WithFaces(soup_, is_left_out_, 1).face_vertices) {
        used[v] = 1;
      }
    }
    unused_ = std::count(used.begin(), used.end(), 0);
    diagonal_ = surface_.triangles.empty() ? 0.0 : box.diagonal();
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
    const SurfaceParts found = OrientParts(positions_, surface_);
    const auto bigger = [](const SurfacePart& a, const SurfacePart& b) {
      return std::abs(a.volume) < std::abs(b.volume);
    };
    const auto main = std::max_element(found.parts.begin(), found.parts.end(), bigger);
    const auto main_index = static_cast<std::uint32_t>(main - found.parts.begin());
    CAPFIT_RETURN_IF_ERROR(CheckVolume(main->volume, found.parts.size()));
    if (found.parts.size() > 1) CAPFIT_RETURN_IF_ERROR(CheckRivals(found, main_index));
    if (main->conflicts > 0) {
      return Refused(ErrorReason::kNotOrientable,
                     absl::StrCat("the surface has no inside: its faces cannot be turned the "
                                  "same way round at ",
                                  main->conflicts, " edges"));
    }
    turned_ = main->turned;
    if (found.parts.size() == 1) return absl::OkStatus();
    const double all = Area();
    KeepPart(found, main_index, surface_);
    left_out_share_ = 1.0 - Area() / all;
    return absl::OkStatus();
  }

  [[nodiscard]] double LeastVolume() const {
    return kLeastVolumeShare * diagonal_ * diagonal_ * diagonal_;
  }

  absl::Status CheckVolume(double volume, std::size_t parts) const {
    if (std::abs(volume) > LeastVolume()) return absl::OkStatus();
    return Refused(ErrorReason::kNoVolume,
                   absl::StrFormat("the surface encloses no volume; it has %d parts that share "
                                   "no edge: do neighbouring faces have the same vertices, or "
                                   "equal ones to within %g of the diagonal?",
                                   parts, kWeldShare));
  }

  // A part of similar size is another body, unless it lies within the main part's box: then it is
  // its inner wall.
  absl::Status CheckRivals(const SurfaceParts& found, std::uint32_t main) {
    const double main_volume = std::abs(found.parts[main].volume);
    const Box main_box = BoxOf(found, main);
    std::size_t rivals = 0;
    for (std::uint32_t p = 0; p < found.parts.size(); ++p) {
      const double share = std::abs(found.parts[p].volume) / main_volume;
      if (p == main || share < kRivalShare) continue;
      if (++rivals > kMostInnerWalls || !main_box.Holds(BoxOf(found, p))) {
        return Refused(ErrorReason::kTwoBodies,
                       absl::StrFormat("two separate parts are of similar size (the second has "
                                       "%.0f %% of the first one's volume); send one body",
                                       100.0 * share));
      }
    }
    Warn("PARTS_LEFT_OUT", static_cast<std::int64_t>(found.parts.size() - 1),
         absl::StrCat(found.parts.size() - 1, " separate parts (",
                      surface_.triangles.size() - found.parts[main].triangles,
                      " faces) were left out; the part with the largest volume was kept"));
    return absl::OkStatus();
  }

  [[nodiscard]] Box BoxOf(const SurfaceParts& found, std::uint32_t part) const {
    Box box;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      if (found.part_of_triangle[t] != part) continue;
      for (const std::uint32_t v : surface_.triangles[t]) box.Add(positions_[v]);
    }
    return box;
  }

  absl::Status CloseAllHoles() {
    if (std::find(surface_.mate.begin(), surface_.mate.end(), kNoMate) == surface_.mate.end()) {
      return absl::OkStatus();
    }
    own_triangles_ = surface_.triangles.size();
    const double own_area = Area();
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

  [[nodiscard]] double Area() const {
    double area = 0.0;
    for (const Triangle& t : surface_.triangles) {
      const Eigen::Vector3d b = positions_[t[1]] - positions_[t[0]];
      area += 0.5 * b.cross(positions_[t[2]] - positions_[t[0]]).norm();
    }
    return area;
  }

  [[nodiscard]] double Volume() const {
    const Eigen::Vector3d& origin = positions_[surface_.triangles.front()[0]];
    double volume = 0.0;
    for (const Triangle& t : surface_.triangles) {
      const Eigen::Vector3d a = positions_[t[0]] - origin;
      const Eigen::Vector3d b = positions_[t[1]] - origin;
      volume += a.dot(b.cross(positions_[t[2]] - origin)) / 6.0;
    }
    return volume;
  }

  absl::Status TurnOutward() {
    const double volume = Volume();
    CAPFIT_RETURN_IF_ERROR(CheckVolume(volume, 1));
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
    Box kept;
    for (const Triangle& t : surface_.triangles) {
      for (const std::uint32_t v : t) kept.Add(positions[v]);
    }
    MendedTriangles mended = MendFlatTriangles(positions, kFlatShare * kept.diagonal(), surface_);
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

  PreparedMesh Finish(BodyMesh mesh, const Overlap& overlap) {
    WarnOfDropped();
    WarnOfOverlap(overlap, mesh.volume());
    return {std::move(mesh), std::move(warnings_), left_out_share_};
  }

  BodyMesh MeshOfUsed() {
    std::vector<std::uint32_t> new_index(positions_.size() + copied_.size(), kNone);
    for (const Triangle& t : surface_.triangles) {
      new_index[t[0]] = new_index[t[1]] = new_index[t[2]] = 0;
    }
    std::vector<Eigen::Vector3d> vertices;
    vertices.reserve(new_index.size());
    for (std::size_t v = 0; v < new_index.size(); ++v) {
      if (new_index[v] == kNone) continue;
      new_index[v] = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(positions_[v < positions_.size() ? v : copied_[v - positions_.size()]]);
    }
    if (vertices.size() < new_index.size()) {
      for (Triangle& t : surface_.triangles) {
        for (std::uint32_t& v : t) v = new_index[v];
      }
    }
    // A vertex may give way to one that gives way later, so the last come first.
    for (auto merge = merged_.rbegin(); merge != merged_.rend(); ++merge) {
      new_index[merge->first] = new_index[merge->second];
    }
    std::vector<std::int32_t> vertex_of_source(positions_.size());
    for (std::size_t v = 0; v < positions_.size(); ++v) {
      const std::uint32_t index = new_index[stand_in_.empty() ? v : stand_in_[v]];
      vertex_of_source[v] = index == kNone ? -1 : static_cast<std::int32_t>(index);
    }
    return BodyMesh(std::move(vertices), std::move(surface_.triangles), std::move(vertex_of_source),
                    std::move(surface_.mate), pool_);
  }

  void WarnOfOverlap(const Overlap& overlap, double volume) {
    if (overlap.volume <= kTellingOverlap * volume) return;
    Warn("SURFACE_OVERLAPS", 0,
         absl::StrFormat("the surface cuts through itself: %.2g %% of its volume, around %s, is "
                         "enclosed more than once",
                         100.0 * overlap.volume / volume, PointText(overlap.middle)));
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
  CAPFIT_RETURN_IF_ERROR(formats::CheckSoup(soup, limits));
  const std::vector<Eigen::Vector3d> decimals = formats::RecoverDecimalsOfFloats(soup.positions);
  const std::vector<Eigen::Vector3d>& positions = decimals.empty() ? soup.positions : decimals;
  return MeshMender(soup, is_left_out, positions, pool, observer).Run();
}

}  // namespace capfit::mesh
