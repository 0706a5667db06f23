#include "client/picture/page.h"

#include <cairo.h>

#include <algorithm>
#include <memory>

namespace capfit::client {
namespace {

// Of the font's size: how far capitals and figures stand above the line, and how high it all is.
constexpr double kTextHeight = 1.05;

// The built-in font draws ASCII alone; file names may hold any bytes.
std::string Printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

}  // namespace

double TextWidth(const std::string& text, double size, bool is_bold) {
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_recording_surface_create(CAIRO_CONTENT_COLOR, nullptr), &cairo_surface_destroy);
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cr(cairo_create(surface.get()),
                                                              &cairo_destroy);
  cairo_select_font_face(cr.get(), "@cairo:", CAIRO_FONT_SLANT_NORMAL,
                         is_bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  // Measured large: the built-in font rounds its advances to pixels' fractions.
  constexpr double kMeasuredSize = 100.0;
  cairo_set_font_size(cr.get(), kMeasuredSize);
  cairo_text_extents_t extents;
  cairo_text_extents(cr.get(), Printable(text).c_str(), &extents);
  return extents.x_advance * size / kMeasuredSize;
}

void AddText(const std::string& text, double x, double y, const TextStyle& style, Page& page) {
  if (text.empty()) return;
  PageText line{Printable(text), {}, style.size, style.is_bold};
  double width = TextWidth(text, style.size, style.is_bold);
  if (width > style.max_width) {
    line.size *= style.max_width / width;
    width = style.max_width;
  }
  const double share = style.anchor == TextAnchor::kLeft     ? 0.0
                       : style.anchor == TextAnchor::kMiddle ? 0.5
                                                             : 1.0;
  line.box = {x - share * width, y, width, kTextHeight * line.size};
  page.texts.push_back(std::move(line));
}

void AddArea(const std::string& name, const Rect& box, const Color& fill, Page& page) {
  PagePath area;
  area.name = name;
  area.points = {
      {box.x, box.y}, {box.right(), box.y}, {box.right(), box.bottom()}, {box.x, box.bottom()}};
  area.is_closed = true;
  area.fill = fill;
  page.paths.push_back(std::move(area));
}

void AddLine(const std::string& name, const std::vector<Eigen::Vector2d>& points, double width,
             Page& page) {
  PagePath line;
  line.name = name;
  line.points = points;
  line.stroke = kInk;
  line.width = width;
  page.paths.push_back(std::move(line));
}

Rect BoxAround(const std::vector<Eigen::Vector2d>& points) {
  if (points.empty()) return {};
  Eigen::Vector2d low = points.front();
  Eigen::Vector2d high = low;
  for (const Eigen::Vector2d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return {low.x(), low.y(), high.x() - low.x(), high.y() - low.y()};
}

}  // namespace capfit::client
