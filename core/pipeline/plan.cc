#include "core/pipeline/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/enum_index.h"
#include "core/base/status.h"
#include "core/capsule/build_primitives.h"
#include "core/pipeline/engines.h"

namespace capfit::pipeline {
namespace {

// Polygons on the torso, on an arm, on a leg. `room`: what the budget must have for them, relative
// to their cost with one circle each.
struct Layout {
  int torso = 0;
  int arm = 0;
  int leg = 0;
  double room = 1.0;
};

// From the smallest that still has a capsule in each chain to more than the paper's twenty. With
// little to spend, more polygons serve better than more circles on each; later both grow. Layouts
// and room: what was best of up to nine layouts at each of twelve budgets, over 13 bodies; the best
// few are within some per cent of each other. From 11 polygons on the trunk on room is what was
// best of three to five at 20 budgets, over 19 bodies and six densities of one: with less, several
// levels of the chest in a row have two circles each, and end where one of them swallows its
// neighbours.
constexpr std::array<Layout, 13> kLadder = {{{2, 2, 2, 1.0},
                                             {3, 2, 2, 1.0},
                                             {3, 2, 3, 1.0},
                                             {3, 3, 3, 1.0},
                                             {3, 3, 4, 1.0},
                                             {4, 3, 4, 1.0},
                                             {6, 3, 5, 1.2},
                                             {6, 4, 6, 1.3},
                                             {8, 5, 7, 1.3},
                                             {9, 5, 8, 1.6},
                                             {11, 6, 9, 2.2},
                                             {14, 8, 10, 2.6},
                                             {18, 10, 13, 3.0}}};
constexpr Layout kPaperLayout = {6, 3, 4, 1.0};

// Balls of head, hands and feet. `room`: what the budget must have, relative to the least set with
// one ball each.
struct EndLayout {
  capsule::EndBalls balls;
  double room = 1.0;
};

// A second ball for the head pays first, hands and feet follow: what was best of some ten at each
// of twelve budgets or more, over 19 bodies.
constexpr std::array<EndLayout, 8> kEndLadder = {{{{1, 1, 1}, 1.0},
                                                  {{2, 1, 1}, 1.6},
                                                  {{3, 2, 1}, 2.1},
                                                  {{4, 4, 1}, 4.0},
                                                  {{5, 5, 2}, 4.3},
                                                  {{7, 7, 3}, 5.4},
                                                  {{8, 8, 4}, 6.8},
                                                  {{8, 10, 5}, 8.6}}};

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

// With one circle on each polygon.
capsule::PrimitiveCount Cost(const Layout& layout, const ChainsPresent& chains) {
  const int spheres =
      chains.torsos * layout.torso + chains.arms * layout.arm + chains.legs * layout.leg;
  return {spheres, spheres - chains.torsos - chains.arms - chains.legs};
}

// What a budget must have for it.
capsule::PrimitiveCount Times(double room, const capsule::PrimitiveCount& cost) {
  const auto more = [&](int count) { return static_cast<int>(std::lround(room * count)); };
  return {more(cost.spheres), more(cost.capsules)};
}

// The heads, hands and feet that get a ball. O(vertices).
std::vector<body::Part> EndsPresent(const body::Body& body, const body::PartSelection& parts) {
  const std::array<bool, body::kPartCount> has_vertices = body::PartsAmong(body.vertex_segments);
  std::vector<body::Part> ends;
  for (int i = body::kChainCount; i < body::kPartCount; ++i) {
    const body::Part part = static_cast<body::Part>(i);
    if (parts.Includes(part) && has_vertices[i]) ends.push_back(part);
  }
  return ends;
}

int CountBalls(const std::vector<body::Part>& ends, const capsule::EndBalls& balls) {
  int count = 0;
  for (const body::Part end : ends) count += balls.Of(end);
  return count;
}

// Capsules between the balls of a part and from them to its chain, at most: the head's balls are
// joined to both of a pair.
int CountBallLinks(const body::Body& body, const body::PartSelection& parts,
                   const std::vector<body::Part>& ends, const capsule::EndBalls& balls) {
  int links = 0;
  for (const body::Part end : ends) {
    links += balls.Of(end) - 1;
    links += Present(body, parts, capsule::ChainAt(end)) * (end == body::Part::kHead ? 2 : 1);
  }
  return links;
}

// The smallest chains, so many balls for the ends, and the links of both.
capsule::PrimitiveCount LeastWith(const capsule::EndBalls& balls, const body::Body& body,
                                  const body::PartSelection& parts,
                                  const std::vector<body::Part>& ends) {
  const ChainsPresent chains = CountChains(body, parts);
  capsule::PrimitiveCount least = Cost(kLadder.front(), chains);
  least.spheres += CountBalls(ends, balls);
  least.capsules += CountBallLinks(body, parts, ends, balls);
  if (chains.torsos > 0) least.capsules += chains.arms + chains.legs;
  return least;
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

Overhead OverheadOf(const body::Body& body, const FitOptions& options,
                    const capsule::Budget& total) {
  const body::PartSelection& parts = options.parts;
  const std::vector<body::Part> ends = EndsPresent(body, parts);
  Overhead overhead;
  overhead.balls = CountBalls(ends, overhead.end_balls);
  const ChainsPresent chains = CountChains(body, parts);
  capsule::PrimitiveCount least = Cost(kLadder.front(), chains);
  least.spheres += overhead.balls;
  if (chains.torsos > 0) {
    least.capsules += chains.arms + chains.legs;
    if (!total.Allows(least)) return overhead;
    overhead.limb_links = chains.arms + chains.legs;
  }
  if (options.grows_only) return overhead;  // links would only make balls of full size larger
  least = LeastWith({}, body, parts, ends);
  if (!total.Allows(least)) return overhead;
  for (const EndLayout& layout : kEndLadder) {
    if (total.Allows(Times(layout.room, least)) &&
        total.Allows(LeastWith(layout.balls, body, parts, ends))) {
      overhead.end_balls = layout.balls;
    }
  }
  overhead.balls = CountBalls(ends, overhead.end_balls);
  overhead.ball_links = CountBallLinks(body, parts, ends, overhead.end_balls);
  return overhead;
}

absl::Status CheckBudget(const body::Body& body, const FitOptions& asked,
                         const FitOptions& limited) {
  const int balls = CountBalls(EndsPresent(body, asked.parts), {});
  capsule::PrimitiveCount least = Cost(kLadder.front(), CountChains(body, asked.parts));
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
  return total.Without({overhead.balls, overhead.limb_links + overhead.ball_links});
}

section::SectionOptions PlanSections(const FitOptions& options, const body::Body& body,
                                     const capsule::Budget& chain_budget) {
  const ChainsPresent chains = CountChains(body, options.parts);
  Layout chosen = kLadder.front();
  for (const Layout& layout : kLadder) {
    if (chain_budget.Allows(Times(layout.room, Cost(layout, chains)))) chosen = layout;
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
