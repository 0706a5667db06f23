#include "core/body/find_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/body/chains.h"
#include "core/body/extremities.h"
#include "core/body/intrinsic_frame.h"
#include "core/body/limb_landmarks.h"
#include "core/body/segments.h"
#include "core/body/shape.h"
#include "core/body/surface_graph.h"
#include "core/body/torso_landmarks.h"

namespace capfit::body {
namespace {

constexpr int kMinExtremities = 3;
// A limb with fewer sections than this (a tenth of the stature long) is none.
constexpr std::size_t kMinStations = 25;

// The mesh without unit and place: area 1, centroid of the volume at the origin.
struct Normalised {
  std::vector<Eigen::Vector3d> points;
  std::vector<double> vertex_areas;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  // caller's frame
  double unit = 1.0;                                   // length 1 here, in the caller's unit
};

Normalised Normalise(const mesh::BodyMesh& mesh) {
  Normalised result;
  const Eigen::Vector3d middle = 0.5 * (mesh.box_min() + mesh.box_max());
  const auto vertices = mesh.vertices();
  result.vertex_areas.assign(vertices.size(), 0.0);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double six_volumes = 0.0;
  for (const mesh::Triangle& t : mesh.triangles()) {
    const Eigen::Vector3d a = vertices[t[0]] - middle;
    const Eigen::Vector3d b = vertices[t[1]] - middle;
    const Eigen::Vector3d c = vertices[t[2]] - middle;
    const double wedge = a.dot(b.cross(c));
    six_volumes += wedge;
    moment += wedge * (a + b + c) / 4.0;
    const double third = (b - a).cross(c - a).norm() / 6.0;
    for (const std::uint32_t v : t) result.vertex_areas[v] += third;
  }
  result.unit = std::sqrt(mesh.area());
  result.centroid = middle + moment / six_volumes;
  result.points.reserve(vertices.size());
  for (const Eigen::Vector3d& v : vertices) {
    result.points.push_back((v - result.centroid) / result.unit);
  }
  return result;
}

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

struct UnitName {
  Unit unit;
  double metres;
  const char* name;
};
constexpr UnitName kUnits[] = {{Unit::kMetre, 1.0, "metres"},
                               {Unit::kCentimetre, 0.01, "centimetres"},
                               {Unit::kMillimetre, 0.001, "millimetres"},
                               {Unit::kInch, 0.0254, "inches"}};
// Heights are judged by their ratio to this one.
constexpr double kUsualHeightM = 1.6;

const UnitName& ChooseUnit(Unit wanted, double height) {
  const UnitName* best = &kUnits[0];
  for (const UnitName& u : kUnits) {
    if (u.unit == wanted) return u;
    if (std::abs(std::log(height * u.metres / kUsualHeightM)) <
        std::abs(std::log(height * best->metres / kUsualHeightM))) {
      best = &u;
    }
  }
  return *best;
}

// Turns the limbs found into left and right ones.
void AssignSides(const Extremities& extremities, const IntrinsicFrame& frame, Shape& shape) {
  const int first_foot = frame.first_is_left ? kLeft : kRight;
  const int first_hand = frame.hands_are_swapped ? 1 - first_foot : first_foot;
  shape.head = extremities.limb(Tip::kHead);
  shape.arms[first_hand] = extremities.limb(Tip::kHandA);
  shape.arms[1 - first_hand] = extremities.limb(Tip::kHandB);
  shape.legs[first_foot] = extremities.limb(Tip::kFootA);
  shape.legs[1 - first_foot] = extremities.limb(Tip::kFootB);
}

// False, and the limb is forgotten, when it is not there or too short to have sections.
bool MakeProfile(const Shape& shape, const Extremities& extremities, std::optional<Limb>& limb,
                 std::optional<LimbProfile>& profile) {
  if (!limb) return false;
  profile = MakeLimbProfile(shape.points, shape.triangles, extremities, *limb, shape.stature_m);
  if (profile->stations.size() < kMinStations) {
    limb.reset();
    profile.reset();
  }
  return limb.has_value();
}

}  // namespace

absl::StatusOr<Body> FindBody(const mesh::BodyMesh& mesh, const BodyOptions& options,
                              const ThreadPool& pool, const FitObserver& observer) {
  (void)pool;
  (void)observer;
  const Normalised normal = Normalise(mesh);
  const SurfaceGraph graph(normal.points, mesh.triangles());
  const Extremities extremities = FindExtremities(normal.points, graph);
  if (extremities.found() < kMinExtremities) {
    return CannotFit("NOT_A_BODY", absl::StrCat("not a human body: found ", extremities.found(),
                                                " of 5 extremities (head, hands, feet)"));
  }
  const auto frame =
      FindIntrinsicFrame(normal.points, normal.vertex_areas, extremities, UpDirection(options.up));
  if (!frame) return CannotFit("NOT_A_BODY", "not a human body: no symmetry plane");
  Eigen::Matrix3d rotation;
  rotation.row(0) = frame->left;
  rotation.row(1) = frame->up;
  rotation.row(2) = frame->forward;
  double low = 0.0;
  double high = 0.0;
  for (const Eigen::Vector3d& p : normal.points) {
    low = std::min(low, frame->up.dot(p));
    high = std::max(high, frame->up.dot(p));
  }
  const UnitName& unit = ChooseUnit(options.unit, (high - low) * normal.unit);
  geometry::Similarity similarity;
  similarity.rotation = rotation;
  similarity.scale = unit.metres;
  similarity.translation =
      -unit.metres *
      (rotation * normal.centroid + normal.unit * Eigen::Vector3d(frame->plane_offset, low, 0.0));
  Body body = {mesh.Transformed(similarity), similarity, 0.0, false, {}, {}, {}, {}};
  body.height_m = (high - low) * normal.unit * unit.metres;
  if (unit.unit != Unit::kMetre && options.unit == Unit::kAuto) {
    body.warnings.push_back({"UNIT_ASSUMED",
                             absl::StrCat("taken to be in ", unit.name, ": the body is then ",
                                          body.height_m, " m tall; name the unit if that is wrong"),
                             0});
  }
  Shape shape;
  shape.points = body.mesh.vertices();
  shape.triangles = body.mesh.triangles();
  shape.graph = &graph;
  shape.top_m = body.height_m;
  shape.stature_m = body.height_m;
  AssignSides(extremities, *frame, shape);
  for (const int side : {kLeft, kRight}) {
    const char* const name = side == kLeft ? "left" : "right";
    if (!MakeProfile(shape, extremities, shape.legs[side], shape.leg_profiles[side])) {
      return CannotFit("PART_MISSING", absl::StrCat("the ", name, " leg was not found (found ",
                                                    extremities.found(), " of 5 extremities)"));
    }
    FindAnkle(shape, side, body.landmarks);
    if (MakeProfile(shape, extremities, shape.arms[side], shape.arm_profiles[side])) {
      FindWrist(shape, side, body.landmarks);
    } else {
      body.warnings.push_back(
          {"PART_MISSING", absl::StrCat("the ", name, " arm was not found; it is left out"), 1});
    }
  }
  FindCrotch(shape, body.landmarks);
  if (!body.landmark(LandmarkId::kCrotch)) {
    return CannotFit("PART_MISSING", "the legs do not part: no crotch found between the knees");
  }
  for (const int side : {kLeft, kRight}) {
    FindThigh(shape, side, body.landmarks);
    if (shape.arms[side]) FindUpperArm(shape, side, body.landmarks);
  }
  FindNeck(shape, body.landmarks);
  FindTrunkSections(shape, body.landmarks);
  body.vertex_segments = LabelVertices(shape, body.landmarks);
  body.chains = BuildChains(shape, body.landmarks);
  return body;
}

}  // namespace capfit::body
