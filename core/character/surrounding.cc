#include "core/character/surrounding.h"

#include <Eigen/Geometry>  // cross
#include <cmath>
#include <cstddef>
#include <numbers>

namespace capfit::character {
namespace {

using body::LandmarkId;

// The neck's joint stands at this share of the height above the middle of the hips, and the hips at
// half of it.
constexpr double kTrunkShare = 0.33;
// Below this the joints are no body's.
constexpr double kLeastHeight = 1e-9;
// Triangles nearer than this many of their edges are taken as they are.
constexpr double kNear = 3.0;

class PointMaker {
 public:
  explicit PointMaker(const std::map<LandmarkId, Eigen::Vector3d>& joints) : joints_(joints) {}

  std::optional<InnerPoints> Run() {
    const auto hips = Middle(LandmarkId::kLeftHip, LandmarkId::kRightHip);
    const auto neck = At(LandmarkId::kNeck);
    if (!hips || !neck) return std::nullopt;
    points_.neck = *neck;
    points_.up = *neck - *hips;
    points_.height = points_.up.norm() / kTrunkShare;
    if (!(points_.height > kLeastHeight)) return std::nullopt;
    points_.up.normalize();
    for (const double share : {0.3, 0.5, 0.7, 0.85}) {
      points_.trunk.push_back(*hips + share * (*neck - *hips));
    }
    for (const double share : {0.07, 0.09, 0.11}) {
      points_.head.push_back(*neck + share * points_.height * points_.up);
    }
    for (const bool is_left : {true, false}) AddLimbs(is_left);
    AddBetweenLegs();
    return points_;
  }

 private:
  [[nodiscard]] std::optional<Eigen::Vector3d> At(LandmarkId id) const {
    const auto joint = joints_.find(id);
    if (joint == joints_.end()) return std::nullopt;
    return joint->second;
  }

  [[nodiscard]] std::optional<Eigen::Vector3d> Middle(LandmarkId a, LandmarkId b) const {
    const auto p = At(a);
    const auto q = At(b);
    if (!p || !q) return std::nullopt;
    return 0.5 * (*p + *q);
  }

  void AddLimbs(bool is_left) {
    const auto at = [&](LandmarkId left) { return At(is_left ? left : MirrorLandmark(left)); };
    AddBone(at(LandmarkId::kLeftShoulder), at(LandmarkId::kLeftElbow), {0.3, 0.5, 0.75});
    // Behind the wrist lies the palm.
    AddBone(at(LandmarkId::kLeftElbow), at(LandmarkId::kLeftWrist), {0.25, 0.5, 0.75, 1.2, 1.3});
    AddBone(at(LandmarkId::kLeftHip), at(LandmarkId::kLeftKnee), {0.3, 0.5, 0.75});
    AddBone(at(LandmarkId::kLeftKnee), at(LandmarkId::kLeftAnkle), {0.0, 0.25, 0.5, 0.75, 0.95});
    AddFoot(at(LandmarkId::kLeftAnkle));
  }

  void AddBone(const std::optional<Eigen::Vector3d>& from, const std::optional<Eigen::Vector3d>& to,
               std::initializer_list<double> shares) {
    if (!from || !to) return;
    for (const double share : shares) points_.limbs.push_back(*from + share * (*to - *from));
  }

  // A foot reaches to the front of the ankle, and a little below it.
  void AddFoot(const std::optional<Eigen::Vector3d>& ankle) {
    const auto left = At(LandmarkId::kLeftHip);
    const auto right = At(LandmarkId::kRightHip);
    if (!ankle || !left || !right) return;
    const Eigen::Vector3d forward = (*left - *right).cross(points_.up).normalized();
    for (const double share : {0.03, 0.05, 0.07}) {
      points_.limbs.push_back(*ankle + points_.height * (share * forward - 0.025 * points_.up));
    }
  }

  void AddBetweenLegs() {
    const auto hips = Middle(LandmarkId::kLeftHip, LandmarkId::kRightHip);
    const auto knees = Middle(LandmarkId::kLeftKnee, LandmarkId::kRightKnee);
    if (!hips || !knees) return;
    for (const double share : {0.5, 0.6}) {
      points_.between_legs.push_back(*hips + share * (*knees - *hips));
    }
  }

  const std::map<LandmarkId, Eigen::Vector3d>& joints_;
  InnerPoints points_;
};

// The solid angle of a triangle, signed (van Oosterom and Strackee).
double SolidAngle(const Facet& facet, const Eigen::Vector3d& from) {
  const Eigen::Vector3d a = facet.corner[0] - from;
  const Eigen::Vector3d b = facet.corner[1] - from;
  const Eigen::Vector3d c = facet.corner[2] - from;
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  const double over = a.dot(b.cross(c));
  const double under = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return 2.0 * std::atan2(over, under);
}

// Middle, area vector and the square of the distance up to which a facet is near.
struct Dipole {
  Eigen::Vector3d middle;
  Eigen::Vector3d area;
  double near_squared;
};

}  // namespace

std::optional<InnerPoints> InnerPointsOf(const std::map<LandmarkId, Eigen::Vector3d>& joints) {
  return PointMaker(joints).Run();
}

std::vector<std::vector<float>> WindingNumbers(const Shells& shells,
                                               const std::vector<Eigen::Vector3d>& points,
                                               const ThreadPool& pool) {
  std::vector<Dipole> dipoles(shells.facets.size());
  for (std::size_t f = 0; f < dipoles.size(); ++f) {
    const Facet& facet = shells.facets[f];
    const double near = kNear * facet.LongestEdge();
    dipoles[f] = {facet.Middle(), facet.AreaVector(), near * near};
  }
  std::vector<std::vector<float>> result(shells.shells.size(),
                                         std::vector<float>(points.size(), 0.0F));
  pool.ForEach(points.size(), [&](std::size_t p) {
    const Eigen::Vector3d& point = points[p];
    for (std::size_t s = 0; s < shells.shells.size(); ++s) {
      double angle = 0.0;
      for (std::size_t f = shells.first_facet[s]; f < shells.first_facet[s + 1]; ++f) {
        const Eigen::Vector3d to = dipoles[f].middle - point;
        const double squared = to.squaredNorm();
        angle += squared > dipoles[f].near_squared
                     ? to.dot(dipoles[f].area) / (squared * std::sqrt(squared))
                     : SolidAngle(shells.facets[f], point);
      }
      result[s][p] = static_cast<float>(std::abs(angle) / (4.0 * std::numbers::pi));
    }
  });
  return result;
}

}  // namespace capfit::character
