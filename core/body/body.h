// A body understood: its own frame, its landmarks, its parts and the curves through their middles.
#ifndef CAPFIT_CORE_BODY_BODY_H_
#define CAPFIT_CORE_BODY_BODY_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/enum_index.h"
#include "core/base/warning.h"
#include "core/body/anatomy.h"
#include "core/geometry/similarity.h"
#include "core/mesh/body_mesh.h"
#include "core/mesh/plane_cutter.h"

namespace capfit::body {

enum class LandmarkMethod { kMeasured, kRatio, kCaller, kSkeleton };

struct Landmark {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  // body frame
  LandmarkMethod method = LandmarkMethod::kMeasured;
  double confidence = 1.0;  // [0, 1]
};

// The medial curve of a chain (paper, III-A): centroids of the level sets of geodesic distance,
// smoothed. Runs from the trunk outward for limbs (shoulder to wrist, hip to ankle) and from the
// crotch up to the middle of the neck for the torso.
struct MedialCurve {
  std::vector<Eigen::Vector3d> points_m;  // at least 2, body frame
  std::vector<double> arc_length_m;       // same size, starts at 0, strictly increasing

  [[nodiscard]] double length_m() const { return arc_length_m.back(); }
  [[nodiscard]] Eigen::Vector3d PointAt(double at_m) const;    // clamped to the ends
  [[nodiscard]] Eigen::Vector3d TangentAt(double at_m) const;  // unit, outward
  // `at_m`: arc length from the start. The inverse: arc length of the point nearest to `point_m`.
  [[nodiscard]] double Project(const Eigen::Vector3d& point_m) const;
};

// The curve through the points; neighbours that coincide are merged. At least two distinct points.
[[nodiscard]] MedialCurve CurveThrough(const std::vector<Eigen::Vector3d>& points_m);

// The shells that a body's mesh was made around, as they came: open, nested, or cutting through
// each other. They, not the mesh, have to be inside of a set. Body frame.
struct ShellSurface {
  std::vector<Eigen::Vector3d> vertices_m;  // those that triangles use
  std::vector<mesh::Triangle> triangles;
  std::vector<Segment> vertex_segments;        // of the mesh's nearest vertex
  std::vector<std::int32_t> vertex_of_source;  // as BodyMesh::vertex_of_source
  std::vector<std::uint32_t> nearest_of_mesh;  // of each of the mesh's vertices the nearest here
};

// What has to be inside of a set: a view.
struct EnclosedSurface {
  std::span<const Eigen::Vector3d> vertices_m;
  std::span<const mesh::Triangle> triangles;
  std::span<const Segment> vertex_segments;
  std::span<const std::int32_t> vertex_of_source;
};

// Body frame: metres, +Y up, facing +Z, the body's left at +X, the symmetry plane at x = 0 and the
// lowest point at y = 0.
struct Body {
  mesh::BodyMesh mesh;                    // in the body frame, in an order of its own
  geometry::Similarity body_from_caller;  // caller's coordinates to the body frame
  double height_m = 0.0;                  // extent along Y
  bool is_symmetric = false;  // surface and pose mirror each other within 1 % of the height
  std::array<std::optional<Landmark>, kLandmarkCount> landmarks;
  std::vector<Segment> vertex_segments;                        // one for each vertex of `mesh`
  std::array<std::optional<MedialCurve>, kChainCount> chains;  // by Part; nothing where missing
  std::vector<Warning> warnings;
  std::optional<ShellSurface> shells = {};  // nothing where `mesh` is the surface that came
  // Of `mesh`, for who cuts it next; nothing where nobody did before.
  std::shared_ptr<const mesh::PlaneCutter> cutter = {};

  // The shells, or the mesh itself.
  [[nodiscard]] EnclosedSurface enclosed() const& {
    if (!shells) {
      return {mesh.vertices(), mesh.triangles(), vertex_segments, mesh.vertex_of_source()};
    }
    return {shells->vertices_m, shells->triangles, shells->vertex_segments,
            shells->vertex_of_source};
  }
  EnclosedSurface enclosed() && = delete;
  [[nodiscard]] const std::optional<Landmark>& landmark(LandmarkId id) const {
    return landmarks[Index(id)];
  }
  [[nodiscard]] const std::optional<MedialCurve>& chain(Part part) const {
    return chains[Index(part)];
  }
};

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_BODY_H_
