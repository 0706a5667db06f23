#include "core/solid/make_solid.h"

#include <Eigen/Geometry>  // cross
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/chunk_sums.h"
#include "core/base/status.h"
#include "core/formats/polygon_soup.h"
#include "core/mesh/mend_flat_triangles.h"
#include "core/mesh/one_surface.h"
#include "core/mesh/prepare_mesh.h"
#include "core/mesh/surface_sums.h"
#include "core/solid/bridges.h"
#include "core/solid/grid_lines.h"
#include "core/solid/node_grid.h"
#include "core/solid/occupancy.h"
#include "core/solid/regions.h"
#include "core/solid/shells.h"
#include "core/solid/surface_net.h"
#include "core/solid/well_composed.h"

namespace capfit::solid {
namespace {

// These two as in mesh::PrepareMesh.
constexpr double kWeldShare = 1e-5;
constexpr double kFlatShare = 1e-9;
// Nodes of the largest grid: a set of them has 4 MB, and about twenty of that size are made.
constexpr double kMostNodes = 32e6;
// Rows of the grid that all triangles together may span (a body's span some hundred thousand): more
// comes of hundreds of thousands of long slivers, and would take seconds.
constexpr double kMostRows = 20e6;
// Clear nodes around the shells, so that what is added beside them never touches the end.
constexpr double kBorder = 3.0;
// Where the first node stands, as a share of a step: off the planes that modelled vertices lie on.
constexpr double kOffset = 0.381966;
// Gaps between pieces that are bridged, as a share of the diagonal: 4 cm on an adult.
constexpr double kReach = 0.02;
// A second piece of this share of the first one's volume may be the body itself.
constexpr double kRivalShare = 0.5;
// Twice the volume over the area is the mean thickness: that of a body is 15 cells and more, that
// of a sheet which encloses nothing about one.
constexpr double kLeastThickness = 2.5;

struct Box {
  Eigen::Vector3d min = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d max = Eigen::Vector3d::Constant(-1e300);

  [[nodiscard]] Eigen::Vector3d sides() const { return max - min; }
};

Box BoxOf(std::span<const Eigen::Vector3d> positions, std::span<const mesh::Triangle> triangles) {
  Box box;
  for (const mesh::Triangle& t : triangles) {
    for (const std::uint32_t v : t) {
      box.min = box.min.cwiseMin(positions[v]);
      box.max = box.max.cwiseMax(positions[v]);
    }
  }
  return box;
}

Eigen::Vector3d NodesAlong(const Box& box, double step) {
  return box.sides() / step + Eigen::Vector3d::Constant(2.0 * kBorder + 2.0);
}

NodeGrid GridFor(const Box& box, double step) {
  NodeGrid grid;
  int longest = 0;
  box.sides().maxCoeff(&longest);
  grid.axes = {longest, (longest + 1) % 3, (longest + 2) % 3};
  grid.step = step;
  const Eigen::Vector3d nodes = grid.FromCaller(NodesAlong(box, step));
  for (int k = 0; k < 3; ++k) grid.size[k] = static_cast<std::uint32_t>(std::ceil(nodes[k]));
  grid.size[0] = (grid.size[0] + 63) / 64 * 64;
  grid.low = grid.FromCaller(box.min) - Eigen::Vector3d::Constant((kBorder + kOffset) * step);
  return grid;
}

class SolidMaker {
 public:
  SolidMaker(std::span<const Eigen::Vector3d> positions, const SolidOptions& options,
             const ThreadPool& pool, const FitObserver& observer)
      : positions_(positions), options_(options), pool_(pool), observer_(observer) {}

