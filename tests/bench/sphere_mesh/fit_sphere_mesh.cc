#include "tests/bench/sphere_mesh/fit_sphere_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tests/bench/sphere_mesh/collapse_edges.h"
#include "tests/bench/sphere_mesh/drop_hulls.h"
#include "tests/bench/sphere_mesh/settle_spheres.h"

namespace capfit::bench {
namespace {

constexpr int kColumns = 160;
constexpr int kDropPoints = 2000;
constexpr int kSettlePoints = 4000;
// Spheres to start dropping from: the share of the way from as many as the collapse leaves to as
// many as a tree of this budget has.
constexpr std::array<double, 3> kSphereShares = {0.0, 0.75, 1.0};
// The best so many are settled, in so many steps.
constexpr std::size_t kSettled = 4;
constexpr int kSettleSteps = 15;

// A tree's spheres and edges.
int MostSpheres(int budget) { return (budget + 1) / 2; }

}  // namespace

SphereMeshFitter::SphereMeshFitter(const mesh::BodyMesh& mesh, int most_primitives,
                                   const FitOptions& options)
    : options_(options),
      error_(mesh, kColumns),
      drop_points_(SurfacePoints(mesh, kDropPoints)),
      settle_points_(SurfacePoints(mesh, kSettlePoints)) {
  for (const double bound : options.radius_bounds) {
    series_.push_back(CollapseEdges(mesh, MostSpheres(most_primitives), {bound}));
  }
}

std::vector<SphereMesh> SphereMeshFitter::Candidates(int budget) const {
  std::vector<SphereMesh> candidates;
  for (const std::vector<SphereMesh>& series : series_) {
    const auto whole = std::find_if(series.begin(), series.end(), [&](const SphereMesh& mesh) {
      return PrimitiveCount(mesh) <= budget;
    });
    if (options_.steps == Steps::kCollapse) {
      candidates.push_back(*whole);
      continue;
    }
    const auto tree = std::find_if(series.begin(), whole, [&](const SphereMesh& mesh) {
      return static_cast<int>(mesh.spheres.size()) <= MostSpheres(budget);
    });
    auto last = series.end();
    for (const double share : kSphereShares) {
      const auto from = whole - std::lround(share * static_cast<double>(whole - tree));
      if (from != last) candidates.push_back(DropHulls(*from, budget, drop_points_));
      last = from;
    }
  }
  return candidates;
}

SphereMeshFitter::Rated SphereMeshFitter::Rate(SphereMesh mesh) const {
  const double error = error_.Of(mesh);
  return {error, std::move(mesh)};
}

SphereMesh SphereMeshFitter::Fit(int budget) const {
  std::vector<Rated> rated;
  for (SphereMesh& mesh : Candidates(budget)) rated.push_back(Rate(std::move(mesh)));
  const auto is_better = [](const Rated& a, const Rated& b) { return a.error < b.error; };
  std::stable_sort(rated.begin(), rated.end(), is_better);
  if (options_.steps == Steps::kSettle) {
    const std::size_t count = std::min(kSettled, rated.size());
    for (std::size_t i = 0; i < count; ++i) {
      rated.push_back(Rate(SettleSpheres(rated[i].mesh, settle_points_, kSettleSteps)));
    }
  }
  return std::min_element(rated.begin(), rated.end(), is_better)->mesh;
}

}  // namespace capfit::bench
