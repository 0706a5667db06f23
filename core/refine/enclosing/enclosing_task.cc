#include "core/refine/enclosing/enclosing_task.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/refine/internal.h"
#include "core/tighten/distance_kernel.h"
#include "core/tighten/set_variables.h"
#include "core/tighten/sparse_points.h"
#include "core/tighten/union_volume.h"

namespace capfit::refine {
namespace {

using geometry::TaperedCapsule;
using Vec3 = Eigen::Vector3d;

// Of the volume's samples, times the root of the number of primitives, relative to the body's size:
// coarse samples tell sets apart by chance.
constexpr double kSampleSpacing = 0.096;
constexpr double kLeastSampleSpacing = 0.006;
constexpr double kMostSampleSpacing = 0.012;
// What a cubic metre outside costs against one too much inside.
constexpr double kOutsidePrice = 4.0;
// Nobody grows further than this to make up for a capsule, relative to the body's size.
constexpr double kFurthestGrowth = 0.045;

constexpr double kTrialGap = 0.03;  // graphs are compared here, not finished
constexpr tighten::TightenPhase kShapePhase{.first_trust = 0.012,
                                            .last_trust = 0.003,
                                            .first_penalty = 1.6,
                                            .last_penalty = 16.0,
                                            .relative_gap = kTrialGap};
constexpr tighten::TightenPhase kInsidePhase{.first_trust = 0.004,
                                             .last_trust = 0.001,
                                             .first_penalty = 100.0,
                                             .last_penalty = 100.0,
                                             .relative_gap = kTrialGap};

constexpr double kMostCuts = 20.0;  // of an edge whose triangle gets points between its corners
constexpr std::size_t kMostBetween = 500'000;  // such points in all

constexpr double kLoosePenalty = 8.0;
constexpr double kApart = 0.03;  // of the worst points, relative to the body's size
// Along and around a tie, where its volume is sampled.
constexpr int kAlong = 8, kAround = 8, kAcross = 4;

// The points that stick out of a set, their coordinates apart.
class OutsidePoints {
 public:
  // Distances are in the grid's order, areas and allowances in the caller's.
  OutsidePoints(const tighten::PointGrid& grid, const std::vector<double>& distances_m,
                const std::vector<double>& areas_m2, double allowed_m)
      : allowed_m_(allowed_m) {
    for (const tighten::PointGrid::Block& block : grid.blocks()) {
      Run run{x_.size(), 0, block.center, block.reach, 0.0};
      for (std::uint32_t i = block.begin; i < block.end; ++i) {
        if (distances_m[i] <= allowed_m) continue;
        const Vec3& p = grid.point(i);
        x_.push_back(p.x()), y_.push_back(p.y()), z_.push_back(p.z());
        area_.push_back(areas_m2[grid.order()[i]]);
        out_.push_back(distances_m[i] - allowed_m);
        run.furthest_m = std::max(run.furthest_m, distances_m[i]);
      }
      run.end = x_.size();
      if (run.end > run.begin) runs_.push_back(run);
    }
  }

  // Area times the depth by which the capsule takes points in, with its image where it has one.
  [[nodiscard]] double TakenInBy(const TaperedCapsule& capsule, bool with_image) const {
    const tighten::DistanceKernel kernel(capsule);
    const double image = with_image ? -1.0 : 1.0;
    double sum = 0.0;
    for (const Run& run : runs_) {
      const Vec3& c = run.center;
      const double here = kernel.SignedDistance(c.x(), c.y(), c.z());
      const double there = kernel.SignedDistance(image * c.x(), c.y(), c.z());
      if (std::min(here, there) - run.reach >= run.furthest_m) continue;  // nearer to others
      sum += TakenInBy(kernel, image, run);
    }
    return sum;
  }

 private:
  // The points of one block.
  struct Run {
    std::size_t begin, end;
    Vec3 center;
    double reach;
    double furthest_m;  // that one of them is from the set
  };

