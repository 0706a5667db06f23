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
constexpr int kClosingRounds = 3;

Spending SpendingOf(const circle::Budget& budget) {
  return {std::min(budget.max_primitives, kNoLimit), std::min(budget.max_spheres, kNoLimit),
          std::min(budget.max_capsules, kNoLimit)};
}

// The vertices of the selected parts; folded to x >= 0, copies dropped, where symmetric.
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
    // Rounding may part equal points or join points up to 20 um apart; both are harmless: the
    // kept set is enclosed in full at the end.
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

// The largest layout that fits; if none does, the smallest.
CapsuleGraph StartingGraph(const body::Body& body, const RefineOptions& options,
                           const Spending& spending) {
  const Guise guise = options.enclose ? Guise::kEnclose : Guise::kBestFit;
  const bool with_ends = HasEnds(body, options.parts);
  CapsuleGraph start;
  for (const NamedLayout& named : Layouts()) {
    if (named.guise != guise || named.with_ends != with_ends) continue;
    CapsuleGraph graph = HangLayout(named.layout, body, options.parts, body.is_symmetric);
    if (!start.nodes.empty() && !spending.Allows(graph)) break;
    start = std::move(graph);
  }
  return start;
}

// Settles the start and brings it up to the budget.
CapsuleGraph FindSet(const Objective& objective, const Spending& spending, bool links,
                     const ThreadPool& pool, const FitObserver& observer, CapsuleGraph graph) {
  objective.Settle(Effort::kRough, graph);
  RemoveSwallowed(graph);
  Spare(objective, spending, pool, observer, graph);
  GrowthOptions growth;
  growth.links = links;
  Grow(objective, spending, growth, pool, observer, graph);
  // What is left over buys capsules between spheres that are there.
  growth.links = true;
  Grow(objective, spending, growth, pool, observer, graph);
  objective.Settle(Effort::kFinish, graph);
  RemoveSwallowed(graph);
  return graph;
}

// Until all vertices are inside and no triangle sticks out: adds the points of triangles that do,
// and settles again.
void CloseGaps(const body::Body& body, const RefineOptions& options, double volume_m3,
               std::vector<CoverPoint> points, CapsuleGraph& graph) {
  for (int round = 0; round < kClosingRounds; ++round) {
    const std::vector<CoverPoint> between =
        StickingPoints(body, options.parts, options.tolerance_m, graph);
    points.insert(points.end(), between.begin(), between.end());
    const CoverPoints all = MakeCoverPoints(points);
    EnclosingObjective(all, volume_m3).Settle(round == 0 ? Effort::kFinish : Effort::kTouch, graph);
    CloseLastGaps(all, graph);
    if (round > 0 && between.empty()) return;
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
  CapsuleGraph graph = StartingGraph(body, options, spending);
  OccupancyGrid grid = MakeOccupancyGrid(body, options.parts, kCellM, body.is_symmetric);
  const double volume_m3 = std::max(1e-9, grid.volume_m3);
  const std::vector<CoverPoint> points = SelectedPoints(body, options);
  CoverPoints thinned = MakeCoverPoints(ThinOut(points, kThinnedCellM));
  if (options.enclose) {
    const EnclosingObjective objective(std::move(thinned), volume_m3);
    // Capsules between present spheres seldom pay here, and trying them takes most of the time.
    graph = FindSet(objective, spending, false, pool, observer, std::move(graph));
    CloseGaps(body, options, volume_m3, points, graph);
  } else {
    const BestFitObjective objective(std::move(grid), std::move(thinned), options.seed);
    graph = FindSet(objective, spending, true, pool, observer, std::move(graph));
  }
  return ToPrimitives(body, graph, pool);
}

}  // namespace capfit::refine
