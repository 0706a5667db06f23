#include "core/body/told_landmarks.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/enum_index.h"
#include "core/base/status.h"
#include "core/body/inside.h"
#include "core/body/landmarks.h"
#include "core/body/skeleton_names.h"
#include "core/geometry/snap.h"

namespace capfit::body {
namespace {

// Shares of the stature.
constexpr double kSkeletonReach = 0.10;
constexpr double kCallersReach = 0.25;
constexpr double kAroundTheBody = 0.10;
// A joint of this body lies in it, or this far outside (3 cm), where cloth is thin and joints are
// set by eye.
constexpr double kNearSurface = 0.02;
// From the neck over the middle of the hips, knee and ankle: 0.76 to 0.82 of the stature in the
// skeletons seen; hats and heels add to the stature, and nobody's skeleton is half of it.
constexpr double kShortestRig = 0.62;
constexpr double kLongestRig = 0.95;
// Upper arm to forearm, thigh to shin: 0.9 to 1.3 in people.
constexpr double kLeastRatio = 0.6;
constexpr double kMostRatio = 1.7;
// Places along a bone that are looked at, and how many of them may lie outside.
constexpr int kPlacesOnBone = 6;
constexpr int kMostOutside = 1;
// Share of a skeleton's joints.
constexpr double kMostBadBones = 2.0 / 3.0;

std::string Centimetres(double length_m) { return absl::StrFormat("%.0f cm", 100.0 * length_m); }

class Judge {
 public:
  Judge(const Extremities& extremities, const Shape& shape)
      : stature_m_(shape.top_m), surface_(shape.surface) {
    low_ = high_ = shape.vertices.front();
    for (const Eigen::Vector3d& p : shape.vertices) {
      low_ = low_.cwiseMin(p);
      high_ = high_.cwiseMax(p);
    }
    Shape own = shape;
    Landmarks measured;
    std::vector<Warning> unheard;
    // What was found before an error still counts.
    FindLandmarks(extremities, own, measured, unheard).IgnoreError();
    measured_ = measured;
    if (own.stature_m > 0.0) stature_m_ = own.stature_m;
    // Of a body that folds its legs the extent is none, of one in a long skirt the legs are none.
    statures_m_ = {stature_m_, shape.top_m};
  }

  // Whether it lies in the surface or near it.
  [[nodiscard]] bool IsInBody(const Eigen::Vector3d& at) const {
    return IsInsideOrNear(*surface_, at, kNearSurface * stature_m_);
  }

  // Whether the way from joint to joint does.
  [[nodiscard]] bool IsBoneInBody(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    return PlacesOutside(*surface_, from, to, kNearSurface * stature_m_, kPlacesOnBone) <=
           kMostOutside;
  }

  [[nodiscard]] bool IsOfThisSize(double neck_to_ankle_m) const {
    return std::any_of(statures_m_.begin(), statures_m_.end(), [&](double stature_m) {
      return neck_to_ankle_m > kShortestRig * stature_m &&
             neck_to_ankle_m < kLongestRig * stature_m;
    });
  }

  // What speaks against the position; nothing if it is credible.
  [[nodiscard]] std::optional<std::string> Objection(LandmarkId id, const Eigen::Vector3d& at,
                                                     double reach) const {
    const Eigen::Vector3d beside = (low_ - at).cwiseMax(at - high_).cwiseMax(0.0);
    if (beside.norm() > kAroundTheBody * stature_m_) {
      return absl::StrCat("lies ", Centimetres(beside.norm()),
                          " outside the body; positions are in the mesh's own unit and axes");
    }
    const std::optional<Landmark>& measured = measured_[Index(id)];
    if (!measured || measured->confidence < kLeastTrust) return std::nullopt;
    const double off = (measured->position_m - at).norm();
    if (off <= reach * stature_m_) return std::nullopt;
    return absl::StrCat("lies ", Centimetres(off), " from where the body shows it, limit ",
                        Centimetres(reach * stature_m_));
  }

 private:
  // Measured landmarks of less confidence are guesses and speak against nothing.
  static constexpr double kLeastTrust = 0.5;

  double stature_m_;
  std::array<double, 2> statures_m_ = {};
  const CutSurface* surface_;
  Landmarks measured_;
  Eigen::Vector3d low_;
  Eigen::Vector3d high_;
};

// Holds the limbs of a skeleton against the surface.
class LimbJudge {
 public:
  LimbJudge(const Landmarks& bones, const Judge& judge) : bones_(bones), judge_(judge) {}

  // Whether the limb that the bone is of lies in the body as a whole, and the skeleton is of its
  // size.
  [[nodiscard]] bool Vouches(LandmarkId id) const {
    if (!IsOfThisSize()) return false;
    for (const LandmarkId start : {LandmarkId::kLeftShoulder, LandmarkId::kRightShoulder,
                                   LandmarkId::kLeftHip, LandmarkId::kRightHip}) {
      const std::array<LandmarkId, 3> limb = LimbFrom(start);
      if (std::find(limb.begin(), limb.end(), id) != limb.end()) return IsLimbInBody(limb);
    }
    return id == LandmarkId::kNeck && IsTrunkInBody();
  }

 private:
  // Landmarks of a side follow each other by two: shoulder, elbow, wrist; hip, knee, ankle.
  static std::array<LandmarkId, 3> LimbFrom(LandmarkId start) {
    const auto first = static_cast<int>(start);
    return {start, static_cast<LandmarkId>(first + 2), static_cast<LandmarkId>(first + 4)};
  }
  [[nodiscard]] const std::optional<Landmark>& at(LandmarkId id) const { return bones_[Index(id)]; }

