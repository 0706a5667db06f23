#include "core/body/told_landmarks.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/status.h"
#include "core/body/landmarks.h"
#include "core/body/skeleton_names.h"
#include "core/body/snap.h"

namespace capfit::body {
namespace {

// Shares of the stature.
constexpr double kSkeletonReach = 0.10;
constexpr double kCallersReach = 0.25;
constexpr double kAroundTheBody = 0.10;
// Share of a skeleton's joints.
constexpr double kMostBadBones = 2.0 / 3.0;

std::string Centimetres(double length_m) { return absl::StrFormat("%.0f cm", 100.0 * length_m); }

class Judge {
 public:
  Judge(const Extremities& extremities, const Shape& shape) : stature_m_(shape.top_m) {
    low_ = high_ = shape.points.front();
    for (const Eigen::Vector3d& p : shape.points) {
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
  Landmarks measured_;
  Eigen::Vector3d low_;
  Eigen::Vector3d high_;
};

struct JudgedBone {
  LandmarkId id;
  Eigen::Vector3d at;
  std::optional<std::string> objection;
};

// Those bones that are credible and not told already. Where most are not, it is another body's
// skeleton, or none, and the others are near by chance.
void AddBones(const std::map<LandmarkId, Eigen::Vector3d>& bones,
              const geometry::Similarity& body_from_caller, const Judge& judge, Landmarks& told,
              std::vector<Warning>& warnings) {
  std::vector<JudgedBone> judged;
  std::size_t bad = 0;
  for (const auto& [id, position] : bones) {
    if (told[Index(id)]) continue;
    const Eigen::Vector3d at = Snap(body_from_caller.Apply(position), kFineGrid);
    judged.push_back({id, at, judge.Objection(id, at, kSkeletonReach)});
    bad += judged.back().objection.has_value() ? 1 : 0;
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

absl::StatusOr<Landmarks> ToldLandmarks(const BodyOptions& options,
                                        const geometry::Similarity& body_from_caller,
                                        const Extremities& extremities, const Shape& shape,
                                        std::vector<Warning>& warnings) {
  Landmarks told;
  const std::map<LandmarkId, Eigen::Vector3d> bones = LandmarksFromSkeleton(options.skeleton);
  if (options.landmarks.empty() && bones.empty()) return told;
  const Judge judge(extremities, shape);
  for (const auto& [id, position] : options.landmarks) {
    const Eigen::Vector3d at = Snap(body_from_caller.Apply(position), kFineGrid);
    if (const auto objection = judge.Objection(id, at, kCallersReach)) {
      return InvalidField(ErrorReason::kContradictsBody,
                          absl::StrCat("options.landmarks.", std::string(LandmarkName(id))),
                          *objection);
    }
    told[Index(id)] = Landmark{at, LandmarkMethod::kCaller, 1.0};
  }
  AddBones(bones, body_from_caller, judge, told, warnings);
  return told;
}

}  // namespace capfit::body
