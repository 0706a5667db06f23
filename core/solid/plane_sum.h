// The place nearest to some planes: where a surface net puts its vertices.
#ifndef CAPFIT_CORE_SOLID_PLANE_SUM_H_
#define CAPFIT_CORE_SOLID_PLANE_SUM_H_

#include <Eigen/Core>
#include <Eigen/LU>

namespace capfit::solid {

// Planes by a point and their normal (length 1), in steps of the grid.
class PlaneSum {
 public:
  void Add(const Eigen::Vector3f& place, const Eigen::Vector3f& normal) {
    pull_ += normal * normal.transpose();
    pulled_ += normal * normal.dot(place);
    sum_ += place;
    count_ += 1.0f;
  }
  // Within the cube from 0 to `side`.
  [[nodiscard]] Eigen::Vector3f Nearest(float side) const {
    const Eigen::Vector3f mean = sum_ / count_;
    const Eigen::Matrix3f held = pull_ + kHold * count_ * Eigen::Matrix3f::Identity();
    const Eigen::Vector3f at = mean + held.inverse() * (pulled_ - pull_ * mean);
    return at.cwiseMax(kMargin).cwiseMin(side - kMargin);
  }

 private:
  // How strongly a vertex is held at the mean of the points, beside each plane's pull of 1: little,
  // so that edges stay sharp, but enough where all planes are nearly one.
  static constexpr float kHold = 0.03f;
  // Vertices keep this share of a step away from their cell's sides, and so from each other.
  static constexpr float kMargin = 0.04f;

  Eigen::Matrix3f pull_ = Eigen::Matrix3f::Zero();
  Eigen::Vector3f pulled_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f sum_ = Eigen::Vector3f::Zero();
  float count_ = 0.0f;
};

}  // namespace capfit::solid

#endif  // CAPFIT_CORE_SOLID_PLANE_SUM_H_