  [[nodiscard]] bool IsLimbInBody(const std::array<LandmarkId, 3>& limb) const {
    const auto& [upper, middle, lower] = limb;
    if (!at(upper) || !at(middle) || !at(lower)) return false;
    const Eigen::Vector3d& a = at(upper)->position_m;
    const Eigen::Vector3d& b = at(middle)->position_m;
    const Eigen::Vector3d& c = at(lower)->position_m;
    const double ratio = (b - a).norm() / (c - b).norm();
    return ratio > kLeastRatio && ratio < kMostRatio && judge_.IsInBody(a) && judge_.IsInBody(b) &&
           judge_.IsInBody(c) && judge_.IsBoneInBody(a, b) && judge_.IsBoneInBody(b, c);
  }

  [[nodiscard]] std::optional<Eigen::Vector3d> MiddleOfHips() const {
    if (!at(LandmarkId::kLeftHip) || !at(LandmarkId::kRightHip)) return std::nullopt;
    return Eigen::Vector3d(
        0.5 * (at(LandmarkId::kLeftHip)->position_m + at(LandmarkId::kRightHip)->position_m));
  }

  [[nodiscard]] bool IsTrunkInBody() const {
    const auto hips = MiddleOfHips();
    return hips && judge_.IsInBody(at(LandmarkId::kNeck)->position_m) &&
           judge_.IsBoneInBody(at(LandmarkId::kNeck)->position_m, *hips);
  }

  [[nodiscard]] bool IsOfThisSize() const {
    const auto hips = MiddleOfHips();
    if (!hips || !at(LandmarkId::kNeck)) return false;
    const double trunk_m = (at(LandmarkId::kNeck)->position_m - *hips).norm();
    for (const LandmarkId start : {LandmarkId::kLeftHip, LandmarkId::kRightHip}) {
      const auto [hip, knee, ankle] = LimbFrom(start);
      if (!at(knee) || !at(ankle)) return false;
      const double leg_m = (at(knee)->position_m - at(hip)->position_m).norm() +
                           (at(ankle)->position_m - at(knee)->position_m).norm();
      if (!judge_.IsOfThisSize(trunk_m + leg_m)) return false;
    }
    return true;
  }

  const Landmarks& bones_;
  const Judge& judge_;
};

struct JudgedBone {
  LandmarkId id;
  Eigen::Vector3d at;
  std::optional<std::string> objection;
};

bool IsOfLeg(LandmarkId id) { return id >= LandmarkId::kLeftHip && id <= LandmarkId::kRightAnkle; }

// Those bones that are credible and not told already. Where most are not, it is another body's
// skeleton, or none, and the others are near by chance.
void AddBones(const std::map<LandmarkId, Eigen::Vector3d>& bones,
              const geometry::Similarity& body_from_caller, const Judge& judge, bool has_legs,
              Landmarks& told, std::vector<Warning>& warnings) {
  std::vector<JudgedBone> judged;
  std::size_t bad = 0;
  Landmarks all;
  for (const auto& [id, position] : bones) {
    const Eigen::Vector3d at =
        geometry::Snap(body_from_caller.Apply(position), geometry::kFineGrid);
    all[Index(id)] = Landmark{at, LandmarkMethod::kSkeleton, 0.95};
  }
  const LimbJudge limbs(all, judge);
  for (const auto& [id, position] : bones) {
    if (told[Index(id)]) continue;
    const Eigen::Vector3d& at = all[Index(id)]->position_m;
    std::optional<std::string> objection = judge.Objection(id, at, kSkeletonReach);
    if (objection && limbs.Vouches(id)) objection = std::nullopt;
    if (!objection && !judge.IsInBody(at)) objection = "lies outside the body";
    if (objection && !has_legs && IsOfLeg(id)) continue;  // that the legs are missing is told once
    bad += objection.has_value() ? 1 : 0;
    judged.push_back({id, at, std::move(objection)});
  }
  const bool is_anothers =
      static_cast<double>(bad) > kMostBadBones * static_cast<double>(judged.size());
  for (JudgedBone& bone : judged) {
    if (is_anothers && !bone.objection)
      bone.objection = "belongs to a skeleton that lies elsewhere";
    if (!bone.objection) {
      told[Index(bone.id)] = Landmark{bone.at, LandmarkMethod::kSkeleton, 0.95};
      continue;
    }
    warnings.push_back({"SKELETON_IGNORED",
                        absl::StrCat("the skeleton's ", std::string(LandmarkName(bone.id)), " ",
                                     *bone.objection, "; the measured one is used"),
                        1});
  }
}

}  // namespace

absl::StatusOr<Landmarks> ToldLandmarks(const BodyOptions& options, const Rig& rig,
                                        const geometry::Similarity& body_from_caller,
                                        const Extremities& extremities, const Shape& shape,
                                        std::vector<Warning>& warnings) {
  Landmarks told;
  const std::map<LandmarkId, Eigen::Vector3d>& bones = rig.landmarks;
  if (options.landmarks.empty() && bones.empty()) return told;
  const Judge judge(extremities, shape);
  for (const auto& [id, position] : options.landmarks) {
    const Eigen::Vector3d at =
        geometry::Snap(body_from_caller.Apply(position), geometry::kFineGrid);
    if (const auto objection = judge.Objection(id, at, kCallersReach)) {
      return InvalidField(ErrorReason::kContradictsBody,
                          absl::StrCat("options.landmarks.", std::string(LandmarkName(id))),
                          *objection);
    }
    told[Index(id)] = Landmark{at, LandmarkMethod::kCaller, 1.0};
  }
  const bool has_legs = shape.legs[kLeft] || shape.legs[kRight];
  AddBones(bones, body_from_caller, judge, has_legs, told, warnings);
  return told;
}

}  // namespace capfit::body
