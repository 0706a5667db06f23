#include "client/picture/polygon_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "client/picture/legend.h"

namespace capfit::client {
namespace {

using Eigen::Vector2d;

// Of the text's size.
constexpr double kPadding = 0.7;
constexpr double kLabelLine = 1.25;

// Of the natural scale: smaller drawings show nothing.
constexpr double kLeastShare = 0.25;

std::string RatioText(const FlatPolygon& polygon) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3f", polygon.outside_area_ratio);
  return text;
}

// Around outline and circles, y up.
Rect DrawingBox(const FlatPolygon& polygon) {
  std::vector<Vector2d> points = polygon.outline;
  for (const FlatCircle& circle : polygon.circles) {
    points.emplace_back(circle.center - Vector2d::Constant(circle.radius));
    points.emplace_back(circle.center + Vector2d::Constant(circle.radius));
  }
  return BoxAround(points);
}

// "arm" and "leg" of either side go together.
std::string LineOf(const FlatPolygon& polygon) {
  const std::size_t side = polygon.part.find('_');
  return side == std::string::npos ? polygon.part : polygon.part.substr(side + 1);
}

struct CellSize {
  double width;
  double height;
};

class Planner {
 public:
  Planner(const std::vector<FlatPolygon>& polygons, const Rect& area, double text_size)
      : polygons_(polygons), area_(area), text_size_(text_size) {
    for (const FlatPolygon& polygon : polygons) {
      extents_.push_back(DrawingBox(polygon));
      word_widths_.push_back(std::max(TextWidth(Spaced(polygon.name), text_size), 4.0 * text_size));
    }
  }

  // The widest polygon on a sixth of the width, without its padding.
  [[nodiscard]] double NaturalScale() const {
    double widest = 0.0;
    for (const Rect& extent : extents_) widest = std::max({widest, extent.width, extent.height});
    return widest > 0.0 ? (area_.width / 6.0 - 2.0 * kPadding * text_size_) / widest : 1.0;
  }

  [[nodiscard]] SheetPlan At(double pixels_per_unit) const {
    SheetPlan plan;
    plan.pixels_per_unit = pixels_per_unit;
    const std::vector<std::size_t> lines = Lines(pixels_per_unit);
    for (std::size_t k = 1; k < lines.size(); ++k) AddLineOfCells(lines[k - 1], lines[k], plan);
    return plan;
  }

 private:
  [[nodiscard]] CellSize SizeOf(std::size_t i, double scale) const {
    const double width =
        std::max(scale * extents_[i].width, word_widths_[i]) + 2.0 * kPadding * text_size_;
    const double height =
        scale * extents_[i].height + (2.0 * kPadding + 2.0 * kLabelLine + 0.4) * text_size_;
    return {std::min(width, area_.width), height};
  }

  // The lines, by their first polygons and one past the last: torso, arms and legs, each side of
  // the latter where both are too wide, and as many lines of those as it takes, about equally long.
  [[nodiscard]] std::vector<std::size_t> Lines(double scale) const {
    std::vector<std::size_t> lines = {0};
    const auto end_of = [&](std::size_t first, auto word) {
      std::size_t end = first;
      while (end < polygons_.size() && word(polygons_[end]) == word(polygons_[first])) ++end;
      return end;
    };
    while (lines.back() < polygons_.size()) {
      const std::size_t first = lines.back();
      std::size_t end = end_of(first, [](const FlatPolygon& p) { return LineOf(p); });
      if (!Fits(first, end, scale))
        end = end_of(first, [](const FlatPolygon& p) { return p.part; });
      for (std::size_t count = 1;; ++count) {
        const std::vector<std::size_t> parts = Split(first, end, count);
        const bool fits = std::adjacent_find(parts.begin(), parts.end(), [&](auto from, auto to) {
                            return !Fits(from, to, scale);
                          }) == parts.end();
        if (!fits && count < end - first) continue;
        lines.insert(lines.end(), parts.begin() + 1, parts.end());
        break;
      }
    }
    return lines;
  }

  [[nodiscard]] bool Fits(std::size_t first, std::size_t end, double scale) const {
    double width = 0.0;
    for (std::size_t i = first; i < end; ++i) width += SizeOf(i, scale).width;
    return width <= area_.width;
  }

  // Ends of `count` pieces of [first, end), the first included.
  static std::vector<std::size_t> Split(std::size_t first, std::size_t end, std::size_t count) {
    std::vector<std::size_t> ends;
    for (std::size_t k = 0; k <= count; ++k) {
      ends.push_back(first + (end - first) * k / count);
    }
    return ends;
  }

