// Feature polygons laid flat.
#ifndef CAPFIT_CLIENT_PICTURE_FLAT_POLYGON_H_
#define CAPFIT_CLIENT_PICTURE_FLAT_POLYGON_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "client/picture/figure.h"
#include "client/picture/result_set.h"
#include "core/geometry/plane_frame.h"

namespace capfit::client {

struct FlatCircle {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double radius = 0.0;
};

// A cross section in its own plane, x to the right and y up, any length unit: as it is seen from
// above, the body's front down and its left to the right. Of a limb: as if it hung straight down,
// which is the least turn from how it is held, so that left and right mirror each other in any
// pose.
struct FlatPolygon {
  std::string name;  // "left_knee"
  std::string part;  // "left_leg"
  double outside_area_ratio = 0.0;
  geometry::PlaneFrame frame;  // in the picture's frame: upright along +Y, facing +Z
  std::vector<Eigen::Vector2d> outline;
  std::vector<FlatCircle> circles;
};

// `turn`: from the frame of the polygons into the picture's (see TurnUpright). The plane is the one
// that the outline spans; its upper side is told by the neighbours of the same part, which come in
// order: upwards on the torso, outwards on limbs.
[[nodiscard]] std::vector<FlatPolygon> Flatten(const std::vector<ResultPolygon>& polygons,
                                               const Eigen::Matrix3d& turn);

// Outlines and circles as closed curves in space, in the picture's frame.
[[nodiscard]] std::vector<FigureCurve> CurvesOf(const std::vector<FlatPolygon>& polygons);

// The circle's rim as a closed line.
[[nodiscard]] std::vector<Eigen::Vector2d> RimOf(const FlatCircle& circle);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_FLAT_POLYGON_H_
