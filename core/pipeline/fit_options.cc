#include <cmath>
#include <string>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/pipeline/engines.h"
#include "core/pipeline/fit.h"

namespace capfit::pipeline {
namespace {

absl::Status CheckCount(const std::string& field, const std::optional<int>& value,
                        const CountRange& range) {
  if (!value.has_value() || (*value >= range.low && *value <= range.high)) return absl::OkStatus();
  return OutOfRange(field, *value, range.low, range.high);
}

absl::Status CheckPolygonError(const std::optional<double>& value) {
  if (!value.has_value() || (*value >= kMinPolygonError && *value <= kMaxPolygonError)) {
    return absl::OkStatus();
  }
  return OutOfRange("options.budget.max_polygon_error", *value, kMinPolygonError, kMaxPolygonError);
}

absl::Status CheckOneBudget(const FitOptions& options) {
  const int ways = (options.max_primitives.has_value() ? 1 : 0) +
                   (options.max_spheres.has_value() || options.max_capsules.has_value() ? 1 : 0) +
                   (options.polygon_error.has_value() ? 1 : 0);
  if (ways <= 1) return absl::OkStatus();
  return InvalidField(ErrorReason::kConflict, "options.budget",
                      "is given in more than one way, must be one of max_primitives, "
                      "spheres_and_capsules, max_polygon_error");
}

absl::Status CheckEngine(const FitOptions& options) {
  if (options.engine.empty()) return absl::OkStatus();
  const Engine* const engine = FindEngine(options.engine);
  if (engine == nullptr) {
    return InvalidField(
        ErrorReason::kUnknownValue, "options.engine",
        absl::StrCat("is \"", options.engine.substr(0, 40), "\", must be one of ", EngineNames()),
        {{"value", options.engine.substr(0, 40)}, {"limit", EngineNames()}});
  }
  if (options.polygon_error.has_value() &&
      engine->max_spheres + engine->max_capsules + engine->max_shapes > 0) {
    return InvalidField(ErrorReason::kConflict, "options.budget.max_polygon_error",
                        absl::StrCat("cannot be promised within the limits of ", options.engine,
                                     "; leave one of them out"));
  }
  return absl::OkStatus();
}

absl::Status CheckLayout(const FitOptions& options) {
  if (!options.layout) return absl::OkStatus();
  if (options.max_primitives || options.max_spheres || options.max_capsules ||
      options.polygon_error) {
    return InvalidField(ErrorReason::kConflict, "options.budget",
                        "cannot be given beside a layout, which says what is spent");
  }
  CAPFIT_RETURN_IF_ERROR(refine::CheckLayout(*options.layout));
  if (options.engine.empty()) return absl::OkStatus();
  const Engine& engine = *FindEngine(options.engine);
  if (engine.profile == capsule::CapsuleProfile::kUniformRadius) {
    return InvalidField(ErrorReason::kConflict, "options.engine",
                        absl::StrCat("is ", options.engine,
                                     ", whose capsules share no spheres: it cannot keep a layout"));
  }
  const auto check = [&](const char* field, int count, int limit) {
    if (limit == 0 || count <= limit) return absl::OkStatus();
    return TooLarge(field, count, absl::StrCat("of them for ", options.engine), limit);
  };
  const capsule::PrimitiveCount count = options.layout->count();
  CAPFIT_RETURN_IF_ERROR(check("layout.spheres", count.spheres, engine.max_spheres));
  return check("layout.capsules", count.capsules, engine.max_capsules);
}

absl::Status CheckExports(const std::vector<ExportWish>& wishes) {
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    const std::string field = absl::StrCat("exports[", i, "]");
    const std::string& format = wishes[i].format;
    if (exports::FindExportFormat(format) == nullptr) {
      return InvalidField(
          ErrorReason::kUnknownValue, field + ".format",
          absl::StrCat("is \"", format.substr(0, 40), "\", must be one of ",
                       exports::ExportFormatNames()),
          {{"value", format.substr(0, 40)}, {"limit", exports::ExportFormatNames()}});
    }
    for (std::size_t before = 0; before < i; ++before) {
      if (wishes[before].format != format) continue;
      return InvalidField(ErrorReason::kDuplicate, field + ".format",
                          absl::StrCat("is ", format, " for the second time"));
    }
    const double overshoot_m = wishes[i].options.max_overshoot_m;
    if (!(overshoot_m >= exports::kMinOvershootM && overshoot_m <= exports::kMaxOvershootM)) {
      return OutOfRange(field + ".max_overshoot_m", overshoot_m, exports::kMinOvershootM,
                        exports::kMaxOvershootM);
    }
  }
  return absl::OkStatus();
}

absl::Status CheckParts(const body::PartSelection& parts) {
  if (parts.torso || parts.arms || parts.legs || parts.head || parts.hands || parts.feet) {
    return absl::OkStatus();
  }
  return InvalidField(ErrorReason::kMissing, "options.parts",
                      "is empty, must name at least one of torso, arms, legs, head, hands, feet");
}

absl::Status CheckPartNames(const std::string& field, const std::vector<std::string>& names) {
  if (names.size() > kMostPartNames) return TooLarge(field, names.size(), "names", kMostPartNames);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string element = absl::StrCat(field, "[", i, "]");
    if (names[i].size() > kLongestPartName) {
      return TooLarge(element, names[i].size(), "bytes", kLongestPartName);
    }
    if (names[i].empty()) {
      return InvalidField(ErrorReason::kMissing, element, "is empty, must name a part");
    }
  }
  return absl::OkStatus();
}

