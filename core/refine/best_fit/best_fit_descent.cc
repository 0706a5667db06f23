#include "core/refine/best_fit/best_fit_descent.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/refine/best_fit/boundary_integral.h"
#include "core/refine/internal.h"

namespace capfit::refine {
namespace {

constexpr double kMeanDecay = 0.9;
constexpr double kSquareDecay = 0.95;

struct Moments {
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  double square = 0.0;  // of the whole gradient, halved
};

double RateAt(const BestFitOptions& options, int step) {
  const double phase = std::numbers::pi * step / std::max(1, options.steps);
  return options.last_rate_m +
         0.5 * (options.first_rate_m - options.last_rate_m) * (1.0 + std::cos(phase));
}

}  // namespace

void DescendBestFit(const OccupancyGrid& grid, const BestFitOptions& options,
                    const ThreadPool& pool, const FitObserver& observer,
                    capsule::MirroredSet& graph) {
  std::vector<Moments> moments(graph.spheres().size());
  Random random(options.seed);
  BoundaryIntegrator integrator(graph, {options.spacing_m, &grid, options.active});
  for (int step = 0; step < options.steps && !observer.IsCancelled(); ++step) {
    const BoundaryIntegral& boundary = integrator.Integrate(random.NextUnit(), pool);
    const double rate = RateAt(options, step) / (1.0 - std::pow(kMeanDecay, step + 1));
    const double unbias = 1.0 / (1.0 - std::pow(kSquareDecay, step + 1));
    for (int v = 0; v < graph.sphere_count(); ++v) {
      if (!graph.IsRepresentative(v)) continue;
      if (options.active != nullptr && !(*options.active)[v]) continue;
      const Eigen::Vector4d gradient = boundary.gradient_m2[v] / grid.volume_m3;
      Moments& m = moments[v];
      m.mean = kMeanDecay * m.mean + (1.0 - kMeanDecay) * gradient;
      m.square = kSquareDecay * m.square + (1.0 - kSquareDecay) * 0.5 * gradient.squaredNorm();
      const Eigen::Vector4d move = rate * m.mean / (std::sqrt(unbias * m.square) + 1e-9);
      geometry::Sphere& sphere = graph.sphere(v);
      sphere.center_m -= move.head<3>();
      sphere.radius_m = std::max(kLeastRadiusM, sphere.radius_m - move[3]);
    }
    graph.CopyToImages();
  }
}

}  // namespace capfit::refine
