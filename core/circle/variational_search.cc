#include "core/circle/variational_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "absl/status/statusor.h"
#include "core/base/random.h"
#include "core/base/ties.h"
#include "core/circle/partition.h"
#include "core/circle/union_area.h"

namespace capfit::circle {
namespace {

// Fitting steps inside a Lloyd round, where the points will change anyway, and at the end.
constexpr int kRoundSteps = 3;
constexpr int kFinalSteps = 24;
// A round or a teleport that saves less than this share counts as no improvement.
constexpr double kSignificantGain = 2e-3;
// Outlines with fewer vertices are not thinned out.
constexpr std::size_t kLeastForCoarse = 64;
// The search looks at every so many of the outline's vertices: few circles show where they belong
// on few.
constexpr std::size_t kLeastCoarse = 32;  // vertices that are left
constexpr int kFewCircles = 3;
constexpr int kStepOfFew = 4;
constexpr int kStepOfMany = 2;
// Rounds without improvement that make a local minimum.
constexpr int kIdleRounds = 2;

// Ends of the outline's longest diagonal.
std::pair<Eigen::Vector2d, Eigen::Vector2d> LongestDiagonal(
    std::span<const Eigen::Vector2d> points) {
  const std::vector<Eigen::Vector2d> hull = ConvexHull(points);
  std::pair<Eigen::Vector2d, Eigen::Vector2d> ends{hull.front(), hull.front()};
  double longest = 0.0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    for (std::size_t j = i + 1; j < hull.size(); ++j) {
      const double length = (hull[j] - hull[i]).squaredNorm();
      if (length <= longest) continue;
      longest = length;
      ends = {hull[i], hull[j]};
    }
  }
  return ends;
}

class Search {
 public:
  Search(const Region& region, const section::Polygon& outline, const CircleOptions& options,
         const FitObserver& observer)
      : region_(region),
        outline_(outline),
        options_(options),
        observer_(observer),
        random_(options.seed) {}

  // The best of several local minima.
  std::vector<Cluster> Run(std::vector<Seed> seeds) {
    std::vector<Cluster> best = Descend(std::move(seeds));
    if (options_.max_idle_teleports == 0) return best;
    double least = Waste(best);
    int idle = 0;
    while (idle < options_.max_idle_teleports && best.size() > 1 && least > 0.0 &&
           !observer_.IsCancelled()) {
      std::vector<Cluster> next = Descend(Teleport(best));
      const double waste = Waste(next);
      idle = waste < (1.0 - kSignificantGain) * least ? 0 : idle + 1;
      if (ClearlyLess(waste, least)) {
        least = waste;
        best = std::move(next);
      }
    }
    return best;
  }

  // Each circle fitted to the end around those of this region's points that have the least power to
  // it: as good a partition as another round's at a tenth of its cost.
  std::vector<Cluster> Finish(std::span<const Cluster> clusters) const {
    std::vector<Seed> seeds;
    for (const Cluster& c : clusters) seeds.push_back({c.circle.center_m, c.place});
    std::vector<int> owners;
    owners.reserve(region_.points_m.size());
    for (const Eigen::Vector2d& point : region_.points_m) {
      owners.push_back(LeastPower(clusters, point));
    }
    return FitAll(seeds, owners, kFinalSteps);
  }

  // With as many pairs as possible, and with one pair less.
  std::vector<Cluster> RunFolded(int circle_count) {
    const int pairs = circle_count / 2;
    std::vector<Cluster> best = Run(FoldedSeeds(pairs, circle_count - 2 * pairs));
    if (pairs == 0) return best;
    std::vector<Cluster> other = Run(FoldedSeeds(pairs - 1, circle_count - 2 * pairs + 2));
    return ClearlyLess(Waste(other), Waste(best)) ? other : best;
  }

  // Evenly on the longest diagonal of the region.
  std::vector<Seed> FreeSeeds(int count) const {
    const auto [a, b] = LongestDiagonal(region_.points_m);
    std::vector<Seed> seeds;
    const Place place = region_.kind == Region::Kind::kHalf ? Place::kPaired : Place::kFree;
    for (int i = 0; i < count; ++i) {
      seeds.push_back({a + (i + 0.5) / count * (b - a), place});
    }
    return seeds;
  }

  // Pairs evenly across, centred circles evenly from back to front.
  std::vector<Seed> FoldedSeeds(int pairs, int centred) const {
    Eigen::Vector2d low = region_.points_m.front();
    Eigen::Vector2d high = low;
    for (const Eigen::Vector2d& p : region_.points_m) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    std::vector<Seed> seeds;
    for (int i = 0; i < centred; ++i) {
      const double t = (i + 0.5) / centred;
      seeds.push_back({{0.0, low.y() + t * (high.y() - low.y())}, Place::kCentred});
    }
    const int across = 2 * pairs + std::min(centred, 1);
    for (int i = 0; i < pairs; ++i) {
      const double x = high.x() * (across - 1 - 2 * i) / across;
      seeds.push_back({{x, 0.5 * (low.y() + high.y())}, Place::kPaired});
    }
    return seeds;
  }