  absl::StatusOr<Solid> Run(std::vector<mesh::Triangle> triangles) {
    const Box box = BoxOf(positions_, triangles);
    diagonal_ = box.sides().norm();
    shells_ =
        FindShells(positions_, std::move(triangles), kWeldShare * diagonal_, pool_, observer_);
    CAPFIT_RETURN_IF_ERROR(CheckCancelled());
    if (!(shells_.area > 0.0)) return NoVolume("all triangles are without area");
    grid_ = GridFor(box, StepFor(box));
    CastLines();
    CAPFIT_RETURN_IF_ERROR(CheckCancelled());
    NodeSet inside = FindOccupied(grid_, shells_, lines_, normals_, pool_);
    CAPFIT_RETURN_IF_ERROR(JoinAndFill(inside));
    CAPFIT_RETURN_IF_ERROR(CheckCancelled());
    CAPFIT_ASSIGN_OR_RETURN(mesh::BodyMesh mesh,
                            CheckedMesh(ExtractSurface(grid_, inside, lines_, normals_, pool_)));
    if (2.0 * mesh.volume() < kLeastThickness * grid_.step * mesh.area()) {
      return NoVolume(absl::StrFormat("what it encloses is %.2g thick in the mean, cells are %.2g",
                                      2.0 * mesh.volume() / mesh.area(), grid_.step));
    }
    return Solid{std::move(mesh), grid_.step, std::move(warnings_)};
  }

 private:
  [[nodiscard]] absl::Status CheckCancelled() const { return capfit::CheckCancelled(observer_); }

  [[nodiscard]] static absl::Status NoVolume(const std::string& why) {
    return Refused(ErrorReason::kNoVolume,
                   absl::StrCat("the parts together enclose no volume: ", why));
  }

  [[nodiscard]] double StepFor(const Box& box) const {
    double spans = 0.0;
    for (const mesh::Triangle& t : shells_.triangles) {
      const Eigen::Vector3d& a = positions_[t[0]];
      const Eigen::Vector3d& b = positions_[t[1]];
      const Eigen::Vector3d& c = positions_[t[2]];
      spans += (a.cwiseMax(b).cwiseMax(c) - a.cwiseMin(b).cwiseMin(c)).sum();
    }
    double step = std::max(std::sqrt(shells_.area / static_cast<double>(options_.squares)),
                           spans / kMostRows);
    while (!(NodesAlong(box, step).prod() <= kMostNodes)) step *= 1.1;
    return step;
  }

