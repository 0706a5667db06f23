#include "core/body/body_unit.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
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
// Of a unit that was named: from a child born far too early to the tallest man there was (2.72 m)
// reaching up a little. No body is beyond that.
constexpr double kMinToldHeightM = 0.25;
constexpr double kMaxToldHeightM = 3.0;
// A unit that makes the body this many times nearer to the usual height (by ratio) is rather meant.
constexpr double kFarMoreUsual = 2.0;
// Litres for each cubic metre of height: slim adults have 10, newborn children 28, the heaviest
// people 50. Bodies without head, hands and feet have some less.
constexpr double kLeastStoutness = 8.0;
constexpr double kMostStoutness = 60.0;
constexpr double kInfantStoutness = 17.0;
constexpr double kLitresPerCubicMetre = 1000.0;

double Oddness(double height_m) { return std::abs(std::log(height_m / kUsualHeightM)); }

const LengthUnit& MostUsual(double height) {
  return *std::min_element(std::begin(kUnits), std::end(kUnits),
                           [height](const LengthUnit& a, const LengthUnit& b) {
                             return Oddness(height * a.metres) < Oddness(height * b.metres);
                           });
}

std::string Metres(double metres) { return absl::StrFormat("%.3g m", metres); }

// "; in centimetres it would be 1.59 m", where that is another unit.
std::string Instead(const LengthUnit& told, double height) {
  const LengthUnit& usual = MostUsual(height);
  if (usual.unit == told.unit) return "";
  return absl::StrCat("; in ", std::string(usual.name), " it would be ",
                      Metres(height * usual.metres));
}

absl::Status CheckTold(const LengthUnit& told, double height) {
  const double height_m = height * told.metres;
  if (height_m >= kMinToldHeightM && height_m <= kMaxToldHeightM) return absl::OkStatus();
  return InvalidField(
      ErrorReason::kContradictsBody, "mesh.unit",
      absl::StrCat("is ", std::string(told.name), ", which makes the body ", Metres(height_m),
                   " tall", Instead(told, height)),
      {{"value", Metres(height_m)},
       {"limit", absl::StrCat("[", kMinToldHeightM, ", ", kMaxToldHeightM, "] m")}});
}

}  // namespace

absl::StatusOr<LengthUnit> ChooseUnit(Unit wanted, double height) {
  for (const LengthUnit& u : kUnits) {
    if (u.unit != wanted) continue;
    CAPFIT_RETURN_IF_ERROR(CheckTold(u, height));
    return u;
  }
  const LengthUnit& best = MostUsual(height);
  const double height_m = height * best.metres;
  if (height_m < kMinHeightM || height_m > kMaxHeightM) {
    return Refused(ErrorReason::kUnitUnknown,
                   absl::StrCat("the body is ", height,
                                " units tall, which is no human height in metres, centimetres, "
                                "millimetres or inches; name the unit"));
  }
  return best;
}

std::optional<Warning> JudgeToldUnit(const LengthUnit& told, double height, double volume) {
  const double height_m = height * told.metres;
  const double litres = kLitresPerCubicMetre * volume * std::pow(told.metres, 3);
  const double stoutness = litres / std::pow(height_m, 3);
  const bool is_far_less_usual =
      Oddness(height_m) - Oddness(height * MostUsual(height).metres) > std::log(kFarMoreUsual);
  const bool is_infant = height_m < kUsualHeightM && stoutness >= kInfantStoutness;
  const bool is_odd = (is_far_less_usual && !is_infant) || height_m > kMaxHeightM ||
                      stoutness < kLeastStoutness || stoutness > kMostStoutness;
  if (!is_odd) return std::nullopt;
  return Warning{"UNIT_CONTRADICTS_BODY",
                 absl::StrCat("told to be in ", std::string(told.name), ", which makes the body ",
                              Metres(height_m), " tall with ", absl::StrFormat("%.3g", litres),
                              " litres", Instead(told, height)),
                 0};
}

Unit UnitOf(double metres) {
  for (const LengthUnit& u : kUnits) {
    if (u.metres == metres) return u.unit;
  }
  return Unit::kAuto;
}

}  // namespace capfit::body
