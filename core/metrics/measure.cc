#include "core/metrics/measure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "core/base/chunk_sums.h"
#include "core/base/enum_index.h"
#include "core/metrics/boundary_distance.h"
#include "core/metrics/fitted_surface.h"
#include "core/metrics/volumes.h"
#include "core/tighten/point_grid.h"

namespace capfit::metrics {
namespace {

constexpr std::size_t kTrianglesPerSum = 8192;
// Distances by tighten::PointGrid are good to this.
constexpr double kGridErrorM = 1e-7;
// A vertex counts as out when it is further out than this, in metres: what the paper's pictures, a
// cloth engine's thickness and float rounding cannot tell from touching.
constexpr double kOutM = 1e-4;
// Points at which the solids' surfaces are looked at for creases: 2 to 3 cm apart on a body.
constexpr int kCreaseGridPoints = 4'000;

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
  std::optional<PartMetrics>& found = metrics.parts[Index(part)];
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

// A point of the skin: the shares of the corners of one of its triangles.
struct SurfaceSample {
  std::size_t triangle = 0;
  std::array<double, 3> shares{};
};

// The next of a row of numbers in [0, 1) that fill it evenly, however many are taken.
double NextEven(double step, double& at) {
  at += step;
  if (at >= 1.0) at -= 1.0;
  return at;
}

// Points spread evenly over the area of the skin: one in the middle of each of `count` equal shares
// of it, taken in the order of the triangles.
std::vector<SurfaceSample> SampleSurface(const FittedSurface& surface, int count) {
  // The plane's counterpart of the golden ratio: the pairs fill the unit square evenly.
  constexpr double kStepU = 0.7548776662466927;
  constexpr double kStepV = 0.5698402909980532;
  const std::vector<double>& areas = surface.skin_areas_m2;
  const double step_m2 = std::accumulate(areas.begin(), areas.end(), 0.0) / count;
  std::vector<SurfaceSample> samples;
  samples.reserve(count);
  double at_u = 0.0;
  double at_v = 0.0;
  std::size_t at = 0;
  double area_up_to = areas[0];
  for (int i = 0; i < count; ++i) {
    while (at + 1 < areas.size() && area_up_to <= step_m2 * (i + 0.5)) area_up_to += areas[++at];
    double u = NextEven(kStepU, at_u);
    double v = NextEven(kStepV, at_v);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    samples.push_back({at, {1.0 - u - v, u, v}});
  }
  return samples;
}

tighten::PointGrid VerticesOf(const FittedSurface& fitted) {
  if (fitted.vertices.size() == fitted.points_m.size()) return tighten::PointGrid(fitted.points_m);
  std::vector<Eigen::Vector3d> points_m;
  points_m.reserve(fitted.vertices.size());
  for (const std::uint32_t v : fitted.vertices) points_m.push_back(fitted.points_m[v]);
  return tighten::PointGrid(points_m);
}

// A point's distance, as far as one solid tells: outside that to the union, inside a depth that the
// union's is not less than. What sticks out is told to the last digit.
double SharpDistance(double distance_m, std::int32_t solid, const Eigen::Vector3d& point,
                     const std::vector<geometry::TaperedCapsule>& solids) {
  if (distance_m <= -kGridErrorM) return distance_m;
  return solids[solid].SignedDistance(point);
}

std::vector<double> VertexDistances(const tighten::PointGrid& grid,
                                    const std::vector<geometry::TaperedCapsule>& solids,
                                    const ThreadPool& pool) {
  const tighten::UnionDistances nearest =
      grid.DistancesTo(solids, -std::numeric_limits<double>::infinity(), pool);
  std::vector<double> distances(grid.size(), 0.0);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    distances[grid.order()[i]] =
        SharpDistance(nearest.distance_m[i], nearest.solid[i], grid.point(i), solids);
  }
  return distances;
}

// The same by the mesh's own numbers: 0 for vertices that are not fitted.
std::vector<double> FittedDistances(const MeasureGround& ground,
                                    const tighten::UnionDistances& known,
                                    const std::vector<geometry::TaperedCapsule>& solids,
                                    const ThreadPool& pool) {
  const FittedSurface& fitted = ground.fitted;
  std::vector<double> distances(fitted.points_m.size(), 0.0);
  if (known.distance_m.size() == fitted.vertices.size()) {
    pool.ForChunks(fitted.vertices.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t v = fitted.vertices[i];
        distances[v] =
            SharpDistance(known.distance_m[i], known.solid[i], fitted.points_m[v], solids);
      }
    });
    return distances;
  }
  const std::vector<double> told =
      VertexDistances(ground.vertices ? *ground.vertices : VerticesOf(fitted), solids, pool);
  for (std::size_t i = 0; i < told.size(); ++i) distances[fitted.vertices[i]] = told[i];
  return distances;
}

void CountVertex(double gap, body::Segment segment, Metrics& metrics) {
  if (gap <= 0.0) return;
  const auto count = [gap](auto& its) {
    its.vertices_out += gap > kOutM ? 1 : 0;
    its.max_out_m = std::max(its.max_out_m, gap);
  };
  count(metrics);
  if (PartMetrics* const its = PartOf(body::PartOf(segment), metrics)) count(*its);
}

