#include "core/refine/best_fit/boundary_integral.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
// Spheres may move so far before what may be near is looked up anew: some steps at the highest
// rate, and little beside the size of most capsules.
constexpr double kMarginM = 0.02;
// Patches are dealt out to so many workers, however many threads there are; few are not worth it.
constexpr std::size_t kWorkers = 4;
constexpr std::size_t kFewPatches = 24;
// Rings of thin capsules, whose samples are close, lie no further apart than so many spacings.
constexpr double kWidestRing = 1.6;

Eigen::AlignedBox3d BoxOf(const capsule::MirroredSet& graph, int a, int b) {
  const auto ball = [&](int v) {
    const geometry::Sphere& sphere = graph.sphere(v);
    const Vec3 reach = Vec3::Constant(sphere.radius_m + kMarginM);
    return Eigen::AlignedBox3d(sphere.center_m - reach, sphere.center_m + reach);
  };
  return ball(a).merged(ball(b));
}

Frame FrameAlong(const Eigen::Vector3f& axis, double turn) {
  const Eigen::Vector3f first = axis.unitOrthogonal();
  const Frame frame{axis, first, axis.cross(first)};
  return frame.Turned(static_cast<float>(std::cos(turn)), static_cast<float>(std::sin(turn)));
}

void AddShare(int v, double area_m2, const BoundarySamples::Sums& sums, BoundaryIntegral& result) {
  result.gradient_m2[v] += area_m2 * sums.force;
  result.area_m2[v] += area_m2 * sums.seen;
}

}  // namespace

BoundaryIntegrator::BoundaryIntegrator(const capsule::MirroredSet& graph,
                                       const BoundaryOptions& options)
    : graph_(graph), options_(options), incident_(graph.spheres().size()) {
  for (int e = 0; e < graph.capsule_count(); ++e) {
    incident_[graph.ends(e)[0]].push_back(e);
    incident_[graph.ends(e)[1]].push_back(e);
  }
}

const BoundaryIntegral& BoundaryIntegrator::Integrate(double phase, const ThreadPool& pool) {
  phase_ = phase;
  FindCones(graph_, cones_);
  if (HaveMovedFar()) FindPatches();
  pool.ForEach(workers_.size(), [&](std::size_t w) {
    Worker& worker = workers_[w];
    worker.sum.gradient_m2.assign(graph_.spheres().size(), Eigen::Vector4d::Zero());
    worker.sum.area_m2.assign(graph_.spheres().size(), 0.0);
    // Neighbours on the body cost alike: every worker gets some of all.
    for (std::size_t i = w; i < patches_.size(); i += workers_.size()) {
      patches_[i].is_side ? AddSide(patches_[i], worker) : AddEnd(patches_[i], worker);
    }
  });
  AddUp();
  FoldImages();
  return result_;
}

bool BoundaryIntegrator::IsActive(int v) const {
  return options_.active == nullptr || (*options_.active)[v] != 0;
}

bool BoundaryIntegrator::HaveMovedFar() const {
  if (looked_up_at_.empty()) return true;
  for (std::size_t v = 0; v < looked_up_at_.size(); ++v) {
    const geometry::Sphere& now = graph_.spheres()[v];
    const geometry::Sphere& then = looked_up_at_[v];
    const double moved_m = (now.center_m - then.center_m).cwiseAbs().maxCoeff();
    if (moved_m + std::abs(now.radius_m - then.radius_m) > kMarginM) return true;
  }
  return false;
}

void BoundaryIntegrator::FindPatches() {
  looked_up_at_ = graph_.spheres();
  patches_.clear();
  const int capsules = graph_.capsule_count();
  std::vector<Eigen::AlignedBox3d> boxes;
  for (int e = 0; e < capsules; ++e) {
    boxes.push_back(BoxOf(graph_, graph_.ends(e)[0], graph_.ends(e)[1]));
  }
  for (std::size_t j = boxes.size(); j < cones_.size(); ++j) {
    boxes.push_back(BoxOf(graph_, cones_[j].node_a, cones_[j].node_a));
  }
  const auto add = [&](int index, bool is_side, const Eigen::AlignedBox3d& box,
                       const auto& is_own) {
    Patch& patch = patches_.emplace_back(Patch{index, is_side, {}});
    for (std::size_t j = 0; j < boxes.size(); ++j) {
      if (boxes[j].intersects(box) && !is_own(j)) patch.near.push_back(static_cast<int>(j));
    }
  };
  for (int e = 0; e < capsules; ++e) {
    if (!graph_.IsCapsuleRepresentative(e)) continue;
    if (!IsActive(graph_.ends(e)[0]) && !IsActive(graph_.ends(e)[1])) continue;
    add(e, true, boxes[e], [&](int j) { return j == e; });
  }
  for (int v = 0; v < graph_.sphere_count(); ++v) {
    if (!graph_.IsRepresentative(v) || !IsActive(v)) continue;
    add(v, false, BoxOf(graph_, v, v),
        [&](std::size_t j) { return cones_[j].node_a == v || cones_[j].node_b == v; });
  }
  workers_.resize(patches_.size() < kFewPatches ? 1 : kWorkers);
}

