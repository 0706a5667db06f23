// The cloth engines whose budgets and capsules capfit knows.
#ifndef CAPFIT_CORE_PIPELINE_ENGINES_H_
#define CAPFIT_CORE_PIPELINE_ENGINES_H_

#include <span>
#include <string>
#include <string_view>

#include "core/capsule/capsule_profile.h"

namespace capfit::pipeline {

struct FitOptions;

struct Engine {
  std::string_view name;  // the word of the options
  int max_spheres = 0;    // 0: no limit of its own, here and below
  int max_capsules = 0;
  int max_shapes = 0;  // capsules, and spheres that no capsule uses
  capsule::CapsuleProfile profile = capsule::CapsuleProfile::kTangentHull;
};

[[nodiscard]] std::span<const Engine> Engines();
// Nothing for an unknown name.
[[nodiscard]] const Engine* FindEngine(std::string_view name);
// What the options' engine makes of a capsule; the tangent hull without one.
[[nodiscard]] capsule::CapsuleProfile ProfileOf(const FitOptions& options);
// "nvcloth, unity_cloth, ...": for messages.
[[nodiscard]] std::string EngineNames();

// The options with the limits of their engine among the budget: the lower of both holds. A set
// whose capsules share no spheres takes three primitives for each, so its budget is turned into one
// of capsules, and its 500 spheres make 250 capsules. Without an engine, the options as they are.
[[nodiscard]] FitOptions WithEngineLimits(const FitOptions& options);

// How many capsules must go until `set`, in the engine's own form, keeps all limits of `options`,
// and has no more than 500 spheres.
[[nodiscard]] int ExcessCapsules(const FitOptions& options, const capsule::PrimitiveSet& set);

}  // namespace capfit::pipeline

#endif  // CAPFIT_CORE_PIPELINE_ENGINES_H_