  [[nodiscard]] double TakenInBy(const tighten::DistanceKernel& kernel, double image,
                                 const Run& run) const {
    double sum = 0.0;
    for (std::size_t i = run.begin; i < run.end; ++i) {
      const double here = kernel.SignedDistance(x_[i], y_[i], z_[i]);
      const double there = kernel.SignedDistance(image * x_[i], y_[i], z_[i]);
      double still_out = (here < there ? here : there) - allowed_m_;
      still_out = still_out > 0.0 ? still_out : 0.0;
      const double won = out_[i] - still_out;
      sum += won > 0.0 ? area_[i] * won : 0.0;
    }
    return sum;
  }

  double allowed_m_;
  std::vector<double> x_, y_, z_, area_, out_;
  std::vector<Run> runs_;
};

// How much of the capsule between its end spheres is in no other shape.
double VolumeOutside(const TaperedCapsule& tie, const std::vector<TaperedCapsule>& shapes) {
  std::vector<std::size_t> near;
  const Vec3 middle = 0.5 * (tie.a().center_m + tie.b().center_m);
  const double reach = 0.5 * tie.length_m() + std::max(tie.a().radius_m, tie.b().radius_m);
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    if (shapes[k].SignedDistance(middle) < reach) near.push_back(k);
  }
  const Vec3 side = tie.axis().unitOrthogonal();
  const Vec3 up = tie.axis().cross(side);
  double sum = 0.0;
  for (int i = 0; i < kAlong; ++i) {
    const double t = (i + 0.5) / kAlong;
    const Vec3 center = tie.a().center_m + t * (tie.b().center_m - tie.a().center_m);
    const double radius = tie.a().radius_m + t * (tie.b().radius_m - tie.a().radius_m);
    for (int j = 0; j < kAround; ++j) {
      const double angle = 2.0 * std::numbers::pi * (j + 0.5 * (i % 2)) / kAround;
      const Vec3 out = std::cos(angle) * side + std::sin(angle) * up;
      for (int m = 0; m < kAcross; ++m) {
        // Equal areas across.
        const Vec3 p = center + radius * std::sqrt((m + 0.5) / kAcross) * out;
        const bool is_inside = std::any_of(near.begin(), near.end(), [&](std::size_t k) {
          return shapes[k].SignedDistance(p) <= 0.0;
        });
        if (!is_inside) sum += std::numbers::pi * radius * radius;
      }
    }
  }
  return sum * tie.length_m() / (kAlong * kAround * kAcross);
}

// Adds points inside triangles with an edge longer than `longest_m` and moves area to them from the
// corners, whose areas come first: small capsules would meet in furrows between far apart vertices.
// A body needs some tens of thousands; a mesh of slivers as long as itself gets no more than fit.
void AddPointsBetween(const tighten::CoverTarget& target, double longest_m,
                      std::vector<Vec3>& points_m, std::vector<double>& areas_m2) {
  for (const mesh::Triangle& t : target.triangles) {
    const Vec3& a = target.points_m[t[0]];
    const Vec3& b = target.points_m[t[1]];
    const Vec3& c = target.points_m[t[2]];
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const int n = static_cast<int>(std::min(longest / longest_m, kMostCuts)) + 1;
    if (n < 2 || points_m.size() - target.points_m.size() > kMostBetween) continue;
    const double area = 0.5 * (b - a).cross(c - a).norm();
    const int count = (n + 1) * (n + 2) / 2;
    for (const std::uint32_t corner : t) areas_m2[corner] -= area * (1.0 / 3.0 - 1.0 / count);
    for (int i = 0; i < n; ++i) {
      for (int j = i == 0 ? 1 : 0; j < n && i + j <= n; ++j) {
        const int k = n - i - j;
        if (k == n) continue;
        points_m.push_back((i * a + j * b + k * c) / n);
        areas_m2.push_back(area / count);
      }
    }
  }
}

// The capsule that takes the place of a sphere with two; nothing for other spheres.
std::vector<std::optional<TaperedCapsule>> BridgesOf(const capsule::MirroredSet& graph) {
  std::vector<std::optional<TaperedCapsule>> bridges(graph.spheres().size());
  for (int v = 0; v < graph.sphere_count(); ++v) {
    const std::vector<int> neighbours = graph.NeighboursOf(v);
    if (neighbours.size() != 2) continue;
    bridges[U(v)].emplace(graph.sphere(neighbours[0]), graph.sphere(neighbours[1]));
  }
  return bridges;
}

// Points against the solids of a graph: who covers each, and who would if that one were gone.
class Weigher {
 public:
  Weigher(const capsule::MirroredSet& graph, double furthest_m)
      : furthest_m_(furthest_m),
        bridges_(BridgesOf(graph)),
        solids_(capsule::SolidEnds(graph.set())),
        shapes_(capsule::Solids(graph.set())) {
    worth_.edge_gap.assign(graph.capsules().size(), 0.0);
    worth_.edge_loss.assign(graph.capsules().size(), 0.0);
    worth_.node_loss.assign(graph.spheres().size(), 0.0);
  }

