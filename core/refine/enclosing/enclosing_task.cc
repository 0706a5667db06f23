#include "core/refine/enclosing/enclosing_task.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/enum_index.h"
#include "core/refine/enclosing/added_capsule.h"
#include "core/refine/graph/points_apart.h"
#include "core/refine/internal.h"
#include "core/tighten/set_variables.h"
#include "core/tighten/union_volume.h"

namespace capfit::refine {
namespace {

using geometry::TaperedCapsule;
using Vec3 = Eigen::Vector3d;

// Of the volume's samples, times the root of the number of primitives, relative to the body's size:
// coarse samples tell sets apart by chance.
constexpr double kSampleSpacing = 0.096;
constexpr double kLeastSampleSpacing = 0.006;
constexpr double kMostSampleSpacing = 0.012;
// What a cubic metre outside costs against one too much inside.
constexpr double kOutsidePrice = 4.0;
// No solid grows further than this to make up for a removed capsule, relative to the body's size.
constexpr double kFurthestGrowth = 0.045;

// Graphs are compared here, not finished.
constexpr tighten::SolveTo kTrial{.relative_gap = 0.03};
constexpr tighten::TightenPhase kShapePhase{.first_trust = 0.012,
                                            .last_trust = 0.003,
                                            .first_penalty = 1.6,
                                            .last_penalty = 16.0,
                                            .solve_to = kTrial};
constexpr tighten::TightenPhase kInsidePhase{.first_trust = 0.004,
                                             .last_trust = 0.001,
                                             .first_penalty = 100.0,
                                             .last_penalty = 100.0,
                                             .solve_to = kTrial};

constexpr double kLoosePenalty = 8.0;
constexpr double kApart = 0.03;  // of the worst points, relative to the body's size
}  // namespace

EnclosingTask::EnclosingTask(const tighten::CoverTarget& target, bool symmetric, double tolerance_m,
                             double spacing, const tighten::FullCells* full,
                             const BodyRegions& regions)
    : EnclosingTask(ThinnedPointsOf(target, symmetric, spacing), tolerance_m, full, regions) {}

EnclosingTask::EnclosingTask(ThinnedPoints thinned, double tolerance_m,
                             const tighten::FullCells* full, const BodyRegions& regions)
    : size_m_(thinned.size_m),
      areas_m2_(std::move(thinned.areas_m2)),
      tolerance_m_(tolerance_m),
      full_(full),
      grid_(thinned.points_m),
      regions_(regions) {
  for (const Vec3& point : grid_.points_m()) point_regions_.push_back(regions.RegionAt(point));
}

void EnclosingTask::Settle(const tighten::TightenPhase& phase, std::uint64_t seed,
                           const ThreadPool& pool, const WorkMeter& meter,
                           capsule::MirroredSet& graph) const {
  capsule::PrimitiveSet set = graph.set();
  const std::array<tighten::PointsToHold, 1> points = {{{grid_, tolerance_m_, areas_m2_}}};
  tighten::Tighten(points, size_m_, phase, seed, pool, meter, set, /*backlog=*/nullptr, full_);
  graph.MoveTo(set.spheres);
}

void EnclosingTask::FindShape(int steps, double looseness, std::uint64_t seed,
                              const ThreadPool& pool, const WorkMeter& meter,
                              capsule::MirroredSet& graph) const {
  tighten::TightenPhase phase = kShapePhase;
  phase.first_penalty /= looseness;
  phase.steps = steps;
  Settle(phase, seed, pool, meter, graph);
}

void EnclosingTask::TakeIn(int steps, std::uint64_t seed, const ThreadPool& pool,
                           const WorkMeter& meter, capsule::MirroredSet& graph) const {
  tighten::TightenPhase phase = kInsidePhase;
  phase.steps = steps;
  Settle(phase, seed, pool, meter, graph);
}

void EnclosingTask::Loosen(int steps, std::uint64_t seed, const ThreadPool& pool,
                           const WorkMeter& meter, capsule::MirroredSet& graph) const {
  tighten::TightenPhase phase = kShapePhase;
  phase.first_penalty = phase.last_penalty = kLoosePenalty;
  phase.last_trust = 0.006;
  phase.steps = steps;
  Settle(phase, seed, pool, meter, graph);
}

std::vector<Vec3> EnclosingTask::WorstPoints(const capsule::MirroredSet& graph, int count,
                                             const ThreadPool& pool) const {
  const std::vector<double> distances =
      grid_.DistancesTo(capsule::Solids(graph.set()), -kFurthestGrowth * size_m_, pool).distance_m;
  std::vector<Vec3> points;
  std::vector<double> scores;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (distances[i] <= tolerance_m_) continue;
    points.push_back(grid_.point(i));
    scores.push_back(distances[i]);
  }
  return BestApart(points, scores, kApart * size_m_, count);
}

