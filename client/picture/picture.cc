#include "client/picture/picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "absl/strings/str_cat.h"
#include "client/picture/polygon_sheet.h"
#include "client/picture/scale_bar.h"
#include "core/base/status.h"

namespace capfit::client {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kUsualHeight = 1100;
constexpr double kGhostHeight = 560.0;  // of the row of panels above the polygons, where it is free

// What a column's figure takes as it is seen, in its own unit.
struct Extent {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity());
  Vector3d high = -low;  // both (right, up, towards the eye)
  void Add(const Vector3d& turned, double radius) {
    low = low.cwiseMin(turned - Vector3d::Constant(radius));
    high = high.cwiseMax(turned + Vector3d::Constant(radius));
  }
  [[nodiscard]] Vector3d middle() const { return 0.5 * (low + high); }
  [[nodiscard]] double width() const { return high.x() - low.x(); }
  [[nodiscard]] double height() const { return high.y() - low.y(); }
};

View ViewOf(const PictureColumn& column, const Vector3d& center, const Vector2d& at, double scale) {
  return {column.yaw_rad, center, at.x(), at.y(), scale, column.pitch_rad};
}

Extent ExtentOf(const PictureColumn& column) {
  const View view = ViewOf(column, Vector3d::Zero(), Vector2d::Zero(), 1.0);
  const Figure& figure = *column.figure;
  Extent extent;
  for (const Vector3d& p : figure.vertices) extent.Add(view.Turn(p), 0.0);
  for (const geometry::TaperedCapsule& solid : figure.solids) {
    extent.Add(view.Turn(solid.a().center_m), solid.a().radius_m);
    extent.Add(view.Turn(solid.b().center_m), solid.b().radius_m);
  }
  for (const FigureCurve& curve : figure.curves) {
    for (const Vector3d& p : curve.points) extent.Add(view.Turn(p), 0.0);
  }
  return extent;
}

// Lays out a page from top to bottom.
class PageMaker {
 public:
  PageMaker(const std::vector<PictureColumn>& columns, const PictureOptions& options)
      : columns_(columns), options_(options) {
    page_.width = options.width;
    page_.height = options.height.value_or(kUsualHeight);
    // Letters are as large as the page allows, and not smaller than can be read.
    unit_ = std::clamp(std::min(page_.width / 1500.0, page_.height / 1100.0), 0.5, 4.0);
    margin_ = 14.0 * unit_;
    for (const PictureColumn& column : columns) extents_.push_back(ExtentOf(column));
  }

  absl::StatusOr<Page> Make() {
    AddHead();
    const double foot = FootHeight();
    const double panels = HasSheet() && !options_.height ? kGhostHeight * unit_
                          : HasSheet()                   ? 0.4 * (page_.height - top_)
                                                         : page_.height - top_ - foot;
    AddPanels(std::max(panels, 10.0));
    AddFoot();
    if (HasSheet()) CAPFIT_RETURN_IF_ERROR(AddPolygons());
    return std::move(page_);
  }

 private:
  [[nodiscard]] bool HasSheet() const { return !options_.polygons.empty(); }
  [[nodiscard]] bool HasHeat() const {
    return std::find(options_.rows.begin(), options_.rows.end(), PanelStyle::kHeat) !=
           options_.rows.end();
  }
  [[nodiscard]] double InnerWidth() const { return page_.width - 2.0 * margin_; }

  void AddHead() {
    top_ = margin_;
    const auto line = [&](const std::string& text, double size, bool is_bold) {
      if (text.empty()) return;
      const TextStyle style{size * unit_, is_bold, TextAnchor::kMiddle, InnerWidth()};
      AddText(text, 0.5 * page_.width, top_, style, page_);
      top_ += 1.35 * size * unit_;
    };
    line(options_.title, 30.0, true);
    line(options_.subtitle, 20.0, false);
    line(options_.note, 18.0, false);
  }

  // The scale that fits all columns side by side, `height` pixels high each.
  [[nodiscard]] double PanelScale(double width, double height) const {
    double widths = 0.0;
    double highest = 0.0;
    for (const Extent& extent : extents_) {
      widths += extent.width();
      highest = std::max(highest, extent.height());
    }
    const double margins = 2.0 * margin_ * static_cast<double>(columns_.size());
    return std::min(std::max(width - margins, 1.0) / widths,
                    std::max(height - 2.0 * margin_, 1.0) / highest);
  }

