#include "core/refine/enclosing/graph_worth.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "core/refine/internal.h"
#include "core/tighten/solid_table.h"

namespace capfit::refine {
namespace {

using geometry::TaperedCapsule;
using Vec3 = Eigen::Vector3d;

// The capsule that takes the place of a sphere with two; nothing for other spheres.
std::vector<std::optional<TaperedCapsule>> BridgesOf(const capsule::MirroredSet& graph) {
  std::vector<std::optional<TaperedCapsule>> bridges(graph.spheres().size());
  for (int v = 0; v < graph.sphere_count(); ++v) {
    const std::vector<int> neighbours = graph.NeighboursOf(v);
    if (neighbours.size() != 2) continue;
    bridges[v].emplace(graph.sphere(neighbours[0]), graph.sphere(neighbours[1]));
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
        shapes_(capsule::Solids(graph.set())),
        table_(shapes_) {
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
    table_.DistancesFrom(block.center, at_center_);
    const double least = *std::min_element(at_center_.begin(), at_center_.end());
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
    const std::optional<TaperedCapsule>& bridge = bridges_[node];
    if (missing > 0.0 && bridge) {
      missing = std::clamp(bridge->SignedDistance(point), 0.0, missing);
    }
    worth_.node_loss[node] += area_m2 * missing;
  }

  struct Nearest {
    float distance_m = std::numeric_limits<float>::infinity();
    std::size_t place = 0;  // in near_
  };

  double furthest_m_;
  std::vector<std::optional<TaperedCapsule>> bridges_;  // by node
  std::vector<capsule::CapsuleEnds> solids_;
  std::vector<TaperedCapsule> shapes_;
  tighten::SolidTable table_;
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
    if (image > index) values[index] = values[image] = values[index] + values[image];
  };
  for (int e = 0; e < graph.capsule_count(); ++e) {
    add_up(worth.edge_gap, e, graph.ImageOfCapsule(e));
    add_up(worth.edge_loss, e, graph.ImageOfCapsule(e));
  }
  for (int v = 0; v < graph.sphere_count(); ++v) add_up(worth.node_loss, v, graph.ImageOf(v));
}

}  // namespace

GraphWorth WorthOf(const capsule::MirroredSet& graph, const tighten::PointGrid& grid,
                   const std::vector<double>& areas_m2, double furthest_m) {
  Weigher weigher(graph, furthest_m);
  for (const tighten::PointGrid::Block& block : grid.blocks()) weigher.Add(grid, block, areas_m2);
  GraphWorth worth = weigher.worth();
  AddUpPairs(graph, worth);
  return worth;
}

}  // namespace capfit::refine
