// From where a picture looks at a body.
#ifndef CAPFIT_CLIENT_PICTURE_VIEW_H_
#define CAPFIT_CLIENT_PICTURE_VIEW_H_

#include <Eigen/Core>

namespace capfit::client {

// A parallel projection onto pixels, x to the right and y down, for a body that is upright along +Y
// and faces +Z.
class View {
 public:
  // `yaw_rad`: 0 sees the body from the front, pi / 2 from its left side, pi from behind.
  // `pitch_rad`: 0 sees it level, more from above; (-pi / 2, pi / 2). `center` comes to lie on
  // (center_px, center_py).
  View(double yaw_rad, const Eigen::Vector3d& center, double center_px, double center_py,
       double pixels_per_unit, double pitch_rad = 0.0);

  // Pixel coordinates and depth; a greater depth is nearer to the eye.
  [[nodiscard]] Eigen::Vector3d Project(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d d = p - center_;
    return {center_px_ + scale_ * d.dot(right_), center_py_ - scale_ * d.dot(up_),
            d.dot(toward_eye_)};
  }
  // The point at depth 0 that is seen at (px, py).
  [[nodiscard]] Eigen::Vector3d PointAt(double px, double py) const;
  [[nodiscard]] const Eigen::Vector3d& right() const { return right_; }
  [[nodiscard]] const Eigen::Vector3d& up() const { return up_; }
  [[nodiscard]] const Eigen::Vector3d& toward_eye() const { return toward_eye_; }
  [[nodiscard]] double pixels_per_unit() const { return scale_; }
  // The same view with `factor` times the pixels along each side.
  [[nodiscard]] View Scaled(double factor) const {
    View view = *this;
    view.center_px_ *= factor;
    view.center_py_ *= factor;
    view.scale_ *= factor;
    return view;
  }
  // Turns a direction into (right, up, towards the eye).
  [[nodiscard]] Eigen::Vector3d Turn(const Eigen::Vector3d& direction) const {
    return {direction.dot(right_), direction.dot(up_), direction.dot(toward_eye_)};
  }

 private:
  Eigen::Vector3d center_;
  Eigen::Vector3d right_;
  Eigen::Vector3d up_;
  Eigen::Vector3d toward_eye_;
  double center_px_;
  double center_py_;
  double scale_;
};

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_VIEW_H_