  // All points of a block of the grid. `areas_m2` by the caller's index.
  void Add(const tighten::PointGrid& grid, const tighten::PointGrid::Block& block,
           const std::vector<double>& areas_m2) {
    Approach(grid, block);
    for (std::uint32_t i = block.begin; i < block.end; ++i) {
      AddPoint(i - block.begin, grid.point(i), areas_m2[grid.order()[i]]);
    }
  }

  [[nodiscard]] const GraphWorth& worth() const { return worth_; }

 private:
  // The solids that the block's points may be told by, their distances, and for each point the two
  // nearest of them.
  void Approach(const tighten::PointGrid& grid, const tighten::PointGrid::Block& block) {
    at_center_.resize(shapes_.size());
    double least = std::numeric_limits<double>::max();
    for (std::size_t k = 0; k < shapes_.size(); ++k) {
      at_center_[k] = shapes_[k].SignedDistance(block.center);
      least = std::min(least, at_center_[k]);
    }
    near_.clear();
    for (std::size_t k = 0; k < shapes_.size(); ++k) {
      if (at_center_[k] <= least + 2.0 * block.reach + furthest_m_) near_.push_back(k);
    }
    count_ = block.end - block.begin;
    distances_.resize(near_.size() * count_);
    first_.assign(count_, {});
    second_.assign(count_, {});
    for (std::size_t k = 0; k < near_.size(); ++k) {
      float* const own = distances_.data() + k * count_;
      grid.BlockDistances(block, shapes_[near_[k]], own);
      for (std::size_t i = 0; i < count_; ++i) {
        if (own[i] >= second_[i].distance_m) continue;
        second_[i] = {own[i], k};
        if (own[i] < first_[i].distance_m) std::swap(first_[i], second_[i]);
      }
    }
  }

  void AddPoint(std::size_t i, const Vec3& point, double area_m2) {
    const std::size_t solid = near_[first_[i].place];
    if (solid < worth_.edge_gap.size()) {
      worth_.edge_gap[solid] += area_m2 * std::max(0.0, -double{first_[i].distance_m});
      worth_.edge_loss[solid] += area_m2 * Missing(second_[i].distance_m);
    }
    const std::array<int, 2> ends = solids_[solid];
    AddDissolved(ends[0], i, point, area_m2);
    if (ends[1] != ends[0]) AddDissolved(ends[1], i, point, area_m2);
  }

  // How far a solid at that distance has to grow.
  [[nodiscard]] double Missing(double distance_m) const {
    return std::clamp(distance_m, 0.0, furthest_m_);
  }

  [[nodiscard]] bool IsAt(std::size_t place, int node) const {
    const std::array<int, 2>& ends = solids_[near_[place]];
    return ends[0] == node || ends[1] == node;
  }

  // The distance of the nearest solid that is not at the node.
  [[nodiscard]] double DistanceWithout(int node, std::size_t i) const {
    if (second_[i].distance_m > furthest_m_ || !IsAt(second_[i].place, node)) {
      return second_[i].distance_m;
    }
    double least = furthest_m_;
    for (std::size_t k = 0; k < near_.size(); ++k) {
      const double distance = distances_[k * count_ + i];
      if (distance < least && !IsAt(k, node)) least = distance;
    }
    return least;
  }

