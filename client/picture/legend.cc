#include "client/picture/legend.h"

#include <algorithm>
#include <cstdio>

namespace capfit::client {
namespace {

// Of the text's size.
constexpr double kLineHeight = 1.5;
constexpr double kMarkWidth = 1.4;
constexpr double kMarkGap = 0.45;
constexpr double kEntryGap = 1.3;

void AddMark(const LegendEntry& entry, const Rect& box, Page& page) {
  if (entry.mark == LegendMark::kArea) {
    AddArea(entry.words, box, entry.color, page);
    return;
  }
  const double middle = box.y + 0.5 * box.height;
  AddLine(entry.words, {{box.x, middle}, {box.right(), middle}}, 0.14 * box.height, page);
  page.paths.back().stroke = entry.color;
  page.paths.back().is_dashed = entry.mark == LegendMark::kDashedLine;
}

std::string GapLabel(double gap_mm) {
  char label[32];
  std::snprintf(label, sizeof(label), gap_mm == 0.0 ? "0" : "%+.3g", gap_mm);
  return label;
}

}  // namespace

std::string Spaced(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

double AddLegend(const std::vector<LegendEntry>& entries, double x, double y, double width,
                 double text_size, Page& page) {
  if (entries.empty()) return 0.0;
  const double indent = (kMarkWidth + kMarkGap) * text_size;
  double at = x;
  double top = y;
  for (const LegendEntry& entry : entries) {
    const double length = indent + TextWidth(entry.words, text_size);
    if (at > x && at + length > x + width) {
      at = x;
      top += kLineHeight * text_size;
    }
    AddMark(entry, {at, top, kMarkWidth * text_size, text_size}, page);
    AddText(entry.words, at + indent, top, {.size = text_size, .max_width = width - indent}, page);
    at += length + kEntryGap * text_size;
  }
  return top + kLineHeight * text_size - y;
}

void AddGapBar(double limit_mm, const Rect& box, double text_size, Page& page) {
  constexpr int kSteps = 200;
  const double line = 1.25 * text_size;
  AddText("gap, mm", box.x, box.y, {.size = text_size, .max_width = box.width}, page);
  AddText("covered", box.x, box.y + line, {.size = 0.85 * text_size, .max_width = box.width}, page);
  AddText("sticks out", box.x, box.bottom() - line,
          {.size = 0.85 * text_size, .max_width = box.width}, page);
  const double top = box.y + 2.5 * line;
  const double height = box.height - 4.1 * line;
  const double step = height / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const Color color = SignedColor(1.0 - 2.0 * (i + 0.5) / kSteps);
    // Each a little longer, so that no paper shows between two of them.
    AddArea("gap", {box.x, top + step * i, 1.3 * text_size, step + (i + 1 < kSteps ? 1.0 : 0.0)},
            color, page);
  }
  for (const double value : {1.0, 0.5, 0.0, -0.5, -1.0}) {
    AddText(GapLabel(-value * limit_mm), box.x + 1.8 * text_size,
            top + 0.5 * height * (1.0 - value) - 0.4 * text_size,
            {.size = text_size, .max_width = box.width - 1.8 * text_size}, page);
  }
}

}  // namespace capfit::client
