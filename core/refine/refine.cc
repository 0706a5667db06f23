#include "core/refine/refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/refine/best_fit_objective.h"
#include "core/refine/between_vertices.h"
#include "core/refine/enclosing_descent.h"
#include "core/refine/enclosing_objective.h"
#include "core/refine/growth.h"
#include "core/refine/internal.h"
#include "core/refine/layout.h"
#include "core/refine/occupancy_grid.h"

namespace capfit::refine {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr double kCellM = 0.008;         // of the occupancy grid
constexpr double kThinnedCellM = 0.012;  // of the points that growing works on
constexpr double kFoldCellM = 2e-5;      // mirrored vertices this close count as one
constexpr int kNoLimit = 1'000'000;
constexpr int kClosingRounds = 6;
constexpr int kSettledRounds = 3;   // of them
constexpr int kFewPrimitives = 80;  // up to here exchanges are quick
// What a sphere or chain that hangs on nothing counts beside its primitives in a best fit: in one
// piece is what users want, but it costs a twentieth to a tenth of the error.
constexpr double kPieceCost = 0.35;
constexpr int kExchangesOfFew = 6;
constexpr int kExchangesOfMany = 2;
constexpr int kMostSpared = 10;  // primitives that a start may have too many

Spending SpendingOf(const circle::Budget& budget) {
  return {std::min(budget.max_primitives, kNoLimit), std::min(budget.max_spheres, kNoLimit),
          std::min(budget.max_capsules, kNoLimit)};
}

// The vertices of the selected parts; folded to x >= 0, copies dropped, where
// symmetric.
std::vector<CoverPoint> SelectedPoints(const body::Body& body, const RefineOptions& options) {
  std::vector<CoverPoint> points;
  for (std::size_t v = 0; v < body.mesh.vertices().size(); ++v) {
    if (!options.parts.Includes(body::PartOf(body.vertex_segments[v]))) continue;
    Eigen::Vector3f p = body.mesh.vertices()[v].cast<float>();
    if (body.is_symmetric) p.x() = std::abs(p.x());
    points.push_back({p, static_cast<float>(options.tolerance_m)});
  }
  if (!body.is_symmetric) return points;
  const auto key = [](const CoverPoint& p) {
    const Eigen::Vector3f q = p.position_m / static_cast<float>(kFoldCellM);
    return std::array<long, 3>{std::lround(q.x()), std::lround(q.y()), std::lround(q.z())};
  };
  std::vector<std::pair<std::array<long, 3>, std::size_t>> order(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) order[i] = {key(points[i]), i};
  std::sort(order.begin(), order.end());
  std::vector<CoverPoint> kept;
  for (std::size_t i = 0; i < order.size(); ++i) {
    // Rounding may part equal points or join points up to 20 um apart; both are
    // harmless: the kept set is enclosed in full at the end.
    if (i == 0 || order[i].first != order[i - 1].first) kept.push_back(points[order[i].second]);
  }
  return kept;
}

bool HasEnds(const body::Body& body, const body::PartSelection& parts) {
  return std::any_of(
      body.vertex_segments.begin(), body.vertex_segments.end(), [&](body::Segment s) {
        const body::Part part = body::PartOf(s);
        return U(static_cast<int>(part)) >= U(body::kChainCount) && parts.Includes(part);
      });
}

// By how many primitives the graph is beyond the spending; 0 when it fits.
int Excess(const Spending& spending, const CapsuleGraph& graph) {
  return std::max({0, graph.primitive_count() - spending.max_primitives,
                   graph.sphere_count() - spending.max_spheres,
                   graph.capsule_count() - spending.max_capsules});
}

// What the search may start from, at least one graph: the largest layout that
// fits, and the next one where little of it has to go.
std::vector<CapsuleGraph> StartingGraphs(const body::Body& body, const RefineOptions& options,
                                         const Spending& spending) {
  const Guise guise = options.enclose ? Guise::kEnclose : Guise::kBestFit;
  const bool with_ends = HasEnds(body, options.parts);
  std::vector<CapsuleGraph> starts;
  for (const NamedLayout& named : Layouts()) {
    if (named.guise != guise || named.with_ends != with_ends) continue;
    CapsuleGraph graph = HangLayout(named.layout, body, options.parts, body.is_symmetric);
    const int excess = Excess(spending, graph);
    if (excess == 0) starts.clear();
    if (excess <= kMostSpared || starts.empty()) starts.push_back(std::move(graph));
    if (excess > 0) break;
  }
  return starts;
}

// How the two guises are grown. Capsules between present spheres seldom pay when enclosing, and
// trying them takes most of the time; the best fit's edits show late what they are worth.
struct GrowthPlan {
  GrowthOptions at_first;
  GrowthOptions for_the_rest;
  bool cuts_the_rest = false;
};

GrowthPlan PlanGrowth(bool enclose, const Spending& spending) {
  GrowthPlan plan;
  plan.at_first.links = !enclose;
  plan.at_first.piece_cost = enclose ? 0.0 : kPieceCost;
  plan.cuts_the_rest = !enclose;
  plan.at_first.thorough_share = enclose ? 0.35 : 0.15;
  plan.for_the_rest = plan.at_first;
  plan.for_the_rest.links = true;
  const bool few = std::min(spending.max_primitives, spending.max_spheres) <= kFewPrimitives;
  if (!enclose) plan.for_the_rest.exchanges = few ? kExchangesOfFew : kExchangesOfMany;
  return plan;
}

void RemoveUseless(const GrowthPlan& plan, CapsuleGraph& graph) {
  if (plan.at_first.piece_cost > 0.0) MergeSwallowed(graph);
  RemoveSwallowed(graph);
}

// Settles the start and brings it up to the budget.
CapsuleGraph FindSet(const Objective& objective, const Spending& spending, const GrowthPlan& plan,
                     const ThreadPool& pool, const FitObserver& observer, CapsuleGraph graph) {
  objective.Settle(Effort::kRough, graph);
  RemoveUseless(plan, graph);
  Spare(objective, spending, plan.at_first, pool, observer, graph);
  Grow(objective, spending, plan.at_first, pool, observer, graph);
  Grow(objective, spending, plan.for_the_rest, pool, observer, graph);
  objective.Settle(Effort::kFinish, graph);
  RemoveUseless(plan, graph);
  // What has become useless in the end is spent once more.
  const int used = graph.primitive_count();
  GrowthOptions last;
  last.piece_cost = plan.at_first.piece_cost;
  Grow(objective, spending, last, pool, observer, graph);
  if (graph.primitive_count() != used) objective.Settle(Effort::kTighten, graph);
  if (plan.cuts_the_rest) SpendByCutting(objective, spending, observer, graph);
  return graph;
}

// The best set that one of the starts leads to.
CapsuleGraph FindBestSet(const Objective& objective, const Spending& spending,
                         const GrowthPlan& plan, const ThreadPool& pool,
                         const FitObserver& observer, std::vector<CapsuleGraph> starts) {
  CapsuleGraph best;
  double least = std::numeric_limits<double>::max();
  for (CapsuleGraph& start : starts) {
    CapsuleGraph graph = FindSet(objective, spending, plan, pool, observer, std::move(start));
    // Over the spending only where a cancellation cut the search short.
    const double value = objective.Value(graph) + Excess(spending, graph);
    if (value < least) {
      least = value;
      best = std::move(graph);
    }
  }
  return best;
}

// Until all vertices are inside and no triangle sticks out: adds the points of triangles that do,
// and settles again; in the last rounds only grows, which puts nothing out again.
void CloseGaps(const body::Body& body, const RefineOptions& options, double volume_m3,
               std::vector<CoverPoint> points, CapsuleGraph& graph) {
  for (int round = 0; round < kClosingRounds; ++round) {
    const std::vector<CoverPoint> between =
        StickingPoints(body, options.parts, options.tolerance_m, graph);
    if (round > 0 && between.empty()) return;
    points.insert(points.end(), between.begin(), between.end());
    const CoverPoints all = MakeCoverPoints(points);
    if (round < kSettledRounds) {
      const Effort effort = round == 0 ? Effort::kTighten : Effort::kTouch;
      EnclosingObjective(all, volume_m3).Settle(effort, graph);
    }
    CloseLastGaps(all, graph);
  }
}

body::Part PartAt(const body::Body& body, const Vec3& point_m) {
  double least = std::numeric_limits<double>::max();
  std::size_t nearest = 0;
  const auto vertices = body.mesh.vertices();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double distance = (vertices[v] - point_m).squaredNorm();
    if (distance < least) least = distance, nearest = v;
  }
  return body::PartOf(body.vertex_segments[nearest]);
}