 private:
  // Partition and fit until nothing improves; the best round's clusters.
  std::vector<Cluster> Descend(std::vector<Seed> seeds) {
    std::vector<Cluster> best;
    std::vector<int> owners;
    double least = 0.0;
    int idle = 0;
    for (int round = 0; round < options_.max_iterations && idle < kIdleRounds; ++round) {
      std::vector<int> next = Partition(region_.points_m, seeds, outline_);
      if (next == owners) break;
      owners = std::move(next);
      std::vector<Cluster> clusters = FitAll(seeds, owners, kRoundSteps);
      const double sum = OutsideAreaSum(clusters);
      idle = !best.empty() && sum > (1.0 - kSignificantGain) * least ? idle + 1 : 0;
      for (std::size_t i = 0; i < seeds.size(); ++i) {
        seeds[i].center_m = clusters[i].circle.center_m;
      }
      if (best.empty() || ClearlyLess(sum, least)) {
        least = sum;
        best = std::move(clusters);
      }
      if (observer_.IsCancelled()) break;
    }
    return best;
  }

  // The cluster whose circle a point has the least power to: the squared distance of the centre
  // less the squared radius.
  static int LeastPower(std::span<const Cluster> clusters, const Eigen::Vector2d& point) {
    int owner = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      const Circle& circle = clusters[i].circle;
      const double power =
          (point - circle.center_m).squaredNorm() - circle.radius_m * circle.radius_m;
      if (power >= least) continue;
      least = power;
      owner = static_cast<int>(i);
    }
    return owner;
  }

  std::vector<Cluster> FitAll(std::span<const Seed> seeds, std::span<const int> owners,
                              int steps) const {
    std::vector<Cluster> clusters(seeds.size());
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      clusters[i].place = seeds[i].place;
      clusters[i].circle.center_m = seeds[i].center_m;
    }
    for (std::size_t p = 0; p < owners.size(); ++p) {
      clusters[owners[p]].points.push_back(static_cast<int>(p));
    }
    FillEmpty(clusters);
    for (Cluster& cluster : clusters) {
      cluster.hull = HullOf(cluster);
      Fit(cluster, steps);
    }
    return clusters;
  }

  // A cluster without points takes half of the largest cluster's.
  static void FillEmpty(std::vector<Cluster>& clusters) {
    for (Cluster& cluster : clusters) {
      if (!cluster.points.empty()) continue;
      Cluster& largest = *std::max_element(
          clusters.begin(), clusters.end(),
          [](const Cluster& a, const Cluster& b) { return a.points.size() < b.points.size(); });
      if (largest.points.size() < 2) continue;
      const auto middle =
          largest.points.begin() + static_cast<std::ptrdiff_t>(largest.points.size() / 2);
      cluster.points.assign(middle, largest.points.end());
      largest.points.erase(middle, largest.points.end());
    }
  }

  std::vector<Eigen::Vector2d> HullOf(const Cluster& cluster) const {
    std::vector<Eigen::Vector2d> points;
    points.reserve(cluster.points.size());
    for (const int p : cluster.points) {
      points.push_back(region_.points_m[p]);
    }
    return ConvexHull(points);  // indices rise, so the points are still sorted
  }

  void Fit(Cluster& cluster, int steps) const {
    if (cluster.hull.empty()) {
      cluster.circle.radius_m = 0.0;
      cluster.outside_area_m2 = 0.0;
      return;
    }
    const CircleFit fit =
        FitCircle(outline_, cluster.hull, cluster.circle.center_m, cluster.place, steps);
    cluster.circle = fit.circle;
    cluster.outside_area_m2 = fit.outside_area_m2;
  }

  // Local minima are compared by what they really waste: overlaps count once.
  double Waste(std::span<const Cluster> clusters) const {
    return UnionOutsideArea(AllCircles(clusters), outline_);
  }

  // Seeds of the clusters without the most overlapped one, the most wasteful one split in two.
  std::vector<Seed> Teleport(std::span<const Cluster> clusters) {
    const std::size_t deleted = MostOverlapped(clusters);
    const std::size_t split = MostWasteful(clusters, deleted);
    std::vector<Seed> seeds;
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      const std::size_t from = i == deleted || i == split ? split : i;
      const Eigen::Vector2d center =
          from == split ? RandomPoint(clusters[split]) : clusters[i].circle.center_m;
      const bool centred = clusters[i].place == Place::kCentred;
      seeds.push_back({centred ? Eigen::Vector2d(0.0, center.y()) : center, clusters[i].place});
    }
    return seeds;
  }

  static std::size_t MostOverlapped(std::span<const Cluster> clusters) {
    const std::vector<double> ratios = OverlapRatios(AllCircles(clusters));
    std::size_t most = 0;
    double highest = -1.0;
    std::size_t circle = 0;
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      if (ratios[circle] > highest + kTie) {
        highest = ratios[circle];
        most = i;
      }
      circle += CircleCount(clusters[i].place);
    }
    return most;
  }

  std::size_t MostWasteful(std::span<const Cluster> clusters, std::size_t except) const {
    const double tie = kTie * outline_.area_m2();
    std::size_t most = except == 0 ? 1 : 0;
    for (std::size_t i = most + 1; i < clusters.size(); ++i) {
      if (i == except) continue;
      if (clusters[i].outside_area_m2 > clusters[most].outside_area_m2 + tie) most = i;
    }
    return most;
  }

  // A point of the cluster, an interior one where there are any: the nearest to a place drawn in
  // the circle. (Drawing from their list would make every later circle depend on the owner of each
  // single point.)
  Eigen::Vector2d RandomPoint(const Cluster& cluster) {
    const double angle = random_.NextIn(0.0, 2.0 * std::numbers::pi);
    const double radius = cluster.circle.radius_m * std::sqrt(random_.NextUnit());
    const Eigen::Vector2d place =
        cluster.circle.center_m + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    Eigen::Vector2d nearest = cluster.circle.center_m;
    double least = std::numeric_limits<double>::infinity();
    bool found_interior = false;
    for (const int p : cluster.points) {
      const bool is_interior = region_.place_on_boundary[p] < 0;
      if (found_interior && !is_interior) continue;
      const Eigen::Vector2d& point = region_.points_m[p];
      const double distance = (point - place).squaredNorm();
      if (is_interior == found_interior && !ClearlyLess(distance, least)) continue;
      nearest = point;
      least = distance;
      found_interior = is_interior;
    }
    return nearest;
  }

  const Region& region_;
  const section::Polygon& outline_;
  const CircleOptions& options_;
  const FitObserver& observer_;
  Random random_;
};

