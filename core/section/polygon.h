// A closed outline in the plane of a section.
#ifndef CAPFIT_CORE_SECTION_POLYGON_H_
#define CAPFIT_CORE_SECTION_POLYGON_H_

#include <Eigen/Core>
#include <span>
#include <vector>

#include "absl/status/statusor.h"

namespace capfit::section {

// Counter-clockwise, at least 3 finite vertices, area > 0, in metres. Simple unless the body's
// surface cuts itself there.
class Polygon {
 public:
  // INVALID_ARGUMENT for fewer than 3 vertices, a vertex that is not finite or an area of 0;
  // clockwise input is turned round.
  static absl::StatusOr<Polygon> Create(std::vector<Eigen::Vector2d> vertices_m);

  [[nodiscard]] std::span<const Eigen::Vector2d> vertices() const& { return vertices_; }
  std::span<const Eigen::Vector2d> vertices() && = delete;  // would dangle
  [[nodiscard]] double area_m2() const { return area_m2_; }
  [[nodiscard]] Eigen::Vector2d Centroid() const;                     // of the area
  [[nodiscard]] bool Contains(const Eigen::Vector2d& point_m) const;  // winding number != 0

 private:
  explicit Polygon(std::vector<Eigen::Vector2d> vertices_m, double area_m2)
      : vertices_(std::move(vertices_m)), area_m2_(area_m2) {}
  std::vector<Eigen::Vector2d> vertices_;
  double area_m2_ = 0.0;
};

}  // namespace capfit::section

#endif  // CAPFIT_CORE_SECTION_POLYGON_H_
