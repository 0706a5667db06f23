#include "core/refine/best_fit/boundary_integral.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kGoldenShare = 0.6180339887498949;
constexpr int kMaxSamples = 512;  // on one ring or one end

using Vec3 = Eigen::Vector3d;

// One ring or one end sphere: normals in a local frame, points in space, what is visible.
struct Patch {
  int count = 0;
  double area_m2 = 0.0;  // of one sample
  alignas(32) std::array<float, kMaxSamples> nx, ny, nz, x, y, z, depth, weight;
};

Box BoxOf(const capsule::MirroredSet& graph, const Cone& cone) {
  const geometry::Sphere& a = graph.sphere(cone.node_a);
  const geometry::Sphere& b = graph.sphere(cone.is_sphere ? cone.node_a : cone.node_b);
  const Vec3 ra = Vec3::Constant(a.radius_m);
  const Vec3 rb = Vec3::Constant(b.radius_m);
  return {(a.center_m - ra).cwiseMin(b.center_m - rb), (a.center_m + ra).cwiseMax(b.center_m + rb)};
}

bool Overlap(const Box& a, const Box& b) {
  return (a[0].array() < b[1].array()).all() && (b[0].array() < a[1].array()).all();
}

class Integrator {
 public:
  Integrator(const capsule::MirroredSet& graph, const std::vector<Cone>& cones,
             const BoundaryOptions& options)
      : graph_(graph), cones_(cones), options_(options) {
    result_.gradient_m2.assign(graph.spheres().size(), Eigen::Vector4d::Zero());
    result_.area_m2.assign(graph.spheres().size(), 0.0);
    for (const Cone& cone : cones) boxes_.push_back(BoxOf(graph, cone));
    incident_.resize(graph.spheres().size());
    for (int e = 0; e < graph.capsule_count(); ++e) {
      incident_[U(graph.ends(e)[0])].push_back(e);
      incident_[U(graph.ends(e)[1])].push_back(e);
    }
  }

  BoundaryIntegral Run() {
    for (int e = 0; e < graph_.capsule_count(); ++e) AddSide(e);
    for (int v = 0; v < graph_.sphere_count(); ++v) AddEnd(v);
    FoldImages();
    return std::move(result_);
  }

 private:
  bool IsActive(int v) const { return options_.active == nullptr || (*options_.active)[U(v)]; }

  void AddSide(int e) {
    const Cone& cone = cones_[U(e)];
    if (cone.is_sphere || !graph_.IsCapsuleRepresentative(e)) return;
    if (!IsActive(cone.node_a) && !IsActive(cone.node_b)) return;
    near_.clear();
    for (std::size_t j = 0; j < cones_.size(); ++j) {
      if (j != U(e) && Overlap(boxes_[j], boxes_[U(e)])) near_.push_back(static_cast<int>(j));
    }
    const double side_m = static_cast<double>(cone.cos_half) * cone.length();
    const int rings = std::max(1, static_cast<int>(side_m / options_.spacing_m + 0.5));
    const double images = graph_.is_mirrored() && graph_.ImageOfCapsule(e) != e ? 2.0 : 1.0;
    for (int k = 0; k < rings; ++k) {
      const double shift = Fraction(options_.phase + 0.137 * e + kGoldenShare * k);
      AddRing(cone, (k + shift) / rings, images * side_m / rings, 0.377 * e + kGoldenShare * k);
    }
  }

