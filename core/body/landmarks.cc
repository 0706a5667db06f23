#include "core/body/landmarks.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/enum_index.h"
#include "core/base/status.h"
#include "core/body/limb_landmarks.h"
#include "core/body/shoulder_landmarks.h"
#include "core/body/torso_landmarks.h"

namespace capfit::body {
namespace {

// A limb with fewer sections than this is none.
constexpr std::size_t kMinStations = 16;
// Length along the surface, in units of the square root of the area, from the place where the arms
// join to the top of the head (0.19 to 0.28) or to a cut through the neck (0.08).
constexpr double kHeadLength = 0.135;
// Of an upper body, as a share of the stature: 0.09 to 0.15, and 0.07.
constexpr double kHeadLengthOfUpperBody = 0.08;
// The section that stands for the lower end of a trunk without legs is taken this far above it, as
// a share of the stature.
constexpr double kAboveTrunkEnd = 0.02;
// A body whose parts add up to this much more than it stands high sits or squats.
constexpr double kClearlyFolded = 1.06;
// Along the surface a leg is about 1.65 times as long as an arm.
constexpr double kLeastLegOfArm = 1.5;
// Shares of the stature that are gone where head or feet are cut off at mid-neck and ankle.
constexpr double kHeadShare = 0.122;
constexpr double kFootShare = 0.055;

const char* SideName(int side) { return side == kLeft ? "left" : "right"; }

// Forgets the limb when it is too short to have sections.
void MakeProfile(const Shape& shape, const Extremities& extremities, std::optional<Limb>& limb,
                 std::optional<LimbProfile>& profile) {
  if (!limb) return;
  profile = MakeLimbProfile(shape.points, shape.triangles, extremities, *limb, shape.stature_m);
  if (profile->stations.size() >= kMinStations) return;
  limb.reset();
  profile.reset();
}

// The distance fields that limbs are measured by.
struct Fields {
  const Extremities* body = nullptr;
  std::array<Extremities, 2> legs;  // empty but for legs that begin too far down
};

void MakeProfiles(const Fields& fields, Shape& shape) {
  // Legs take longest and come first.
  shape.pool->ForEach(4, [&](std::size_t limb) {
    if (shape.observer->IsCancelled()) return;
    const std::size_t side = limb % 2;
    const Extremities& leg = fields.legs[side].distance.empty() ? *fields.body : fields.legs[side];
    if (limb < 2) MakeProfile(shape, leg, shape.legs[side], shape.leg_profiles[side]);
    if (limb >= 2) MakeProfile(shape, *fields.body, shape.arms[side], shape.arm_profiles[side]);
  });
}

double Length(const Limb& limb) { return limb.tip_distance - limb.junction; }

// On a lap the way from the waist to the knee is short, and the leg seems to begin there.
bool LegsBeginTooFarDown(const Shape& shape) {
  double arms = 0.0;
  double leg = 0.0;  // the longer one: the other may be cut off
  for (const int side : {kLeft, kRight}) {
    if (!shape.legs[side] || !shape.arms[side]) return false;
    arms += 0.5 * Length(*shape.arms[side]);
    leg = std::max(leg, Length(*shape.legs[side]));
  }
  return leg < kLeastLegOfArm * arms;
}

// Instead, all that is nearer to a foot than where the ways from both feet meet: the inner sides of
// the legs lead to the crotch however they are lifted.
void MeasureLegsFromFeet(Shape& shape, Fields& fields) {
  std::array<std::vector<double>, 2> from_foot = DistancesFromFeet(shape);
  for (const int side : {kLeft, kRight}) {
    if (!IsCutShort(shape.legs, side)) continue;
    // As if it were as long as the other.
    const double missing = shape.legs[1 - side]->tip_distance - shape.legs[side]->tip_distance;
    for (double& distance : from_foot[side]) distance += missing;
  }
  double meeting = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < shape.points.size(); ++v) {
    meeting = std::min(meeting, std::max(from_foot[kLeft][v], from_foot[kRight][v]));
  }
  for (const int side : {kLeft, kRight}) {
    const std::uint32_t tip = shape.legs[side]->tip;
    Limb limb = {tip, 0.0, meeting - from_foot[side][tip], {}, {}};
    std::vector<double>& distance = fields.legs[side].distance;
    distance.resize(shape.points.size());
    for (std::uint32_t v = 0; v < distance.size(); ++v) {
      distance[v] = meeting - from_foot[side][v];
      if (distance[v] > 0.0 && from_foot[side][v] < from_foot[1 - side][v]) {
        limb.vertices.push_back(v);
      }
    }
    shape.legs[side] = std::move(limb);
  }
}

void FindEnds(Shape& shape, Landmarks& landmarks) {
  for (const int side : {kLeft, kRight}) {
    if (shape.legs[side]) FindAnkle(shape, side, landmarks);
    if (shape.arms[side]) FindWrist(shape, side, landmarks);
  }
}

// What head and feet would add to the extent. Without legs, or with what is left of them, arms and
// head have told it.
double Stature(const Shape& shape) {
  const bool has_legs = shape.legs[kLeft] || shape.legs[kRight];
  if (!has_legs || shape.legs_are_cut) return shape.stature_m;
  double share = 1.0;
  if (!shape.has_head) share -= kHeadShare;
  if (!shape.has_foot[kLeft] && !shape.has_foot[kRight]) share -= kFootShare;
  return shape.crown_m / share;
}

// Hands may be higher.
double CrownHeight(const Shape& shape) {
  if (!shape.head) return shape.top_m;
  double crown = 0.0;
  VisitVertices(shape, *shape.head,
                [&](const Eigen::Vector3d& p) { crown = std::max(crown, p.y()); });
  return crown;
}

bool HasHead(const Shape& shape) {
  if (!shape.head) return false;
  const double length = shape.head->tip_distance - shape.head->junction;
  const bool has_legs = shape.legs[kLeft] || shape.legs[kRight];
  return has_legs ? length > kHeadLength
                  : length * shape.distance_unit_m > kHeadLengthOfUpperBody * shape.stature_m;
}

void WarnOfMissing(const std::string& what, const std::string& consequence,
                   std::vector<Warning>& warnings) {
  warnings.push_back({"PART_MISSING", what + "; " + consequence, 1});
}

void WarnOfMissingLimbs(const Shape& shape, std::vector<Warning>& warnings) {
  for (const int side : {kLeft, kRight}) {
    const std::string the_side = absl::StrCat("the ", SideName(side));
    if (!shape.legs[side]) {
      WarnOfMissing(the_side + " leg was not found (missing, melted to the other or folded up)",
                    "what there is of it counts as trunk", warnings);
    }
    if (!shape.arms[side]) {
      WarnOfMissing(the_side + " arm was not found (missing, or melted to the trunk)",
                    "what there is of it counts as trunk", warnings);
    }
  }
  if (!shape.head) {
    WarnOfMissing("neither head nor neck was found", "the trunk ends at its highest section",
                  warnings);
  }
}

// Heads, hands and feet that are cut off limbs which are there.
void WarnOfMissingEnds(const Shape& shape, std::vector<Warning>& warnings) {
  if (shape.head && !shape.has_head) {
    WarnOfMissing("the head is missing", "the neck ends in a cut", warnings);
  }
  for (const int side : {kLeft, kRight}) {
    const std::string the_side = absl::StrCat("the ", SideName(side));
    if (shape.arms[side] && !shape.has_hand[side]) {
      WarnOfMissing(the_side + " hand is missing", "the arm ends in a cut", warnings);
    }
    if (shape.legs[side] && !shape.has_foot[side]) {
      WarnOfMissing(the_side + " foot is missing", "the leg ends in a cut", warnings);
    }
  }
}

// The trunk, where there are not two legs that part: its lowest point that belongs to no limb.
double LowestOfTrunk(const Shape& shape) {
  std::vector<char> in_limb(shape.points.size(), 0);
  const auto mark = [&](const std::optional<Limb>& limb) {
    if (!limb) return;
    for (const std::uint32_t v : limb->vertices) in_limb[v] = 1;
  };
  for (const int side : {kLeft, kRight}) {
    mark(shape.arms[side]);
    mark(shape.legs[side]);
  }
  mark(shape.head);
  double lowest = shape.top_m;
  for (std::uint32_t node = 0; node < in_limb.size(); ++node) {
    if (in_limb[node]) continue;
    for (const std::uint32_t v : shape.coarse->VerticesOf(node)) {
      lowest = std::min(lowest, shape.vertices[v].y());
    }
  }
  return lowest;
}

// Without both legs there is no crotch; the middle of the trunk's lower end stands in for it.
void FindTrunkBase(Shape& shape, Landmarks& landmarks) {
  const auto& crotch = landmarks[Index(LandmarkId::kCrotch)];
  if (crotch) {
    shape.trunk_base_m = crotch->position_m;
    return;
  }
  const double lowest = LowestOfTrunk(shape);
  const CutPlane plane = {Eigen::Vector3d(0, lowest + kAboveTrunkEnd * shape.stature_m, 0),
                          Eigen::Vector3d::UnitY()};
  const auto loop = shape.surface->CutNearest(plane, 0.0);
  shape.trunk_base_m = loop ? loop->centroid : Eigen::Vector3d(0, lowest, 0);
  shape.trunk_base_m.y() = lowest;
  if (shape.legs[kLeft] || shape.legs[kRight]) {
    Put(landmarks, Index(LandmarkId::kCrotch), shape.trunk_base_m, 0.2, LandmarkMethod::kRatio);
  }
}

// Height of a body that stood up from what it sits or squats on; its extent where it stands.
double UnfoldedStature(const Shape& shape, const Landmarks& landmarks) {
  const auto& crotch = landmarks[Index(LandmarkId::kCrotch)];
  const bool has_legs = shape.legs[kLeft] && shape.legs[kRight] && !shape.legs_are_cut;
  if (!has_legs || !crotch) return shape.stature_m;
  double legs = std::numeric_limits<double>::infinity();
  for (const int side : {kLeft, kRight}) {
    legs = std::min(legs, LegLength(shape, side, landmarks));
  }
  const double trunk = shape.crown_m - crotch->position_m.y();
  const double head = shape.has_head ? 0.0 : kHeadShare * shape.stature_m;
  const double unfolded = (trunk + legs + head) / (1.0 - kFootShare);
  return shape.stature_m + std::max(0.0, unfolded - kClearlyFolded * shape.stature_m);
}

using Armpits = std::array<std::optional<Armpit>, 2>;

void FindArmJoints(const Shape& shape, const Armpits& armpits, Landmarks& landmarks) {
  for (const int side : {kLeft, kRight}) {
    if (armpits[side]) FindShoulder(shape, side, *armpits[side], landmarks);
  }
  MatchShoulders(shape, landmarks);
  for (const int side : {kLeft, kRight}) {
    if (shape.arms[side]) FindElbow(shape, side, landmarks);
  }
}

void FindLegRoots(Shape& shape, Landmarks& landmarks) {
  if (shape.legs[kLeft] && shape.legs[kRight]) FindCrotch(shape, landmarks);
  if (!shape.observer->IsCancelled()) FindTrunkBase(shape, landmarks);
}

void FindThighs(const Shape& shape, Landmarks& landmarks) {
  for (const int side : {kLeft, kRight}) {
    if (shape.legs[side]) FindHip(shape, side, landmarks);
  }
  for (const int side : {kLeft, kRight}) {
    if (shape.legs[side]) FindKnee(shape, side, landmarks);
  }
}

// Everything that scales with the stature.
absl::Status FindAll(const Fields& fields, Shape& shape, Landmarks& landmarks,
                     std::vector<Warning>& warnings) {
  MakeProfiles(fields, shape);
  CAPFIT_RETURN_IF_ERROR(CheckCancelled(*shape.observer));
  if (!shape.legs[kLeft] && !shape.legs[kRight] && !shape.arms[kLeft] && !shape.arms[kRight]) {
    return Refused(ErrorReason::kNotABody, "not a human body: no arm and no leg was found on it");
  }
  WarnOfMissingLimbs(shape, warnings);
  FindEnds(shape, landmarks);
  WarnOfMissingEnds(shape, warnings);
  CAPFIT_RETURN_IF_ERROR(CheckCancelled(*shape.observer));
  Armpits armpits;
  shape.pool->ForEach(3, [&](std::size_t place) {  // none needs what another finds
    const int side = place == 1 ? kLeft : kRight;
    if (place == 0) FindLegRoots(shape, landmarks);
    if (place > 0 && shape.arms[side]) armpits[side] = FindArmpit(shape, side, landmarks);
  });
  CAPFIT_RETURN_IF_ERROR(CheckCancelled(*shape.observer));  // what was found may be none
  shape.pool->ForEach(4, [&](std::size_t place) {           // here neither
    if (place == 0) FindTrunkSections(shape, landmarks);
    if (place == 1) FindArmJoints(shape, armpits, landmarks);
    if (place == 2) FindThighs(shape, landmarks);
    if (place == 3) FindNeck(shape, landmarks);
  });
  return absl::OkStatus();
}

}  // namespace

absl::Status FindLandmarks(const Extremities& extremities, Shape& shape, Landmarks& landmarks,
                           std::vector<Warning>& warnings) {
  shape.has_head = HasHead(shape);
  shape.has_foot = {true, true};
  shape.crown_m = CrownHeight(shape);
  shape.stature_m = Stature(shape);
  Fields fields = {&extremities, {}};
  if (LegsBeginTooFarDown(shape)) MeasureLegsFromFeet(shape, fields);
  CAPFIT_RETURN_IF_ERROR(CheckCancelled(*shape.observer));
  const Shape before = shape;
  const Landmarks told = landmarks;
  const std::size_t warned = warnings.size();
  CAPFIT_RETURN_IF_ERROR(FindAll(fields, shape, landmarks, warnings));
  // The stature counted on feet, and on legs that are not folded.
  const double folded = shape.stature_m;
  shape.stature_m = Stature(shape);
  const double stature = UnfoldedStature(shape, landmarks);
  if (stature == folded) return absl::OkStatus();
  shape = before;
  shape.stature_m = stature;
  landmarks = told;
  warnings.resize(warned);
  return FindAll(fields, shape, landmarks, warnings);
}

}  // namespace capfit::body