// Of shells, whose mesh only stands for them, all their own vertices count.
void PutShellVertices(const body::ShellSurface& shells, const body::PartSelection& parts,
                      const std::vector<geometry::TaperedCapsule>& solids, const ThreadPool& pool,
                      Metrics& metrics) {
  const std::vector<double> distances =
      VertexDistances(tighten::PointGrid(shells.vertices_m), solids, pool);
  for (std::size_t v = 0; v < distances.size(); ++v) {
    if (!parts.Includes(body::PartOf(shells.vertex_segments[v]))) continue;
    CountVertex(distances[v], shells.vertex_segments[v], metrics);
  }
}

void PutVertices(const body::Body& body, const FittedSurface& fitted,
                 const std::vector<double>& distances, Metrics& metrics) {
  for (const std::uint32_t vertex : fitted.vertices) {
    CountVertex(distances[vertex], body.vertex_segments[vertex], metrics);
  }
}

// Sums of absolute distances over the skin of one part, or of all: those of the vertices, linear
// between them.
struct LinearGaps {
  double area_m2 = 0.0;
  double linear = 0.0;  // times the area
  double max_m = 0.0;
};

struct GapSums : LinearGaps {
  // Of the samples.
  std::vector<double> signed_m;
  double beyond_linear = 0.0;  // the sum of what their absolute distances are beyond those

  void Add(const GapSums& more) {
    area_m2 += more.area_m2;
    linear += more.linear;
    max_m = std::max(max_m, more.max_m);
    beyond_linear += more.beyond_linear;
    signed_m.insert(signed_m.end(), more.signed_m.begin(), more.signed_m.end());
  }
};
using PartGapSums = std::array<GapSums, body::kPartCount>;

// What the vertices alone tell.
PartGapSums SumVertices(const FittedSurface& fitted, const std::vector<double>& distances,
                        const ThreadPool& pool) {
  const std::span<const mesh::Triangle> skin = fitted.skin();
  std::vector<PartGapSums> chunks((skin.size() + kTrianglesPerSum - 1) / kTrianglesPerSum);
  const std::span<const body::Part> parts = std::span(fitted.parts).subspan(fitted.skin_begin);
  pool.ForChunks(skin.size(), kTrianglesPerSum, [&](std::size_t begin, std::size_t end) {
    PartGapSums& sums = chunks[begin / kTrianglesPerSum];
    // Neighbours in the list are mostly of one part, whose sums so far stay in registers.
    std::size_t part = Index(parts[begin]);
    LinearGaps so_far;
    for (std::size_t t = begin; t < end; ++t) {
      if (Index(parts[t]) != part) {
        static_cast<LinearGaps&>(sums[part]) = so_far;
        part = Index(parts[t]);
        so_far = sums[part];
      }
      const double a = std::abs(distances[skin[t][0]]);
      const double b = std::abs(distances[skin[t][1]]);
      const double c = std::abs(distances[skin[t][2]]);
      so_far.max_m = std::max({so_far.max_m, a, b, c});
      so_far.area_m2 += fitted.skin_areas_m2[t];
      so_far.linear += fitted.skin_areas_m2[t] * (a + b + c) / 3.0;
    }
    static_cast<LinearGaps&>(sums[part]) = so_far;
  });
  PartGapSums total;
  for (const PartGapSums& chunk : chunks) {
    for (std::size_t p = 0; p < total.size(); ++p) total[p].Add(chunk[p]);
  }
  return total;
}

void AddSamples(const FittedSurface& fitted, const std::vector<double>& distances,
                const std::vector<geometry::TaperedCapsule>& solids, int count,
                const ThreadPool& pool, PartGapSums& sums) {
  const std::vector<SurfaceSample> samples = SampleSurface(fitted, count);
  std::vector<Eigen::Vector3d> points_m(samples.size(), Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      points_m[i] += samples[i].shares[k] * fitted.points_m[fitted.skin()[samples[i].triangle][k]];
    }
  }
  const std::vector<double> signed_m =
      BoundaryDistance(solids, kCreaseGridPoints, pool).SignedAt(points_m, pool);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::size_t triangle = samples[i].triangle;
    GapSums& part = sums[Index(fitted.parts[fitted.skin_begin + triangle])];
    part.signed_m.push_back(signed_m[i]);
    part.beyond_linear += std::abs(signed_m[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      part.beyond_linear -= samples[i].shares[k] * std::abs(distances[fitted.skin()[triangle][k]]);
    }
  }
}