  // The line's polygons share out the whole width; all cells are as high as the highest.
  void AddLineOfCells(std::size_t first, std::size_t end, SheetPlan& plan) const {
    double height = 0.0;
    double width = 0.0;
    for (std::size_t i = first; i < end; ++i) {
      const CellSize size = SizeOf(i, plan.pixels_per_unit);
      height = std::max(height, size.height);
      width += size.width;
    }
    const double extra = (area_.width - width) / static_cast<double>(end - first);
    double x = area_.x;
    for (std::size_t i = first; i < end; ++i) {
      const Rect box{x, area_.y + plan.height, SizeOf(i, plan.pixels_per_unit).width + extra,
                     height};
      plan.cells.push_back({box, Origin(i, box, plan.pixels_per_unit)});
      x = box.right();
    }
    plan.height += height;
  }

  // Brings the middle of the drawing to the middle of what is above the words.
  [[nodiscard]] Vector2d Origin(std::size_t i, const Rect& box, double scale) const {
    const Rect& extent = extents_[i];
    const double middle_x = extent.x + 0.5 * extent.width;
    const double middle_y = extent.y + 0.5 * extent.height;
    const double words = (2.0 * kLabelLine + 0.4) * text_size_;
    return {box.x + 0.5 * box.width - scale * middle_x,
            box.y + 0.5 * (box.height - words) + scale * middle_y};
  }

  const std::vector<FlatPolygon>& polygons_;
  const Rect area_;
  const double text_size_;
  std::vector<Rect> extents_;
  std::vector<double> word_widths_;
};

// Draws one polygon.
class CellPen {
 public:
  CellPen(const FlatPolygon& polygon, const SheetCell& cell, double scale, double text_size,
          Page& page)
      : polygon_(polygon), cell_(cell), scale_(scale), text_size_(text_size), page_(page) {}

  void Draw() {
    const Color color = PartColor(polygon_.part, 0.5);
    // The tinted discs first and the polygon in paper white over them: what stays is outside.
    for (const FlatCircle& circle : polygon_.circles) Fill("outside", RimOf(circle), Tint(color));
    Fill("inside", polygon_.outline, kPaper);
    for (const FlatCircle& circle : polygon_.circles) {
      Stroke("circle", RimOf(circle), color, 0.11).is_dashed = true;
      const FlatCircle dot{circle.center, 0.16 * text_size_ / scale_};
      Fill("centre", RimOf(dot), color);
    }
    Stroke("outline", polygon_.outline, kInk, 0.12);
    Words();
  }

 private:
  static Color Tint(const Color& color) { return 0.4f * color + 0.6f * kPaper; }

  PagePath& Add(const std::string& what, const std::vector<Vector2d>& points) {
    PagePath path;
    path.name = polygon_.name + ": " + what;
    path.is_closed = true;
    for (const Vector2d& p : points) {
      path.points.emplace_back(cell_.at.x() + scale_ * p.x(), cell_.at.y() - scale_ * p.y());
    }
    page_.paths.push_back(std::move(path));
    return page_.paths.back();
  }
  void Fill(const std::string& what, const std::vector<Vector2d>& points, const Color& color) {
    Add(what, points).fill = color;
  }
  PagePath& Stroke(const std::string& what, const std::vector<Vector2d>& points, const Color& color,
                   double width) {
    PagePath& path = Add(what, points);
    path.stroke = color;
    path.width = width * text_size_;
    return path;
  }
  void Words() {
    const double middle = cell_.box.x + 0.5 * cell_.box.width;
    const double top = cell_.box.bottom() - (2.0 * kLabelLine + 0.4) * text_size_;
    const TextStyle style{.size = text_size_,
                          .anchor = TextAnchor::kMiddle,
                          .max_width = cell_.box.width - 2.0 * kPadding * text_size_};
    AddText(Spaced(polygon_.name), middle, top, style, page_);
    AddText(RatioText(polygon_), middle, top + kLabelLine * text_size_, style, page_);
  }

  const FlatPolygon& polygon_;
  const SheetCell& cell_;
  const double scale_;
  const double text_size_;
  Page& page_;
};

}  // namespace

SheetPlan PlanSheet(const std::vector<FlatPolygon>& polygons, const Rect& area,
                    std::optional<double> max_height, double text_size) {
  const Planner planner(polygons, area, text_size);
  double high = planner.NaturalScale();
  SheetPlan plan = planner.At(high);
  if (!max_height || plan.height <= *max_height) return plan;
  double low = kLeastShare * high;
  plan = planner.At(low);
  for (int i = 0; i < 30; ++i) {
    const double scale = 0.5 * (low + high);
    const SheetPlan tried = planner.At(scale);
    (tried.height <= *max_height ? low : high) = scale;
    if (tried.height <= *max_height) plan = tried;
  }
  return plan;
}

void AddSheet(const std::vector<FlatPolygon>& polygons, const SheetPlan& plan, double text_size,
              Page& page) {
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    CellPen(polygons[i], plan.cells[i], plan.pixels_per_unit, text_size, page).Draw();
  }
}

}  // namespace capfit::client
