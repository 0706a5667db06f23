#include "core/circle/approximate_polygon.h"

#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include "core/circle/cluster.h"
#include "core/circle/cover_outline.h"
#include "core/circle/sample_points.h"
#include "core/circle/union_area.h"
#include "core/circle/variational_search.h"

namespace capfit::circle {
namespace {

// Circles reach the outline to within a nanometre: rounding, far below any mesh's own precision.
constexpr double kCoverageToleranceM = 1e-9;

// How much more the circles of a split outline may waste than circles that ignore the split. Their
// own circles keep buttocks and breasts in shape; beyond this the shape is not worth the volume
// (three circles leave a single one for all the front of a hip).
constexpr double kSplitAllowance = 1.25;

// Settings of drafts.
constexpr int kDraftPoints = 50;
constexpr int kDraftIterations = 2;

// One piece of a split outline (or the whole of it) while circles are handed out.
class Piece {
 public:
  Piece(Region region, const section::Polygon& outline, const CircleOptions& options,
        const FitObserver& observer)
      : region_(std::move(region)), outline_(outline), options_(options), observer_(observer) {}

  [[nodiscard]] Region::Kind kind() const { return region_.kind; }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] const std::vector<Cluster>& clusters() const { return clusters_; }

  void Take(int more) {
    count_ += more;
    clusters_ = Clusters(count_);
  }
  // Outside area that `more` circles would save.
  [[nodiscard]] double Gain(int more) {
    return OutsideAreaSum(clusters_) - OutsideAreaSum(Clusters(count_ + more));
  }

 private:
  const std::vector<Cluster>& Clusters(int count) {
    const auto [it, is_new] = known_.try_emplace(count);
    if (is_new) it->second = SearchClusters(region_, outline_, count, options_, observer_);
    return it->second;
  }

  Region region_;
  const section::Polygon& outline_;
  const CircleOptions& options_;
  const FitObserver& observer_;
  int count_ = 0;
  std::vector<Cluster> clusters_;
  std::map<int, std::vector<Cluster>> known_;  // by count
};

// The piece whose nearest outline vertex is nearest to each interior point.
std::vector<int> PiecesOfInterior(const section::FeaturePolygon& polygon,
                                  std::span<const Eigen::Vector2d> interior) {
  const std::span<const Eigen::Vector2d> vertices = polygon.outline.vertices();
  std::vector<int> owners(interior.size(), 0);
  for (std::size_t p = 0; p < interior.size(); ++p) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t piece = 0; piece < polygon.split->pieces.size(); ++piece) {
      for (const int v : polygon.split->pieces[piece]) {
        const double d = (vertices[v] - interior[p]).squaredNorm();
        if (d >= least) continue;
        least = d;
        owners[p] = static_cast<int>(piece);
      }
    }
  }
  return owners;
}

// On a mirrored outline a piece is one side's (its image is another piece) or its own image.
enum class Side { kLeft, kRight, kBoth };
Side SideOf(std::span<const Eigen::Vector2d> points) {
  bool left = false;
  bool right = false;
  for (const Eigen::Vector2d& p : points) {
    left = left || p.x() > 1e-9;
    right = right || p.x() < -1e-9;
  }
  if (left && right) return Side::kBoth;
  return left ? Side::kLeft : Side::kRight;
}

std::vector<Piece> SplitPieces(const section::FeaturePolygon& polygon, const CircleOptions& options,
                               const FitObserver& observer) {
  const std::span<const Eigen::Vector2d> vertices = polygon.outline.vertices();
  const std::vector<Eigen::Vector2d> interior =
      InteriorPoints(polygon.outline, options.interior_points);
  const std::vector<int> owners = PiecesOfInterior(polygon, interior);
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < polygon.split->pieces.size(); ++i) {
    std::vector<Eigen::Vector2d> boundary;
    for (const int v : polygon.split->pieces[i]) {
      boundary.push_back(vertices[v]);
    }
    std::vector<Eigen::Vector2d> inner;
    for (std::size_t p = 0; p < interior.size(); ++p) {
      if (owners[p] == static_cast<int>(i)) inner.push_back(interior[p]);
    }
    Region::Kind kind = Region::Kind::kWhole;
    if (options.symmetric) {
      const Side side = SideOf(boundary);
      if (side == Side::kRight) continue;  // the image of another piece
      kind = side == Side::kLeft ? Region::Kind::kHalf : Region::Kind::kFolded;
    }
    pieces.emplace_back(MakeRegion(kind, boundary, inner), polygon.outline, options, observer);
  }
  return pieces;
}

