// A plane in space with two axes in it, so that a section can be handled in two dimensions.
#ifndef CAPFIT_CORE_GEOMETRY_PLANE_FRAME_H_
#define CAPFIT_CORE_GEOMETRY_PLANE_FRAME_H_

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace capfit::geometry {

// Right-handed: x_axis cross y_axis = normal, all of length 1.
struct PlaneFrame {
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d x_axis = Eigen::Vector3d::UnitX();
  Eigen::Vector3d y_axis = Eigen::Vector3d::UnitY();

  [[nodiscard]] Eigen::Vector3d Normal() const { return x_axis.cross(y_axis); }
  [[nodiscard]] Eigen::Vector2d ToPlane(const Eigen::Vector3d& point_m) const {
    const Eigen::Vector3d d = point_m - origin_m;
    return {d.dot(x_axis), d.dot(y_axis)};
  }
  [[nodiscard]] Eigen::Vector3d ToSpace(const Eigen::Vector2d& point_m) const {
    return origin_m + point_m.x() * x_axis + point_m.y() * y_axis;
  }
  // Signed distance of a point from the plane, along the normal.
  [[nodiscard]] double Height(const Eigen::Vector3d& point_m) const {
    return (point_m - origin_m).dot(Normal());
  }
};

}  // namespace capfit::geometry

#endif  // CAPFIT_CORE_GEOMETRY_PLANE_FRAME_H_
