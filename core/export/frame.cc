#include "core/export/frame.h"

#include <Eigen/Geometry>
#include <array>

namespace capfit::exports {
namespace {

Eigen::Matrix3d Rows(const Eigen::RowVector3d& x, const Eigen::RowVector3d& y,
                     const Eigen::RowVector3d& z) {
  Eigen::Matrix3d matrix;
  matrix << x, y, z;
  return matrix;
}

// Of the 24 turns that exchange axes the one nearest to `turn`; of equal ones the first.
Eigen::Matrix3d NearestQuarterTurns(const Eigen::Matrix3d& turn) {
  constexpr std::array<std::array<int, 3>, 6> kOrders = {
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  Eigen::Matrix3d best = Eigen::Matrix3d::Identity();
  double best_trace = -4.0;
  for (const std::array<int, 3>& order : kOrders) {
    for (int signs = 0; signs < 8; ++signs) {
      Eigen::Matrix3d candidate = Eigen::Matrix3d::Zero();
      for (int row = 0; row < 3; ++row) {
        candidate(row, order[row]) = (signs >> row & 1) != 0 ? -1.0 : 1.0;
      }
      const double trace = candidate.cwiseProduct(turn).sum();
      if (candidate.determinant() > 0.0 && trace > best_trace) {
        best = candidate;
        best_trace = trace;
      }
    }
  }
  return best;
}

}  // namespace

const Frame& YUpFrame() {
  static const Frame frame{"metres, +Y up, +Z ahead, right-handed", Eigen::Matrix3d::Identity(),
                           1.0};
  return frame;
}

const Frame& ZUpFrame() {
  static const Frame frame{"metres, +Z up, +X ahead, right-handed",
                           Rows({0, 0, 1}, {1, 0, 0}, {0, 1, 0}), 1.0};
  return frame;
}

const Frame& UnityFrame() {
  static const Frame frame{"metres, +Y up, +Z ahead, left-handed",
                           Rows({-1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1.0};
  return frame;
}

const Frame& UnrealFrame() {
  static const Frame frame{"centimetres, +Z up, +Y ahead, left-handed",
                           Rows({1, 0, 0}, {0, 0, 1}, {0, 1, 0}), 100.0};
  return frame;
}

geometry::Similarity UprightFromMesh(const ColliderSet& set) {
  geometry::Similarity upright;
  upright.rotation = NearestQuarterTurns(set.body_from_mesh.rotation);
  upright.scale = set.body_from_mesh.scale;
  return upright;
}

ColliderSet Upright(ColliderSet set) {
  const geometry::Similarity upright = UprightFromMesh(set);
  for (geometry::Sphere& sphere : set.primitives.spheres) {
    sphere = {upright.Apply(sphere.center_m), upright.scale * sphere.radius_m};
  }
  for (formats::NamedJoint& joint : set.joints) {
    joint.position = upright.Apply(joint.position);
    joint.to_mesh.leftCols<3>() =
        (upright.scale * upright.rotation * joint.to_mesh.leftCols<3>()).eval();
    joint.to_mesh.col(3) = joint.position;
  }
  geometry::Similarity& body = set.body_from_mesh;
  body.rotation = (body.rotation * upright.rotation.transpose()).eval();
  body.scale = 1.0;
  return set;
}

}  // namespace capfit::exports