  // One ring of the cone's side at the share `t` of its axis, standing for `width_m` of the side.
  void AddRing(const Cone& cone, double t, double width_m, double turn) {
    const geometry::Sphere& a = graph_.sphere(cone.node_a);
    const geometry::Sphere& b = graph_.sphere(cone.node_b);
    const Vec3 center = a.center_m + t * (b.center_m - a.center_m);
    const double radius = a.radius_m + t * (b.radius_m - a.radius_m);
    if (!FindOccluders(center, radius)) return;
    const Vec3 axis(cone.ux, cone.uy, cone.uz);
    const Vec3 side =
        (std::abs(axis.x()) < 0.7 ? axis.cross(Vec3::UnitX()) : axis.cross(Vec3::UnitY()))
            .normalized();
    const Vec3 other = axis.cross(side);
    const double around_m = kTwoPi * radius * cone.cos_half;
    patch_.count =
        std::clamp(static_cast<int>(around_m / options_.spacing_m + 0.5), 6, kMaxSamples);
    patch_.area_m2 = around_m / patch_.count * width_m;
    const double step = kTwoPi / patch_.count;
    const double start = (7.13 * options_.phase + turn) * step;
    double c = std::cos(start), s = std::sin(start);
    const double dc = std::cos(step), ds = std::sin(step);
    for (int i = 0; i < patch_.count; ++i) {
      const Vec3 n = cone.sin_half * axis + cone.cos_half * (c * side + s * other);
      SetSample(i, n, center + radius * n);
      const double next = c * dc - s * ds;
      s = s * dc + c * ds;
      c = next;
    }
    const Eigen::Vector4d force = Accumulate();
    Share(cone.node_a, 1.0 - t, force);
    Share(cone.node_b, t, force);
  }

  void AddEnd(int v) {
    if (!graph_.IsRepresentative(v) || !IsActive(v)) return;
    const geometry::Sphere& node = graph_.sphere(v);
    near_.clear();
    for (std::size_t j = 0; j < cones_.size(); ++j) {
      const Cone& cone = cones_[j];
      if (cone.node_a != v && cone.node_b != v) {
        near_.push_back(static_cast<int>(j));
      } else if (cone.is_sphere && cone.node_a != v) {
        return;  // swallowed
      }
    }
    if (!FindOccluders(node.center_m, node.radius_m)) return;
    SpiralOn(node, v);
    for (const int e : incident_[U(v)]) HideBehind(cones_[U(e)], v);
    const Eigen::Vector4d force = Accumulate();
    Share(v, 1.0, force);
  }

  void SpiralOn(const geometry::Sphere& node, int v) {
    const double area = 2.0 * kTwoPi * node.radius_m * node.radius_m;
    const double wanted = area / (options_.spacing_m * options_.spacing_m);
    patch_.count = std::clamp(static_cast<int>(wanted + 0.5), 12, kMaxSamples);
    patch_.area_m2 =
        area / patch_.count * (graph_.IsOnPlane(v) || !graph_.is_mirrored() ? 1.0 : 2.0);
    const double start = kTwoPi * (3.7 * options_.phase + kGoldenShare * v);
    double c = std::cos(start), s = std::sin(start);
    static const double dc = std::cos(kTwoPi * kGoldenShare), ds = std::sin(kTwoPi * kGoldenShare);
    for (int i = 0; i < patch_.count; ++i) {
      const double height = 1.0 - 2.0 * (i + options_.phase) / patch_.count;
      const double across = std::sqrt(std::max(0.0, 1.0 - height * height));
      const Vec3 n(across * c, across * s, height);
      SetSample(i, n, node.center_m + node.radius_m * n);
      const double next = c * dc - s * ds;
      s = s * dc + c * ds;
      c = next;
    }
  }

  // An end shows only beyond the circle where the side of each of its capsules touches it.
  void HideBehind(const Cone& cone, int v) {
    if (cone.is_sphere) return;
    const float sign = cone.node_a == v ? 1.0f : -1.0f;
    for (int i = 0; i < patch_.count; ++i) {
      const float along =
          patch_.nx[U(i)] * cone.ux + patch_.ny[U(i)] * cone.uy + patch_.nz[U(i)] * cone.uz;
      const float hidden = sign * (along - cone.sin_half) > 0.0f ? -1.0f : 1.0f;
      patch_.depth[U(i)] = std::min(patch_.depth[U(i)], hidden);
    }
  }

