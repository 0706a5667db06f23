// The body in its own frame while it is being understood: what the landmark finders work on.
#ifndef CAPFIT_CORE_BODY_SHAPE_H_
#define CAPFIT_CORE_BODY_SHAPE_H_

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/base/enum_index.h"
#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/body/body.h"
#include "core/body/coarse_surface.h"
#include "core/body/cross_section.h"
#include "core/body/extremities.h"
#include "core/body/limb_profile.h"
#include "core/body/surface_graph.h"

namespace capfit::body {

// Thighs that point to the front or back by less hang down, by more are lifted (25 and 45 degrees).
inline constexpr double kHangingThighRad = 0.44;
inline constexpr double kLiftedThighRad = 0.79;

inline constexpr int kLeft = 0;
inline constexpr int kRight = 1;

// Body frame, metres. The spans outlive the shape.
struct Shape {
  std::span<const Eigen::Vector3d> vertices;  // of the whole mesh
  std::span<const mesh::Triangle> mesh_triangles;
  std::span<const std::uint32_t> first_triangle;  // as the mesh's
  const CutSurface* mesh_surface = nullptr;
  const CoarseSurface* coarse = nullptr;
  std::span<const Eigen::Vector3d> points;    // its nodes: what is searched, and cut in many places
  std::span<const mesh::Triangle> triangles;  // of nodes
  const SurfaceGraph* graph = nullptr;        // of nodes
  const CutSurface* surface = nullptr;        // of nodes
  const ThreadPool* pool = nullptr;
  const FitObserver* observer = nullptr;
  double distance_unit_m = 1.0;  // in which the limbs' distances over the surface are
  double top_m = 0.0;            // extent along Y; the lowest point is at 0
  // Height of the head's top, or of the neck's; top_m without either. Set by FindLandmarks.
  double crown_m = 0.0;
  // Height of the whole body: what is cut off is added, by proportion. Without legs it must be set
  // before landmarks are looked for; with them it follows from the extent.
  bool legs_are_cut = false;  // both, so that they do not tell the stature
  double stature_m = 0.0;
  // By side; nothing where the limb is missing. Profiles run from the tip to the trunk.
  std::array<std::optional<Limb>, 2> arms;
  std::array<std::optional<Limb>, 2> legs;
  std::optional<Limb> head;
  std::array<std::optional<LimbProfile>, 2> arm_profiles;
  std::array<std::optional<LimbProfile>, 2> leg_profiles;
  // The neck: where it leaves the trunk, and its middle (the cut, where there is no head).
  std::optional<Eigen::Vector3d> neck_base_m;
  std::optional<Eigen::Vector3d> neck_middle_m;
  // Lower end of the trunk: the crotch, where there are two legs.
  Eigen::Vector3d trunk_base_m = Eigen::Vector3d::Zero();
  // Whether the limb ends as nature made it, not in a flat cut.
  bool has_head = false;
  std::array<bool, 2> has_hand = {false, false};
  std::array<bool, 2> has_foot = {false, false};
};

// Calls visit(position) for the mesh's vertices that belong to the limb: extreme places among them
// are sharper than among nodes.
template <typename Visit>
void VisitVertices(const Shape& shape, const Limb& limb, const Visit& visit) {
  for (const std::uint32_t node : limb.vertices) {
    for (const std::uint32_t v : shape.coarse->VerticesOf(node)) visit(shape.vertices[v]);
  }
}

// Over the surface, by side, to each node. Both legs must be there.
[[nodiscard]] inline std::array<std::vector<double>, 2> DistancesFromFeet(const Shape& shape) {
  std::array<std::vector<double>, 2> distances;
  shape.pool->ForEach(distances.size(), [&](std::size_t side) {
    distances[side] = shape.graph->Distances(std::array{GeodesicSource{shape.legs[side]->tip, 0.0}},
                                             ThreadPool(1), *shape.observer);
  });
  return distances;
}

// The landmarks while they are being found, by LandmarkId.
using Landmarks = std::array<std::optional<Landmark>, kLandmarkCount>;

// The landmark of a pair on a side: Sided(kLeftWrist, kRight) is the right wrist.
[[nodiscard]] inline std::size_t Sided(LandmarkId left, int side) { return Index(left) + side; }

// Enters a landmark that was found, unless the caller or a skeleton has told it.
inline void Put(Landmarks& landmarks, std::size_t index, const Eigen::Vector3d& position_m,
                double confidence, LandmarkMethod method = LandmarkMethod::kMeasured) {
  std::optional<Landmark>& landmark = landmarks[index];
  if (landmark && (landmark->method == LandmarkMethod::kCaller ||
                   landmark->method == LandmarkMethod::kSkeleton)) {
    return;
  }
  landmark = Landmark{position_m, method, confidence};
}

// +1 on the left, -1 on the right.
[[nodiscard]] inline double SideSign(int side) { return side == kLeft ? 1.0 : -1.0; }

}  // namespace capfit::body

#endif  // CAPFIT_CORE_BODY_SHAPE_H_
