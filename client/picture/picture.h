// The picture of a body with its primitives: panels with captions, a legend, a scale bar, a colour
// bar and the feature polygons, as PNG or SVG.
#ifndef CAPFIT_CLIENT_PICTURE_PICTURE_H_
#define CAPFIT_CLIENT_PICTURE_PICTURE_H_

#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/picture/figure.h"
#include "client/picture/flat_polygon.h"
#include "client/picture/legend.h"
#include "client/picture/page.h"
#include "client/picture/page_painter.h"
#include "client/picture/panel.h"
#include "core/base/thread_pool.h"

namespace capfit::client {

// A column of the picture: one figure from one side, in one row for each style.
struct PictureColumn {
  const Figure* figure = nullptr;
  double yaw_rad = 0.0;    // 0: front; pi / 2: the body's left side; pi: back
  std::string caption;     // under the column
  double pitch_rad = 0.0;  // > 0: from above
};

struct PictureOptions {
  int width = 1500;
  std::optional<int> height;  // 1100; with polygons as much as they take
  std::vector<PanelStyle> rows = {PanelStyle::kBodyAndOutlines, PanelStyle::kPrimitives};
  std::string title;     // large, on top
  std::string subtitle;  // below it
  std::string note;      // below that
  std::vector<LegendEntry> legend;
  double heat_limit = 0.03;           // for rows of kHeat, in the figure's unit ...
  std::optional<double> mm_per_unit;  // ... and how long that is, for bars; none where not known
  std::vector<FlatPolygon> polygons;  // for the sheet below the panels; none: no sheet
};

// Where everything goes. All columns have the same scale, which fits the largest figure. Letters
// grow and shrink with the page. INVALID_ARGUMENT with the field "height" where the polygons do not
// fit in.
[[nodiscard]] absl::StatusOr<Page> LayOutPage(const std::vector<PictureColumn>& columns,
                                              const PictureOptions& options);

// The bytes of the file. Panels in parallel; about 1 s for 1500 x 1100.
[[nodiscard]] absl::StatusOr<std::string> DrawPicture(const std::vector<PictureColumn>& columns,
                                                      const PictureOptions& options,
                                                      PictureFormat format, const ThreadPool& pool);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_PICTURE_H_