capsule::PrimitiveSet ToPrimitives(const body::Body& body, const CapsuleGraph& graph,
                                   const ThreadPool& pool) {
  capsule::PrimitiveSet set;
  set.origins.resize(graph.nodes.size());
  pool.ForEach(graph.nodes.size(), [&](std::size_t v) {
    set.origins[v] = {PartAt(body, graph.nodes[v].center_m), -1, graph.nodes[v].mirror};
  });
  for (const Node& node : graph.nodes) set.spheres.push_back({node.center_m, node.radius_m});
  for (const Edge& edge : graph.edges) set.capsules.push_back({edge.a, edge.b});
  return set;
}

}  // namespace

capsule::PrimitiveSet RefineSet(const body::Body& body, const RefineOptions& options,
                                const ThreadPool& pool, const FitObserver& observer) {
  const Spending spending = SpendingOf(options.budget);
  const GrowthPlan plan = PlanGrowth(options.enclose, spending);
  CapsuleGraph graph;
  std::vector<CapsuleGraph> starts = StartingGraphs(body, options, spending);
  OccupancyGrid grid = MakeOccupancyGrid(body, options.parts, kCellM, body.is_symmetric);
  const double volume_m3 = std::max(1e-9, grid.volume_m3);
  const std::vector<CoverPoint> points = SelectedPoints(body, options);
  CoverPoints thinned = MakeCoverPoints(ThinOut(points, kThinnedCellM));
  if (options.enclose) {
    const EnclosingObjective objective(std::move(thinned), volume_m3);
    // Capsules between present spheres seldom pay here, and trying them takes
    // most of the time.
    graph = FindBestSet(objective, spending, plan, pool, observer, std::move(starts));
    CloseGaps(body, options, volume_m3, points, graph);
  } else {
    const BestFitObjective objective(std::move(grid), std::move(thinned), options.seed);
    graph = FindBestSet(objective, spending, plan, pool, observer, std::move(starts));
  }
  return ToPrimitives(body, graph, pool);
}

}  // namespace capfit::refine
