#include "core/solid/scan_parts.h"

#include <Eigen/Geometry>  // cross
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/base/disjoint_sets.h"
#include "core/mesh/surface_sums.h"
#include "core/mesh/weld_vertices.h"
#include "core/solid/floor_plane.h"

namespace capfit::solid {
namespace {

// What is smaller in both is a fragment, as shares of the largest piece.
constexpr double kFragmentArea = 0.01;
constexpr double kFragmentDiagonal = 0.1;
// A piece with this share of its area at or under the floor is all floor.
constexpr double kMostlyFloor = 0.8;
// A piece of which this share of the floor's bare area is its own hangs together with the floor.
constexpr double kOwnBare = 0.1;

struct Piece {
  double area = 0.0;
  double low_area = 0.0;   // of triangles at or under the floor
  double bare_area = 0.0;  // of triangles where the floor is bare
  Eigen::Vector3d min = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d max = Eigen::Vector3d::Constant(-1e300);

  [[nodiscard]] double diagonal() const { return (max - min).norm(); }
};

// Of each triangle, counted from 0 in order of their first: triangles that share vertices, or
// vertices in one place, are a piece.
std::vector<std::uint32_t> PiecesOf(std::span<const Eigen::Vector3d> positions,
                                    std::span<const mesh::Triangle> triangles) {
  std::vector<std::uint32_t> all(positions.size());
  std::iota(all.begin(), all.end(), 0u);
  DisjointSets sets(mesh::WeldEqual(positions, all));
  for (const mesh::Triangle& t : triangles) {
    sets.Join(t[0], t[1]);
    sets.Join(t[0], t[2]);
  }
  std::vector<std::uint32_t> number(positions.size(), 0xFFFFFFFFu);
  std::vector<std::uint32_t> piece;
  std::uint32_t pieces = 0;
  for (const mesh::Triangle& t : triangles) {
    std::uint32_t& n = number[sets.Find(t[0])];
    if (n == 0xFFFFFFFFu) n = pieces++;
    piece.push_back(n);
  }
  return piece;
}

class ScanSorter {
 public:
  ScanSorter(std::span<const Eigen::Vector3d> positions, std::span<const mesh::Triangle> triangles)
      : positions_(positions), triangles_(triangles) {
    parts_.of_triangle.assign(triangles.size(), ScanPart::kBody);
  }

  ScanParts Run() {
    piece_of_ = PiecesOf(positions_, triangles_);
    const std::optional<FloorPlane> floor = FindFloorPlane(positions_, triangles_);
    MeasurePieces(floor);
    if (floor.has_value()) {
      parts_.floor = floor->floor;
      CutFloor(*floor);
    }
    DropFragments();
    return std::move(parts_);
  }

 private:
  void MeasurePieces(const std::optional<FloorPlane>& floor) {
    pieces_.resize(*std::max_element(piece_of_.begin(), piece_of_.end()) + 1);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      Piece& piece = pieces_[piece_of_[t]];
      const double area = mesh::AreaVector(positions_, triangles_[t]).norm();
      piece.area += area;
      for (const std::uint32_t v : triangles_[t]) {
        piece.min = piece.min.cwiseMin(positions_[v]);
        piece.max = piece.max.cwiseMax(positions_[v]);
      }
      if (!floor.has_value() || !IsLow(*floor, t)) continue;
      piece.low_area += area;
      if (floor->IsBareAt(mesh::Middle(positions_, triangles_[t]))) piece.bare_area += area;
    }
  }

  [[nodiscard]] bool IsLow(const FloorPlane& floor, std::size_t t) const {
    return std::all_of(triangles_[t].begin(), triangles_[t].end(), [&](std::uint32_t v) {
      return floor.HeightOf(positions_[v]) < floor.floor.margin;
    });
  }

  void CutFloor(const FloorPlane& floor) {
    double bare = 0.0;
    for (const Piece& piece : pieces_) bare += piece.bare_area;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const Piece& piece = pieces_[piece_of_[t]];
      const bool is_whole = piece.low_area > kMostlyFloor * piece.area;
      const bool is_joined = piece.bare_area > kOwnBare * bare;
      if (is_whole || (is_joined && IsLow(floor, t))) parts_.of_triangle[t] = ScanPart::kFloor;
    }
  }

  // Judged by what the floor left of them.
  void DropFragments() {
    const auto rest = [](const Piece& piece) { return piece.area - piece.low_area; };
    const Piece main =
        *std::max_element(pieces_.begin(), pieces_.end(),
                          [&](const Piece& a, const Piece& b) { return rest(a) < rest(b); });
    std::vector<char> is_fragment(pieces_.size(), 0);
    std::vector<char> is_counted(pieces_.size(), 0);
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      is_fragment[p] = pieces_[p].area < kFragmentArea * rest(main) &&
                       pieces_[p].diagonal() < kFragmentDiagonal * main.diagonal();
    }
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const std::uint32_t p = piece_of_[t];
      if (is_fragment[p] == 0 || parts_.of_triangle[t] == ScanPart::kFloor) continue;
      parts_.of_triangle[t] = ScanPart::kFragment;
      parts_.fragments += is_counted[p] == 0 ? 1 : 0;
      is_counted[p] = 1;
    }
  }

  std::span<const Eigen::Vector3d> positions_;
  std::span<const mesh::Triangle> triangles_;
  std::vector<std::uint32_t> piece_of_;  // each triangle's
  std::vector<Piece> pieces_;
  ScanParts parts_;
};

}  // namespace

ScanParts FindScanParts(std::span<const Eigen::Vector3d> positions,
                        std::span<const mesh::Triangle> triangles, const FitObserver& observer) {
  if (triangles.empty() || observer.IsCancelled()) {
    return {std::vector<ScanPart>(triangles.size(), ScanPart::kBody), std::nullopt, 0};
  }
  return ScanSorter(positions, triangles).Run();
}

}  // namespace capfit::solid
