#include "core/metrics/measure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>

#include "core/metrics/boundary_distance.h"
#include "core/metrics/fitted_surface.h"
#include "core/metrics/volumes.h"
#include "core/tighten/point_grid.h"

namespace capfit::metrics {
namespace {

// Distances by tighten::PointGrid are good to this.
constexpr double kGridErrorM = 1e-7;
// A vertex counts as out when it is further out than this, in metres: what the paper's pictures, a
// cloth engine's thickness and float rounding cannot tell from touching.
constexpr double kOutM = 1e-4;
// Points at which the solids' surfaces are looked at for creases: 2 to 3 cm apart on a body.
constexpr int kCreaseGridPoints = 6'000;

template <typename AnyMetrics>
void PutVolumeRatios(const PartVolumes& volumes, AnyMetrics& metrics) {
  if (!(volumes.fitted > 0.0)) return;
  metrics.outside = volumes.outside / volumes.fitted;
  metrics.uncovered = volumes.uncovered / volumes.fitted;
  metrics.E_r = metrics.outside + metrics.uncovered;
  metrics.volume_ratio = volumes.set / volumes.fitted;
}

void PutVolumes(const Volumes& volumes, Metrics& metrics) {
  PutVolumeRatios(volumes.all, metrics);
  if (volumes.all.fitted > 0.0) {
    metrics.iou = (1.0 - metrics.uncovered) / (1.0 + metrics.outside);
  }
  if (volumes.all.set > 0.0) metrics.mirror_error = volumes.mirror_xor / volumes.all.set;
  for (std::size_t p = 0; p < metrics.parts.size(); ++p) {
    if (!metrics.parts[p]) continue;
    metrics.parts[p]->volume_m3 = volumes.parts[p].fitted;
    PutVolumeRatios(volumes.parts[p], *metrics.parts[p]);
  }
}

PartMetrics* PartOf(body::Part part, Metrics& metrics) {
  std::optional<PartMetrics>& found = metrics.parts[static_cast<std::size_t>(part)];
  return found ? &*found : nullptr;
}

void PutCounts(const capsule::PrimitiveSet& set, Metrics& metrics) {
  metrics.n_p = set.primitive_count();
  metrics.spheres = static_cast<int>(set.spheres.size());
  metrics.capsules = static_cast<int>(set.capsules.size());
  for (const capsule::SphereOrigin& origin : set.origins) {
    if (PartMetrics* const its = PartOf(origin.part, metrics)) ++its->spheres;
  }
  for (std::size_t k = 0; k < set.capsules.size(); ++k) {
    if (PartMetrics* const its = PartOf(capsule::PartOfCapsule(set, k), metrics)) ++its->capsules;
  }
}

// Points of the surface and the part of each.
struct SurfaceSamples {
  std::vector<Eigen::Vector3d> points_m;
  std::vector<body::Part> parts;
};

// The next of a row of numbers in [0, 1) that fill it evenly, however many are taken.
double NextEven(double step, double& at) {
  at += step;
  if (at >= 1.0) at -= 1.0;
  return at;
}

// Points spread evenly over the area of the triangles: one in the middle of each of `count` equal
// shares of it, taken in the order of the triangles.
SurfaceSamples SampleSurface(const FittedSurface& surface, int count) {
  // The plane's counterpart of the golden ratio: the pairs fill the unit square evenly.
  constexpr double kStepU = 0.7548776662466927;
  constexpr double kStepV = 0.5698402909980532;
  const std::span<const mesh::Triangle> triangles = surface.skin();
  const std::vector<Eigen::Vector3d>& points = surface.points_m;
  const double step_m2 =
      std::accumulate(surface.skin_areas_m2.begin(), surface.skin_areas_m2.end(), 0.0) / count;
  SurfaceSamples samples;
  samples.points_m.reserve(static_cast<std::size_t>(count));
  samples.parts.reserve(static_cast<std::size_t>(count));
  double at_u = 0.0;
  double at_v = 0.0;
  std::size_t at = 0;
  double area_up_to = surface.skin_areas_m2[0];
  for (int i = 0; i < count; ++i) {
    const double target = step_m2 * (i + 0.5);
    while (at + 1 < triangles.size() && area_up_to <= target) {
      area_up_to += surface.skin_areas_m2[++at];
    }
    double u = NextEven(kStepU, at_u);
    double v = NextEven(kStepV, at_v);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const Eigen::Vector3d& a = points[triangles[at][0]];
    samples.points_m.emplace_back(a + u * (points[triangles[at][1]] - a) +
                                  v * (points[triangles[at][2]] - a));
    samples.parts.push_back(surface.parts[surface.skin_begin + at]);
  }
  return samples;
}

// `signed_m` in any order; is reordered.
template <typename AnyMetrics>
void PutGaps(double diagonal_m, std::vector<double>& signed_m, AnyMetrics& metrics) {
  if (signed_m.empty()) return;
  const auto count = static_cast<double>(signed_m.size());
  const auto out =
      std::count_if(signed_m.begin(), signed_m.end(), [](double d) { return d > kOutM; });
  metrics.surface_out = static_cast<double>(out) / count;
  double sum = 0.0;
  for (double& d : signed_m) sum += d = std::abs(d);
  metrics.gap.mean_m = sum / count;
  metrics.gap.max_m = *std::max_element(signed_m.begin(), signed_m.end());
  const auto p95 = signed_m.begin() + static_cast<std::ptrdiff_t>(0.95 * count);
  std::nth_element(signed_m.begin(), p95, signed_m.end());
  metrics.gap.p95_m = *p95;
  metrics.E_M = 100.0 * metrics.gap.mean_m / diagonal_m;
}

void PutSurfaceDistances(const FittedSurface& fitted,
                         const std::vector<geometry::TaperedCapsule>& solids,
                         const MeasureOptions& options, const ThreadPool& pool, Metrics& metrics) {
  const BoundaryDistance boundary(solids, kCreaseGridPoints, pool);
  const SurfaceSamples samples = SampleSurface(fitted, options.surface_samples);
  std::vector<double> signed_m = boundary.SignedAt(samples.points_m, pool);
  const double diagonal_m = fitted.box.diagonal().norm();
  std::array<std::vector<double>, body::kPartCount> by_part;
  for (std::size_t i = 0; i < signed_m.size(); ++i) {
    by_part[static_cast<std::size_t>(samples.parts[i])].push_back(signed_m[i]);
  }
  for (std::size_t p = 0; p < by_part.size(); ++p) {
    if (metrics.parts[p]) PutGaps(diagonal_m, by_part[p], *metrics.parts[p]);
  }
  PutGaps(diagonal_m, signed_m, metrics);
  metrics.hausdorff = 100.0 * metrics.gap.max_m / diagonal_m;
}

void PutVertices(const body::Body& body, const FittedSurface& fitted,
                 const std::vector<geometry::TaperedCapsule>& solids, const ThreadPool& pool,
                 Metrics& metrics) {
  std::vector<Eigen::Vector3d> points_m;
  points_m.reserve(fitted.vertices.size());
  for (const std::uint32_t v : fitted.vertices) points_m.push_back(body.mesh.vertices()[v]);
  const tighten::PointGrid grid(points_m);
  const tighten::UnionDistances nearest = grid.DistancesTo(solids, /*ignore_below_m=*/0.0, pool);
  const auto count = [](double gap, auto& its) {
    its.vertices_out += gap > kOutM ? 1 : 0;
    its.max_out_m = std::max(its.max_out_m, gap);
  };
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (nearest.distance_m[i] < -kGridErrorM) continue;
    const double gap =
        solids[static_cast<std::size_t>(nearest.solid[i])].SignedDistance(grid.point(i));
    count(gap, metrics);
    const std::uint32_t vertex = fitted.vertices[grid.order()[i]];
    PartMetrics* const its = PartOf(body::PartOf(body.vertex_segments[vertex]), metrics);
    if (its != nullptr) count(gap, *its);
  }
}

}  // namespace

