#include "core/body/extremities.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/enum_index.h"
#include "core/body/tip_roles.h"

namespace capfit::body {
namespace {

// Lengths below are in units of the square root of the surface's area (0.75 of the height).

// A limb stands out by at least this much; the longest finger has 0.06.
constexpr double kMinPersistence = 0.068;
// Of an upper body, which has about half of the area, fingers come to more. They join the others
// farther out than this share of the farthest tip's distance; nothing else does.
constexpr double kMaxJunctionOfUpperBody = 0.75;
// The stump of a neck may be shorter. It is taken for one where it joins well inside the body
// (fingers join far out, at 0.7 of the farthest tip and more), and for nothing but a head.
constexpr double kMinStump = 0.018;
constexpr double kMaxStumpJunction = 0.66;
// More tips than this are not looked at; five are a body, a bun or a tail may add one or two.
constexpr int kMaxCandidates = 8;
constexpr int kMaxStumps = 3;
// Distances start at the vertices nearest to the centroid, as far out as this factor, so that not
// a single vertex decides.
constexpr double kSourceShell = 1.3;

// A piece as wide as a trunk (1.0) is no limb.
constexpr double kMaxLimbGirth = 0.85;

// Of an upper body: a piece more open than this is what is left of the trunk above its cut (.75 to
// .85); heads have .1 to .4, thighs up to .55.
constexpr double kMostOpen = 0.65;

// A result worse than the first is not trusted before the middle that no pose moves has been tried,
// one worse than the second before still others have.
constexpr double kGoodMisfit = 0.17;
constexpr double kFairMisfit = 0.30;
// That middle is sought from this many tips, and is this much wide.
constexpr int kSweeps = 4;
constexpr double kMiddleWidth = 0.03;
// At most this many other middles.
constexpr int kMaxMiddles = 4;

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
  // In order.
  auto next = vertices.begin();
  for (std::uint32_t v = 0; v < seen.size(); ++v) {
    if (seen[v]) *next++ = v;
  }
  return vertices;
}

// The vertices nearest to the centroid.
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

// The vertices that are nearest to the farthest tips along the surface: near the waist in any pose,
// where the centroid may be at a thigh that is lifted, or a hand that rests on a hip. `distance` is
// from any place on the trunk.
std::vector<GeodesicSource> MiddleOfTheSurface(std::span<const double> distance,
                                               const SurfaceGraph& graph, const ThreadPool& pool,
                                               const FitObserver& observer) {
  std::vector<double> nearest_tip(distance.begin(), distance.end());
  std::vector<double> farthest_tip(distance.size(), 0.0);
  for (int sweep = 0; sweep < kSweeps && !observer.IsCancelled(); ++sweep) {
    const auto tip = static_cast<std::uint32_t>(
        std::max_element(nearest_tip.begin(), nearest_tip.end()) - nearest_tip.begin());
    const std::vector<double> from_tip =
        graph.Distances(std::array{GeodesicSource{tip, 0.0}}, pool, observer);
    for (std::size_t v = 0; v < from_tip.size(); ++v) {
      nearest_tip[v] = sweep == 0 ? from_tip[v] : std::min(nearest_tip[v], from_tip[v]);
      farthest_tip[v] = std::max(farthest_tip[v], from_tip[v]);
    }
  }
  const double least = *std::min_element(farthest_tip.begin(), farthest_tip.end());
  std::vector<GeodesicSource> sources;
  for (std::uint32_t v = 0; v < farthest_tip.size(); ++v) {
    const double more = farthest_tip[v] - least;
    if (more <= kMiddleWidth) sources.push_back({v, more});
  }
  return sources;
}

// The same as MiddleOfTheBody, patch by patch, the largest first: a hand that sinks into the hips
// is near the centroid too, but it is a patch of its own.
std::vector<std::vector<GeodesicSource>> PatchesOf(const std::vector<GeodesicSource>& sources,
                                                   std::span<const Eigen::Vector3d> points,
                                                   std::span<const double> vertex_areas,
                                                   const SurfaceGraph& graph) {
  std::vector<char> is_free(points.size(), 0);
  for (const GeodesicSource& s : sources) is_free[s.vertex] = 1;
  std::vector<std::pair<double, std::vector<GeodesicSource>>> patches;
  for (const GeodesicSource& s : sources) {
    if (!is_free[s.vertex]) continue;
    is_free[s.vertex] = 0;
    std::vector<GeodesicSource> patch = {s};
    double area = 0.0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      area += vertex_areas[patch[i].vertex];
      for (const std::uint32_t n : graph.Neighbours(patch[i].vertex)) {
        if (!is_free[n]) continue;
        is_free[n] = 0;
        patch.push_back({n, points[n].norm()});
      }
    }
    patches.emplace_back(area, std::move(patch));
  }
  std::stable_sort(patches.begin(), patches.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::vector<GeodesicSource>> result;
  for (auto& [area, patch] : patches) result.push_back(std::move(patch));
  return result;
}

// Level at which a branch joins the first of `others`.
double FirstJunction(std::span<const Branch> branches, int branch, std::span<const int> others) {
  double level = 0.0;
  for (const int other : others) {
    if (other != branch) level = std::max(level, JunctionLevel(branches, branch, other));
  }
  return level;
}

// How large the opening is that a part of a closed surface leaves, relative to the part: what is
// outside of it has the opposite area vector. Nearly 0 for a long limb, .5 for half of a ball.
double OpennessOf(const CoarseSurface& surface, std::span<const std::uint32_t> part) {
  std::vector<char> is_part(surface.points.size(), 0);
  for (const std::uint32_t v : part) is_part[v] = 1;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0.0;
  for (const mesh::Triangle& t : surface.triangles) {
    if (!is_part[t[0]] || !is_part[t[1]] || !is_part[t[2]]) continue;
    const Eigen::Vector3d& p = surface.points[t[0]];
    const Eigen::Vector3d twice = (surface.points[t[1]] - p).cross(surface.points[t[2]] - p);
    sum += twice;
    area += twice.norm();
  }
  return area > 0.0 ? sum.norm() / area : 1.0;
}

// The tips that stand out, but for what is as wide as a trunk, and stumps after them.
std::vector<TipCandidate> Candidates(std::span<const Branch> branches,
                                     std::span<const double> distance, const CoarseSurface& surface,
                                     const SurfaceGraph& graph, const ThreadPool& pool,
                                     const std::optional<RigEnds>& rig, Cut cut) {
  const bool is_upper_body = cut == Cut::kUpperBody;
  std::vector<int> tall;
  std::vector<int> stumps;
  for (int b = 0; b < static_cast<int>(branches.size()); ++b) {
    if (branches[b].Persistence() >= kMinPersistence) {
      const double junction = branches[b].saddle_distance / branches[0].tip_distance;
      if (!is_upper_body || junction <= kMaxJunctionOfUpperBody) tall.push_back(b);
    } else if (branches[b].saddle_distance <= kMaxStumpJunction * branches[0].tip_distance) {
      stumps.push_back(b);
    }
  }
  if (tall.size() < 2) return {};  // a ball, a cube: one way out is none
  if (tall.size() > kMaxCandidates) tall.resize(kMaxCandidates);
  if (stumps.size() > kMaxStumps) stumps.resize(kMaxStumps);
  std::vector<TipCandidate> candidates(tall.size() + stumps.size());
  pool.ForEach(candidates.size(), [&](std::size_t i) {
    const bool is_stump = i >= tall.size();
    const int b = is_stump ? stumps[i - tall.size()] : tall[i];
    const double level = FirstJunction(branches, b, tall);
    std::vector<std::uint32_t> vertices = VerticesAbove(graph, distance, branches[b].tip, level);
    double area = 0.0;
    for (const std::uint32_t v : vertices) area += surface.areas[v];
    const double girth = area / std::max(branches[b].tip_distance - level, 1e-6);
    const double openness = is_upper_body ? OpennessOf(surface, vertices) : 0.0;
    candidates[i] = {b, girth, is_stump, openness, level, std::move(vertices), {}};
    for (std::size_t end = 0; rig && end < rig->vertex.size(); ++end) {
      const std::vector<std::uint32_t>& held = candidates[i].vertices;
      candidates[i].holds[end] =
          rig->vertex[end] && std::binary_search(held.begin(), held.end(), *rig->vertex[end]);
    }
  });
  std::erase_if(candidates, [](const TipCandidate& c) {
    return (!c.is_stump && c.girth > kMaxLimbGirth) || c.openness > kMostOpen;
  });
  return candidates;
}

Extremities FromSources(const std::vector<GeodesicSource>& sources, const CoarseSurface& surface,
                        const SurfaceGraph& graph, const ThreadPool& pool,
                        const FitObserver& observer, const std::optional<RigEnds>& rig, Cut cut) {
  Extremities result;
  result.distance = graph.Distances(sources, pool, observer);
  if (observer.IsCancelled()) return result;
  const std::vector<Branch> branches = FindBranches(graph, result.distance, kMinStump, pool);
  if (observer.IsCancelled()) return result;
  std::vector<TipCandidate> candidates =
      Candidates(branches, result.distance, surface, graph, pool, rig, cut);
  const TipRoles found = FindTipRoles(branches, candidates, rig, cut);
  result.misfit = found.misfit;
  result.legs_are_cut = found.legs_are_cut;
  for (int role = 0; role < kTipCount; ++role) {
    const int candidate = found.candidates[role];
    if (candidate < 0) continue;
    const Branch& branch = branches[candidates[candidate].branch];
    Limb limb = {branch.tip, 0.0, branch.tip_distance, {}, {}};
    const auto [left, right] = EndsOf(static_cast<Tip>(role));
    const bool holds_left = candidates[candidate].holds[Index(left)];
    const bool holds_right = candidates[candidate].holds[Index(right)];
    if (holds_left != holds_right) limb.is_left = holds_left;
    for (const int other : found.candidates) {
      if (other < 0 || other == candidate) continue;
      limb.junction = std::max(limb.junction, JunctionLevel(branches, candidates[candidate].branch,
                                                            candidates[other].branch));
    }
    limb.vertices = candidates[candidate].junction == limb.junction
                        ? std::move(candidates[candidate].vertices)
                        : VerticesAbove(graph, result.distance, limb.tip, limb.junction);
    result.limbs[role] = std::move(limb);
  }
  return result;
}

}  // namespace

