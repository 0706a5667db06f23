// A body and the primitives that stand for it, ready to be drawn.
#ifndef CAPFIT_CLIENT_PICTURE_FIGURE_H_
#define CAPFIT_CLIENT_PICTURE_FIGURE_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "client/picture/color.h"
#include "client/picture/result_set.h"
#include "core/formats/polygon_soup.h"
#include "core/geometry/tapered_capsule.h"
#include "core/mesh/body_mesh.h"

namespace capfit::client {

// A closed line in space that is drawn over a figure.
struct FigureCurve {
  std::string name;
  std::vector<Eigen::Vector3d> points;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // inside of it: what is behind it is its back
  Color color = kInk;
  bool is_outline = false;  // of a feature polygon; otherwise one of its circles
};

// Upright along +Y, facing +Z. Any length unit.
struct Figure {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<mesh::Triangle> triangles;
  std::vector<geometry::TaperedCapsule> solids;  // capsules, then the spheres that none uses
  std::vector<Color> solid_colors;
  // Signed distance of each vertex from the union of the solids: < 0 where they cover it, NaN where
  // it is not meant to be covered. Empty: found out when they are drawn.
  std::vector<double> gaps;
  // Whether each vertex is on a part that the solids stand for; empty: all are. The rest is grey.
  std::vector<bool> is_fitted;
  std::vector<FigureCurve> curves;  // for panels of kGhost
};

// Which axis of the caller's frame points up.
enum class PictureUp { kAuto, kX, kY, kZ };

// The turn from the caller's frame into the picture's. kAuto: the result's own, or Y or
// Z, along which the body is longer. Where the result tells left from right by its landmarks, the
// body's left decides the front; otherwise Y up faces +Z, Z up faces -Y and X up faces +Z.
[[nodiscard]] Eigen::Matrix3d TurnUpright(const std::vector<Eigen::Vector3d>& positions,
                                          const ResultSet& result, PictureUp up);

// `positions` and `centers` stand for those in `soup` and `result` (frames of an animation).
[[nodiscard]] Figure MakeFigure(const formats::PolygonSoup& soup, const ResultSet& result,
                                const std::vector<Eigen::Vector3d>& positions,
                                const std::vector<Eigen::Vector3d>& centers,
                                const Eigen::Matrix3d& turn);

// Signed distance of each vertex from the union of the solids: negative where they cover it.
[[nodiscard]] std::vector<double> Gaps(const Figure& figure);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_FIGURE_H_
