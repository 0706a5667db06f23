#include "client/picture/page_painter.h"

#include <cairo-svg.h>
#include <cairo.h>

#include <memory>

namespace capfit::client {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

// Of the font's size: from the top of a line's box to the line that letters stand on.
constexpr double kBaseline = 0.78;

cairo_status_t AppendBytes(void* closure, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void PaintPanel(cairo_t* cr, const Rect& box, Pixels& pixels) {
  const Surface image(cairo_image_surface_create_for_data(
                          reinterpret_cast<unsigned char*>(pixels.argb.data()), CAIRO_FORMAT_RGB24,
                          pixels.width, pixels.height, 4 * pixels.width),
                      &cairo_surface_destroy);
  cairo_set_source_surface(cr, image.get(), box.x, box.y);
  cairo_rectangle(cr, box.x, box.y, pixels.width, pixels.height);
  cairo_fill(cr);
}

void SetColor(cairo_t* cr, const Color& color, double alpha) {
  cairo_set_source_rgba(cr, color.x(), color.y(), color.z(), alpha);
}

void PaintPath(cairo_t* cr, const PagePath& path) {
  cairo_new_path(cr);
  for (const Eigen::Vector2d& p : path.points) cairo_line_to(cr, p.x(), p.y());
  if (path.is_closed) cairo_close_path(cr);
  if (path.fill) {
    SetColor(cr, *path.fill, path.alpha);
    cairo_fill_preserve(cr);
  }
  if (path.stroke) {
    const double dash = 3.0 * path.width;
    cairo_set_dash(cr, &dash, path.is_dashed ? 1 : 0, 0.0);
    cairo_set_line_width(cr, path.width);
    SetColor(cr, *path.stroke, path.alpha);
    cairo_stroke_preserve(cr);
  }
  cairo_new_path(cr);
}

void PaintText(cairo_t* cr, const PageText& text) {
  cairo_select_font_face(cr, "@cairo:", CAIRO_FONT_SLANT_NORMAL,
                         text.is_bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr, text.size);
  SetColor(cr, kInk, 1.0);
  cairo_move_to(cr, text.box.x, text.box.y + kBaseline * text.size);
  cairo_show_text(cr, text.text.c_str());
}

void Paint(cairo_t* cr, const Page& page, std::vector<Pixels>& panels) {
  SetColor(cr, kPaper, 1.0);
  cairo_paint(cr);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  for (std::size_t i = 0; i < panels.size(); ++i) PaintPanel(cr, page.panels[i].box, panels[i]);
  for (const PagePath& path : page.paths) PaintPath(cr, path);
  for (const PageText& text : page.texts) PaintText(cr, text);
}

absl::Status CairoStatus(cairo_status_t status) {
  return status == CAIRO_STATUS_SUCCESS ? absl::OkStatus()
                                        : absl::InternalError(cairo_status_to_string(status));
}

}  // namespace

absl::StatusOr<std::string> PaintPage(const Page& page, std::vector<Pixels> panels,
                                      PictureFormat format) {
  std::string bytes;
  const Surface surface(
      format == PictureFormat::kSvg
          ? cairo_svg_surface_create_for_stream(AppendBytes, &bytes, page.width, page.height)
          : cairo_image_surface_create(CAIRO_FORMAT_RGB24, page.width, page.height),
      &cairo_surface_destroy);
  {
    const Context cr(cairo_create(surface.get()), &cairo_destroy);
    Paint(cr.get(), page, panels);
    if (absl::Status status = CairoStatus(cairo_status(cr.get())); !status.ok()) return status;
  }
  if (format == PictureFormat::kPng) {
    cairo_surface_write_to_png_stream(surface.get(), AppendBytes, &bytes);
  } else {
    cairo_surface_finish(surface.get());
  }
  if (absl::Status status = CairoStatus(cairo_surface_status(surface.get())); !status.ok()) {
    return status;
  }
  return bytes;
}

}  // namespace capfit::client
