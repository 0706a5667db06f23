#include "client/picture/scale_bar.h"

#include <cmath>

#include "absl/strings/str_cat.h"

namespace capfit::client {
namespace {

std::string LengthLabel(double length_mm) {
  if (length_mm >= 1e6) return absl::StrCat(length_mm / 1e6, " km");
  if (length_mm >= 1e3) return absl::StrCat(length_mm / 1e3, " m");
  if (length_mm >= 10.0) return absl::StrCat(length_mm / 10.0, " cm");
  return absl::StrCat(length_mm, " mm");
}

}  // namespace

ScaleBar FitScaleBar(double pixels_per_mm, double max_pixels) {
  const double limit_mm = max_pixels / pixels_per_mm;
  const double power = std::pow(10.0, std::floor(std::log10(limit_mm)));
  double length_mm = power;
  for (const double times : {2.0, 5.0}) {
    if (times * power <= limit_mm) length_mm = times * power;
  }
  return {length_mm, length_mm * pixels_per_mm, LengthLabel(length_mm)};
}

double AddScaleBar(const ScaleBar& bar, double x, double y, double text_size, Page& page) {
  const double tick = 0.3 * text_size;
  const double middle = y + 0.5 * text_size;
  const double right = x + bar.pixels;
  AddLine("scale bar", {{x, middle}, {right, middle}}, 0.12 * text_size, page);
  for (const double end : {x, right}) {
    AddLine("scale bar end", {{end, middle - tick}, {end, middle + tick}}, 0.12 * text_size, page);
  }
  AddText(bar.label, right + 0.5 * text_size, y, {.size = text_size}, page);
  return page.texts.back().box.right() - x;
}

}  // namespace capfit::client
