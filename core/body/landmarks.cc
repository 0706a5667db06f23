#include "core/body/landmarks.h"

#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/body/limb_landmarks.h"
#include "core/body/torso_landmarks.h"

namespace capfit::body {
namespace {

// A limb with fewer sections than this is none.
constexpr std::size_t kMinStations = 20;
// Length along the surface, in units of the square root of the area, from the place where the arms
// join to the top of the head (0.19 to 0.28) or to a cut through the neck (0.08).
constexpr double kHeadLength = 0.135;
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

void MakeProfiles(const Extremities& extremities, Shape& shape) {
  for (const int side : {kLeft, kRight}) {
    MakeProfile(shape, extremities, shape.legs[side], shape.leg_profiles[side]);
    MakeProfile(shape, extremities, shape.arms[side], shape.arm_profiles[side]);
  }
}

void FindEnds(Shape& shape, Landmarks& landmarks) {
  for (const int side : {kLeft, kRight}) {
    if (shape.legs[side]) FindAnkle(shape, side, landmarks);
    if (shape.arms[side]) FindWrist(shape, side, landmarks);
  }
}

// What head and feet would add to the extent.
double Stature(const Shape& shape) {
  double share = 1.0;
  if (!shape.has_head) share -= kHeadShare;
  if (!shape.has_foot[kLeft] && !shape.has_foot[kRight]) share -= kFootShare;
  return shape.top_m / share;
}

absl::Status MissingParts(const Shape& shape, std::vector<Warning>& warnings) {
  for (const int side : {kLeft, kRight}) {
    if (!shape.legs[side]) {
      return CannotFit("PART_MISSING", absl::StrCat("the ", SideName(side),
                                                    " leg was not found: it is missing, melted to "
                                                    "the other or folded up"));
    }
    if (shape.arms[side]) continue;
    warnings.push_back({"PART_MISSING",
                        absl::StrCat("the ", SideName(side),
                                     " arm was not found (missing, or melted to the trunk); what "
                                     "there is of it counts as trunk"),
                        1});
  }
  if (!shape.head) {
    warnings.push_back({"PART_MISSING",
                        "neither head nor neck was found; the trunk ends at its highest section",
                        1});
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status FindLandmarks(const Extremities& extremities, Shape& shape, Landmarks& landmarks,
                           std::vector<Warning>& warnings) {
  shape.has_head = shape.head && shape.head->tip_distance - shape.head->junction > kHeadLength;
  shape.has_foot = {true, true};
  shape.stature_m = Stature(shape);
  MakeProfiles(extremities, shape);
  if (absl::Status status = MissingParts(shape, warnings); !status.ok()) return status;
  Landmarks draft = landmarks;  // with a stature that still counts on feet
  FindEnds(shape, draft);
  shape.stature_m = Stature(shape);
  FindEnds(shape, landmarks);
  FindCrotch(shape, landmarks);
  if (!landmarks[Index(LandmarkId::kCrotch)]) {
    return CannotFit(
        "PART_MISSING",
        "the legs do not part where the thighs meet (closed, fused, or folded up as in "
        "sitting); a crotch landmark would help");
  }
  for (const int side : {kLeft, kRight}) {
    FindThigh(shape, side, landmarks);
    if (shape.arms[side]) FindUpperArm(shape, side, landmarks);
  }
  FindNeck(shape, landmarks);
  FindTrunkSections(shape, landmarks);
  return absl::OkStatus();
}

}  // namespace capfit::body