int Extremities::found() const {
  return static_cast<int>(
      std::count_if(limbs.begin(), limbs.end(), [](const auto& limb) { return limb.has_value(); }));
}

bool Extremities::has_whole_leg() const {
  return !legs_are_cut && (limb(Tip::kFootA) || limb(Tip::kFootB));
}

Extremities FindExtremities(const CoarseSurface& surface, const SurfaceGraph& graph,
                            const ThreadPool& pool, const FitObserver& observer,
                            const std::optional<RigEnds>& rig) {
  const auto from = [&](const std::vector<GeodesicSource>& sources, Cut cut = Cut::kNothing) {
    return FromSources(sources, surface, graph, pool, observer, rig, cut);
  };
  const std::vector<GeodesicSource> sources = MiddleOfTheBody(surface.points);
  Extremities best = from(sources);
  if (observer.IsCancelled()) return best;
  if (best.misfit <= kGoodMisfit && best.found() == kTipCount) return best;
  const std::vector<GeodesicSource> middle =
      MiddleOfTheSurface(best.distance, graph, pool, observer);
  Extremities whole = from(middle);
  if (observer.IsCancelled()) return best;
  // Only for a whole body is that middle near the waist.
  if (whole.found() == kTipCount && whole.misfit < best.misfit) best = std::move(whole);
  if (best.found() < kTipCount || best.misfit > kFairMisfit) {
    // Of a body with an arm or a leg that is cut off there are still five tips.
    for (const std::vector<GeodesicSource>* const start : {&sources, &middle}) {
      Extremities cut = from(*start, Cut::kLimbs);
      if (observer.IsCancelled()) return best;
      if (cut.found() == kTipCount && cut.misfit < best.misfit) best = std::move(cut);
    }
    // What MiddleOfTheSurface says of an upper body lies in its chest, too near to the arms.
    Extremities upper = from(sources, Cut::kUpperBody);
    if (observer.IsCancelled()) return best;
    if (upper.misfit < best.misfit) best = std::move(upper);
  }
  if (best.misfit <= kFairMisfit) return best;
  const auto patches = PatchesOf(sources, surface.points, surface.areas, graph);
  for (std::size_t i = 0; i < patches.size() && i < kMaxMiddles; ++i) {
    Extremities other = from(patches[i]);
    if (observer.IsCancelled()) return best;
    if (other.misfit < best.misfit) best = std::move(other);
  }
  return best;
}

}  // namespace capfit::body
