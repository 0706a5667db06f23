// Samples of a ring or of an end sphere, in whole vector registers.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_BOUNDARY_SAMPLES_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_BOUNDARY_SAMPLES_H_

#include <Eigen/Core>
#include <array>

#include "core/refine/best_fit/occupancy_grid.h"
#include "core/refine/graph/cone.h"

namespace capfit::refine {

// An axis and two more directions at right angles.
struct Frame {
  Eigen::Vector3f axis = Eigen::Vector3f::UnitZ();
  Eigen::Vector3f first = Eigen::Vector3f::UnitX();
  Eigen::Vector3f second = Eigen::Vector3f::UnitY();

  // Turned about its axis.
  [[nodiscard]] Frame Turned(float cosine, float sine) const {
    return {axis, cosine * first + sine * second, cosine * second - sine * first};
  }
};

// First all samples are seen; what hides some takes them away.
class BoundarySamples {
 public:
  static constexpr int kLane = 8;
  static constexpr int kMost = 512;

  // Their number for what would be that many: whole registers.
  [[nodiscard]] static int CountFor(double wanted);

  // Around the axis in equal steps; `slope`: sine and cosine of the normals' angle with the plane
  // of the ring.
  void PlaceRing(int count, const Eigen::Vector3f& center_m, float radius_m,
                 const std::array<float, 2>& slope, const Frame& frame);
  // All over the part of a sphere below the height `top` on the axis, in radii; the first is
  // `phase` of a step above the lowest point.
  void PlaceSpiral(int count, const geometry::Sphere& sphere, float top, double phase,
                   const Frame& frame);

  void HideBehind(const Cone& cone);
  // What lies higher than `height` radii along `axis`.
  void HideBeyond(const Eigen::Vector3f& axis, float height);

  // Over the samples that are seen: their number, and the sum of weight * (normal, 1). Null: every
  // weight is 1.
  struct Sums {
    double seen = 0.0;
    Eigen::Vector4d force = Eigen::Vector4d::Zero();
  };
  [[nodiscard]] Sums Collect(const OccupancyGrid* body);

 private:
  using Array = std::array<float, kMost>;

  [[nodiscard]] bool IsAnySeen() const;
  void PlacePoints(const Eigen::Vector3f& center_m, float radius_m);

  int count_ = 0;
  Frame frame_;
  alignas(32) Array u_, v_, w_;  // normals in the frame
  alignas(32) Array x_, y_, z_;
  alignas(32) Array clear_;  // >= 0: seen
  alignas(32) Array weight_;
};

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_BOUNDARY_SAMPLES_H_
