#include "client/picture/view.h"

#include <cmath>

namespace capfit::client {

View::View(double yaw_rad, const Eigen::Vector3d& center, double center_px, double center_py,
           double pixels_per_unit, double pitch_rad)
    : center_(center),
      right_(std::cos(yaw_rad), 0.0, -std::sin(yaw_rad)),
      up_(-std::sin(pitch_rad) * std::sin(yaw_rad), std::cos(pitch_rad),
          -std::sin(pitch_rad) * std::cos(yaw_rad)),
      toward_eye_(std::cos(pitch_rad) * std::sin(yaw_rad), std::sin(pitch_rad),
                  std::cos(pitch_rad) * std::cos(yaw_rad)),
      center_px_(center_px),
      center_py_(center_py),
      scale_(pixels_per_unit) {}

Eigen::Vector3d View::PointAt(double px, double py) const {
  return center_ + (px - center_px_) / scale_ * right_ + (center_py_ - py) / scale_ * up_;
}

}  // namespace capfit::client
