#include "core/coverage/cover_vertices.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/coverage/grow.h"
#include "core/coverage/point_grid.h"
#include "core/coverage/set_variables.h"
#include "core/coverage/surface_probe.h"
#include "core/coverage/tighten.h"

namespace capfit::coverage {
namespace {

// Vertices end up this deep inside at least, so that writing the result in another unit or with
// fewer digits does not bring them out again. Metres; a hundredth of what anybody can measure.
constexpr double kVertexDepth = 1e-6;
// Enough points to find the shape by; all of them have their say in the second phase.
constexpr std::uint32_t kCoarsePointsPerBlock = 8;

// The set finds its shape with points left out at a price, which rises; then they must all come in.
// Starting with a low price matters most (a fifth of E_r): where everything must be inside from the
// start, each sphere is caught in the circle it came with.
constexpr TightenPhase kLoosePhase{.steps = 14,
                                   .first_trust = 0.012,
                                   .last_trust = 0.006,
                                   .first_penalty = 0.05,
                                   .last_penalty = 0.3,
                                   .row_spacing = 0.016};
constexpr TightenPhase kTightPhase{.steps = 7,
                                   .first_trust = 0.004,
                                   .last_trust = 0.0005,
                                   .first_penalty = 12.0,
                                   .last_penalty = 12.0,
                                   .row_spacing = 0.006};

double SizeOf(const CoverTarget& target) {
  double area = 0.0;
  for (const mesh::Triangle& t : target.triangles) {
    const Eigen::Vector3d& origin = target.points_m[t[0]];
    area += 0.5 * (target.points_m[t[1]] - origin).cross(target.points_m[t[2]] - origin).norm();
  }
  if (area > 0.0) return std::sqrt(area);
  Eigen::Array3d low = target.points_m[0];
  Eigen::Array3d high = low;
  for (const Eigen::Vector3d& p : target.points_m) {
    low = low.min(p.array());
    high = high.max(p.array());
  }
  return std::max((high - low).matrix().norm(), 1e-9);
}

class Coverer {
 public:
  Coverer(const CoverTarget& target, const CoverOptions& options, const ThreadPool& pool,
          const FitObserver& observer, capsule::PrimitiveSet& set)
      : target_(target),
        options_(options),
        pool_(pool),
        observer_(observer),
        set_(set),
        grid_(target.points_m),
        size_(SizeOf(target)),
        solids_(SetVariables(set).solids()) {}

  CoverReport Run() {
    if (options_.tighten) Tightening();
    Growing();
    report_.max_vertex_distance_m = MaxVertexDistance();
    report_.certified_gap_m = CertifiedGap(target_, set_, 0.05 * options_.max_gap_m, pool_);
    report_.added_points = static_cast<int>(between_.size());
    return report_;
  }

 private:
  void Tightening() {
    const std::vector<Eigen::Vector3d> coarse = CoarsePoints();
    const std::vector<double> coarse_depths(coarse.size(), -kVertexDepth);
    Tighten(PointGrid(coarse), coarse_depths, size_, kLoosePhase, /*seed=*/1, pool_, observer_,
            set_);
    Collect();
    std::vector<Eigen::Vector3d> points = target_.points_m;
    points.insert(points.end(), between_.begin(), between_.end());
    std::vector<double> allowed(target_.points_m.size(), -kVertexDepth);
    allowed.resize(points.size(), AllowedBetween());
    Tighten(between_.empty() ? grid_ : PointGrid(points), allowed, size_, kTightPhase, /*seed=*/101,
            pool_, observer_, set_);
  }

  // A few of each block's points.
  std::vector<Eigen::Vector3d> CoarsePoints() const {
    std::vector<Eigen::Vector3d> coarse;
    for (const PointGrid::Block& block : grid_.blocks()) {
      const std::uint32_t count = block.end - block.begin;
      const std::uint32_t kept = std::min(count, kCoarsePointsPerBlock);
      for (std::uint32_t i = 0; i < kept; ++i) {
        coarse.push_back(grid_.point(block.begin + i * count / kept));
      }
    }
    return coarse;
  }

  double AllowedBetween() const { return 0.5 * options_.max_gap_m; }

  // Adds points between vertices where the surface sticks out; whether there were any.
  bool Collect() {
    const std::vector<geometry::TaperedCapsule> shapes = ShapesOf(solids_, set_);
    const UnionDistances distances =
        InCallersOrder(grid_, grid_.DistancesTo(shapes, -size_, pool_));
    const std::vector<Eigen::Vector3d> found =
        FindPointsOutside(target_, distances, shapes, options_.max_gap_m, pool_);
    between_.insert(between_.end(), found.begin(), found.end());
    return !found.empty();
  }

  // Vertices first, then what lies between them. Solids only grow here, so no point is met twice
  // and the rounds come to an end.
  void Growing() {
    do {
      const std::vector<Demand> demands = OpenDemands();
      report_.growth_steps += GrowToAll(demands, observer_, set_);
    } while (!observer_.IsCancelled() && Collect());
  }

  std::vector<Demand> OpenDemands() const {
    const UnionDistances distances =
        grid_.DistancesTo(ShapesOf(solids_, set_), -options_.max_gap_m, pool_);
    std::vector<Demand> demands;
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      if (distances.distance_m[i] > -2.0 * kVertexDepth) {
        demands.push_back({grid_.point(i), -kVertexDepth});
      }
    }
    for (const Eigen::Vector3d& point : between_) demands.push_back({point, AllowedBetween()});
    return demands;
  }

  double MaxVertexDistance() const {
    const std::vector<geometry::TaperedCapsule> shapes = ShapesOf(solids_, set_);
    const UnionDistances distances = grid_.DistancesTo(shapes, -options_.max_gap_m, pool_);
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      if (distances.distance_m[i] < most - 1e-6) continue;
      const auto solid = static_cast<std::size_t>(distances.solid[i]);
      most = std::max(most, shapes[solid].SignedDistance(grid_.point(i)));
    }
    return most;
  }

  const CoverTarget& target_;
  const CoverOptions& options_;
  const ThreadPool& pool_;
  const FitObserver& observer_;
  capsule::PrimitiveSet& set_;
  PointGrid grid_;
  double size_;
  std::vector<Solid> solids_;
  std::vector<Eigen::Vector3d> between_;  // points inside triangles that had to be asked for
  CoverReport report_;
};

}  // namespace

CoverReport CoverBody(const CoverTarget& target, const CoverOptions& options,
                      const ThreadPool& pool, const FitObserver& observer,
                      capsule::PrimitiveSet& set) {
  if (target.points_m.empty() || set.spheres.empty()) {
    CoverReport report;
    if (!target.points_m.empty()) {
      report.max_vertex_distance_m = std::numeric_limits<double>::infinity();
      report.certified_gap_m = std::numeric_limits<double>::infinity();
    }
    return report;
  }
  return Coverer(target, options, pool, observer, set).Run();
}

}  // namespace capfit::coverage