Region CoarseRegion(const Region& region, int step) {
  Region coarse;
  coarse.kind = region.kind;
  for (std::size_t i = 0; i < region.points_m.size(); ++i) {
    const int place = region.place_on_boundary[i];
    if (place >= 0 && place % step != 0 && place != region.last_on_boundary) continue;
    coarse.points_m.push_back(region.points_m[i]);
    coarse.place_on_boundary.push_back(place);
  }
  return coarse;
}

// Every so many vertices, from the first on: a mirrored outline with its first vertex on the axis
// and a multiple of twice so many vertices stays mirrored.
section::Polygon CoarseOutline(const section::Polygon& outline, int step) {
  const std::span<const Eigen::Vector2d> vertices = outline.vertices();
  if (vertices.size() < kLeastForCoarse) return outline;
  std::vector<Eigen::Vector2d> coarse;
  for (std::size_t i = 0; i < vertices.size(); i += step) {
    coarse.push_back(vertices[i]);
  }
  absl::StatusOr<section::Polygon> polygon = section::Polygon::Create(std::move(coarse));
  return polygon.ok() ? *std::move(polygon) : outline;
}

}  // namespace

double OutsideAreaSum(std::span<const Cluster> clusters) {
  double sum = 0.0;
  for (const Cluster& c : clusters) sum += CircleCount(c.place) * c.outside_area_m2;
  return sum;
}

Region MakeRegion(Region::Kind kind, std::span<const Eigen::Vector2d> boundary_m,
                  std::span<const Eigen::Vector2d> interior_m) {
  struct Marked {
    Eigen::Vector2d point;
    int place;  // on the boundary, or -1
  };
  std::vector<Marked> marked;
  const auto add = [&](const Marked& m) {
    if (kind == Region::Kind::kWhole || m.point.x() >= 0.0) marked.push_back(m);
  };
  for (std::size_t i = 0; i < boundary_m.size(); ++i) {
    add({boundary_m[i], static_cast<int>(i)});
  }
  for (const Eigen::Vector2d& p : interior_m) add({p, -1});
  std::sort(marked.begin(), marked.end(), [](const Marked& a, const Marked& b) {
    return a.point.x() != b.point.x() ? a.point.x() < b.point.x() : a.point.y() < b.point.y();
  });
  Region region;
  region.kind = kind;
  region.last_on_boundary = static_cast<int>(boundary_m.size()) - 1;
  for (const Marked& m : marked) {
    region.points_m.push_back(m.point);
    region.place_on_boundary.push_back(m.place);
  }
  return region;
}

std::vector<Cluster> SearchClusters(const Region& region, const section::Polygon& outline,
                                    int circle_count, const CircleOptions& options,
                                    const FitObserver& observer) {
  const bool is_few =
      circle_count <= kFewCircles && outline.vertices().size() >= kStepOfFew * kLeastCoarse;
  const int step = is_few ? kStepOfFew : kStepOfMany;
  const Region coarse = CoarseRegion(region, step);
  const section::Polygon coarse_outline = CoarseOutline(outline, step);
  Search search(coarse, coarse_outline, options, observer);
  std::vector<Cluster> best;
  if (region.kind != Region::Kind::kFolded) {
    const bool is_half = region.kind == Region::Kind::kHalf;
    best = search.Run(search.FreeSeeds(is_half ? circle_count / 2 : circle_count));
  } else {
    best = search.RunFolded(circle_count);
  }
  return Search(region, outline, options, observer).Finish(best);
}

}  // namespace capfit::circle