// The vertices' linear distances are summed exactly; the samples, few as they are, only have to
// tell what the true ones are beyond them.
template <typename AnyMetrics>
void PutGaps(double diagonal_m, GapSums sums, AnyMetrics& metrics) {
  if (sums.signed_m.empty()) return;
  const auto count = static_cast<double>(sums.signed_m.size());
  const auto out =
      std::count_if(sums.signed_m.begin(), sums.signed_m.end(), [](double d) { return d > kOutM; });
  metrics.surface_out = static_cast<double>(out) / count;
  const double linear_m = sums.area_m2 > 0.0 ? sums.linear / sums.area_m2 : 0.0;
  metrics.gap.mean_m = std::max(0.0, linear_m + sums.beyond_linear / count);
  for (double& d : sums.signed_m) d = std::abs(d);
  metrics.gap.max_m =
      std::max(sums.max_m, *std::max_element(sums.signed_m.begin(), sums.signed_m.end()));
  const auto p95 = sums.signed_m.begin() + static_cast<std::ptrdiff_t>(0.95 * count);
  std::nth_element(sums.signed_m.begin(), p95, sums.signed_m.end());
  metrics.gap.p95_m = *p95;
  metrics.E_M = 100.0 * metrics.gap.mean_m / diagonal_m;
}

void PutSurface(const body::Body& body, const MeasureGround& ground,
                const tighten::UnionDistances& at_vertices,
                const std::vector<geometry::TaperedCapsule>& solids, const MeasureOptions& options,
                const ThreadPool& pool, const FitObserver& observer, Metrics& metrics) {
  const FittedSurface& fitted = ground.fitted;
  const std::vector<double> distances = FittedDistances(ground, at_vertices, solids, pool);
  if (observer.IsCancelled()) return;
  if (body.shells) {
    PutShellVertices(*body.shells, options.parts, solids, pool, metrics);
  } else {
    PutVertices(body, fitted, distances, metrics);
  }
  PartGapSums parts = SumVertices(fitted, distances, pool);
  if (observer.IsCancelled()) return;
  AddSamples(fitted, distances, solids, options.surface_samples, pool, parts);
  const double diagonal_m = fitted.box.diagonal().norm();
  GapSums all;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    all.Add(parts[p]);
    if (metrics.parts[p]) PutGaps(diagonal_m, std::move(parts[p]), *metrics.parts[p]);
  }
  PutGaps(diagonal_m, std::move(all), metrics);
  metrics.hausdorff = 100.0 * metrics.gap.max_m / diagonal_m;
}

}  // namespace

MeasureGround::MeasureGround(const body::Body& body, const MeasureOptions& options,
                             bool knows_vertices, Backlog& backlog)
    : fitted(body, options.parts, backlog),
      columns(MakeColumnGrid({body.mesh.box_min(), body.mesh.box_max()}, options.columns)),
      rows(fitted, columns, backlog) {
  if (knows_vertices) return;
  backlog.Add(1, [this](std::size_t) { vertices = VerticesOf(fitted); });
}

Metrics Measure(const body::Body& body, const capsule::PrimitiveSet& set,
                const MeasureOptions& options, const ThreadPool& pool,
                const FitObserver& observer) {
  Backlog backlog(pool, observer);
  const MeasureGround ground(body, options, /*knows_vertices=*/false, backlog);
  backlog.Finish();
  return Measure(body, ground, set, options, pool, observer);
}

Metrics Measure(const body::Body& body, const MeasureGround& ground,
                const capsule::PrimitiveSet& set, const MeasureOptions& options,
                const ThreadPool& pool, const FitObserver& observer,
                const tighten::UnionDistances& at_vertices) {
  Metrics metrics;
  const FittedSurface& fitted = ground.fitted;
  if (observer.IsCancelled()) return metrics;
  for (std::size_t p = 0; p < metrics.parts.size(); ++p) {
    if (fitted.has_part[p]) metrics.parts[p].emplace();
  }
  PutCounts(set, metrics);
  const std::vector<geometry::TaperedCapsule> solids = capsule::Solids(set);
  const bool has_gaps = !solids.empty() && fitted.skin_begin < fitted.skin_end;
  // Side by side: what one of them cannot share out, the other fills.
  pool.ForEach(has_gaps ? 2 : 1, [&](std::size_t which) {
    if (observer.IsCancelled()) return;
    if (which == 0) {
      PutVolumes(MeasureVolumes({fitted, ground.columns, ground.rows}, solids, PartsOfSolids(set),
                                pool, observer),
                 metrics);
    } else {
      PutSurface(body, ground, at_vertices, solids, options, pool, observer, metrics);
    }
  });
  return metrics;
}

std::vector<double> SignedGaps(const body::Body& body, const capsule::PrimitiveSet& set,
                               const body::PartSelection& parts, const ThreadPool& pool) {
  const std::vector<geometry::TaperedCapsule> solids = capsule::Solids(set);
  const BoundaryDistance boundary(solids, kCreaseGridPoints, pool);
  const body::EnclosedSurface surface = body.enclosed();
  std::vector<double> gaps = boundary.SignedAt(surface.vertices_m, pool);
  for (std::size_t v = 0; v < gaps.size(); ++v) {
    if (parts.Includes(body::PartOf(surface.vertex_segments[v]))) continue;
    gaps[v] = std::numeric_limits<double>::quiet_NaN();
  }
  return gaps;
}

}  // namespace capfit::metrics