int BoundaryIntegrator::RingsOn(const Cone& cone) const {
  const double length = cone.length();
  const double side_m = cone.cos_half * length;
  const double around_m = kPi * cone.cos_half * (2.0 * cone.radius + length * cone.radius_slope);
  const double count = BoundarySamples::CountFor(around_m / options_.spacing_m);
  const double by_area = side_m * around_m / (count * options_.spacing_m * options_.spacing_m);
  const double by_length = side_m / (kWidestRing * options_.spacing_m);
  return std::max(1, static_cast<int>(std::max(by_area, by_length) + 0.5));
}

void BoundaryIntegrator::AddSide(const Patch& patch, Worker& worker) const {
  const int e = patch.index;
  const Cone& cone = cones_[e];
  if (cone.is_sphere) return;
  static const auto cosine = static_cast<float>(std::cos(2.0 * kPi * kGoldenShare));
  static const auto sine = static_cast<float>(std::sin(2.0 * kPi * kGoldenShare));
  const int count = RingsOn(cone);
  const double width_m = static_cast<double>(cone.cos_half) * cone.length() / count;
  Frame frame = FrameAlong({cone.ux, cone.uy, cone.uz}, 2.0 * kPi * (7.13 * phase_ + 0.377 * e));
  for (int first = 0; first < count; first += BoundarySamples::kLane) {
    Rings rings;
    rings.count = std::min(count - first, BoundarySamples::kLane);
    for (int k = 0; k < BoundarySamples::kLane; ++k) {
      const double shift = Fraction(phase_ + 0.137 * e + kGoldenShare * (first + k));
      const double t = (first + k + shift) / count;
      const auto foot = static_cast<float>(t) * cone.length();
      rings.t[k] = static_cast<float>(t);
      rings.x[k] = cone.ax + foot * cone.ux;
      rings.y[k] = cone.ay + foot * cone.uy;
      rings.z[k] = cone.az + foot * cone.uz;
      rings.radius[k] = cone.radius + foot * cone.radius_slope;
    }
    MeasureRings(patch, rings, worker);
    for (std::size_t k = 0; k < rings.count; ++k) {
      AddRing(patch, rings, k, width_m, frame, worker);
      frame = frame.Turned(cosine, sine);
    }
  }
}

void BoundaryIntegrator::MeasureRings(const Patch& patch, const Rings& rings,
                                      Worker& worker) const {
  worker.ring_occluders.clear();
  worker.ring_distances_m.clear();
  for (const int j : patch.near) {
    const Cone cone = cones_[j];
    alignas(32) Lane distance;
    alignas(32) Lane gap;
    for (std::size_t k = 0; k < distance.size(); ++k) {
      distance[k] = cone.SignedDistance(rings.x[k], rings.y[k], rings.z[k]);
      gap[k] = distance[k] - rings.radius[k];
    }
    for (std::size_t half = gap.size() / 2; half > 0; half /= 2) {
      for (std::size_t k = 0; k < half; ++k) gap[k] = std::min(gap[k], gap[k + half]);
    }
    if (gap[0] >= 0.0f) continue;
    worker.ring_occluders.push_back(j);
    worker.ring_distances_m.push_back(distance);
  }
}

void BoundaryIntegrator::AddRing(const Patch& patch, const Rings& rings, std::size_t k,
                                 double width_m, const Frame& frame, Worker& worker) const {
  const Cone& cone = cones_[patch.index];
  const float radius = rings.radius[k];
  worker.occluders.clear();
  for (std::size_t n = 0; n < worker.ring_occluders.size(); ++n) {
    const float distance = worker.ring_distances_m[n][k];
    if (distance <= -radius) return;
    if (distance < radius) worker.occluders.push_back(worker.ring_occluders[n]);
  }
  const double around_m = 2.0 * kPi * radius * cone.cos_half;
  const int count = BoundarySamples::CountFor(around_m / options_.spacing_m);
  worker.samples.PlaceRing(count, {rings.x[k], rings.y[k], rings.z[k]}, radius,
                           {cone.sin_half, cone.cos_half}, frame);
  for (const int j : worker.occluders) worker.samples.HideBehind(cones_[j]);
  const bool has_image = graph_.is_mirrored() && graph_.ImageOfCapsule(patch.index) != patch.index;
  const double area_m2 = (has_image ? 2.0 : 1.0) * around_m * width_m / count;
  const BoundarySamples::Sums sums = worker.samples.Collect(options_.body);
  AddShare(cone.node_a, (1.0 - rings.t[k]) * area_m2, sums, worker.sum);
  AddShare(cone.node_b, rings.t[k] * area_m2, sums, worker.sum);
}

