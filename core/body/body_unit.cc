#include "core/body/body_unit.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::body {
namespace {

constexpr LengthUnit kUnits[] = {{Unit::kMetre, 1.0, "metres"},
                                 {Unit::kCentimetre, 0.01, "centimetres"},
                                 {Unit::kMillimetre, 0.001, "millimetres"},
                                 {Unit::kInch, 0.0254, "inches"}};
constexpr double kUsualHeightM = 1.6;
constexpr double kMinHeightM = 0.4;
constexpr double kMaxHeightM = 2.8;

double Oddness(double height_m) { return std::abs(std::log(height_m / kUsualHeightM)); }

}  // namespace

absl::StatusOr<LengthUnit> ChooseUnit(Unit wanted, double height) {
  const LengthUnit* best = &kUnits[0];
  for (const LengthUnit& u : kUnits) {
    if (u.unit == wanted) return u;
    if (Oddness(height * u.metres) < Oddness(height * best->metres)) best = &u;
  }
  const double height_m = height * best->metres;
  if (height_m < kMinHeightM || height_m > kMaxHeightM) {
    return Refused(ErrorReason::kUnitUnknown,
                   absl::StrCat("the body is ", height,
                                " units tall, which is no human height in metres, centimetres, "
                                "millimetres or inches; name the unit"));
  }
  return *best;
}

Unit UnitOf(double metres) {
  for (const LengthUnit& u : kUnits) {
    if (u.metres == metres) return u.unit;
  }
  return Unit::kAuto;
}

}  // namespace capfit::body