  void SetSample(int i, const Vec3& normal, const Vec3& point) {
    patch_.nx[U(i)] = static_cast<float>(normal.x());
    patch_.ny[U(i)] = static_cast<float>(normal.y());
    patch_.nz[U(i)] = static_cast<float>(normal.z());
    patch_.x[U(i)] = static_cast<float>(point.x());
    patch_.y[U(i)] = static_cast<float>(point.y());
    patch_.z[U(i)] = static_cast<float>(point.z());
    patch_.depth[U(i)] = 1.0f;
  }

  // Which of near_ may hide something of the sphere; false where one hides all of it.
  bool FindOccluders(const Vec3& center, double radius) {
    occluders_.clear();
    const Eigen::Vector3f c = center.cast<float>();
    const auto r = static_cast<float>(radius);
    for (const int j : near_) {
      const float distance = cones_[U(j)].SignedDistance(c.x(), c.y(), c.z());
      if (distance <= -r) return false;
      if (distance < r) occluders_.push_back(j);
    }
    return true;
  }

  // Sum of weight * (normal, 1) * area over the visible samples; leaves their area in visible_m2_.
  Eigen::Vector4d Accumulate() {
    const int count = patch_.count;
    for (const int j : occluders_) {
      const Cone cone = cones_[U(j)];
      for (int i = 0; i < count; ++i) {
        const float d = cone.SignedDistance(patch_.x[U(i)], patch_.y[U(i)], patch_.z[U(i)]);
        patch_.depth[U(i)] = d < patch_.depth[U(i)] ? d : patch_.depth[U(i)];
      }
    }
    if (options_.body != nullptr) {
      SampleCost(*options_.body, patch_.x.data(), patch_.y.data(), patch_.z.data(), count,
                 patch_.weight.data());
    } else {
      std::fill_n(patch_.weight.begin(), count, 1.0f);
    }
    double seen = 0.0, sw = 0.0, sx = 0.0, sy = 0.0, sz = 0.0;
    for (int i = 0; i < count; ++i) {
      if (patch_.depth[U(i)] < 0.0f) continue;
      const double w = patch_.weight[U(i)];
      seen += 1.0;
      sw += w;
      sx += w * patch_.nx[U(i)];
      sy += w * patch_.ny[U(i)];
      sz += w * patch_.nz[U(i)];
    }
    visible_m2_ = seen * patch_.area_m2;
    return Eigen::Vector4d(sx, sy, sz, sw) * patch_.area_m2;
  }

  void Share(int v, double share, const Eigen::Vector4d& force) {
    result_.gradient_m2[U(v)] += share * force;
    result_.area_m2[U(v)] += share * visible_m2_;
  }

  void FoldImages() {
    if (!graph_.is_mirrored()) return;
    for (int v = 0; v < graph_.sphere_count(); ++v) {
      Eigen::Vector4d& from = result_.gradient_m2[U(v)];
      const int to = graph_.ImageOf(v);
      if (to == v) from[0] = 0.0;
      if (to >= v) continue;
      from[0] = -from[0];
      result_.gradient_m2[U(to)] += from;
      result_.area_m2[U(to)] += result_.area_m2[U(v)];
      from.setZero();
      result_.area_m2[U(v)] = 0.0;
    }
  }

  const capsule::MirroredSet& graph_;
  const std::vector<Cone>& cones_;
  const BoundaryOptions& options_;
  BoundaryIntegral result_;
  std::vector<Box> boxes_;
  std::vector<std::vector<int>> incident_;  // by node: its edges
  std::vector<int> near_;
  std::vector<int> occluders_;
  Patch patch_;
  double visible_m2_ = 0.0;
};

}  // namespace

BoundaryIntegral IntegrateBoundary(const capsule::MirroredSet& graph,
                                   const std::vector<Cone>& cones, const BoundaryOptions& options) {
  return Integrator(graph, cones, options).Run();
}

}  // namespace capfit::refine
