#include "core/refine/layouts/bones.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/base/enum_index.h"

namespace capfit::refine {
namespace {

using body::LandmarkId;
using Vec3 = Eigen::Vector3d;

constexpr double kLongestBoneShare = 0.5;  // of the height; beyond, a landmark is wrong
constexpr double kShortestBoneM = 0.01;
// A bone that runs close under the skin still gets a radius of this share of its length.
constexpr double kLeastRadiusShare = 0.15;
constexpr std::size_t kSkinSamples = 4000;

std::optional<Vec3> Mean(const std::optional<Vec3>& a, const std::optional<Vec3>& b) {
  if (!a || !b) return std::nullopt;
  return Vec3(0.5 * (*a + *b));
}

// The landmarks of one side by the words that bones use.
struct Joints {
  std::optional<Vec3> hip_center, waist, bust, neck, head_top, collar;
  std::optional<Vec3> shoulder, elbow, wrist, fingertip, hip, knee, ankle, toe, heel;
};

Joints JointsOf(const body::Body& body, Side side) {
  const auto at = [&](LandmarkId left) -> std::optional<Vec3> {
    const LandmarkId id = side == Side::kLeft ? left : body::MirrorLandmark(left);
    if (const auto& landmark = body.landmark(id)) return landmark->position_m;
    return std::nullopt;
  };
  Joints j;
  j.hip = at(LandmarkId::kLeftHip);
  j.hip_center = at(LandmarkId::kHip);
  if (!j.hip_center) j.hip_center = Mean(j.hip, at(LandmarkId::kRightHip));
  j.waist = at(LandmarkId::kWaist);
  j.bust = at(LandmarkId::kBust);
  // A body that ends above its legs has its trunk hung from where that ends.
  const auto& torso = body.chain(body::Part::kTorso);
  if (!j.hip_center && torso) j.hip_center = torso->PointAt(0.0);
  if (!j.waist) j.waist = Mean(j.hip_center, j.bust);
  j.neck = at(LandmarkId::kNeck);
  j.head_top = at(LandmarkId::kHeadTop);
  j.collar = Mean(j.bust, j.neck);
  j.shoulder = at(LandmarkId::kLeftShoulder);
  j.elbow = at(LandmarkId::kLeftElbow);
  j.wrist = at(LandmarkId::kLeftWrist);
  j.fingertip = at(LandmarkId::kLeftFingertip);
  j.knee = at(LandmarkId::kLeftKnee);
  j.ankle = at(LandmarkId::kLeftAnkle);
  j.toe = at(LandmarkId::kLeftToe);
  j.heel = at(LandmarkId::kLeftHeel);
  return j;
}

std::pair<std::optional<Vec3>, std::optional<Vec3>> EndsOf(const Joints& j, BoneId id) {
  switch (id) {
    case BoneId::kBelly:
      return {j.hip_center, j.waist};
    case BoneId::kRibs:
      return {j.waist, j.bust};
    case BoneId::kChest:
      return {j.bust, j.neck};
    case BoneId::kHead:
      return {j.neck, j.head_top};
    case BoneId::kClavicle:
      return {j.collar, j.shoulder};
    case BoneId::kUpperArm:
      return {j.shoulder, j.elbow};
    case BoneId::kForearm:
      return {j.elbow, j.wrist};
    case BoneId::kHand:
      return {j.wrist, j.fingertip};
    case BoneId::kPelvis:
      return {j.hip_center, j.hip};
    case BoneId::kThigh:
      return {j.hip, j.knee};
    case BoneId::kShin:
      return {j.knee, j.ankle};
    case BoneId::kFoot:
      return {j.ankle, j.toe};
    case BoneId::kHeel:
      return {j.ankle, j.heel};
  }
  return {};
}

// Vertices all over a body, coordinates apart.
class Skin {
 public:
  explicit Skin(std::span<const Vec3> vertices) {
    const std::size_t stride = 1 + vertices.size() / kSkinSamples;
    samples_m_.resize(static_cast<Eigen::Index>((vertices.size() + stride - 1) / stride), 3);
    for (Eigen::Index i = 0; i < samples_m_.rows(); ++i) {
      samples_m_.row(i) = vertices[static_cast<std::size_t>(i) * stride].transpose().array();
    }
  }

  [[nodiscard]] double DistanceFrom(const Vec3& point) const {
    return std::sqrt(((samples_m_.col(0) - point.x()).square() +
                      (samples_m_.col(1) - point.y()).square() +
                      (samples_m_.col(2) - point.z()).square())
                         .minCoeff());
  }

