#include "core/pipeline/plan.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/pipeline/engines.h"

namespace capfit::pipeline {
namespace {

// Polygons on the torso, on an arm, on a leg.
struct Layout {
  int torso = 0;
  int arm = 0;
  int leg = 0;
};

// From the smallest that still has a capsule in each chain to more than the paper's twenty.
constexpr std::array<Layout, 11> kLadder = {{{2, 2, 2},
                                             {3, 2, 2},
                                             {3, 2, 3},
                                             {4, 3, 3},
                                             {5, 3, 4},
                                             {6, 3, 4},
                                             {7, 4, 5},
                                             {9, 5, 6},
                                             {11, 6, 8},
                                             {14, 8, 10},
                                             {18, 10, 13}}};
constexpr Layout kPaperLayout = {6, 3, 4};

constexpr int kMostCapsulesPerSphere = 2;

struct ChainsPresent {
  int torsos = 0;
  int arms = 0;
  int legs = 0;
};

int Present(const body::Body& body, const body::PartSelection& parts, body::Part part) {
  return parts.Includes(part) && body.chain(part).has_value() ? 1 : 0;
}

ChainsPresent CountChains(const body::Body& body, const body::PartSelection& parts) {
  using body::Part;
  return {Present(body, parts, Part::kTorso),
          Present(body, parts, Part::kLeftArm) + Present(body, parts, Part::kRightArm),
          Present(body, parts, Part::kLeftLeg) + Present(body, parts, Part::kRightLeg)};
}

// A chain of `polygons` with `circles` on each and all pairs of neighbours joined.
capsule::PrimitiveCount ChainCost(int polygons, int circles) {
  return {polygons * circles, (polygons - 1) * circles * circles};
}

// With `torso_circles` on each torso polygon and one on each limb polygon.
capsule::PrimitiveCount Cost(const Layout& layout, const ChainsPresent& chains, int torso_circles) {
  const capsule::PrimitiveCount torso = ChainCost(layout.torso, torso_circles);
  const capsule::PrimitiveCount arm = ChainCost(layout.arm, 1);
  const capsule::PrimitiveCount leg = ChainCost(layout.leg, 1);
  return {chains.torsos * torso.spheres + chains.arms * arm.spheres + chains.legs * leg.spheres,
          chains.torsos * torso.capsules + chains.arms * arm.capsules + chains.legs * leg.capsules};
}

int CountBalls(const body::Body& body, const body::PartSelection& parts) {
  std::array<bool, body::kPartCount> has_vertices{};
  for (const body::Segment segment : body.vertex_segments) {
    has_vertices[static_cast<std::size_t>(body::PartOf(segment))] = true;
  }
  int balls = 0;
  for (int i = body::kChainCount; i < body::kPartCount; ++i) {
    const bool is_wanted = parts.Includes(static_cast<body::Part>(i));
    if (is_wanted && has_vertices[static_cast<std::size_t>(i)]) ++balls;
  }
  return balls;
}

// A limit that the caller gave, or none. `engine`: whose capsules make it so many; empty: any.
absl::Status CheckLimit(const std::string& field, const std::optional<int>& limit, int least,
                        const std::string& engine) {
  if (!limit.has_value() || *limit >= least) return absl::OkStatus();
  const std::string whose =
      engine.empty() ? "" : absl::StrCat(", as capsules of ", engine, " share no spheres");
  return InvalidField(ErrorReason::kBudgetTooSmall, field,
                      absl::StrCat("is ", *limit, ", must be at least ", least,
                                   " for the parts asked for on this body", whose),
                      {{"value", absl::StrCat(*limit)}, {"limit", absl::StrCat(">= ", least)}});
}

// What the engine allows is too little; what the caller gave is not.
absl::Status EngineTooSmall(const Engine& engine, const capsule::PrimitiveCount& least) {
  const bool has_shapes = engine.max_shapes > 0;
  const std::string allowed = has_shapes ? absl::StrCat(engine.max_shapes, " shapes")
                                         : absl::StrCat(engine.max_spheres, " spheres and ",
                                                        engine.max_capsules, " capsules");
  const std::string needed =
      has_shapes ? absl::StrCat(least.capsules, " capsules and further balls")
                 : absl::StrCat(least.spheres, " spheres and ", least.capsules, " capsules");
  return InvalidField(ErrorReason::kBudgetTooSmall, "options.engine",
                      absl::StrCat(std::string(engine.name), " allows ", allowed,
                                   ", the parts asked for on this body take at least ", needed),
                      {{"value", allowed}, {"limit", absl::StrCat(">= ", needed)}});
}

}  // namespace

capsule::Budget TotalBudget(const FitOptions& options) {
  capsule::Budget budget;
  if (options.max_primitives.has_value()) budget.max_primitives = *options.max_primitives;
  if (options.max_spheres.has_value()) budget.max_spheres = *options.max_spheres;
  if (options.max_capsules.has_value()) budget.max_capsules = *options.max_capsules;
  // Capsules alone: a sphere more than that on each part, and no more, can be of use.
  if (options.max_capsules.has_value() && !options.max_spheres.has_value()) {
    budget.max_spheres = *options.max_capsules + body::kPartCount;
  }
  // Spheres alone: with more capsules than that sets got no better, but looking took many times as
  // long.
  if (options.max_spheres.has_value() && !options.max_capsules.has_value()) {
    budget.max_capsules = kMostCapsulesPerSphere * *options.max_spheres;
  }
  if (options.polygon_error.has_value()) budget.max_primitives = kMaxPrimitivesRange.high;
  const bool is_limited = options.max_primitives.has_value() || options.max_spheres.has_value() ||
                          options.max_capsules.has_value() || options.polygon_error.has_value();
  if (!is_limited) budget.max_primitives = kDefaultMaxPrimitives;
  // What no set exceeds, whatever was asked for; left open where it cannot be reached.
  if (std::min(budget.max_primitives, budget.max_spheres) > kMaxSpheresRange.high) {
    budget.max_spheres = kMaxSpheresRange.high;
  }
  if (std::min(budget.max_primitives, budget.max_capsules) > kMaxCapsulesRange.high) {
    budget.max_capsules = kMaxCapsulesRange.high;
  }
  return budget;
}

Overhead OverheadOf(const body::Body& body, const body::PartSelection& parts,
                    const capsule::Budget& total) {
  Overhead overhead;
  overhead.balls = CountBalls(body, parts);
  const ChainsPresent chains = CountChains(body, parts);
  if (chains.torsos == 0) return overhead;
  const int links = chains.arms + chains.legs;
  capsule::PrimitiveCount least = Cost(kLadder.front(), chains, 1);
  least.spheres += overhead.balls;
  least.capsules += links;
  if (total.Allows(least)) overhead.links = links;
  return overhead;
}

absl::Status CheckBudget(const body::Body& body, const FitOptions& asked,
                         const FitOptions& limited) {
  const int balls = CountBalls(body, asked.parts);
  capsule::PrimitiveCount least = Cost(kLadder.front(), CountChains(body, asked.parts), 1);
  least.spheres += balls;
  if (TotalBudget(limited).Allows(least)) return absl::OkStatus();
  const Engine* const engine = FindEngine(asked.engine);
  std::string sharing;
  if (engine != nullptr && engine->profile == capsule::CapsuleProfile::kUniformRadius) {
    least.spheres = 2 * least.capsules + balls;
    sharing = asked.engine;
  }
  CAPFIT_RETURN_IF_ERROR(
      CheckLimit("options.budget.max_primitives", asked.max_primitives, least.total(), sharing));
  CAPFIT_RETURN_IF_ERROR(CheckLimit("options.budget.spheres_and_capsules.max_spheres",
                                    asked.max_spheres, least.spheres, sharing));
  CAPFIT_RETURN_IF_ERROR(CheckLimit("options.budget.spheres_and_capsules.max_capsules",
                                    asked.max_capsules, least.capsules, ""));
  if (engine != nullptr) return EngineTooSmall(*engine, least);
  return Refused(ErrorReason::kInternal, "the smallest set is beyond a budget that nobody gave");
}

capsule::Budget ChainBudget(const capsule::Budget& total, const Overhead& overhead) {
  return total.Without({overhead.balls, overhead.links});
}

section::SectionOptions PlanSections(const FitOptions& options, const body::Body& body,
                                     const capsule::Budget& chain_budget) {
  const ChainsPresent chains = CountChains(body, options.parts);
  Layout chosen = kLadder.front();
  for (const Layout& layout : kLadder) {
    if (chain_budget.Allows(Cost(layout, chains, 2))) chosen = layout;
  }
  if (options.polygon_error.has_value()) chosen = kPaperLayout;
  section::SectionOptions sections;
  sections.torso_polygons = chosen.torso;
  sections.arm_polygons = chosen.arm;
  sections.leg_polygons = chosen.leg;
  sections.sex = options.sex;
  sections.parts = options.parts;
  return sections;
}

}  // namespace capfit::pipeline
