#include "client/picture/view.h"

#include <cmath>

namespace capfit::client {

View::View(double yaw_rad, const Eigen::Vector3d& center, double center_px, double center_py,
           double pixels_per_unit)
    : center_(center),
      right_(std::cos(yaw_rad), 0.0, -std::sin(yaw_rad)),
      toward_eye_(std::sin(yaw_rad), 0.0, std::cos(yaw_rad)),
      center_px_(center_px),
      center_py_(center_py),
      scale_(pixels_per_unit) {}

Eigen::Vector3d View::PointAt(double px, double py) const {
  return center_ + (px - center_px_) / scale_ * right_ +
         Eigen::Vector3d(0.0, (center_py_ - py) / scale_, 0.0);
}

}  // namespace capfit::client
