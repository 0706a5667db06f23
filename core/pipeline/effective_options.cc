#include "core/pipeline/effective_options.h"

#include <array>
#include <cmath>

#include "core/body/body_unit.h"
#include "core/pipeline/engines.h"

namespace capfit::pipeline {
namespace {

// An axis this near to the body's own counts as the one that points up: wider than a stance leans,
// narrower than anything that could be mistaken for the next axis.
constexpr double kUpAxisDegrees = 15.0;
constexpr double kDegreesPerRadian = 57.29577951308232;

// The positive axis of the caller's frame that points up; kAuto where none does.
body::UpAxis UpAxisOf(const geometry::Similarity& body_from_caller) {
  constexpr std::array kAxes = {body::UpAxis::kX, body::UpAxis::kY, body::UpAxis::kZ};
  const double least = std::cos(kUpAxisDegrees / kDegreesPerRadian);
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    // Row 1 of the rotation is the body's up in the caller's axes.
    if (body_from_caller.rotation(1, static_cast<Eigen::Index>(axis)) >= least) return kAxes[axis];
  }
  return body::UpAxis::kAuto;
}

}  // namespace

FitOptions EffectiveOptions(const FitOptions& asked, const geometry::Similarity& body_from_caller) {
  FitOptions effective = WithEngineLimits(asked);
  // Profiles with capsules of their own keep a budget of primitives by one of capsules.
  if (asked.max_primitives.has_value()) effective.max_primitives = asked.max_primitives;
  if (asked.max_spheres.has_value() && !effective.max_spheres.has_value()) {
    effective.max_spheres = asked.max_spheres;
  }
  const bool is_limited = effective.max_primitives || effective.max_spheres ||
                          effective.max_capsules || effective.polygon_error || effective.layout;
  if (!is_limited) effective.max_primitives = kDefaultMaxPrimitives;
  effective.unit = body::UnitOf(body_from_caller.scale);
  effective.up = UpAxisOf(body_from_caller);
  return effective;
}

BodyFacts FactsOf(const formats::PolygonSoup& soup, const body::Body& body) {
  BodyFacts facts;
  facts.vertex_count = static_cast<std::int64_t>(soup.positions.size());
  facts.face_count = static_cast<std::int64_t>(soup.face_count());
  facts.height_m = body.height_m;
  facts.is_symmetric = body.is_symmetric;
  return facts;
}

}  // namespace capfit::pipeline