std::vector<double> EnclosingTask::GainsOf(const capsule::MirroredSet& graph,
                                           const std::vector<Edit>& additions,
                                           const ThreadPool& pool) const {
  const std::vector<TaperedCapsule> shapes = capsule::Solids(graph.set());
  const tighten::UnionDistances at = grid_.DistancesTo(shapes, -kFurthestGrowth * size_m_, pool);
  const OutsidePoints outside(grid_, at.distance_m, areas_m2_, tolerance_m_);
  std::vector<double> gains(additions.size(), 0.0);
  pool.ForEach(additions.size(), [&](std::size_t k) {
    const Edit& edit = additions[k];
    const geometry::Sphere end = edit.kind == EditKind::kLeaf
                                     ? geometry::Sphere{edit.center_m, edit.radius_m}
                                     : graph.sphere(edit.second);
    const TaperedCapsule added(graph.sphere(edit.first), end);
    if (added.IsSphere()) return;
    const bool is_pair = HasImage(graph, edit);
    const double gain = kLoosePenalty * outside.TakenInBy(added, is_pair);
    if (gain > 0.0) gains[k] = gain - (is_pair ? 2.0 : 1.0) * VolumeOutside(added, shapes);
  });
  return gains;
}

GraphValue EnclosingTask::Value(const capsule::MirroredSet& graph, const ThreadPool& pool) const {
  capsule::PrimitiveSet set = graph.set();
  const tighten::SetVariables variables(set);
  const tighten::UnionDistances at =
      grid_.DistancesTo(capsule::Solids(set), -kFurthestGrowth * size_m_, pool);
  GraphValue value;
  for (std::size_t i = 0; i < grid_.size(); ++i) {
    const double area = areas_m2_[grid_.order()[i]];
    const double outside = kOutsidePrice * area * std::max(0.0, at.distance_m[i] - tolerance_m_);
    value.total_m3 += outside;
    value.of_region_m3[Index(point_regions_[i])] +=
        outside + area * std::max(0.0, -at.distance_m[i]);
  }
  const double primitives = std::max(1, graph.primitive_count());
  const double spacing_m = size_m_ * std::clamp(kSampleSpacing / std::sqrt(primitives),
                                                kLeastSampleSpacing, kMostSampleSpacing);
  value.total_m3 +=
      tighten::UnionVolumeGradient(set, variables, spacing_m, /*seed=*/7, pool, full_).volume_m3;
  return value;
}

std::vector<Region> EnclosingTask::RegionsOf(const capsule::MirroredSet& graph) const {
  std::vector<Region> regions;
  for (const geometry::Sphere& sphere : graph.spheres()) {
    regions.push_back(regions_.RegionAt(sphere.center_m));
  }
  return regions;
}

GraphWorth EnclosingTask::Weigh(const capsule::MirroredSet& graph) const {
  return WorthOf(graph, grid_, areas_m2_, kFurthestGrowth * size_m_);
}

}  // namespace capfit::refine
