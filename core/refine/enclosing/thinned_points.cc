#include "core/refine/enclosing/thinned_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/mesh/surface_sums.h"
#include "core/tighten/sparse_points.h"

namespace capfit::refine {
namespace {

using Vec3 = Eigen::Vector3d;

constexpr double kMostCuts = 20.0;  // of an edge whose triangle gets points between its corners
constexpr std::size_t kMostBetween = 500'000;  // such points in all

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
    const double area = mesh::Area(target.points_m, t);
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

}  // namespace

ThinnedPoints ThinnedPointsOf(const tighten::CoverTarget& target, bool symmetric, double spacing) {
  std::vector<double> areas(target.points_m.size(), 0.0);
  const double area = mesh::AddVertexAreas(target.points_m, target.triangles, areas);
  ThinnedPoints thinned;
  thinned.size_m = std::max(std::sqrt(area), 1e-6);
  std::vector<Vec3> points(target.points_m.begin(), target.points_m.end());
  AddPointsBetween(target, spacing * thinned.size_m, points, areas);
  if (symmetric) {
    for (Vec3& p : points) p.x() = std::abs(p.x());
  }
  tighten::SparsePoints sparse = tighten::MakeSparse(points, areas, spacing * thinned.size_m);
  thinned.points_m = std::move(sparse.points_m);
  thinned.areas_m2 = std::move(sparse.weights);
  return thinned;
}

}  // namespace capfit::refine