  void AddDissolved(int node, std::size_t i, const Vec3& point, double area_m2) {
    double missing = Missing(DistanceWithout(node, i));
    const std::optional<TaperedCapsule>& bridge = bridges_[U(node)];
    if (missing > 0.0 && bridge) {
      missing = std::clamp(bridge->SignedDistance(point), 0.0, missing);
    }
    worth_.node_loss[U(node)] += area_m2 * missing;
  }

  struct Nearest {
    float distance_m = std::numeric_limits<float>::infinity();
    std::size_t place = 0;  // in near_
  };

  double furthest_m_;
  std::vector<std::optional<TaperedCapsule>> bridges_;  // by node
  std::vector<capsule::CapsuleEnds> solids_;
  std::vector<TaperedCapsule> shapes_;
  std::vector<double> at_center_;
  std::vector<std::size_t> near_;
  std::size_t count_ = 0;         // of the block's points
  std::vector<float> distances_;  // by place in near_, then point
  std::vector<Nearest> first_, second_;
  GraphWorth worth_;
};

// Both of a pair get what the two have together.
void AddUpPairs(const capsule::MirroredSet& graph, GraphWorth& worth) {
  const auto add_up = [](std::vector<double>& values, int index, int image) {
    if (image > index) values[U(index)] = values[U(image)] = values[U(index)] + values[U(image)];
  };
  for (int e = 0; e < graph.capsule_count(); ++e) {
    add_up(worth.edge_gap, e, graph.ImageOfCapsule(e));
    add_up(worth.edge_loss, e, graph.ImageOfCapsule(e));
  }
  for (int v = 0; v < graph.sphere_count(); ++v) add_up(worth.node_loss, v, graph.ImageOf(v));
}

}  // namespace

EnclosingTask::Thinned EnclosingTask::Thin(const tighten::CoverTarget& target, bool symmetric,
                                           double spacing) {
  std::vector<double> areas(target.points_m.size(), 0.0);
  double area = 0.0;
  for (const mesh::Triangle& t : target.triangles) {
    const Vec3& a = target.points_m[t[0]];
    const double twice = (target.points_m[t[1]] - a).cross(target.points_m[t[2]] - a).norm();
    for (const std::uint32_t corner : t) areas[corner] += twice / 6.0;
    area += 0.5 * twice;
  }
  Thinned thinned;
  thinned.size_m = std::max(std::sqrt(area), 1e-6);
  std::vector<Vec3> points = target.points_m;
  AddPointsBetween(target, spacing * thinned.size_m, points, areas);
  if (symmetric) {
    for (Vec3& p : points) p.x() = std::abs(p.x());
  }
  tighten::SparsePoints sparse = tighten::MakeSparse(points, areas, spacing * thinned.size_m);
  thinned.points_m = std::move(sparse.points_m);
  thinned.areas_m2 = std::move(sparse.weights);
  return thinned;
}

EnclosingTask::EnclosingTask(const tighten::CoverTarget& target, bool symmetric, double tolerance_m,
                             double spacing)
    : EnclosingTask(Thin(target, symmetric, spacing), tolerance_m) {}

EnclosingTask::EnclosingTask(Thinned thinned, double tolerance_m)
    : size_m_(thinned.size_m),
      areas_m2_(std::move(thinned.areas_m2)),
      tolerance_m_(tolerance_m),
      grid_(thinned.points_m) {}

void EnclosingTask::Settle(const tighten::TightenPhase& phase, std::uint64_t seed,
                           const ThreadPool& pool, const WorkMeter& meter,
                           capsule::MirroredSet& graph) const {
  capsule::PrimitiveSet set = graph.set();
  const std::array<tighten::PointsToHold, 1> points = {{{grid_, tolerance_m_, areas_m2_}}};
  tighten::Tighten(points, size_m_, phase, seed, pool, meter, set);
  graph.MoveTo(set.spheres);
}

void EnclosingTask::FindShape(int steps, double looseness, std::uint64_t seed,
                              const ThreadPool& pool, const WorkMeter& meter,
                              capsule::MirroredSet& graph) const {
  tighten::TightenPhase phase = kShapePhase;
  phase.first_penalty /= looseness;
  phase.steps = steps;
  Settle(phase, seed, pool, meter, graph);
}