  void AddPanels(double height) {
    const double bar = HasHeat() ? 110.0 * unit_ : 0.0;
    const double width = page_.width - bar;
    const int row_height =
        std::max(1, static_cast<int>(height / static_cast<double>(options_.rows.size())));
    scale_ = PanelScale(width, row_height);
    double used = 0.0;
    for (const Extent& extent : extents_) used += ColumnWidth(extent);
    const double extra = (width - used) / static_cast<double>(columns_.size());
    double x = 0.0;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const double right = x + ColumnWidth(extents_[i]) + extra;
      AddColumn(i, x, right, row_height);
      x = right;
    }
    if (HasHeat()) {
      AddGapBar(options_.heat_limit * options_.mm_per_unit.value_or(1000.0),
                {width + 8.0 * unit_, top_, bar - 8.0 * unit_ - 0.5 * margin_,
                 static_cast<double>(row_height)},
                17.0 * unit_, page_);
    }
    top_ += row_height * static_cast<double>(options_.rows.size());
  }

  [[nodiscard]] double ColumnWidth(const Extent& extent) const {
    return scale_ * extent.width() + 2.0 * margin_;
  }

  void AddColumn(std::size_t i, double left, double right, int row_height) {
    const PictureColumn& column = columns_[i];
    const double x = std::floor(left);
    const double width = std::max(1.0, std::floor(right) - x);
    const View turned = ViewOf(column, Vector3d::Zero(), Vector2d::Zero(), 1.0);
    const Vector3d middle = extents_[i].middle();
    const Vector3d center =
        middle.x() * turned.right() + middle.y() * turned.up() + middle.z() * turned.toward_eye();
    const View view = ViewOf(column, center, {0.5 * width, 0.5 * row_height}, scale_);
    for (std::size_t row = 0; row < options_.rows.size(); ++row) {
      const Rect panel{x, std::floor(top_) + static_cast<double>(row) * row_height, width,
                       static_cast<double>(row_height)};
      page_.panels.push_back({panel, i, options_.rows[row], view});
      if (options_.rows[row] == PanelStyle::kGhost) AddCurves(*column.figure, page_.panels.back());
    }
    const double bottom = top_ + row_height * static_cast<double>(options_.rows.size());
    AddText(column.caption, 0.5 * (left + right), bottom + 0.2 * CaptionSize(),
            {.size = CaptionSize(),
             .anchor = TextAnchor::kMiddle,
             .max_width = right - left - 0.5 * margin_},
            page_);
  }

  void AddCurves(const Figure& figure, const PagePanel& panel) {
    for (const bool is_front : {false, true}) {
      for (const FigureCurve& curve : figure.curves) AddCurve(curve, panel, is_front);
    }
  }

  // The half of a curve that faces the eye, or the other one, which is pale.
  void AddCurve(const FigureCurve& curve, const PagePanel& panel, bool is_front) {
    PagePath path;
    path.name = curve.name + (curve.is_outline ? ": outline" : ": circle") + " in place";
    path.stroke = curve.color;
    path.width = (curve.is_outline ? 1.9 : 1.5) * unit_;
    path.alpha = is_front ? 1.0 : 0.3;
    const std::size_t count = curve.points.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Vector3d& from = curve.points[i];
      const Vector3d& to = curve.points[(i + 1) % count];
      const Vector3d outward = 0.5 * (from + to) - curve.middle;
      // A curve that is seen flat has no back.
      const bool faces = outward.dot(panel.view.toward_eye()) >= -0.02 * outward.norm();
      if (faces == is_front) {
        if (path.points.empty()) path.points.push_back(OnPage(from, panel));
        path.points.push_back(OnPage(to, panel));
      }
      if ((faces != is_front || i + 1 == count) && !path.points.empty()) {
        page_.paths.push_back(path);
        path.points.clear();
      }
    }
  }

  static Vector2d OnPage(const Vector3d& point, const PagePanel& panel) {
    return panel.view.Project(point).head<2>() + Vector2d(panel.box.x, panel.box.y);
  }

  [[nodiscard]] double CaptionSize() const { return 18.0 * unit_; }
  [[nodiscard]] double LegendSize() const { return 16.0 * unit_; }

  // Below the panels: captions, then the bar and right of it the legend. The height is the same
  // wherever it stands, so it is found on a page that nobody sees.
  [[nodiscard]] double FootHeight() const {
    Page unseen;
    const double bar = options_.mm_per_unit ? kBarShare * InnerWidth() : 0.0;
    const double legend =
        AddLegend(options_.legend, 0.0, 0.0, InnerWidth() - bar, LegendSize(), unseen);
    return 1.8 * CaptionSize() + std::max(legend, bar > 0.0 ? 1.5 * LegendSize() : 0.0) +
           0.5 * margin_;
  }

  void AddFoot() {
    const double end = top_ + FootHeight();
    top_ += 1.8 * CaptionSize();
    double x = margin_;
    if (options_.mm_per_unit) {
      AddBar(scale_, top_);
      x += kBarShare * InnerWidth();
    }
    AddLegend(options_.legend, x, top_, page_.width - margin_ - x, LegendSize(), page_);
    top_ = end;
  }

  void AddBar(double pixels_per_unit, double y) {
    // What its label takes is left free of the share.
    const double room = kBarShare * InnerWidth() - 6.0 * LegendSize();
    const ScaleBar bar =
        FitScaleBar(pixels_per_unit / *options_.mm_per_unit, std::max(room, 2.0 * LegendSize()));
    AddScaleBar(bar, margin_, y, LegendSize(), page_);
  }

  absl::Status AddPolygons() {
    const double heading = top_ + 0.3 * margin_;
    AddLine("rule", {{margin_, heading}, {page_.width - margin_, heading}}, unit_, page_);
    const double bar_y = heading + margin_;
    const Rect area{margin_, bar_y + 1.8 * LegendSize(), InnerWidth(), 0.0};
    std::optional<double> room;
    if (options_.height) room = page_.height - area.y - 0.5 * margin_;
    const SheetPlan plan = PlanSheet(options_.polygons, area, room, LegendSize());
    const int needed = static_cast<int>(std::ceil(area.y + plan.height + 0.5 * margin_));
    if (room && plan.height > *room) {
      return InvalidField(ErrorReason::kOutOfRange, "height",
                          absl::StrCat("is ", page_.height, ", must be at least ", needed, " for ",
                                       options_.polygons.size(), " polygons"));
    }
    if (!room) page_.height = needed;
    if (options_.mm_per_unit) AddBar(plan.pixels_per_unit, bar_y);
    AddText(
        "seen from above, limbs as if they hung: front down, the body's left to the right; number: "
        "area of the circles outside (tinted) / area of the polygon",
        margin_ + kBarShare * InnerWidth(), bar_y,
        {.size = LegendSize(), .max_width = (1.0 - kBarShare) * InnerWidth()}, page_);
    AddSheet(options_.polygons, plan, LegendSize(), page_);
    return absl::OkStatus();
  }

  static constexpr double kBarShare = 0.16;  // of the page's width, for bar and label

  const std::vector<PictureColumn>& columns_;
  const PictureOptions& options_;
  Page page_;
  double unit_ = 1.0;            // a pixel of a page of 1500 x 1100
  double margin_ = 0.0;          // in pixels
  double top_ = 0.0;             // of what is not yet laid out
  double scale_ = 1.0;           // pixels for each of the figures' units
  std::vector<Extent> extents_;  // of each column
};

}  // namespace

absl::StatusOr<Page> LayOutPage(const std::vector<PictureColumn>& columns,
                                const PictureOptions& options) {
  return PageMaker(columns, options).Make();
}

absl::StatusOr<std::string> DrawPicture(const std::vector<PictureColumn>& columns,
                                        const PictureOptions& options, PictureFormat format,
                                        const ThreadPool& pool) {
  CAPFIT_ASSIGN_OR_RETURN(const Page page, LayOutPage(columns, options));
  std::vector<Pixels> pixels(page.panels.size());
  pool.ForEach(pixels.size(), [&](std::size_t i) {
    const PagePanel& panel = page.panels[i];
    pixels[i] = RenderPanel(*columns[panel.column].figure, panel.view,
                            {static_cast<int>(panel.box.width), static_cast<int>(panel.box.height),
                             panel.style, options.heat_limit});
  });
  return PaintPage(page, std::move(pixels), format);
}

}  // namespace capfit::client
