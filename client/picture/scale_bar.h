// How long things on a page are.
#ifndef CAPFIT_CLIENT_PICTURE_SCALE_BAR_H_
#define CAPFIT_CLIENT_PICTURE_SCALE_BAR_H_

#include <string>

#include "client/picture/page.h"

namespace capfit::client {

struct ScaleBar {
  double length_mm = 0.0;  // 1, 2 or 5 times a power of ten
  double pixels = 0.0;     // as long as that is on the page
  std::string label;       // "20 cm"
};

// The longest such bar of at most `max_pixels`.
[[nodiscard]] ScaleBar FitScaleBar(double pixels_per_mm, double max_pixels);

// Draws the bar, as the path "scale bar" with its two ends first and last, and its label right of
// it. (x, y): left end, and the upper edge of the label. Gives the width of both.
double AddScaleBar(const ScaleBar& bar, double x, double y, double text_size, Page& page);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_SCALE_BAR_H_
