// One figure seen from one side, in pixels.
#ifndef CAPFIT_CLIENT_PICTURE_PANEL_H_
#define CAPFIT_CLIENT_PICTURE_PANEL_H_

#include <cstdint>
#include <span>
#include <vector>

#include "client/picture/figure.h"
#include "client/picture/view.h"

namespace capfit::client {

// Rows of 0xffRRGGBB.
struct Pixels {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> argb;
};

enum class PanelStyle {
  kBody,             // the body alone
  kBodyAndOutlines,  // the primitives lie over the body like tinted glass, with their outlines
  kPrimitives,       // the primitives alone
  kHeat,             // the body, coloured by the gap at each vertex; grey where there is none
  kGhost             // the body, pale as glass, for what is drawn over it
};

struct PanelOptions {
  int width = 480;
  int height = 480;
  PanelStyle style = PanelStyle::kBody;
  double heat_limit = 0.03;  // the gap that has the strongest colour, in the figure's unit
};

// Every pixel is the mean of 3 x 3 samples. `view` is in pixels of the panel. Same input, same
// bits.
[[nodiscard]] Pixels RenderPanel(const Figure& figure, const View& view,
                                 const PanelOptions& options);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_PANEL_H_
