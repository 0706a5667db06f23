#include "client/picture/picture.h"

#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

namespace capfit::client {
namespace {

using Eigen::Vector3d;

constexpr int kTitleHeight = 92;
constexpr int kCaptionHeight = 34;
constexpr int kBarWidth = 110;
constexpr int kMargin = 14;

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

cairo_status_t AppendBytes(void* closure, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

// A box around all figures, solids included.
struct Box {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
  Vector3d high = -low;
  void Add(const Vector3d& p, double radius) {
    low = low.cwiseMin(p - Vector3d::Constant(radius));
    high = high.cwiseMax(p + Vector3d::Constant(radius));
  }
};

Box BoxOf(const Figure& figure) {
  Box box;
  for (const Vector3d& p : figure.vertices) box.Add(p, 0.0);
  for (const geometry::TaperedCapsule& solid : figure.solids) {
    box.Add(solid.a().center_m, solid.a().radius_m);
    box.Add(solid.b().center_m, solid.b().radius_m);
  }
  return box;
}

struct Layout {
  int panel_width;
  int panel_height;
  std::vector<View> views;  // of each column
};

// Half the box's width as seen under this angle.
double HalfWidth(const Box& box, double yaw_rad) {
  const Vector3d half = 0.5 * (box.high - box.low);
  return std::abs(std::cos(yaw_rad)) * half.x() + std::abs(std::sin(yaw_rad)) * half.z();
}

bool HasHeat(const PictureOptions& options) {
  return std::find(options.rows.begin(), options.rows.end(), PanelStyle::kHeat) !=
         options.rows.end();
}

Layout LayOut(const std::vector<PictureColumn>& columns, const PictureOptions& options) {
  Layout layout{};
  const int bar = HasHeat(options) ? kBarWidth : 0;
  layout.panel_width = (options.width - bar) / static_cast<int>(columns.size());
  layout.panel_height =
      (options.height - kTitleHeight - kCaptionHeight) / static_cast<int>(options.rows.size());
  double scale = std::numeric_limits<double>::infinity();
  for (const PictureColumn& column : columns) {
    const Box box = BoxOf(*column.figure);
    const double half_height = 0.5 * (box.high.y() - box.low.y());
    scale = std::min({scale, (0.5 * layout.panel_width - kMargin) / HalfWidth(box, column.yaw_rad),
                      (0.5 * layout.panel_height - kMargin) / half_height});
  }
  for (const PictureColumn& column : columns) {
    const Box box = BoxOf(*column.figure);
    layout.views.emplace_back(column.yaw_rad, 0.5 * (box.low + box.high), 0.5 * layout.panel_width,
                              0.5 * layout.panel_height, scale);
  }
  return layout;
}

// cairo's built-in stroke font needs no font files.
void PrepareText(cairo_t* cr, double size, cairo_font_weight_t weight) {
  cairo_select_font_face(cr, "@cairo:", CAIRO_FONT_SLANT_NORMAL, weight);
  cairo_set_font_size(cr, size);
  cairo_set_source_rgb(cr, kInk.x(), kInk.y(), kInk.z());
}

void DrawCentered(cairo_t* cr, const std::string& text, double x, double y) {
  cairo_text_extents_t extents;
  cairo_text_extents(cr, text.c_str(), &extents);
  cairo_move_to(cr, x - 0.5 * extents.width - extents.x_bearing, y);
  cairo_show_text(cr, text.c_str());
}

void DrawPanel(cairo_t* cr, Pixels& pixels, double x, double y) {
  const Surface image(cairo_image_surface_create_for_data(
                          reinterpret_cast<unsigned char*>(pixels.argb.data()), CAIRO_FORMAT_RGB24,
                          pixels.width, pixels.height, 4 * pixels.width),
                      &cairo_surface_destroy);
  cairo_set_source_surface(cr, image.get(), x, y);
  cairo_rectangle(cr, x, y, pixels.width, pixels.height);
  cairo_fill(cr);
}

// From +limit (the body sticks out of the primitives) up to -limit (they stand off from it).
void DrawColorBar(cairo_t* cr, const PictureOptions& options) {
  constexpr int kSteps = 200;
  const double x = options.width - kBarWidth + 22;
  const double top = kTitleHeight + 40;
  const double height = options.height - top - kCaptionHeight - 30;
  for (int i = 0; i < kSteps; ++i) {
    const Color color = SignedColor(1.0 - 2.0 * (i + 0.5) / kSteps);
    cairo_set_source_rgb(cr, color.x(), color.y(), color.z());
    cairo_rectangle(cr, x, top + height * i / kSteps, 22, height / kSteps + 1);
    cairo_fill(cr);
  }
  PrepareText(cr, 17, CAIRO_FONT_WEIGHT_NORMAL);
  for (const double value : {1.0, 0.5, 0.0, -0.5, -1.0}) {
    char label[32];
    // Taken from 0, so that the middle is +0.
    const double gap_mm = 0.0 - value * options.heat_limit * options.mm_per_unit;
    std::snprintf(label, sizeof(label), "%+.3g", gap_mm);
    cairo_move_to(cr, x + 30, top + 0.5 * height * (1.0 - value) + 6);
    cairo_show_text(cr, label);
  }
  cairo_move_to(cr, x - 8, top - 36);
  cairo_show_text(cr, "gap, mm");
  PrepareText(cr, 14, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_move_to(cr, x - 8, top - 14);
  cairo_show_text(cr, "covered");
  cairo_move_to(cr, x - 8, top + height + 22);
  cairo_show_text(cr, "sticks out");
}

void Compose(cairo_t* cr, const std::vector<PictureColumn>& columns, const PictureOptions& options,
             const Layout& layout, std::vector<Pixels>& panels) {
  cairo_set_source_rgb(cr, 1, 1, 1);
  cairo_paint(cr);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const auto column = static_cast<int>(i % columns.size());
    const auto row = static_cast<int>(i / columns.size());
    DrawPanel(cr, panels[i], column * layout.panel_width, kTitleHeight + row * layout.panel_height);
  }
  PrepareText(cr, 30, CAIRO_FONT_WEIGHT_BOLD);
  DrawCentered(cr, options.title, 0.5 * options.width, 42);
  PrepareText(cr, 21, CAIRO_FONT_WEIGHT_NORMAL);
  DrawCentered(cr, options.subtitle, 0.5 * options.width, 76);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    DrawCentered(cr, columns[i].caption, (static_cast<double>(i) + 0.5) * layout.panel_width,
                 options.height - 12);
  }
  if (HasHeat(options)) DrawColorBar(cr, options);
}

Surface MakeSurface(const PictureOptions& options, PictureFormat format, std::string& bytes) {
  cairo_surface_t* const surface =
      format == PictureFormat::kSvg
          ? cairo_svg_surface_create_for_stream(AppendBytes, &bytes, options.width, options.height)
          : cairo_image_surface_create(CAIRO_FORMAT_RGB24, options.width, options.height);
  return {surface, &cairo_surface_destroy};
}

std::vector<Pixels> RenderPanels(const std::vector<PictureColumn>& columns,
                                 const PictureOptions& options, const Layout& layout,
                                 const ThreadPool& pool) {
  std::vector<Pixels> panels(columns.size() * options.rows.size());
  pool.ForEach(panels.size(), [&](std::size_t i) {
    const std::size_t column = i % columns.size();
    const PanelOptions panel{layout.panel_width, layout.panel_height,
                             options.rows[i / columns.size()], options.heat_limit};
    panels[i] = RenderPanel(*columns[column].figure, layout.views[column], panel);
  });
  return panels;
}

}  // namespace

absl::StatusOr<std::string> DrawPicture(const std::vector<PictureColumn>& columns,
                                        const PictureOptions& options, PictureFormat format,
                                        const ThreadPool& pool) {
  const Layout layout = LayOut(columns, options);
  std::vector<Pixels> panels = RenderPanels(columns, options, layout, pool);
  std::string bytes;
  const Surface surface = MakeSurface(options, format, bytes);
  {
    const Context cr(cairo_create(surface.get()), &cairo_destroy);
    Compose(cr.get(), columns, options, layout, panels);
    if (cairo_status(cr.get()) != CAIRO_STATUS_SUCCESS) {
      return absl::InternalError(cairo_status_to_string(cairo_status(cr.get())));
    }
  }
  if (format == PictureFormat::kPng) {
    cairo_surface_write_to_png_stream(surface.get(), AppendBytes, &bytes);
  } else {
    cairo_surface_finish(surface.get());
  }
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) {
    return absl::InternalError(cairo_status_to_string(cairo_surface_status(surface.get())));
  }
  return bytes;
}

}  // namespace capfit::client