absl::Status CheckTolerance(const FitOptions& options) {
  if (!(options.tolerance_m >= 0.0 && options.tolerance_m <= kMaxToleranceM)) {
    return OutOfRange("options.tolerance_m", options.tolerance_m, 0.0, kMaxToleranceM);
  }
  if (options.tolerance_m > 0.0 && options.fit == FitMode::kBestFit) {
    return InvalidField(ErrorReason::kConflict, "options.tolerance_m",
                        "is for fit enclose; the best fit encloses nothing");
  }
  return absl::OkStatus();
}

absl::Status CheckMotionFits(const FitOptions& options) {
  if (options.motion == nullptr) return absl::OkStatus();
  if (options.fit != FitMode::kEnclose) {
    return InvalidField(ErrorReason::kConflict, "motion",
                        "is for fit enclose; the best fit encloses nothing");
  }
  if (ProfileOf(options) == capsule::CapsuleProfile::kTangentHull) return absl::OkStatus();
  return InvalidField(ErrorReason::kConflict, "motion",
                      absl::StrCat("cannot be enclosed for ", options.engine,
                                   ", whose capsules are no tangent hulls"));
}

absl::Status CheckLandmarks(const FitOptions& options) {
  for (const auto& [id, position] : options.landmarks) {
    if (position.allFinite()) continue;
    return InvalidField(ErrorReason::kNotFinite,
                        absl::StrCat("options.landmarks.", std::string(body::LandmarkName(id))),
                        "must be finite");
  }
  return absl::OkStatus();
}

}  // namespace

std::string_view QualityName(Quality quality) {
  switch (quality) {
    case Quality::kPaper:
      return "paper";
    case Quality::kBalanced:
      return "balanced";
    case Quality::kTight:
      return "tight";
  }
  return "";
}

absl::Status ValidateOptions(const FitOptions& options) {
  CAPFIT_RETURN_IF_ERROR(CheckOneBudget(options));
  CAPFIT_RETURN_IF_ERROR(
      CheckCount("options.budget.max_primitives", options.max_primitives, kMaxPrimitivesRange));
  CAPFIT_RETURN_IF_ERROR(CheckCount("options.budget.spheres_and_capsules.max_spheres",
                                    options.max_spheres, kMaxSpheresRange));
  CAPFIT_RETURN_IF_ERROR(CheckCount("options.budget.spheres_and_capsules.max_capsules",
                                    options.max_capsules, kMaxCapsulesRange));
  CAPFIT_RETURN_IF_ERROR(CheckPolygonError(options.polygon_error));
  CAPFIT_RETURN_IF_ERROR(CheckEngine(options));
  CAPFIT_RETURN_IF_ERROR(CheckLayout(options));
  CAPFIT_RETURN_IF_ERROR(CheckParts(options.parts));
  CAPFIT_RETURN_IF_ERROR(CheckLandmarks(options));
  CAPFIT_RETURN_IF_ERROR(CheckExports(options.exports));
  CAPFIT_RETURN_IF_ERROR(CheckMotionFits(options));
  CAPFIT_RETURN_IF_ERROR(CheckPartNames("options.include_parts", options.character.include));
  CAPFIT_RETURN_IF_ERROR(CheckPartNames("options.exclude_parts", options.character.exclude));
  if (options.grows_only && options.quality != Quality::kPaper) {
    return InvalidField(ErrorReason::kConflict, "grows_only",
                        "is for quality paper, must be false for others");
  }
  return CheckTolerance(options);
}

}  // namespace capfit::pipeline