void BoundaryIntegrator::AddEnd(const Patch& patch, Worker& worker) const {
  const int v = patch.index;
  if (!FindOccluders(patch, worker.occluders)) return;
  // Each capsule hides the end beyond the circle where its side touches it. The one that hides most
  // becomes the axis of the samples, all of which lie below that circle.
  const auto height_of = [&](const Cone& cone) {
    return cone.node_a == v ? cone.sin_half : -cone.sin_half;
  };
  const auto axis_of = [&](const Cone& cone) {
    const float sign = cone.node_a == v ? 1.0f : -1.0f;
    return Eigen::Vector3f(sign * cone.ux, sign * cone.uy, sign * cone.uz);
  };
  float top = 1.0f;
  int most = -1;
  for (const int e : incident_[v]) {
    const Cone& cone = cones_[e];
    if (!cone.is_sphere && height_of(cone) < top) top = height_of(cone), most = e;
  }
  const Eigen::Vector3f axis =
      most < 0 ? Eigen::Vector3f(Eigen::Vector3f::UnitZ()) : axis_of(cones_[most]);
  const geometry::Sphere& sphere = graph_.sphere(v);
  const double area_m2 = 2.0 * kPi * (1.0 + top) * sphere.radius_m * sphere.radius_m;
  const int count = BoundarySamples::CountFor(area_m2 / (options_.spacing_m * options_.spacing_m));
  worker.samples.PlaceSpiral(count, sphere, top, phase_,
                             FrameAlong(axis, 2.0 * kPi * (3.7 * phase_ + kGoldenShare * v)));
  for (const int e : incident_[v]) {
    const Cone& cone = cones_[e];
    if (e != most && !cone.is_sphere) worker.samples.HideBeyond(axis_of(cone), height_of(cone));
  }
  for (const int j : worker.occluders) worker.samples.HideBehind(cones_[j]);
  const bool has_image = graph_.is_mirrored() && !graph_.IsOnPlane(v);
  AddShare(v, (has_image ? 2.0 : 1.0) * area_m2 / count, worker.samples.Collect(options_.body),
           worker.sum);
}

// What may hide something of an end; false where all of it is hidden.
bool BoundaryIntegrator::FindOccluders(const Patch& patch, std::vector<int>& occluders) const {
  const int v = patch.index;
  for (const int e : incident_[v]) {
    if (cones_[e].is_sphere && cones_[e].node_a != v) return false;
  }
  occluders.clear();
  const Eigen::Vector3f center = graph_.sphere(v).center_m.cast<float>();
  const auto radius = static_cast<float>(graph_.sphere(v).radius_m);
  for (const int j : patch.near) {
    const float distance = cones_[j].SignedDistance(center.x(), center.y(), center.z());
    if (distance <= -radius) return false;
    if (distance < radius) occluders.push_back(j);
  }
  return true;
}

void BoundaryIntegrator::AddUp() {
  result_ = workers_.front().sum;
  for (std::size_t w = 1; w < workers_.size(); ++w) {
    for (std::size_t v = 0; v < result_.area_m2.size(); ++v) {
      result_.gradient_m2[v] += workers_[w].sum.gradient_m2[v];
      result_.area_m2[v] += workers_[w].sum.area_m2[v];
    }
  }
}

void BoundaryIntegrator::FoldImages() {
  if (!graph_.is_mirrored()) return;
  for (int v = 0; v < graph_.sphere_count(); ++v) {
    Eigen::Vector4d& from = result_.gradient_m2[v];
    const int to = graph_.ImageOf(v);
    if (to == v) from[0] = 0.0;
    if (to >= v) continue;
    from[0] = -from[0];
    result_.gradient_m2[to] += from;
    result_.area_m2[to] += result_.area_m2[v];
    from.setZero();
    result_.area_m2[v] = 0.0;
  }
}

BoundaryIntegral IntegrateBoundary(const capsule::MirroredSet& graph,
                                   const BoundaryOptions& options, double phase) {
  return BoundaryIntegrator(graph, options).Integrate(phase, ThreadPool(1));
}

}  // namespace capfit::refine
