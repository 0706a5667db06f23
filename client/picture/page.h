// A page as a list of what is on it, in pixels from its upper left corner. It is laid out first and
// painted afterwards, so that what stands where can be asked of it.
#ifndef CAPFIT_CLIENT_PICTURE_PAGE_H_
#define CAPFIT_CLIENT_PICTURE_PAGE_H_

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "client/picture/color.h"
#include "client/picture/panel.h"
#include "client/picture/view.h"

namespace capfit::client {

struct Rect {
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;

  [[nodiscard]] double right() const { return x + width; }
  [[nodiscard]] double bottom() const { return y + height; }
  [[nodiscard]] bool Contains(const Rect& other) const {
    return other.x >= x && other.y >= y && other.right() <= right() && other.bottom() <= bottom();
  }
  [[nodiscard]] bool Overlaps(const Rect& other) const {
    return x < other.right() && other.x < right() && y < other.bottom() && other.y < bottom();
  }
};

// One line of words.
struct PageText {
  std::string text;  // printable ASCII
  Rect box;          // from the top of the capitals to the lowest descender, over the whole advance
  double size = 0.0;
  bool is_bold = false;
};

// A line, or an area.
struct PagePath {
  std::string name;  // what it shows: "scale bar", "torso", "hip: outline", "hip: circle"
  std::vector<Eigen::Vector2d> points;
  bool is_closed = false;
  std::optional<Color> fill;
  std::optional<Color> stroke;
  double width = 1.0;  // of the stroke
  double alpha = 1.0;
  bool is_dashed = false;
};

// A column's figure in one style.
struct PagePanel {
  Rect box;  // whole pixels
  std::size_t column = 0;
  PanelStyle style = PanelStyle::kBody;
  View view;  // in pixels of the panel
};

// Panels lie lowest, then paths in their order, then texts.
struct Page {
  int width = 0;
  int height = 0;
  std::vector<PagePanel> panels;
  std::vector<PagePath> paths;
  std::vector<PageText> texts;
};

// Where `x` lies on a line of text.
enum class TextAnchor { kLeft, kMiddle, kRight };

struct TextStyle {
  double size = 16.0;  // the font's, in pixels: lines are 1.3 times as high
  bool is_bold = false;
  TextAnchor anchor = TextAnchor::kLeft;
  double max_width = std::numeric_limits<double>::infinity();  // smaller letters where it is longer
};

// Width of the words in cairo's built-in font. Bytes that are not printable ASCII count as "?".
[[nodiscard]] double TextWidth(const std::string& text, double size, bool is_bold = false);

// Writes the words with their upper edge at `y`.
void AddText(const std::string& text, double x, double y, const TextStyle& style, Page& page);

// An area without a rim.
void AddArea(const std::string& name, const Rect& box, const Color& fill, Page& page);

// An open line of ink.
void AddLine(const std::string& name, const std::vector<Eigen::Vector2d>& points, double width,
             Page& page);

// The least box around the points.
[[nodiscard]] Rect BoxAround(const std::vector<Eigen::Vector2d>& points);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_PICTURE_PAGE_H_