 private:
  Eigen::ArrayX3d samples_m_;
};

// Along, aside and ahead of the standing body with arms stretched out sideways.
Eigen::Matrix3d StandardAxes(BoneId id, Side side) {
  const Vec3 out = side == Side::kLeft ? Vec3::UnitX() : Vec3(-Vec3::UnitX());
  Eigen::Matrix3d axes;
  switch (id) {
    case BoneId::kBelly:
    case BoneId::kRibs:
    case BoneId::kChest:
    case BoneId::kHead:
      axes << Vec3::UnitY(), out, Vec3::UnitZ();
      break;
    case BoneId::kClavicle:
    case BoneId::kUpperArm:
    case BoneId::kForearm:
    case BoneId::kHand:
    case BoneId::kPelvis:
      axes << out, Vec3::UnitY(), Vec3::UnitZ();
      break;
    case BoneId::kThigh:
    case BoneId::kShin:
      axes << Vec3(-Vec3::UnitY()), out, Vec3::UnitZ();
      break;
    case BoneId::kFoot:
      axes << Vec3::UnitZ(), out, Vec3::UnitY();
      break;
    case BoneId::kHeel:
      axes << Vec3(-Vec3::UnitZ()), out, Vec3::UnitY();
      break;
  }
  return axes;
}

Eigen::Matrix3d AxesOf(const Bone& bone, BoneId id, Side side) {
  const Eigen::Matrix3d axes = StandardAxes(id, side);
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(Vec3(axes.col(0)), Vec3(bone.to_m - bone.from_m));
  return turn.toRotationMatrix() * axes;
}

}  // namespace

body::Part PartOf(BoneId bone, Side side) {
  const auto of_side = [side](body::Part left) {
    return side == Side::kLeft ? left : body::MirrorPart(left);
  };
  switch (bone) {
    case BoneId::kBelly:
    case BoneId::kRibs:
    case BoneId::kChest:
    case BoneId::kClavicle:
    case BoneId::kPelvis:
      return body::Part::kTorso;
    case BoneId::kHead:
      return body::Part::kHead;
    case BoneId::kUpperArm:
    case BoneId::kForearm:
      return of_side(body::Part::kLeftArm);
    case BoneId::kHand:
      return of_side(body::Part::kLeftHand);
    case BoneId::kThigh:
    case BoneId::kShin:
      return of_side(body::Part::kLeftLeg);
    case BoneId::kFoot:
    case BoneId::kHeel:
      return of_side(body::Part::kLeftFoot);
  }
  return body::Part::kTorso;
}

Skeleton::Skeleton(const body::Body& body) {
  const Skin skin(body.mesh.vertices());
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Joints joints = JointsOf(body, side);
    for (int i = 0; i < kBoneCount; ++i) {
      const auto [from, to] = EndsOf(joints, static_cast<BoneId>(i));
      if (!from || !to || (*to - *from).norm() < kShortestBoneM) continue;
      if ((*to - *from).norm() > kLongestBoneShare * body.height_m) continue;
      Bone bone{*from, *to, 0.0};
      for (const double t : {0.25, 0.5, 0.75}) {
        bone.radius_m += skin.DistanceFrom(*from + t * (*to - *from)) / 3.0;
      }
      bone.radius_m = std::max(bone.radius_m, kLeastRadiusShare * (*to - *from).norm());
      bones_[Index(side)][i] = bone;
    }
  }
}

const std::optional<Bone>& Skeleton::bone(BoneId id, Side side) const {
  return bones_[Index(side)][Index(id)];
}

std::optional<Vec3> Skeleton::Position(BoneId id, Side side, const BonePlace& place) const {
  const std::optional<Bone>& b = bone(id, side);
  if (!b) return std::nullopt;
  const double length = (b->to_m - b->from_m).norm();
  const double along = place.along < 0.0   ? place.along * b->radius_m
                       : place.along > 1.0 ? length + (place.along - 1.0) * b->radius_m
                                           : place.along * length;
  const Vec3 local(along, place.aside * b->radius_m, place.ahead * b->radius_m);
  return Vec3(b->from_m + AxesOf(*b, id, side) * local);
}

std::optional<BonePlace> Skeleton::PlaceOf(BoneId id, Side side, const Vec3& point_m) const {
  const std::optional<Bone>& b = bone(id, side);
  if (!b) return std::nullopt;
  const double length = (b->to_m - b->from_m).norm();
  const Vec3 local = AxesOf(*b, id, side).transpose() * (point_m - b->from_m);
  const double along = local.x() < 0.0      ? local.x() / b->radius_m
                       : local.x() > length ? 1.0 + (local.x() - length) / b->radius_m
                                            : local.x() / length;
  return BonePlace{along, local.y() / b->radius_m, local.z() / b->radius_m};
}

double Skeleton::DistanceInRadii(BoneId id, Side side, const Vec3& point_m) const {
  const std::optional<Bone>& b = bone(id, side);
  if (!b) return std::numeric_limits<double>::infinity();
  const Vec3 along = b->to_m - b->from_m;
  const Vec3 p = point_m - b->from_m;
  const double t = std::clamp(p.dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - t * along).norm() / b->radius_m;
}

}  // namespace capfit::refine
