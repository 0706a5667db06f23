// How volume changes when spheres move and grow: integrals over the exposed boundary of the union.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_BOUNDARY_INTEGRAL_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_BOUNDARY_INTEGRAL_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/best_fit/boundary_samples.h"
#include "core/refine/best_fit/occupancy_grid.h"
#include "core/refine/graph/cone.h"

namespace capfit::refine {

struct BoundaryOptions {
  double spacing_m = 0.011;  // between samples; the gradient's noise falls with its square
  // Weighs each sample by the cost of filling it: the gradient of E_r. Null: weight 1, the gradient
  // of the union's volume.
  const OccupancyGrid* body = nullptr;
  // Only primitives at these nodes are sampled. Null: all.
  const std::vector<char>* active = nullptr;
};

// Both by node; those of the images are folded onto the representatives and zero themselves.
struct BoundaryIntegral {
  // d/d(x, y, z, r) of the integral of the weight over the solid, m2.
  std::vector<Eigen::Vector4d> gradient_m2;
  std::vector<double> area_m2;  // exposed area, shared out like the gradient
};

// Integrates over one graph again and again while its spheres move; its topology must stay. Exact
// for the continuous boundary (a moving surface sweeps weight * normal speed * area); sampled by
// rings on the sides and spirals on the ends.
class BoundaryIntegrator {
 public:
  // Graph, grid and marks must outlive the integrator.
  BoundaryIntegrator(const capsule::MirroredSet& graph, const BoundaryOptions& options);

  // `phase` in [0, 1): shifts and turns all samples. A new one in every step keeps the search from
  // fitting itself to the samples. O(samples * overlapping primitives). The result stays until the
  // next call; the same bits for any pool.
  const BoundaryIntegral& Integrate(double phase, const ThreadPool& pool);

 private:
  using Lane = std::array<float, BoundarySamples::kLane>;
  // Some rings of one capsule: shares of its axis, centres, radii.
  struct Rings {
    alignas(32) Lane t{}, x{}, y{}, z{}, radius{};
    std::size_t count = 0;
  };
  // A capsule's side or a sphere that is sampled, and which cones may be near.
  struct Patch {
    int index;
    bool is_side;
    std::vector<int> near;
  };
  // What one thread sums up, and its memory from step to step.
  struct Worker {
    Worker() {}  // leaves the samples as they are: they are many

    BoundaryIntegral sum;
    // What may hide something of some rings, and how far it is from their centres.
    std::vector<int> ring_occluders;
    std::vector<Lane> ring_distances_m;
    std::vector<int> occluders;
    BoundarySamples samples;
  };

  [[nodiscard]] bool IsActive(int v) const;
  [[nodiscard]] bool HaveMovedFar() const;
  void FindPatches();
  void AddSide(const Patch& patch, Worker& worker) const;
  [[nodiscard]] int RingsOn(const Cone& cone) const;
  void MeasureRings(const Patch& patch, const Rings& rings, Worker& worker) const;
  void AddRing(const Patch& patch, const Rings& rings, std::size_t k, double width_m,
               const Frame& frame, Worker& worker) const;
  void AddEnd(const Patch& patch, Worker& worker) const;
  [[nodiscard]] bool FindOccluders(const Patch& patch, std::vector<int>& occluders) const;
  void AddUp();
  void FoldImages();

  const capsule::MirroredSet& graph_;
  BoundaryOptions options_;
  double phase_ = 0.0;
  BoundaryIntegral result_;
  std::vector<Cone> cones_;
  std::vector<std::vector<int>> incident_;  // by node: its capsules
  std::vector<Patch> patches_;
  std::vector<geometry::Sphere> looked_up_at_;  // where the spheres were when patches_ was found
  std::vector<Worker> workers_;
};

// Once.
[[nodiscard]] BoundaryIntegral IntegrateBoundary(const capsule::MirroredSet& graph,
                                                 const BoundaryOptions& options, double phase);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_BOUNDARY_INTEGRAL_H_
