// Meshes and bodies made on the spot for the tests of core/section.
#ifndef CAPFIT_TESTS_CORE_SECTION_SHAPES_H_
#define CAPFIT_TESTS_CORE_SECTION_SHAPES_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/enum_index.h"
#include "core/body/body.h"
#include "core/mesh/body_mesh.h"

namespace capfit::section {

inline constexpr double kPi = std::numbers::pi;

// Vertices and triangles that grow piece by piece.
struct MeshParts {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<mesh::Triangle> triangles;

  [[nodiscard]] mesh::BodyMesh Build() const {
    std::vector<std::int32_t> sources(vertices.size());
    for (std::size_t i = 0; i < sources.size(); ++i) sources[i] = static_cast<std::int32_t>(i);
    return {vertices, triangles, sources};
  }
};

// A closed tube around the straight line from `from` to `to`: rings of `sides` vertices with the
// half axes that `half_axes(t)` gives along `x_axis` and across, t in [0, 1], and flat ends.
inline void AddTube(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                    const Eigen::Vector3d& x_axis,
                    const std::function<Eigen::Vector2d(double)>& half_axes, int rings, int sides,
                    MeshParts& mesh) {
  const Eigen::Vector3d along = (to - from).normalized();
  const Eigen::Vector3d y_axis = along.cross(x_axis);
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto index = [&](int ring, int side) {
    return base + static_cast<std::uint32_t>(ring * sides + side % sides);
  };
  for (int ring = 0; ring <= rings; ++ring) {
    const double t = static_cast<double>(ring) / rings;
    const Eigen::Vector2d half = half_axes(t);
    for (int side = 0; side < sides; ++side) {
      const double a = 2.0 * kPi * side / sides;
      mesh.vertices.push_back(from + t * (to - from) + half.x() * std::cos(a) * x_axis +
                              half.y() * std::sin(a) * y_axis);
    }
  }
  for (int ring = 0; ring < rings; ++ring) {
    for (int side = 0; side < sides; ++side) {
      mesh.triangles.push_back({index(ring, side), index(ring, side + 1), index(ring + 1, side)});
      mesh.triangles.push_back(
          {index(ring + 1, side), index(ring, side + 1), index(ring + 1, side + 1)});
    }
  }
  const auto bottom = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(from);
  mesh.vertices.push_back(to);
  for (int side = 0; side < sides; ++side) {
    mesh.triangles.push_back({bottom, index(0, side + 1), index(0, side)});
    mesh.triangles.push_back({bottom + 1, index(rings, side), index(rings, side + 1)});
  }
}

inline mesh::BodyMesh Sphere(double radius, int rings, int sides) {
  MeshParts mesh;
  AddTube(
      {0, -radius, 0}, {0, radius, 0}, Eigen::Vector3d::UnitX(),
      [=](double t) {
        const double r = radius * std::sqrt(std::max(1e-6, 1.0 - (2 * t - 1) * (2 * t - 1)));
        return Eigen::Vector2d(r, r);
      },
      rings, sides, mesh);
  return mesh.Build();
}

inline mesh::BodyMesh Torus(double radius, double tube, int around, int sides) {
  MeshParts mesh;
  const auto index = [&](int i, int j) {
    return static_cast<std::uint32_t>((i % around) * sides + j % sides);
  };
  for (int i = 0; i < around; ++i) {
    const double a = 2 * kPi * i / around;
    for (int j = 0; j < sides; ++j) {
      const double b = 2 * kPi * j / sides;
      const double r = radius + tube * std::cos(b);
      mesh.vertices.emplace_back(r * std::cos(a), tube * std::sin(b), r * std::sin(a));
    }
  }
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < sides; ++j) {
      mesh.triangles.push_back({index(i, j), index(i, j + 1), index(i + 1, j)});
      mesh.triangles.push_back({index(i + 1, j), index(i, j + 1), index(i + 1, j + 1)});
    }
  }
  return mesh.Build();
}

inline body::MedialCurve StraightCurve(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  body::MedialCurve curve;
  for (int i = 0; i <= 10; ++i) {
    curve.points_m.push_back(from + 0.1 * i * (to - from));
    curve.arc_length_m.push_back(0.1 * i * (to - from).norm());
  }
  return curve;
}

// A stick figure of separate tubes, mirrored in x = 0: a trunk 0.3 m by 0.2 m with level arms of
// radius 0.04 m and straight legs of radius 0.07 m. Height 1.6 m, crotch at 0.7 m.
inline body::Body StickFigure() {
  using body::LandmarkId;
  using body::Part;
  using body::Segment;
  MeshParts mesh;
  std::vector<Segment> segments;
  body::Body body{mesh::BodyMesh({}, {}, {}), {}, 1.6, true, {}, {}, {}, {}};
  const auto add = [&](Part part, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                       const Eigen::Vector3d& x_axis, const Eigen::Vector2d& half, Segment near,
                       Segment far) {
    const std::size_t first = mesh.vertices.size();
    AddTube(
        from, to, x_axis, [&](double) { return half; }, 16, 32, mesh);
    for (std::size_t v = first; v < mesh.vertices.size(); ++v) {
      const double t = (mesh.vertices[v] - from).dot(to - from) / (to - from).squaredNorm();
      segments.push_back(t < 0.5 ? near : far);
    }
    body.chains[Index(part)] = StraightCurve(from, to);
  };
  const auto set = [&](LandmarkId id, const Eigen::Vector3d& at) {
    body.landmarks[Index(id)] = body::Landmark{at};
  };
  add(Part::kTorso, {0, 0.7, 0}, {0, 1.4, 0}, {1, 0, 0}, {0.15, 0.1}, Segment::kTorso,
      Segment::kTorso);
  for (const double side : {1.0, -1.0}) {
    const bool left = side > 0;
    add(left ? Part::kLeftArm : Part::kRightArm, {side * 0.2, 1.3, 0}, {side * 0.7, 1.3, 0},
        {0, 1, 0}, {0.04, 0.04}, left ? Segment::kLeftUpperArm : Segment::kRightUpperArm,
        left ? Segment::kLeftForearm : Segment::kRightForearm);
    add(left ? Part::kLeftLeg : Part::kRightLeg, {side * 0.08, 0.69, 0}, {side * 0.08, 0.05, 0},
        {1, 0, 0}, {0.07, 0.07}, left ? Segment::kLeftThigh : Segment::kRightThigh,
        left ? Segment::kLeftCalf : Segment::kRightCalf);
    set(left ? LandmarkId::kLeftArmpit : LandmarkId::kRightArmpit, {side * 0.22, 1.26, 0});
    set(left ? LandmarkId::kLeftElbow : LandmarkId::kRightElbow, {side * 0.45, 1.3, 0});
    set(left ? LandmarkId::kLeftShoulder : LandmarkId::kRightShoulder, {side * 0.2, 1.3, 0});
    set(left ? LandmarkId::kLeftKnee : LandmarkId::kRightKnee, {side * 0.08, 0.4, 0});
  }
  set(LandmarkId::kCrotch, {0, 0.7, 0});
  set(LandmarkId::kWaist, {0, 1.0, 0});
  set(LandmarkId::kBust, {0, 1.2, 0});
  body.mesh = mesh.Build();
  body.vertex_segments = std::move(segments);
  return body;
}

}  // namespace capfit::section

#endif  // CAPFIT_TESTS_CORE_SECTION_SHAPES_H_
