#include "core/body/facing.h"

#include <algorithm>

namespace capfit::body {
namespace {

// What tells front from back: how far it must show to be clear, and its say.
constexpr double kClearToe = 0.06;
constexpr double kToeWeight = 1.0;
constexpr double kClearCalf = 0.010;
constexpr double kCalfWeight = 0.5;
constexpr double kClearElbow = 0.005;
constexpr double kElbowWeight = 0.1;
constexpr double kClearReach = 0.10;
constexpr double kReachWeight = 0.3;
constexpr double kClearHead = 0.2;  // slope
constexpr double kHeadWeight = 0.5;
constexpr double kClearFace = 0.02;
constexpr double kFaceWeight = 0.3;

// How far `middle` stands out to the front of the straight line between the two ends.
double Bulge(const Eigen::Vector3d& a, const Eigen::Vector3d& middle, const Eigen::Vector3d& b,
             const Eigen::Vector3d& forward) {
  const Eigen::Vector3d chord = b - a;
  const double share = (middle - a).dot(chord) / std::max(chord.squaredNorm(), 1e-12);
  return (middle - a - share * chord).dot(forward);
}

double Clear(double value, double clear) { return std::clamp(value / clear, -1.0, 1.0); }

// Positive when the leg says that `forward` is the front: toes reach out to the front, the calf
// bulges to the back.
double LegFacing(const LevelCentroids& leg, const Eigen::Vector3d& tip,
                 const Eigen::Vector3d& forward) {
  const Eigen::Vector3d& shin = leg[kLevels * 2 / 3];
  const Eigen::Vector3d down = (shin - leg[kLevels / 3]).normalized();
  const Eigen::Vector3d reach = tip - shin;
  const double toe = (reach - reach.dot(down) * down).dot(forward);
  const double calf =
      Bulge(leg[kLevels * 7 / 16], leg[kLevels * 5 / 8], leg[kLevels * 3 / 4], forward);
  return kToeWeight * Clear(toe, kClearToe) - kCalfWeight * Clear(calf, kClearCalf);
}

// The same for arms (the elbow stands out to the back, and hands reach to the front rather than to
// the back) and the head (it leans to the front, and stands out over the neck there).
double ArmFacing(const LevelCentroids& arm, const Eigen::Vector3d& forward) {
  const double elbow = Bulge(arm[kLevels / 8], arm[kLevels / 2], arm[kLevels * 5 / 6], forward);
  const double reach = (arm[kLevels * 5 / 6] - arm[kLevels / 8]).dot(forward);
  return kReachWeight * Clear(reach, kClearReach) - kElbowWeight * Clear(elbow, kClearElbow);
}

double HeadFacing(const LevelCentroids& head, const Eigen::Vector3d& tip, const Eigen::Vector3d& up,
                  const Eigen::Vector3d& forward) {
  const Eigen::Vector3d reach = tip - head.front();
  const Eigen::Vector3d& neck = head[kLevels / 4];
  const double face = (head[kLevels * 5 / 8] - neck).dot(forward);
  return kHeadWeight * Clear(reach.dot(forward) / std::max(reach.dot(up), 1e-3), kClearHead) +
         kFaceWeight * Clear(face, kClearFace);
}

}  // namespace

double Facing(const Rings& rings, std::span<const Eigen::Vector3d> points,
              const Extremities& extremities, const Eigen::Vector3d& up,
              const Eigen::Vector3d& forward) {
  const bool has_legs = extremities.has_whole_leg();
  double evidence = 0.0;
  for (const Tip tip : {Tip::kFootA, Tip::kFootB}) {
    if (!rings.limb(tip) || !has_legs) continue;
    evidence += LegFacing(*rings.limb(tip), points[extremities.limb(tip)->tip], forward);
  }
  for (const Tip tip : {Tip::kHandA, Tip::kHandB}) {
    if (rings.limb(tip)) evidence += ArmFacing(*rings.limb(tip), forward);
  }
  // Without legs the middle that the rings are told from lies in the chest, and the head's do not
  // begin at the neck: they are wrong as often as not.
  if (rings.limb(Tip::kHead) && has_legs) {
    evidence +=
        HeadFacing(*rings.limb(Tip::kHead), points[extremities.limb(Tip::kHead)->tip], up, forward);
  }
  return evidence;
}

}  // namespace capfit::body
