// A turn, a uniform scale and a move: what leads from the caller's frame to the body's and back.
#ifndef CAPFIT_CORE_GEOMETRY_SIMILARITY_H_
#define CAPFIT_CORE_GEOMETRY_SIMILARITY_H_

#include <Eigen/Core>

namespace capfit::geometry {

// y = scale * (rotation * x) + translation. `rotation` is orthonormal with determinant +1.
struct Similarity {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double scale = 1.0;  // > 0
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector3d Apply(const Eigen::Vector3d& x) const {
    return scale * (rotation * x) + translation;
  }
  // For directions: turned, not scaled.
  [[nodiscard]] Eigen::Vector3d Turn(const Eigen::Vector3d& x) const { return rotation * x; }

  [[nodiscard]] Similarity Inverse() const {
    Similarity inverse;
    inverse.rotation = rotation.transpose();
    inverse.scale = 1.0 / scale;
    inverse.translation = -inverse.scale * (inverse.rotation * translation);
    return inverse;
  }
};

}  // namespace capfit::geometry

#endif  // CAPFIT_CORE_GEOMETRY_SIMILARITY_H_