// One circle for each piece (two for a mirrored one), then the rest where it saves most.
std::vector<Cluster> FitPieces(std::vector<Piece> pieces, int circle_count) {
  int left = circle_count;
  const auto step = [](const Piece& piece) { return piece.kind() == Region::Kind::kHalf ? 2 : 1; };
  for (Piece& piece : pieces) {
    piece.Take(step(piece));
    left -= step(piece);
  }
  const bool has_pairs =
      std::any_of(pieces.begin(), pieces.end(), [&](const Piece& p) { return step(p) == 2; });
  while (left > 0) {
    const int more = has_pairs && left >= 2 ? 2 : 1;
    Piece* best = nullptr;
    double most = -std::numeric_limits<double>::infinity();
    for (Piece& piece : pieces) {
      if (step(piece) > more) continue;
      const double gain = piece.Gain(more);
      if (gain <= most) continue;
      most = gain;
      best = &piece;
    }
    best->Take(more);
    left -= more;
  }
  std::vector<Cluster> clusters;
  for (const Piece& piece : pieces) {
    clusters.insert(clusters.end(), piece.clusters().begin(), piece.clusters().end());
  }
  return clusters;
}

std::vector<Cluster> FitWhole(const section::Polygon& outline, int circle_count,
                              const CircleOptions& options, const FitObserver& observer) {
  const auto kind = options.symmetric ? Region::Kind::kFolded : Region::Kind::kWhole;
  const Region region =
      MakeRegion(kind, outline.vertices(), InteriorPoints(outline, options.interior_points));
  return SearchClusters(region, outline, circle_count, options, observer);
}

bool UsesSplit(const section::FeaturePolygon& polygon, int circle_count) {
  return polygon.split && circle_count >= static_cast<int>(polygon.split->pieces.size());
}

PolygonApproximation Finish(std::vector<Circle> circles, const section::Polygon& outline) {
  std::sort(circles.begin(), circles.end(), [](const Circle& a, const Circle& b) {
    if (a.center_m.x() != b.center_m.x()) return a.center_m.x() < b.center_m.x();
    if (a.center_m.y() != b.center_m.y()) return a.center_m.y() < b.center_m.y();
    return a.radius_m < b.radius_m;
  });
  PolygonApproximation result;
  result.outside_area_m2 = UnionOutsideArea(circles, outline);
  result.circles = std::move(circles);
  return result;
}

PolygonApproximation Covering(std::vector<Cluster> clusters, const section::FeaturePolygon& polygon,
                              const CircleOptions& options) {
  CloseGaps(polygon.outline, options.symmetric, options.gap_fitting_rounds, kCoverageToleranceM,
            clusters);
  return Finish(AllCircles(clusters), polygon.outline);
}

PolygonApproximation OneCircle(const section::Polygon& outline, bool symmetric) {
  Circle circle = geometry::SmallestEnclosingCircle(outline.vertices());
  if (symmetric) {  // the circle is unique, so only rounding keeps it from the axis
    circle.center_m.x() = 0.0;
    for (const Eigen::Vector2d& v : outline.vertices()) {
      circle.radius_m = std::max(circle.radius_m, (v - circle.center_m).norm());
    }
  }
  return Finish({circle}, outline);
}

}  // namespace

CircleOptions DraftOptions(const CircleOptions& options) {
  CircleOptions draft = options;
  draft.interior_points = kDraftPoints;
  draft.max_iterations = kDraftIterations;
  draft.max_idle_teleports = 0;
  draft.gap_fitting_rounds = 0;
  return draft;
}

PolygonApproximation ApproximatePolygon(const section::FeaturePolygon& polygon, int circle_count,
                                        const CircleOptions& options, const FitObserver& observer) {
  if (circle_count <= 1 || observer.IsCancelled()) {
    return OneCircle(polygon.outline, options.symmetric);
  }
  PolygonApproximation whole =
      Covering(FitWhole(polygon.outline, circle_count, options, observer), polygon, options);
  if (!UsesSplit(polygon, circle_count)) return whole;
  PolygonApproximation split =
      Covering(FitPieces(SplitPieces(polygon, options, observer), circle_count), polygon, options);
  return split.outside_area_m2 <= kSplitAllowance * whole.outside_area_m2 ? split : whole;
}

}  // namespace capfit::circle
