#include "core/body/find_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/chunk_sums.h"
#include "core/base/status.h"
#include "core/body/body_unit.h"
#include "core/body/coarse_surface.h"
#include "core/body/extremities.h"
#include "core/body/find_parts.h"
#include "core/body/intrinsic_frame.h"
#include "core/body/rig_ends.h"
#include "core/body/shape.h"
#include "core/body/skeleton_names.h"
#include "core/body/surface_graph.h"
#include "core/body/working_copy.h"
#include "core/geometry/snap.h"
#include "core/mesh/surface_sums.h"

namespace capfit::body {
namespace {

constexpr int kMinExtremities = 3;
// Below this the evidence for front and back is thin.
constexpr double kFacingTrust = 0.35;
// Length of an arm along the surface, from where it leaves the trunk: 0.21 of the height without
// hand, 0.26 to 0.33 with.
constexpr double kArmShare = 0.26;
// The way from the top of the head to a hand, as short as what joins them has it: 0.38 to 0.50 of
// the height of bodies cut anywhere between waist and knees.
constexpr double kHeadToHandShare = 0.44;
// A told axis this near to the body's own (5 degrees) is taken as it is. Beyond that the body
// leans, and its own axis serves better: at 13 degrees landmarks were up to 15 cm off along the
// told one.
constexpr double kTakenCosine = 0.99619;
// Beyond this (45 degrees) nobody only leans; as near to the opposite the body is upside down.
constexpr double kToldCosine = 0.70711;

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

// Limbs that hold a wrist or an ankle of the skeleton are of its side.
void NameLimbs(const Extremities& extremities, IntrinsicFrame& frame) {
  const auto name = [&](Tip first, Tip second, bool& first_is_left) {
    const auto& a = extremities.limb(first);
    const auto& b = extremities.limb(second);
    if (a && a->is_left) {
      first_is_left = *a->is_left;
    } else if (b && b->is_left) {
      first_is_left = !*b->is_left;
    }
  };
  name(Tip::kHandA, Tip::kHandB, frame.first_hand_is_left);
  name(Tip::kFootA, Tip::kFootB, frame.first_foot_is_left);
}

// The body as it came and what is known of it before its frame is.
struct Found {
  const WorkingCopy& copy;
  CoarseSurface coarse;
  Rig rig;
  std::optional<SurfaceGraph> graph;
  std::optional<RigEnds> rig_ends;  // nothing where the rig lies elsewhere
  Extremities extremities;
  std::optional<MirrorSurface> mirror;  // nothing where each node is a vertex
};

// Landmarks on the wrong sides mean that front and back are mistaken: the caller knows better, and
// so does a skeleton.
void TurnToToldSides(const BodyOptions& options, const Found& found, IntrinsicFrame& frame) {
  const WorkingCopy& copy = found.copy;
  double agreement = 0.0;
  const bool is_rig_told = options.landmarks.empty() && found.rig_ends.has_value();
  if (is_rig_told) {
    agreement = frame.left.dot(found.rig_ends->left);
    frame.facing_trust = 1.0;
  }
  for (const auto& [id, position] :
       options.landmarks.empty() ? found.rig.landmarks : options.landmarks) {
    if (is_rig_told) break;  // crossed limbs say less than shoulders and hips
    if (MirrorLandmark(id) == id) continue;
    const bool is_left = id < MirrorLandmark(id);
    agreement += (is_left ? 1.0 : -1.0) *
                 (frame.left.dot(copy.frame.FromMesh(position)) - frame.plane_offset);
  }
  if (agreement < 0.0) frame = TurnedAbout(frame);
  if (is_rig_told) NameLimbs(found.extremities, frame);
}

// Height of a body that ends above its legs, from what reaches out of the trunk; rough.
double StatureWithoutLegs(const Extremities& extremities) {
  const std::optional<Limb>& head = extremities.limb(Tip::kHead);
  double sum = 0.0;
  int count = 0;
  for (const Tip tip : {Tip::kHandA, Tip::kHandB}) {
    const std::optional<Limb>& arm = extremities.limb(tip);
    if (!arm) continue;
    const double arm_length = arm->tip_distance - arm->junction;
    sum += head ? (arm_length + head->tip_distance - arm->junction) / kHeadToHandShare
                : arm_length / kArmShare;
    ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

double VolumeOf(const WorkingCopy& copy) {
  double volume = 0.0;
  for (const mesh::Triangle& t : copy.mesh.triangles()) {
    volume += mesh::SignedVolume(copy.points[t[0]], copy.points[t[1]], copy.points[t[2]]);
  }
  return std::abs(volume);
}

// The nodes at the ends of limbs are put where their outermost vertices are.
void PutTipsAtVertices(const WorkingCopy& copy, const SurfaceGraph& graph,
                       const Extremities& extremities, CoarseSurface& coarse) {
  for (const std::optional<Limb>& limb : extremities.limbs) {
    if (!limb) continue;
    Eigen::Vector3d outward = Eigen::Vector3d::Zero();
    for (const std::uint32_t n : graph.Neighbours(limb->tip)) {
      outward += coarse.points[limb->tip] - coarse.points[n];
    }
    const std::span<const std::uint32_t> vertices = coarse.VerticesOf(limb->tip);
    coarse.points[limb->tip] = copy.points[*std::max_element(
        vertices.begin(), vertices.end(), [&](std::uint32_t a, std::uint32_t b) {
          return outward.dot(copy.points[a]) < outward.dot(copy.points[b]);
        })];
  }
}

// The way to the body's frame (upright, in metres, standing at y = 0) from the caller's and from
// the working copy's. The latter is the same for every copy of a body, bit by bit.
struct WaysToBody {
  geometry::Similarity from_caller;
  geometry::Similarity from_copy;
  double stature_m = 0.0;  // a first guess; of the whole body, where there are no legs
};

// Around the centroid.
struct Extent {
  double low = 0.0;
  double high = 0.0;

  Extent& operator+=(const Extent& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
    return *this;
  }
};

absl::StatusOr<WaysToBody> FindWaysToBody(const BodyOptions& options, const WorkingCopy& copy,
                                          const IntrinsicFrame& frame,
                                          const Extremities& extremities, const ThreadPool& pool,
                                          std::vector<Warning>& warnings) {
  const auto extent_of = [&](std::size_t begin, std::size_t end) {
    Extent extent;
    for (std::size_t i = begin; i < end; ++i) {
      const double height = frame.up.dot(copy.points[i]);
      extent += {height, height};
    }
    return extent;
  };
  const auto [low, high] = SumOverChunks(pool, copy.points.size(), Extent{}, extent_of);
  const double stature =
      std::max(extremities.has_whole_leg() ? 0.0 : StatureWithoutLegs(extremities), high - low) *
      copy.frame.unit;
  CAPFIT_ASSIGN_OR_RETURN(const LengthUnit unit, ChooseUnit(options.unit, stature));
  if (options.unit != Unit::kAuto) {
    const double volume = VolumeOf(copy) * copy.frame.unit * copy.frame.unit * copy.frame.unit;
    if (auto warning = JudgeToldUnit(unit, stature, volume)) warnings.push_back(*warning);
  }
  if (unit.unit != Unit::kMetre && options.unit == Unit::kAuto) {
    warnings.push_back(
        {"UNIT_ASSUMED",
         absl::StrCat("taken to be in ", std::string(unit.name), ", which makes the body ",
                      stature * unit.metres, " m tall; name the unit if that is wrong"),
         0});
  }
  WaysToBody ways;
  ways.stature_m = geometry::Snap(stature * unit.metres, geometry::kFineGrid);
  ways.from_copy.rotation.row(0) = frame.left;
  ways.from_copy.rotation.row(1) = frame.up;
  ways.from_copy.rotation.row(2) = frame.forward;
  ways.from_copy.scale = geometry::Snap(copy.frame.unit * unit.metres, geometry::kFineGrid);
  ways.from_copy.translation =
      -ways.from_copy.scale * Eigen::Vector3d(frame.plane_offset, low, 0.0);
  ways.from_caller.rotation = ways.from_copy.rotation * copy.frame.axes;
  ways.from_caller.scale = unit.metres;
  ways.from_caller.translation =
      ways.from_copy.translation - unit.metres * (ways.from_caller.rotation * copy.frame.centroid);
  return ways;
}

// Every room that follows gets the same numbers in the same order, whatever file and frame the body
// came in.
mesh::BodyMesh MeshInBodyFrame(const WorkingCopy& copy, const WaysToBody& ways,
                               const ThreadPool& pool) {
  std::vector<Eigen::Vector3d> vertices(copy.points.size());
  pool.ForChunks(vertices.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) vertices[i] = ways.from_copy.Apply(copy.points[i]);
  });
  return copy.mesh.Transformed(ways.from_caller, std::move(vertices), pool);
}

// The caller's axis, with its sign, that is nearest to a direction of the working copy: "-z".
std::string NearestAxis(const WorkingCopy& copy, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d in_mesh = copy.frame.axes.transpose() * direction;
  Eigen::Index axis = 0;
  in_mesh.cwiseAbs().maxCoeff(&axis);
  return std::string(in_mesh[axis] < 0.0 ? "-" : "") + "xyz"[axis];
}

IntrinsicFrame FrameOf(const Found& found, const std::optional<Eigen::Vector3d>& up,
                       const ThreadPool& pool) {
  return FindIntrinsicFrame(found.copy, found.coarse, found.mirror ? &*found.mirror : nullptr,
                            found.extremities, pool, up, found.rig_ends);
}

// The frame that the surface shows, or, where the told axis is near to its own, that with the told
// axis. A body that stands along another axis may lie in truth: its own frame serves there
// too.
absl::StatusOr<IntrinsicFrame> FrameWithTold(const Eigen::Vector3d& told, const Found& found,
                                             const ThreadPool& pool,
                                             std::vector<Warning>& warnings) {
  const WorkingCopy& copy = found.copy;
  const Eigen::Vector3d up =
      geometry::Snap(copy.frame.axes * told, geometry::kFineGrid).normalized();
  IntrinsicFrame own = FrameOf(found, std::nullopt, pool);
  const double cosine = own.up.dot(up);
  const std::string axis = NearestAxis(copy, up);
  const std::string own_axis = NearestAxis(copy, own.up);
  if (cosine < -kToldCosine) {
    return InvalidField(ErrorReason::kContradictsBody, "mesh.up_axis",
                        absl::StrCat("is ", axis,
                                     ", which points from the head to the feet of this body: it "
                                     "stands along ",
                                     own_axis),
                        {{"value", axis}, {"limit", own_axis}});
  }
  if (cosine < kToldCosine) {
    warnings.push_back(
        {"UP_AXIS_CONTRADICTS_BODY",
         absl::StrCat("the up axis was told to be ", axis, ", the body stands along ", own_axis,
                      " and was fitted so; right for a body that lies down"),
         0});
  }
  if (cosine < kTakenCosine) return own;
  return FrameOf(found, up, pool);
}

absl::StatusOr<IntrinsicFrame> FindFrame(const BodyOptions& options, const Found& found,
                                         const ThreadPool& pool, std::vector<Warning>& warnings) {
  const Extremities& extremities = found.extremities;
  if (extremities.found() < kMinExtremities) {
    return Refused(ErrorReason::kNotABody,
                   absl::StrCat("not a human body: found ", extremities.found(),
                                " of 5 extremities (head, hands, feet)"));
  }
  const std::optional<Eigen::Vector3d> told = UpDirection(options.up);
  IntrinsicFrame frame;
  if (told) {
    CAPFIT_ASSIGN_OR_RETURN(frame, FrameWithTold(*told, found, pool, warnings));
  } else {
    frame = FrameOf(found, std::nullopt, pool);
  }
  TurnToToldSides(options, found, frame);
  return frame;
}

// What the surface tells without a frame, from the coarse surface on.
absl::Status SearchSurface(const ThreadPool& pool, const FitObserver& observer, Found& found) {
  CoarseSurface& coarse = found.coarse;
  const auto find_extremities = [&]() -> absl::Status {
    found.graph.emplace(coarse.points, coarse.triangles, coarse.mates, pool, observer);
    CAPFIT_RETURN_IF_ERROR(CheckCancelled(observer));
    found.rig_ends = FindRigEnds(found.rig, found.copy, coarse, pool);
    CAPFIT_RETURN_IF_ERROR(CheckCancelled(observer));
    found.extremities = FindExtremities(coarse, *found.graph, pool, observer, found.rig_ends);
    return CheckCancelled(observer);
  };
  absl::Status status;
  pool.ForEach(2, [&](std::size_t half) {  // they touch different members
    if (half == 0) status = find_extremities();
    if (half == 1 && coarse.points.size() < found.copy.points.size()) found.mirror.emplace(coarse);
  });
  CAPFIT_RETURN_IF_ERROR(status);
  PutTipsAtVertices(found.copy, *found.graph, found.extremities, coarse);
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<Body> FindBody(const mesh::BodyMesh& mesh, const BodyOptions& options,
                              const ThreadPool& pool, const FitObserver& observer) {
  CAPFIT_RETURN_IF_ERROR(CheckCancelled(observer));
  const WorkingCopy copy = MakeWorkingCopy(mesh, pool, observer);
  CAPFIT_RETURN_IF_ERROR(CheckCancelled(observer));
  Found found = {copy, MakeCoarseSurface(copy, pool), ReadRig(options.skeleton), {}, {}, {}, {}};
  CAPFIT_RETURN_IF_ERROR(CheckCancelled(observer));
  CAPFIT_RETURN_IF_ERROR(SearchSurface(pool, observer, found));
  std::vector<Warning> warnings;
  CAPFIT_ASSIGN_OR_RETURN(const IntrinsicFrame frame, FindFrame(options, found, pool, warnings));
  CAPFIT_RETURN_IF_ERROR(CheckCancelled(observer));
  CAPFIT_ASSIGN_OR_RETURN(const WaysToBody ways,
                          FindWaysToBody(options, copy, frame, found.extremities, pool, warnings));
  if (frame.facing_trust < kFacingTrust) {
    warnings.push_back({"FACING_UNSURE",
                        "front and back look alike; a left or right landmark would tell them", 0});
  }
  for (Eigen::Vector3d& p : found.coarse.points) p = ways.from_copy.Apply(p);
  Body body = {MeshInBodyFrame(copy, ways, pool),
               ways.from_caller,
               0.0,
               false,
               {},
               {},
               {},
               std::move(warnings)};
  CAPFIT_RETURN_IF_ERROR(CheckCancelled(observer));
  body.height_m = body.mesh.box_max().y() - body.mesh.box_min().y();
  CAPFIT_RETURN_IF_ERROR(FindParts(options,
                                   {found.rig, *found.graph, found.coarse, found.extremities, frame,
                                    ways.stature_m, ways.from_copy.scale},
                                   pool, observer, body));
  return body;
}

}  // namespace capfit::body
