#include "core/metrics/measure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "core/base/random.h"
#include "core/metrics/boundary_distance.h"
#include "core/metrics/fitted_surface.h"
#include "core/metrics/union_distance.h"
#include "core/metrics/volumes.h"

namespace capfit::metrics {
namespace {

constexpr std::uint64_t kSurfaceSeed = 20'180'001;
constexpr std::size_t kPointsPerChunk = 512;
// A vertex counts as out when it is further out than this, in metres: what the paper's pictures, a
// cloth engine's thickness and float rounding cannot tell from touching.
constexpr double kOutM = 1e-4;
// Cells of the distance grid along the body: 4 to 5 cm, where a cell keeps a few candidates.
constexpr int kDistanceCells = 40;
// Points at which the solids' surfaces are looked at for creases: 1 to 2 cm apart on a body. Twenty
// times as many change E_M by less than 0.1 % of itself.
constexpr int kCreaseGridPoints = 16'000;

UnionDistance DistanceTo(const body::Body& body, const capsule::PrimitiveSet& set,
                         const ThreadPool& pool) {
  Eigen::AlignedBox3d box(body.mesh.box_min(), body.mesh.box_max());
  for (const geometry::Sphere& sphere : set.spheres) {
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(sphere.radius_m);
    box.extend(Eigen::Vector3d(sphere.center_m - reach));
    box.extend(Eigen::Vector3d(sphere.center_m + reach));
  }
  return {capsule::Solids(set), box, kDistanceCells, pool};
}

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

// Points spread evenly over the area of the triangles: one in each of `count` equal shares of it,
// taken in the order of the triangles, at a random place.
SurfaceSamples SampleSurface(const FittedSurface& surface, int count) {
  const std::span<const mesh::Triangle> triangles = surface.skin();
  const std::vector<Eigen::Vector3d>& points = surface.points_m;
  std::vector<double> area_up_to;
  area_up_to.reserve(triangles.size());
  double area = 0.0;
  for (const mesh::Triangle& t : triangles) {
    const Eigen::Vector3d& a = points[t[0]];
    area += 0.5 * (points[t[1]] - a).cross(points[t[2]] - a).norm();
    area_up_to.push_back(area);
  }
  SurfaceSamples samples;
  samples.points_m.reserve(static_cast<std::size_t>(count));
  samples.parts.reserve(static_cast<std::size_t>(count));
  Random random(kSurfaceSeed);
  std::size_t at = 0;
  for (int i = 0; i < count; ++i) {
    const double target = area * (i + random.NextUnit()) / count;
    while (at + 1 < triangles.size() && area_up_to[at] <= target) ++at;
    double u = random.NextUnit();
    double v = random.NextUnit();
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const Eigen::Vector3d& a = points[triangles[at][0]];
    samples.points_m.emplace_back(a + u * (points[triangles[at][1]] - a) +
                                  v * (points[triangles[at][2]] - a));
    samples.parts.push_back(surface.parts[at]);
  }
  return samples;
}

std::vector<double> SignedDistances(const BoundaryDistance& boundary,
                                    std::span<const Eigen::Vector3d> points_m,
                                    const ThreadPool& pool) {
  std::vector<double> distances(points_m.size());
  pool.ForChunks(points_m.size(), kPointsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) distances[i] = boundary.SignedAt(points_m[i]);
  });
  return distances;
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

void PutSurfaceDistances(const FittedSurface& fitted, const UnionDistance& distance,
                         const MeasureOptions& options, const ThreadPool& pool, Metrics& metrics) {
  const BoundaryDistance boundary(distance, kCreaseGridPoints, pool);
  const SurfaceSamples samples = SampleSurface(fitted, options.surface_samples);
  std::vector<double> signed_m = SignedDistances(boundary, samples.points_m, pool);
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

void PutVertices(const body::Body& body, const FittedSurface& fitted, const UnionDistance& distance,
                 const ThreadPool& pool, Metrics& metrics) {
  std::vector<double> gaps(fitted.vertices.size());
  pool.ForChunks(gaps.size(), kPointsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      // How deep a covered vertex is does not matter here.
      gaps[i] = distance.At(body.mesh.vertices()[fitted.vertices[i]], 0.0).distance_m;
    }
  });
  const auto count = [](double gap, auto& its) {
    its.vertices_out += gap > kOutM ? 1 : 0;
    its.max_out_m = std::max(its.max_out_m, gap);
  };
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    count(gaps[i], metrics);
    const body::Part part = body::PartOf(body.vertex_segments[fitted.vertices[i]]);
    if (PartMetrics* const its = PartOf(part, metrics)) count(gaps[i], *its);
  }
}

}  // namespace

Metrics Measure(const body::Body& body, const capsule::PrimitiveSet& set,
                const MeasureOptions& options, const ThreadPool& pool,
                const FitObserver& observer) {
  Metrics metrics;
  const FittedSurface fitted = MakeFittedSurface(body, options.parts);
  for (std::size_t p = 0; p < metrics.parts.size(); ++p) {
    if (fitted.has_part[p]) metrics.parts[p].emplace();
  }
  PutCounts(set, metrics);
  const UnionDistance distance = DistanceTo(body, set, pool);
  if (observer.IsCancelled()) return metrics;
  PutVolumes(MeasureVolumes(body.mesh, fitted, distance.solids(), PartsOfSolids(set),
                            options.columns, pool),
             metrics);
  if (set.spheres.empty() || fitted.skin_count == 0 || observer.IsCancelled()) return metrics;
  PutSurfaceDistances(fitted, distance, options, pool, metrics);
  if (observer.IsCancelled()) return metrics;
  PutVertices(body, fitted, distance, pool, metrics);
  return metrics;
}

std::vector<double> SignedGaps(const body::Body& body, const capsule::PrimitiveSet& set,
                               const body::PartSelection& parts, const ThreadPool& pool) {
  const UnionDistance distance = DistanceTo(body, set, pool);
  const BoundaryDistance boundary(distance, kCreaseGridPoints, pool);
  std::vector<double> gaps = SignedDistances(boundary, body.mesh.vertices(), pool);
  for (std::size_t v = 0; v < gaps.size(); ++v) {
    if (parts.Includes(body::PartOf(body.vertex_segments[v]))) continue;
    gaps[v] = std::numeric_limits<double>::quiet_NaN();
  }
  return gaps;
}

}  // namespace capfit::metrics