  void CastLines() {
    std::vector<Eigen::Vector3d> points(positions_.size());
    pool_.ForChunks(points.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) points[i] = grid_.FromCaller(positions_[i]);
    });
    normals_.resize(shells_.triangles.size());
    pool_.ForChunks(normals_.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Eigen::Vector3d area = mesh::AreaVector(points, shells_.triangles[i]);
        normals_[i] = (area / std::max(area.norm(), 1e-300)).cast<float>();
      }
    });
    for (int axis = 0; axis < 3; ++axis) {
      lines_[axis] = CastGridLines(points, shells_, grid_, axis, pool_);
    }
  }

  absl::Status JoinAndFill(NodeSet& inside) {
    MakeWellComposed(grid_, pool_, inside);
    const std::size_t bridged =
        BridgeRegions(grid_, lines_, normals_, kReach * diagonal_, pool_, inside);
    if (bridged > 0) {
      MakeWellComposed(grid_, pool_, inside);
      Warn("GAPS_BRIDGED", bridged,
           "gaps between pieces that nothing else joins were filled; check that the parts belong "
           "together");
    }
    FillCavities(grid_, inside);
    const std::vector<std::size_t> pieces = KeepLargestRegion(grid_, inside);
    if (pieces.empty()) return NoVolume("no cell lies inside");
    return CheckPieces(pieces);
  }

  // `pieces`: nodes of each, the largest first.
  absl::Status CheckPieces(const std::vector<std::size_t>& pieces) {
    std::size_t left_out = 0;
    while (left_out + 1 < pieces.size() && pieces[left_out + 1] >= kCrumbNodes) ++left_out;
    if (left_out == 0) return absl::OkStatus();
    const double share = static_cast<double>(pieces[1]) / static_cast<double>(pieces[0]);
    if (share >= kRivalShare) {
      return Refused(ErrorReason::kTwoBodies,
                     absl::StrFormat("two pieces more than %.3g apart are of similar size (the "
                                     "second has %.0f %% of the first one's volume); send one body",
                                     kReach * diagonal_, 100.0 * share));
    }
    Warn("PARTS_LEFT_OUT", left_out,
         absl::StrFormat("%d pieces more than %.3g from the rest were left out (the largest has "
                         "%.2g %% of the volume)",
                         left_out, kReach * diagonal_, 100.0 * share));
    return absl::OkStatus();
  }

  // The net keeps the promises but for chances that no known mesh has met; the mesh room mends
  // those.
  [[nodiscard]] absl::StatusOr<mesh::BodyMesh> CheckedMesh(NetSurface net) const {
    const double flat = kFlatShare * diagonal_;
    const auto flat_in = [&](std::size_t begin, std::size_t end) {
      return std::count_if(
          net.triangles.begin() + begin, net.triangles.begin() + end,
          [&](const mesh::Triangle& t) { return mesh::IsFlat(net.vertices, t, flat); });
    };
    const bool is_sound =
        !net.mates.empty() &&
        mesh::IsOneSurface(net.triangles, net.mates, net.vertices.size(), pool_) &&
        SumOverChunks(pool_, net.triangles.size(), std::ptrdiff_t{0}, flat_in) == 0;
    if (is_sound) {
      return mesh::BodyMesh(std::move(net.vertices), std::move(net.triangles), {},
                            std::move(net.mates), pool_);
    }
    formats::PolygonSoup soup;
    soup.positions = std::move(net.vertices);
    for (const mesh::Triangle& t : net.triangles) {
      soup.face_vertices.insert(soup.face_vertices.end(), t.begin(), t.end());
    }
    formats::MeshLimits limits;
    limits.max_vertices = soup.positions.size();
    limits.max_faces = net.triangles.size();
    CAPFIT_ASSIGN_OR_RETURN(const mesh::PreparedMesh mended,
                            mesh::PrepareMesh(soup, limits, pool_, observer_));
    return mesh::BodyMesh({mended.mesh.vertices().begin(), mended.mesh.vertices().end()},
                          {mended.mesh.triangles().begin(), mended.mesh.triangles().end()}, {},
                          {mended.mesh.mates().begin(), mended.mesh.mates().end()}, pool_);
  }

  void Warn(std::string code, std::size_t count, std::string message) {
    warnings_.push_back({std::move(code), std::move(message), static_cast<std::int64_t>(count)});
  }

  std::span<const Eigen::Vector3d> positions_;
  const SolidOptions& options_;
  const ThreadPool& pool_;
  const FitObserver& observer_;
  double diagonal_ = 0.0;
  Shells shells_;
  NodeGrid grid_;
  std::array<GridLines, 3> lines_;
  std::vector<Eigen::Vector3f> normals_;  // of the shells' triangles, as u, v, w
  std::vector<Warning> warnings_;
};

}  // namespace

absl::StatusOr<Solid> MakeSolid(std::span<const Eigen::Vector3d> positions,
                                std::span<const mesh::Triangle> triangles,
                                const SolidOptions& options, const ThreadPool& pool,
                                const FitObserver& observer) {
  std::vector<mesh::Triangle> sound;
  sound.reserve(triangles.size());
  for (const mesh::Triangle& t : triangles) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) sound.push_back(t);
  }
  if (sound.empty()) {
    return Refused(ErrorReason::kNoSurface,
                   absl::StrCat("all ", triangles.size(),
                                " triangles are degenerate: none has three different vertices"));
  }
  return SolidMaker(positions, options, pool, observer).Run(std::move(sound));
}

}  // namespace capfit::solid