Metrics Measure(const body::Body& body, const capsule::PrimitiveSet& set,
                const MeasureOptions& options, const ThreadPool& pool,
                const FitObserver& observer) {
  Metrics metrics;
  const FittedSurface fitted = MakeFittedSurface(body, options.parts, pool);
  for (std::size_t p = 0; p < metrics.parts.size(); ++p) {
    if (fitted.has_part[p]) metrics.parts[p].emplace();
  }
  PutCounts(set, metrics);
  const std::vector<geometry::TaperedCapsule> solids = capsule::Solids(set);
  const bool has_gaps = !solids.empty() && fitted.skin_begin < fitted.skin_end;
  // Side by side: what one of them cannot share out, the others fill.
  pool.ForEach(has_gaps ? 3 : 1, [&](std::size_t which) {
    if (observer.IsCancelled()) return;
    if (which == 0) {
      PutVolumes(
          MeasureVolumes(body.mesh, fitted, solids, PartsOfSolids(set), options.columns, pool),
          metrics);
    } else if (which == 1) {
      PutSurfaceDistances(fitted, solids, options, pool, metrics);
    } else {
      PutVertices(body, fitted, solids, pool, metrics);
    }
  });
  return metrics;
}

std::vector<double> SignedGaps(const body::Body& body, const capsule::PrimitiveSet& set,
                               const body::PartSelection& parts, const ThreadPool& pool) {
  const std::vector<geometry::TaperedCapsule> solids = capsule::Solids(set);
  const BoundaryDistance boundary(solids, kCreaseGridPoints, pool);
  std::vector<double> gaps = boundary.SignedAt(body.mesh.vertices(), pool);
  for (std::size_t v = 0; v < gaps.size(); ++v) {
    if (parts.Includes(body::PartOf(body.vertex_segments[v]))) continue;
    gaps[v] = std::numeric_limits<double>::quiet_NaN();
  }
  return gaps;
}

}  // namespace capfit::metrics
