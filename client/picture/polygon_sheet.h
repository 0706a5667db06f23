// Feature polygons side by side, each in a cell of its own, all to the same scale.
#ifndef CAPFIT_CLIENT_PICTURE_POLYGON_SHEET_H_
#define CAPFIT_CLIENT_PICTURE_POLYGON_SHEET_H_

#include <optional>
#include <vector>

#include "client/picture/flat_polygon.h"
#include "client/picture/page.h"

namespace capfit::client {

// A polygon's place: the drawing in the middle of its cell, two lines of words below.
struct SheetCell {
  Rect box;                                      // of the cell
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  // where the polygon's (0, 0) lies on the page
};

struct SheetPlan {
  double pixels_per_unit = 0.0;
  double height = 0.0;           // of all cells
  std::vector<SheetCell> cells;  // one for each polygon
};

// Torso, arms and legs each begin a new line of cells within `area`, whose height does not count;
// so does each side of the latter where both do not fit side by side. The widest polygon takes
// about a sixth of the width, or less, until the cells are not higher than `max_height`, but never
// below a quarter of that: then plan.height is more.
[[nodiscard]] SheetPlan PlanSheet(const std::vector<FlatPolygon>& polygons, const Rect& area,
                                  std::optional<double> max_height, double text_size);

// Draws what was planned: the circles as dashed lines with their centres, what of them is outside
// the polygon tinted ("area of the circles outside"), the outline in ink. Paths are named
// "NAME: circle", "NAME: centre", "NAME: inside" and "NAME: outline".
void AddSheet(const std::vector<FlatPolygon>& polygons, const SheetPlan& plan, double text_size,
              Page& page);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_POLYGON_SHEET_H_
