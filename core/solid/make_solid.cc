#include "core/solid/make_solid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <chrono>
#include <cstdio>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/chunk_sums.h"
#include "core/base/status.h"
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

// As in mesh::PrepareMesh.
constexpr double kWeldShare = 1e-5;
// Nodes of the largest grid: a set of them has 4 MB.
constexpr double kMostNodes = 32e6;
// Rows of the grid that all triangles together may span (a body's span some hundred thousand).
constexpr double kMostRows = 20e6;
// Clear nodes around the shells, so that what is added beside them never touches the end.
constexpr double kBorder = 3.0;
// Where the first node stands, as a share of a step: off the planes that modelled vertices lie on.
constexpr double kOffset = 0.381966;

// Gaps between pieces that are bridged, as a share of the diagonal: 4 cm on an adult.
constexpr double kReach = 0.02;

struct Box {
  Eigen::Vector3d min = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d max = Eigen::Vector3d::Constant(-1e300);
};

struct Stopwatch {
  std::chrono::steady_clock::time_point t = std::chrono::steady_clock::now();
  bool on = std::getenv("SOLID_TIMES") != nullptr;
  void Lap(const char* name) {
    const auto n = std::chrono::steady_clock::now();
    if (on) std::fprintf(stderr, "  %-12s %6.2f ms\n", name, std::chrono::duration<double, std::milli>(n - t).count());
    t = n;
  }
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

NodeGrid GridFor(const Box& box, double step) {
  NodeGrid grid;
  const Eigen::Vector3d sides = box.max - box.min;
  int longest = 0;
  sides.maxCoeff(&longest);
  grid.axes = {longest, (longest + 1) % 3, (longest + 2) % 3};
  grid.step = step;
  for (int k = 0; k < 3; ++k) {
    grid.low[k] = box.min[grid.axes[k]] - (kBorder + kOffset) * step;
    const double nodes = std::ceil(sides[grid.axes[k]] / step + 2.0 * kBorder + 2.0);
    grid.size[k] = static_cast<std::uint32_t>(nodes);
  }
  grid.size[0] = (grid.size[0] + 63) / 64 * 64;
  return grid;
}

double NodesOf(const Box& box, double step) {
  const Eigen::Vector3d sides = box.max - box.min;
  return (sides / step + Eigen::Vector3d::Constant(2.0 * kBorder + 2.0)).prod();
}

class SolidMaker {
 public:
  SolidMaker(std::span<const Eigen::Vector3d> positions, const SolidOptions& options,
             const ThreadPool& pool, const FitObserver& observer)
      : positions_(positions), options_(options), pool_(pool), observer_(observer) {}

  absl::StatusOr<Solid> Run(std::vector<mesh::Triangle> triangles) {
    Stopwatch watch;
    const Box box = BoxOf(positions_, triangles);
    const double diagonal = (box.max - box.min).norm();
    Shells shells =
        FindShells(positions_, std::move(triangles), kWeldShare * diagonal, pool_, observer_);
    watch.Lap("shells");
    const NodeGrid grid = GridFor(box, StepFor(box, shells));
    std::vector<Eigen::Vector3d> points(positions_.size());
    std::vector<Eigen::Vector3f> normals(shells.triangles.size());
    pool_.ForChunks(points.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) points[i] = grid.FromCaller(positions_[i]);
    });
    pool_.ForChunks(normals.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Eigen::Vector3d area = mesh::AreaVector(points, shells.triangles[i]);
        normals[i] = (area / std::max(area.norm(), 1e-300)).cast<float>();
      }
    });
    watch.Lap("points");
    std::array<GridLines, 3> lines;
    for (int axis = 0; axis < 3; ++axis) {
      lines[axis] = CastGridLines(points, shells, grid, axis, pool_);
      watch.Lap("cast");
    }
    NodeSet inside = FindOccupied(grid, shells, lines, normals, pool_);
    watch.Lap("occupied");
    std::size_t n = MakeWellComposed(grid, pool_, inside);
    watch.Lap("composed");
    const std::size_t bridged = BridgeRegions(grid, lines, normals, kReach * diagonal, pool_, inside);
    if (bridged > 0) MakeWellComposed(grid, pool_, inside);
    if (watch.on) std::fprintf(stderr, "bridged %zu\n", bridged);
    watch.Lap("bridged");
    std::size_t c = FillCavities(grid, inside);
    watch.Lap("cavities");
    const std::vector<std::size_t> regions = KeepLargestRegion(grid, inside);
    watch.Lap("regions");
    if (watch.on) {
      std::fprintf(stderr, "  step %.5f size %u %u %u added %zu cavities %zu regions %zu:", grid.step, grid.size[0], grid.size[1], grid.size[2], n, c, regions.size());
      for (std::size_t i = 0; i < std::min<std::size_t>(6, regions.size()); ++i) std::fprintf(stderr, " %zu", regions[i]);
      std::fprintf(stderr, " shells %zu rims %zu\n", shells.volumes.size(), shells.rims.size());
      for (auto& r : shells.rims) std::fprintf(stderr, "    rim shell %u n %zu area %.5f at %.3f %.3f %.3f\n", r.shell, r.vertices.size(), r.area_vector.norm(), r.middle.x(), r.middle.y(), r.middle.z());
    }
    if (regions.empty()) {
      return Refused(ErrorReason::kNoVolume, "the surface encloses no volume");
    }
    NetSurface net = ExtractSurface(grid, inside, lines, normals, pool_);
    watch.Lap("extract");
    mesh::BodyMesh mesh(std::move(net.vertices), std::move(net.triangles), {}, std::move(net.mates), pool_);
    watch.Lap("mesh");
    return Solid{std::move(mesh), grid.step, {}};
  }

 private:
  [[nodiscard]] double StepFor(const Box& box, const Shells& shells) const {
    double step = std::sqrt(shells.area / static_cast<double>(options_.cells));
    double spans = 0.0;
    for (const mesh::Triangle& t : shells.triangles) {
      const Eigen::Vector3d low =
          positions_[t[0]].cwiseMin(positions_[t[1]]).cwiseMin(positions_[t[2]]);
      const Eigen::Vector3d high =
          positions_[t[0]].cwiseMax(positions_[t[1]]).cwiseMax(positions_[t[2]]);
      spans += (high - low).sum();
    }
    step = std::max(step, spans / kMostRows);
    while (NodesOf(box, step) > kMostNodes) step *= 1.1;
    return step;
  }

  std::span<const Eigen::Vector3d> positions_;
  const SolidOptions& options_;
  const ThreadPool& pool_;
  const FitObserver& observer_;
};

}  // namespace

absl::StatusOr<Solid> MakeSolid(std::span<const Eigen::Vector3d> positions,
                                std::span<const mesh::Triangle> triangles,
                                const SolidOptions& options, const ThreadPool& pool,
                                const FitObserver& observer) {
  return SolidMaker(positions, options, pool, observer)
      .Run(std::vector<mesh::Triangle>(triangles.begin(), triangles.end()));
}

}  // namespace capfit::solid
