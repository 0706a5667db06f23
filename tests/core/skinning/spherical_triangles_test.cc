#include "core/skinning/spherical_triangles.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/random.h"
#include "tests/core/metrics/shapes.h"

namespace capfit::skinning {
namespace {

using Eigen::Vector3d;

// The pseudo-code of Ju, Schaefer and Warren (2005, Fig. 4) for centres that lie in no triangle's
// plane. Its weights are twice ours: the factor drops out when they are divided by their sum.
std::vector<double> JuWeights(const mesh::BodyMesh& mesh, const Vector3d& x) {
  std::vector<double> weights(mesh.vertices().size(), 0.0);
  for (const mesh::Triangle& t : mesh.triangles()) {
    std::array<double, 3> d{};
    std::array<double, 3> theta{};
    std::array<double, 3> c{};
    std::array<double, 3> s{};
    Eigen::Matrix3d u;
    for (int i = 0; i < 3; ++i) {
      d[i] = (mesh.vertices()[t[i]] - x).norm();
      u.col(i) = (mesh.vertices()[t[i]] - x) / d[i];
    }
    double h = 0.0;
    for (int i = 0; i < 3; ++i) {
      theta[i] = 2 * std::asin((u.col((i + 1) % 3) - u.col((i + 2) % 3)).norm() / 2);
      h += theta[i] / 2;
    }
    const double sign = u.determinant() > 0 ? 1.0 : -1.0;
    for (int i = 0; i < 3; ++i) {
      const double next = theta[(i + 1) % 3];
      const double last = theta[(i + 2) % 3];
      c[i] = 2 * std::sin(h) * std::sin(h - theta[i]) / (std::sin(next) * std::sin(last)) - 1;
      s[i] = sign * std::sqrt(std::max(0.0, 1 - c[i] * c[i]));
    }
    for (int i = 0; i < 3; ++i) {
      const int next = (i + 1) % 3;
      const int last = (i + 2) % 3;
      weights[t[i]] += (theta[i] - c[next] * theta[last] - c[last] * theta[next]) /
                       (2 * d[i] * std::sin(theta[next]) * s[last]);
    }
  }
  return weights;
}

struct Case {
  std::string name;
  mesh::BodyMesh mesh;
  double tolerance;  // relative to the largest weight; Ju's own rounding grows on fine meshes
  friend void PrintTo(const Case& c, std::ostream* os) { *os << c.name; }
};
class SphericalTrianglesTest : public testing::TestWithParam<Case> {
 protected:
  // Four centres at random in a box a little larger than the mesh.
  std::array<Vector3d, kLanes> Centers(std::uint64_t seed) const {
    Random random(seed);
    std::array<Vector3d, kLanes> centers;
    const mesh::BodyMesh& mesh = GetParam().mesh;
    for (Vector3d& center : centers) {
      for (int axis = 0; axis < 3; ++axis) {
        center[axis] = random.NextIn(1.2 * mesh.box_min()[axis] - 0.2 * mesh.box_max()[axis],
                                     1.2 * mesh.box_max()[axis] - 0.2 * mesh.box_min()[axis]);
      }
    }
    return centers;
  }
};

TEST_P(SphericalTrianglesTest, MatchesJusFormulas) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto centers = Centers(seed);
    const RawWeights raw = MeanValueRawWeights(GetParam().mesh, centers);
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::vector<double> expected = JuWeights(GetParam().mesh, centers[lane]);
      double largest = 0.0;
      for (const double weight : expected) largest = std::max(largest, std::abs(weight));
      for (std::size_t i = 0; i < expected.size(); ++i) {
        ASSERT_NEAR(raw.weights[i][lane], expected[i], GetParam().tolerance * largest)
            << "vertex " << i << " seed " << seed;
      }
    }
  }
}

TEST_P(SphericalTrianglesTest, ReproducesTheCentreWithoutAnyCorrection) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto centers = Centers(seed);
    const mesh::BodyMesh& mesh = GetParam().mesh;
    const RawWeights raw = MeanValueRawWeights(mesh, centers);
    for (int lane = 0; lane < kLanes; ++lane) {
      Vector3d moment = Vector3d::Zero();
      double absolute = 0.0;
      for (std::size_t i = 0; i < raw.weights.size(); ++i) {
        moment += raw.weights[i][lane] * (mesh.vertices()[i] - centers[lane]);
        absolute += std::abs(raw.weights[i][lane]);
      }
      EXPECT_LE(moment.norm(), 1e-10 * absolute * mesh.diagonal());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, SphericalTrianglesTest,
    testing::Values(Case{"Cube", test_shapes::Box({0, 0, 0}, {1, 1, 1}), 1e-9},
                    Case{"Bracket", test_shapes::Bracket(), 1e-9},
                    Case{"CutCube", test_shapes::Box({0, 0, 0}, {1, 1, 1}, 8), 1e-7},
                    Case{"CoarseBall", test_shapes::Ball({{3, 1, 2}, 2.0}, 2), 1e-8},
                    Case{"FineBall", test_shapes::Ball({{3, 1, 2}, 2.0}, 4), 1e-6},
                    Case{"Capsule", test_shapes::Capsule({{0, 0, 0}, 0.1}, {{0, 0, 1}, 0.2}, 40, 8),
                         1e-5}),
    [](const auto& of) { return of.param.name; });

}  // namespace
}  // namespace capfit::skinning
