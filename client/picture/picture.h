// The picture of a body with its primitives: panels, captions, a colour bar, as PNG or SVG.
#ifndef CAPFIT_CLIENT_PICTURE_PICTURE_H_
#define CAPFIT_CLIENT_PICTURE_PICTURE_H_

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/picture/figure.h"
#include "client/picture/panel.h"
#include "core/base/thread_pool.h"

namespace capfit::client {

// A column of the picture: one figure from one side, in one row for each style.
struct PictureColumn {
  const Figure* figure = nullptr;
  double yaw_rad = 0.0;  // 0: front; pi / 2: the body's left side; pi: back
  std::string caption;   // under the column
};

struct PictureOptions {
  int width = 1500;
  int height = 1100;
  std::vector<PanelStyle> rows = {PanelStyle::kBodyAndOutlines, PanelStyle::kPrimitives};
  std::string title;            // large, on top; captions are plain ASCII
  std::string subtitle;         // below it
  double heat_limit = 0.03;     // for rows of kHeat, in the figure's unit ...
  double mm_per_unit = 1000.0;  // ... and how long that unit is, for the colour bar
};

enum class PictureFormat { kPng, kSvg };

// The bytes of the file. All columns have the same scale, which fits the largest figure. The text
// is drawn with cairo's own built-in font, so that the bytes are the same on every machine with the
// same cairo and libpng. Panels in parallel; about 1 s for 1500 x 1100.
[[nodiscard]] absl::StatusOr<std::string> DrawPicture(const std::vector<PictureColumn>& columns,
                                                      const PictureOptions& options,
                                                      PictureFormat format, const ThreadPool& pool);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_PICTURE_H_
