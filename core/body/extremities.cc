#include "core/body/extremities.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace capfit::body {
namespace {

// Lengths below are in units of the square root of the surface's area (0.75 of the height).

// A limb stands out by at least this much. The shortest, the stump of a neck cut at half height,
// has 0.075; the longest finger 0.06.
constexpr double kMinPersistence = 0.068;
// More tips than this are not looked at; five are a body, a bun or a tail may add one or two.
constexpr int kMaxCandidates = 8;
// Distances start at the vertices nearest to the centroid, as far out as this factor, so that not
// a single vertex decides.
constexpr double kSourceShell = 1.3;

// Ways along the surface between two tips, half-way between bodies with and without head, hands
// and feet. Only their ratios count.
constexpr double kHandToHand = 0.65;
constexpr double kHeadToHand = 0.48;
constexpr double kHeadToFoot = 1.05;
constexpr double kHandToFoot = 1.20;
constexpr double kFootToFoot = 1.20;
// Both arms are about as long as each other, both legs too: weight of the log of the ratio.
constexpr double kUnequalPairCost = 0.5;
// What it costs to leave a role empty, or a tip without a role, in units of the misfit.
constexpr double kEmptyRoleCost = 0.12;
constexpr double kUnusedTipCost = 0.10;

double UsualWay(Tip a, Tip b) {
  const auto is_hand = [](Tip t) { return t == Tip::kHandA || t == Tip::kHandB; };
  if (a > b) std::swap(a, b);
  if (a == Tip::kHead) return is_hand(b) ? kHeadToHand : kHeadToFoot;
  if (is_hand(a)) return is_hand(b) ? kHandToHand : kHandToFoot;
  return kFootToFoot;
}

using Roles = std::array<int, kTipCount>;  // branch of each role, -1: none

// |log(length of a / length of b)|, both counted from the body's middle.
double Inequality(std::span<const Branch> branches, int a, int b) {
  if (a < 0 || b < 0) return 0.0;
  const double level = JunctionLevel(branches, a, b);
  const double length_a = std::max(branches[a].tip_distance - level, 1e-6);
  const double length_b = std::max(branches[b].tip_distance - level, 1e-6);
  return std::abs(std::log(length_a / length_b));
}

// Standard deviation of log(way / usual way) over all pairs, plus the cost of unequal pairs and of
// what is left over.
double Misfit(const Roles& roles, std::span<const Branch> branches, int candidates) {
  double sum = 0.0;
  double sum_of_squares = 0.0;
  int pairs = 0;
  int used = 0;
  for (int i = 0; i < kTipCount; ++i) {
    if (roles[i] < 0) continue;
    ++used;
    for (int j = i + 1; j < kTipCount; ++j) {
      if (roles[j] < 0) continue;
      const double way = branches[roles[i]].tip_distance + branches[roles[j]].tip_distance -
                         2.0 * JunctionLevel(branches, roles[i], roles[j]);
      const double deviation =
          std::log(std::max(way, 1e-6) / UsualWay(static_cast<Tip>(i), static_cast<Tip>(j)));
      sum += deviation;
      sum_of_squares += deviation * deviation;
      ++pairs;
    }
  }
  const double mean = pairs > 0 ? sum / pairs : 0.0;
  const double variance = pairs > 0 ? sum_of_squares / pairs - mean * mean : 0.0;
  const double inequality =
      Inequality(branches, roles[1], roles[2]) + Inequality(branches, roles[3], roles[4]);
  return std::sqrt(std::max(0.0, variance)) + kUnequalPairCost * inequality +
         kEmptyRoleCost * (kTipCount - used) + kUnusedTipCost * (candidates - used);
}

struct Assignment {
  Roles roles = {-1, -1, -1, -1, -1};
  double misfit = std::numeric_limits<double>::infinity();
};

// Tries every way to give the roles to the tips; equal roles (two hands) count once.
void TryRoles(int role, Roles& roles, std::span<const Branch> branches, int candidates,
              Assignment& best) {
  if (role == kTipCount) {
    const double misfit = Misfit(roles, branches, candidates);
    if (misfit < best.misfit) best = {roles, misfit};
    return;
  }
  const bool is_second =
      role == static_cast<int>(Tip::kHandB) || role == static_cast<int>(Tip::kFootB);
  const bool first_is_empty = is_second && roles[role - 1] < 0;
  const int first = is_second ? roles[role - 1] + 1 : 0;
  for (int tip = first; tip < candidates && !first_is_empty; ++tip) {
    if (std::find(roles.begin(), roles.begin() + role, tip) != roles.begin() + role) continue;
    roles[role] = tip;
    TryRoles(role + 1, roles, branches, candidates, best);
  }
  roles[role] = -1;
  TryRoles(role + 1, roles, branches, candidates, best);
}

// All vertices that can be reached from the tip without sinking to the level.
std::vector<std::uint32_t> VerticesAbove(const SurfaceGraph& graph,
                                         std::span<const double> distance, std::uint32_t tip,
                                         double level) {
  std::vector<char> seen(distance.size(), 0);
  std::vector<std::uint32_t> vertices = {tip};
  seen[tip] = 1;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (const std::uint32_t n : graph.Neighbours(vertices[i])) {
      if (seen[n] || !(distance[n] > level)) continue;
      seen[n] = 1;
      vertices.push_back(n);
    }
  }
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

std::vector<GeodesicSource> MiddleOfTheBody(std::span<const Eigen::Vector3d> points) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p : points) nearest = std::min(nearest, p.norm());
  std::vector<GeodesicSource> sources;
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    const double distance = points[v].norm();
    if (distance <= kSourceShell * nearest) sources.push_back({v, distance});
  }
  return sources;
}

Limb MakeLimb(const SurfaceGraph& graph, std::span<const double> distance,
              std::span<const Branch> branches, int branch, const Roles& roles) {
  Limb limb;
  limb.tip = branches[branch].tip;
  limb.tip_distance = branches[branch].tip_distance;
  for (const int other : roles) {
    if (other < 0 || other == branch) continue;
    limb.junction = std::max(limb.junction, JunctionLevel(branches, branch, other));
  }
  limb.vertices = VerticesAbove(graph, distance, limb.tip, limb.junction);
  return limb;
}

}  // namespace

int Extremities::found() const {
  return static_cast<int>(
      std::count_if(limbs.begin(), limbs.end(), [](const auto& limb) { return limb.has_value(); }));
}

Extremities FindExtremities(std::span<const Eigen::Vector3d> points, const SurfaceGraph& graph) {
  Extremities result;
  result.distance = graph.Distances(MiddleOfTheBody(points));
  const std::vector<Branch> branches = FindBranches(graph, result.distance, kMinPersistence);
  const int candidates = std::min(kMaxCandidates, static_cast<int>(branches.size()));
  Assignment best;
  Roles roles = {-1, -1, -1, -1, -1};
  TryRoles(0, roles, branches, candidates, best);
  result.misfit = best.misfit;
  for (int role = 0; role < kTipCount; ++role) {
    if (best.roles[role] < 0) continue;
    result.limbs[role] = MakeLimb(graph, result.distance, branches, best.roles[role], best.roles);
  }
  return result;
}

}  // namespace capfit::body
