#include "core/metrics/measure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

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

void PutVolumes(const Volumes& volumes, Metrics& metrics) {
  if (volumes.fitted > 0.0) {
    metrics.outside = volumes.outside / volumes.fitted;
    metrics.uncovered = volumes.uncovered / volumes.fitted;
    metrics.E_r = metrics.outside + metrics.uncovered;
    metrics.volume_ratio = volumes.set / volumes.fitted;
  }
  if (volumes.set > 0.0) metrics.mirror_error = volumes.mirror_xor / volumes.set;
}

// Points spread evenly over the area of the triangles: one in each of `count` equal shares of it,
// taken in the order of the triangles, at a random place.
std::vector<Eigen::Vector3d> SampleSurface(std::span<const Eigen::Vector3d> points,
                                           std::span<const mesh::Triangle> triangles, int count) {
  std::vector<double> area_up_to;
  double area = 0.0;
  for (const mesh::Triangle& t : triangles) {
    const Eigen::Vector3d& a = points[t[0]];
    area += 0.5 * (points[t[1]] - a).cross(points[t[2]] - a).norm();
    area_up_to.push_back(area);
  }
  std::vector<Eigen::Vector3d> samples;
  samples.reserve(static_cast<std::size_t>(count));
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
    samples.push_back(a + u * (points[triangles[at][1]] - a) + v * (points[triangles[at][2]] - a));
  }
  return samples;
}

void PutSurfaceDistances(const FittedSurface& fitted, const UnionDistance& distance,
                         const MeasureOptions& options, const ThreadPool& pool, Metrics& metrics) {
  const BoundaryDistance boundary(distance, kCreaseGridPoints, pool);
  const std::vector<Eigen::Vector3d> samples =
      SampleSurface(fitted.points_m, fitted.skin(), options.surface_samples);
  std::vector<double> distances(samples.size());
  pool.ForChunks(samples.size(), kPointsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) distances[i] = boundary.At(samples[i]);
  });
  double sum = 0.0;
  double worst = 0.0;
  for (const double d : distances) {
    sum += d;
    worst = std::max(worst, d);
  }
  const double percent = 100.0 / fitted.box.diagonal().norm();
  metrics.E_M = percent * sum / static_cast<double>(distances.size());
  metrics.hausdorff = percent * worst;
}

void PutVertices(const body::Body& body, const FittedSurface& fitted, const UnionDistance& distance,
                 const ThreadPool& pool, Metrics& metrics) {
  std::vector<double> gaps(fitted.vertices.size());
  pool.ForChunks(gaps.size(), kPointsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      gaps[i] = distance.At(body.mesh.vertices()[fitted.vertices[i]]).distance_m;
    }
  });
  for (const double gap : gaps) {
    metrics.vertices_out += gap > kOutM ? 1 : 0;
    metrics.max_out_m = std::max(metrics.max_out_m, gap);
  }
}

}  // namespace

Metrics Measure(const body::Body& body, const capsule::PrimitiveSet& set,
                const MeasureOptions& options, const ThreadPool& pool,
                const FitObserver& observer) {
  Metrics metrics;
  metrics.n_p = set.primitive_count();
  const FittedSurface fitted = MakeFittedSurface(body, options.parts);
  const UnionDistance distance = DistanceTo(body, set, pool);
  if (observer.IsCancelled()) return metrics;
  PutVolumes(MeasureVolumes(body.mesh, fitted, distance.solids(), options.columns, pool), metrics);
  if (set.spheres.empty() || fitted.skin_count == 0 || observer.IsCancelled()) return metrics;
  PutSurfaceDistances(fitted, distance, options, pool, metrics);
  if (observer.IsCancelled()) return metrics;
  PutVertices(body, fitted, distance, pool, metrics);
  return metrics;
}

std::vector<double> SignedGaps(const body::Body& body, const capsule::PrimitiveSet& set,
                               const ThreadPool& pool) {
  const UnionDistance distance = DistanceTo(body, set, pool);
  std::vector<double> gaps(body.mesh.vertices().size());
  pool.ForChunks(gaps.size(), kPointsPerChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      gaps[i] = distance.At(body.mesh.vertices()[i]).distance_m;
    }
  });
  return gaps;
}

}  // namespace capfit::metrics
