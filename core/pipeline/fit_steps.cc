#include "core/pipeline/fit_steps.h"

#include "core/pipeline/engines.h"
#include "core/pipeline/plan.h"

namespace capfit::pipeline {
namespace {

constexpr int kFewPrimitives = 48;

bool IsUniform(const FitOptions& options) {
  return ProfileOf(options) == capsule::CapsuleProfile::kUniformRadius;
}

}  // namespace

bool IsSearched(const FitOptions& options) { return options.quality != Quality::kPaper; }

bool NeedsPolygons(const FitOptions& options) {
  return !IsSearched(options) || options.want_polygons || options.polygon_error.has_value() ||
         ComparesWithPaper(options);
}

bool ComparesWithPaper(const FitOptions& options) {
  if (!IsSearched(options) || options.fit != FitMode::kEnclose) return false;
  const capsule::Budget budget = TotalBudget(options);
  const body::PartSelection& parts = options.parts;
  return !parts.torso || !parts.arms || !parts.legs || IsUniform(options) ||
         budget.max_primitives < kFewPrimitives || budget.max_spheres < kFewPrimitives / 2 ||
         budget.max_capsules < kFewPrimitives / 2;
}

bool DraftsServe(const FitOptions& options) {
  return options.fit == FitMode::kEnclose && !options.grows_only && !options.polygon_error;
}

bool HasShape(const FitOptions& options) {
  return IsSearched(options) || options.layout.has_value();
}

bool CoversLast(const FitOptions& options, const body::Body& body) {
  return options.fit == FitMode::kEnclose && options.motion == nullptr && !body.shells &&
         ProfileOf(options) != capsule::CapsuleProfile::kLerpedRadius;
}

refine::RefineOptions RefineOptionsFor(const FitOptions& options, const capsule::Budget& budget,
                                       bool will_move) {
  refine::RefineOptions refine_options;
  refine_options.enclose = options.fit == FitMode::kEnclose;
  refine_options.budget = budget;
  refine_options.tolerance_m = options.tolerance_m;
  refine_options.parts = options.parts;
  refine_options.thorough = options.quality == Quality::kTight;
  refine_options.will_move = will_move;
  refine_options.seed = options.seed;
  return refine_options;
}

coverage::CoverOptions CoverOptionsFor(const FitOptions& options, bool has_shape) {
  coverage::CoverOptions cover_options;
  cover_options.tolerance_m = options.tolerance_m;
  cover_options.tighten = !options.grows_only;
  cover_options.uniform_radius = IsUniform(options);
  cover_options.keeps_swallowed = options.layout.has_value();
  if (has_shape && !cover_options.uniform_radius) {
    cover_options.loosening = coverage::Loosening::kNone;
  } else if (IsSearched(options)) {
    cover_options.loosening = coverage::Loosening::kThorough;
  }
  return cover_options;
}

}  // namespace capfit::pipeline
