#include "core/body/find_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/body/body_unit.h"
#include "core/body/chains.h"
#include "core/body/extremities.h"
#include "core/body/intrinsic_frame.h"
#include "core/body/landmarks.h"
#include "core/body/mirror.h"
#include "core/body/segments.h"
#include "core/body/shape.h"
#include "core/body/snap.h"
#include "core/body/surface_graph.h"
#include "core/body/working_copy.h"

namespace capfit::body {
namespace {

constexpr int kMinExtremities = 3;
// Below this the evidence for front and back is thin.
constexpr double kFacingTrust = 0.35;

std::optional<Eigen::Vector3d> UpDirection(UpAxis up) {
  switch (up) {
    case UpAxis::kAuto:
      return std::nullopt;
    case UpAxis::kX:
      return Eigen::Vector3d::UnitX();
    case UpAxis::kY:
      return Eigen::Vector3d::UnitY();
    case UpAxis::kZ:
      return Eigen::Vector3d::UnitZ();
  }
  return std::nullopt;
}

// Landmarks on the wrong sides mean that front and back are mistaken: the caller knows better.
void TurnToCallersSides(const BodyOptions& options, const WorkingCopy& copy,
                        IntrinsicFrame& frame) {
  double agreement = 0.0;
  for (const auto& [id, position] : options.landmarks) {
    if (MirrorLandmark(id) == id) continue;
    const bool is_left = id < MirrorLandmark(id);
    agreement +=
        (is_left ? 1.0 : -1.0) * (frame.left.dot(copy.FromMesh(position)) - frame.plane_offset);
  }
  if (agreement < 0.0) frame = TurnedAbout(frame);
}

// The way to the body's frame (upright, in metres, standing at y = 0) from the caller's and from
// the working copy's. The latter is the same for every copy of a body, bit by bit.
struct WaysToBody {
  geometry::Similarity from_caller;
  geometry::Similarity from_copy;
};

absl::StatusOr<WaysToBody> FindWaysToBody(const BodyOptions& options, const WorkingCopy& copy,
                                          const IntrinsicFrame& frame,
                                          std::vector<Warning>& warnings) {
  double low = 0.0;
  double high = 0.0;
  for (const Eigen::Vector3d& p : copy.points) {
    low = std::min(low, frame.up.dot(p));
    high = std::max(high, frame.up.dot(p));
  }
  const double height = (high - low) * copy.unit;
  CAPFIT_ASSIGN_OR_RETURN(const LengthUnit unit, ChooseUnit(options.unit, height));
  if (unit.unit != Unit::kMetre && options.unit == Unit::kAuto) {
    warnings.push_back(
        {"UNIT_ASSUMED",
         absl::StrCat("taken to be in ", std::string(unit.name), ", which makes the body ",
                      height * unit.metres, " m tall; name the unit if that is wrong"),
         0});
  }
  WaysToBody ways;
  ways.from_copy.rotation.row(0) = frame.left;
  ways.from_copy.rotation.row(1) = frame.up;
  ways.from_copy.rotation.row(2) = frame.forward;
  ways.from_copy.scale = Snap(copy.unit * unit.metres, kFineGrid);
  ways.from_copy.translation =
      -ways.from_copy.scale * Eigen::Vector3d(frame.plane_offset, low, 0.0);
  ways.from_caller.rotation = ways.from_copy.rotation * copy.axes;
  ways.from_caller.scale = unit.metres;
  ways.from_caller.translation =
      ways.from_copy.translation - unit.metres * (ways.from_caller.rotation * copy.centroid);
  return ways;
}

mesh::BodyMesh MeshInBodyFrame(const mesh::BodyMesh& mesh, const WorkingCopy& copy,
                               const geometry::Similarity& body_from_copy) {
  std::vector<Eigen::Vector3d> vertices(copy.points.size());
  for (std::size_t i = 0; i < copy.points.size(); ++i) {
    vertices[copy.mesh_vertex[i]] = body_from_copy.Apply(copy.points[i]);
  }
  return mesh::BodyMesh(
      std::move(vertices), std::vector(mesh.triangles().begin(), mesh.triangles().end()),
      std::vector(mesh.vertex_of_source().begin(), mesh.vertex_of_source().end()));
}

// Turns the limbs found into left and right ones.
void AssignSides(const Extremities& extremities, const IntrinsicFrame& frame, Shape& shape) {
  const int first_foot = frame.first_foot_is_left ? kLeft : kRight;
  const int first_hand = frame.first_hand_is_left ? kLeft : kRight;
  shape.head = extremities.limb(Tip::kHead);
  shape.arms[first_hand] = extremities.limb(Tip::kHandA);
  shape.arms[1 - first_hand] = extremities.limb(Tip::kHandB);
  shape.legs[first_foot] = extremities.limb(Tip::kFootA);
  shape.legs[1 - first_foot] = extremities.limb(Tip::kFootB);
}

void EnterCallersLandmarks(const BodyOptions& options, Body& body) {
  for (const auto& [id, position] : options.landmarks) {
    body.landmarks[Index(id)] = Landmark{Snap(body.body_from_caller.Apply(position), kFineGrid),
                                         LandmarkMethod::kCaller, 1.0};
  }
}

absl::StatusOr<IntrinsicFrame> FindFrame(const BodyOptions& options, const WorkingCopy& copy,
                                         const Extremities& extremities) {
  if (extremities.found() < kMinExtremities) {
    return CannotFit("NOT_A_BODY", absl::StrCat("not a human body: found ", extremities.found(),
                                                " of 5 extremities (head, hands, feet)"));
  }
  std::optional<Eigen::Vector3d> up = UpDirection(options.up);
  if (up) up = Snap(copy.axes * *up, kFineGrid).normalized();
  IntrinsicFrame frame = FindIntrinsicFrame(copy.points, copy.vertex_areas, extremities, up);
  if (up && frame.up_agreement < 0.0) {
    return InvalidField("up", "points from the head to the feet of this body");
  }
  TurnToCallersSides(options, copy, frame);
  return frame;
}

}  // namespace

absl::StatusOr<Body> FindBody(const mesh::BodyMesh& mesh, const BodyOptions& options,
                              const ThreadPool& pool, const FitObserver& observer) {
  (void)pool;
  const WorkingCopy copy = MakeWorkingCopy(mesh);
  const SurfaceGraph graph(copy.points, copy.triangles);
  const Extremities extremities = FindExtremities(copy.points, copy.vertex_areas, graph);
  CAPFIT_ASSIGN_OR_RETURN(const IntrinsicFrame frame, FindFrame(options, copy, extremities));
  std::vector<Warning> warnings;
  CAPFIT_ASSIGN_OR_RETURN(const WaysToBody ways, FindWaysToBody(options, copy, frame, warnings));
  if (frame.facing_trust < kFacingTrust) {
    warnings.push_back({"FACING_UNSURE",
                        "front and back look alike; a left or right landmark would tell them", 0});
  }
  Body body = {
      MeshInBodyFrame(mesh, copy, ways.from_copy), ways.from_caller, 0.0, false, {}, {}, {}, {}};
  body.height_m = body.mesh.box_max().y() - body.mesh.box_min().y();
  EnterCallersLandmarks(options, body);

  std::vector<Eigen::Vector3d> points;
  points.reserve(copy.points.size());
  for (const std::uint32_t v : copy.mesh_vertex) points.push_back(body.mesh.vertices()[v]);
  const CutSurface surface(points, copy.triangles);
  Shape shape;
  shape.points = points;
  shape.triangles = copy.triangles;
  shape.graph = &graph;
  shape.surface = &surface;
  shape.top_m = body.height_m;
  AssignSides(extremities, frame, shape);
  CAPFIT_RETURN_IF_ERROR(FindLandmarks(extremities, shape, body.landmarks, warnings));
  if (observer.IsCancelled()) return absl::CancelledError("cancelled while finding landmarks");
  body.is_symmetric = IsSymmetric(shape, body.landmarks);
  if (body.is_symmetric) {
    Symmetrise(body.landmarks);
    Symmetrise(shape);
  }
  const std::vector<Segment> segments = LabelVertices(shape, body.landmarks);
  body.vertex_segments.resize(segments.size());
  for (std::size_t v = 0; v < segments.size(); ++v) {
    body.vertex_segments[copy.mesh_vertex[v]] = segments[v];
  }
  body.chains = BuildChains(shape, body.landmarks);
  if (body.is_symmetric) Symmetrise(body.chains);
  body.warnings = std::move(warnings);
  return body;
}

}  // namespace capfit::body