void EnclosingTask::TakeIn(int steps, std::uint64_t seed, const ThreadPool& pool,
                           const WorkMeter& meter, capsule::MirroredSet& graph) const {
  tighten::TightenPhase phase = kInsidePhase;
  phase.steps = steps;
  Settle(phase, seed, pool, meter, graph);
}

void EnclosingTask::Loosen(int steps, std::uint64_t seed, const ThreadPool& pool,
                           const WorkMeter& meter, capsule::MirroredSet& graph) const {
  tighten::TightenPhase phase = kShapePhase;
  phase.first_penalty = phase.last_penalty = kLoosePenalty;
  phase.last_trust = 0.006;
  phase.steps = steps;
  Settle(phase, seed, pool, meter, graph);
}

std::vector<Vec3> EnclosingTask::WorstPoints(const capsule::MirroredSet& graph, int count,
                                             const ThreadPool& pool) const {
  const std::vector<double> distances =
      grid_.DistancesTo(capsule::Solids(graph.set()), -kFurthestGrowth * size_m_, pool).distance_m;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (distances[i] > tolerance_m_) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return distances[a] > distances[b]; });
  std::vector<Vec3> worst;
  for (const std::size_t i : order) {
    if (static_cast<int>(worst.size()) >= count) break;
    const Vec3 p = grid_.point(i);
    const bool is_near = std::any_of(worst.begin(), worst.end(), [&](const Vec3& q) {
      return (p - q).norm() < kApart * size_m_;
    });
    if (!is_near) worst.push_back(p);
  }
  return worst;
}

std::vector<double> EnclosingTask::GainsOf(const capsule::MirroredSet& graph,
                                           const std::vector<Edit>& additions,
                                           const ThreadPool& pool) const {
  const std::vector<TaperedCapsule> shapes = capsule::Solids(graph.set());
  const tighten::UnionDistances at = grid_.DistancesTo(shapes, -kFurthestGrowth * size_m_, pool);
  const OutsidePoints outside(grid_, at.distance_m, areas_m2_, tolerance_m_);
  std::vector<double> gains(additions.size(), 0.0);
  pool.ForEach(additions.size(), [&](std::size_t k) {
    const Edit& edit = additions[k];
    const geometry::Sphere end = edit.kind == EditKind::kLeaf
                                     ? geometry::Sphere{edit.center_m, edit.radius_m}
                                     : graph.sphere(edit.second);
    const TaperedCapsule added(graph.sphere(edit.first), end);
    if (added.IsSphere()) return;
    const bool is_pair = HasImage(graph, edit);
    const double gain = kLoosePenalty * outside.TakenInBy(added, is_pair);
    if (gain > 0.0) gains[k] = gain - (is_pair ? 2.0 : 1.0) * VolumeOutside(added, shapes);
  });
  return gains;
}

double EnclosingTask::Value(const capsule::MirroredSet& graph, const ThreadPool& pool) const {
  capsule::PrimitiveSet set = graph.set();
  const tighten::SetVariables variables(set);
  const tighten::UnionDistances at =
      grid_.DistancesTo(capsule::Solids(set), -kFurthestGrowth * size_m_, pool);
  double outside = 0.0;
  for (std::size_t i = 0; i < grid_.size(); ++i) {
    const std::uint32_t point = grid_.order()[i];
    outside += areas_m2_[point] * std::max(0.0, at.distance_m[i] - tolerance_m_);
  }
  const double primitives = std::max(1, graph.primitive_count());
  const double spacing_m = size_m_ * std::clamp(kSampleSpacing / std::sqrt(primitives),
                                                kLeastSampleSpacing, kMostSampleSpacing);
  return tighten::UnionVolumeGradient(set, variables, spacing_m, /*seed=*/7, pool).volume_m3 +
         kOutsidePrice * outside;
}

GraphWorth EnclosingTask::Weigh(const capsule::MirroredSet& graph) const {
  Weigher weigher(graph, kFurthestGrowth * size_m_);
  for (const tighten::PointGrid::Block& block : grid_.blocks()) {
    weigher.Add(grid_, block, areas_m2_);
  }
  GraphWorth worth = weigher.worth();
  AddUpPairs(graph, worth);
  return worth;
}

}  // namespace capfit::refine
