#include "core/pipeline/plan.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit::pipeline {
namespace {

// Polygons on the torso, on an arm, on a leg.
struct Layout {
  int torso = 0;
  int arm = 0;
  int leg = 0;
};

// From the smallest that still has a capsule in each chain to more than the paper's twenty.
constexpr std::array<Layout, 9> kLadder = {{{2, 2, 2},
                                            {3, 2, 2},
                                            {3, 2, 3},
                                            {4, 3, 3},
                                            {5, 3, 4},
                                            {6, 3, 4},
                                            {7, 4, 5},
                                            {9, 5, 6},
                                            {11, 6, 8}}};
constexpr Layout kPaperLayout = {6, 3, 4};

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
circle::PrimitiveCount ChainCost(int polygons, int circles) {
  return {polygons * circles, (polygons - 1) * circles * circles};
}

// With `torso_circles` on each torso polygon and one on each limb polygon.
circle::PrimitiveCount Cost(const Layout& layout, const ChainsPresent& chains, int torso_circles) {
  const circle::PrimitiveCount torso = ChainCost(layout.torso, torso_circles);
  const circle::PrimitiveCount arm = ChainCost(layout.arm, 1);
  const circle::PrimitiveCount leg = ChainCost(layout.leg, 1);
  return {chains.torsos * torso.spheres + chains.arms * arm.spheres + chains.legs * leg.spheres,
          chains.torsos * torso.capsules + chains.arms * arm.capsules + chains.legs * leg.capsules};
}

bool Fits(const circle::PrimitiveCount& cost, const circle::Budget& budget) {
  return cost.total() <= budget.max_primitives && cost.spheres <= budget.max_spheres &&
         cost.capsules <= budget.max_capsules;
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

absl::Status CheckLimit(const std::string& field, int limit, int least) {
  if (limit >= least) return absl::OkStatus();
  return InvalidField(ErrorReason::kBudgetTooSmall, field,
                      absl::StrCat("is ", limit, ", must be at least ", least,
                                   " for the parts asked for on this body"),
                      {{"value", absl::StrCat(limit)}, {"limit", absl::StrCat(">= ", least)}});
}

int Reduced(int limit, int by) {
  return limit == std::numeric_limits<int>::max() ? limit : std::max(0, limit - by);
}

}  // namespace

circle::Budget TotalBudget(const FitOptions& options) {
  circle::Budget budget;
  if (options.max_primitives.has_value()) budget.max_primitives = *options.max_primitives;
  if (options.max_spheres.has_value()) budget.max_spheres = *options.max_spheres;
  if (options.max_capsules.has_value()) budget.max_capsules = *options.max_capsules;
  // Capsules alone: a sphere more than that on each part, and no more, can be of use.
  if (options.max_capsules.has_value() && !options.max_spheres.has_value()) {
    budget.max_spheres = *options.max_capsules + body::kPartCount;
  }
  const bool is_limited = options.max_primitives.has_value() || options.max_spheres.has_value() ||
                          options.max_capsules.has_value() || options.polygon_error.has_value();
  if (!is_limited) budget.max_primitives = kDefaultMaxPrimitives;
  return budget;
}

Overhead OverheadOf(const body::Body& body, const body::PartSelection& parts,
                    const circle::Budget& total) {
  Overhead overhead;
  overhead.balls = CountBalls(body, parts);
  const ChainsPresent chains = CountChains(body, parts);
  if (chains.torsos == 0) return overhead;
  const int links = chains.arms + chains.legs;
  circle::PrimitiveCount least = Cost(kLadder.front(), chains, 1);
  least.spheres += overhead.balls;
  least.capsules += links;
  if (Fits(least, total)) overhead.links = links;
  return overhead;
}

absl::Status CheckBudget(const body::Body& body, const body::PartSelection& parts,
                         const circle::Budget& total) {
  circle::PrimitiveCount least = Cost(kLadder.front(), CountChains(body, parts), 1);
  least.spheres += CountBalls(body, parts);
  CAPFIT_RETURN_IF_ERROR(
      CheckLimit("options.budget.max_primitives", total.max_primitives, least.total()));
  CAPFIT_RETURN_IF_ERROR(CheckLimit("options.budget.spheres_and_capsules.max_spheres",
                                    total.max_spheres, least.spheres));
  return CheckLimit("options.budget.spheres_and_capsules.max_capsules", total.max_capsules,
                    least.capsules);
}

circle::Budget ChainBudget(const circle::Budget& total, const Overhead& overhead) {
  return {Reduced(total.max_primitives, overhead.balls + overhead.links),
          Reduced(total.max_spheres, overhead.balls), Reduced(total.max_capsules, overhead.links)};
}

section::SectionOptions PlanSections(const FitOptions& options, const body::Body& body,
                                     const circle::Budget& chain_budget) {
  const ChainsPresent chains = CountChains(body, options.parts);
  Layout chosen = kLadder.front();
  for (const Layout& layout : kLadder) {
    if (Fits(Cost(layout, chains, 2), chain_budget)) chosen = layout;
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
