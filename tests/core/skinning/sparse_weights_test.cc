#include "core/skinning/sparse_weights.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "core/base/random.h"
#include "core/formats/read_mesh.h"
#include "core/geometry/similarity.h"
#include "core/mesh/prepare_mesh.h"
#include "tests/core/metrics/shapes.h"
#include "tests/support/bodies.h"

namespace capfit::skinning {
namespace {

using Eigen::Vector3d;
using test_shapes::Ball;
using test_shapes::Box;
using test_shapes::Bracket;

const ThreadPool& One() {
  static const ThreadPool pool(1);
  return pool;
}

SparseWeights Sparse(const mesh::BodyMesh& mesh, const std::vector<Vector3d>& centers) {
  return SparseMeanValueWeights(mesh, centers, One(), NullObserver());
}

std::vector<Vector3d> PointsIn(const Vector3d& low, const Vector3d& high, int count,
                               std::uint64_t seed) {
  Random random(seed);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(random.NextIn(low.x(), high.x()), random.NextIn(low.y(), high.y()),
                        random.NextIn(low.z(), high.z()));
  }
  return points;
}

std::vector<Vector3d> VerticesOf(const mesh::BodyMesh& mesh) {
  return {mesh.vertices().begin(), mesh.vertices().end()};
}

void ExpectSoundRows(const SparseWeights& weights, const std::vector<Vector3d>& centers,
                     const std::vector<Vector3d>& vertices, double tolerance,
                     double sum_tolerance = 1e-9) {
  ASSERT_EQ(weights.sphere_count(), centers.size());
  for (std::size_t s = 0; s < centers.size(); ++s) {
    const std::size_t begin = weights.RowBegin(s);
    const std::size_t end = weights.row_ends[s];
    EXPECT_LE(end - begin, kMostSparseWeights);
    double sum = 0.0;
    Vector3d center = Vector3d::Zero();
    for (std::size_t i = begin; i < end; ++i) {
      ASSERT_LT(weights.vertices[i], vertices.size());
      ASSERT_TRUE(i == begin || weights.vertices[i] > weights.vertices[i - 1]);
      sum += weights.weights[i];
      center += static_cast<double>(weights.weights[i]) * vertices[weights.vertices[i]];
    }
    EXPECT_NEAR(sum, 1.0, sum_tolerance) << "centre " << s;
    EXPECT_LE((center - centers[s]).norm(), tolerance) << "centre " << s;
  }
}

TEST(SparseMeanValueWeightsTest, ReproducesCentresInABallToANanometre) {
  const mesh::BodyMesh ball = Ball({{0.3, -0.2, 0.1}, 1.0}, 4);
  const std::vector<Vector3d> centers = PointsIn({-0.3, -0.7, -0.4}, {0.8, 0.3, 0.6}, 40, 1);
  const SparseWeights weights = Sparse(ball, centers);
  ExpectSoundRows(weights, centers, VerticesOf(ball), 1e-9);
  for (std::size_t s = 0; s < centers.size(); ++s) {
    EXPECT_GE(weights.row_ends[s] - weights.RowBegin(s), kLeastSparseWeights - 8);
  }
}

TEST(SparseMeanValueWeightsTest, ReproducesCentresInsideOnAndOutsideOfFewVertices) {
  const mesh::BodyMesh bracket = Bracket();
  const std::vector<Vector3d> centers = PointsIn({-1, -1, -1}, {3, 3, 2}, 200, 2);
  // (Few vertices leave no small weights to take up the rounding.)
  ExpectSoundRows(Sparse(bracket, centers), centers, VerticesOf(bracket), 1e-6, 2e-8);
}

TEST(SparseMeanValueWeightsTest, ReproducesCentresThatTouchTheSurface) {
  const mesh::BodyMesh ball = Ball({{0, 0, 0}, 1.0}, 4);
  const mesh::Triangle& t = ball.triangles()[77];
  const std::vector<Vector3d> centers = {
      ball.vertices()[5], 0.5 * (ball.vertices()[t[0]] + ball.vertices()[t[1]]),
      (ball.vertices()[t[0]] + ball.vertices()[t[1]] + ball.vertices()[t[2]]) / 3.0,
      (1.0 - 1e-7) * ball.vertices()[9], 1.0001 * ball.vertices()[11]};
  const SparseWeights weights = Sparse(ball, centers);
  ExpectSoundRows(weights, centers, VerticesOf(ball), 1e-9);
  // Nearly all is the vertex's that the first one touches.
  for (std::size_t i = 0; i < weights.row_ends[0]; ++i) {
    EXPECT_NEAR(weights.weights[i], weights.vertices[i] == 5 ? 1.0 : 0.0, 1e-3);
  }
}

// A bar that is bent sharply, and has no parts that patches could keep apart: sparse rows carry the
// centres as dense ones do to within 7 mm of its 1.2 m. (Over a body's walk, with parts: 2 mm.)
TEST(SparseMeanValueWeightsTest, CarriesAsTheDenseFormDoes) {
  const mesh::BodyMesh bar = test_shapes::Capsule({{0, 0, 0}, 0.08}, {{0, 0, 1.2}, 0.1}, 60, 12);
  std::vector<Vector3d> centers;
  for (double z = 0.0; z <= 1.2; z += 0.1) centers.emplace_back(0.01, -0.02, z);
  const DenseWeights dense = MeanValueWeights(bar, centers, One(), NullObserver());
  const SparseWeights sparse = Sparse(bar, centers);
  std::vector<Vector3d> bent;
  for (const Vector3d& p : bar.vertices()) {
    const double angle = std::clamp(4.0 * (p.z() - 0.5), 0.0, 1.0);
    bent.push_back(Vector3d(0, 0, 0.5) +
                   Eigen::AngleAxisd(angle, Vector3d::UnitX()) * (p - Vector3d(0, 0, 0.5)));
  }
  const std::vector<Vector3d> of_dense = Apply(dense, bent, One());
  const std::vector<Vector3d> of_sparse = Apply(sparse, bent);
  for (std::size_t i = 0; i < centers.size(); ++i) {
    EXPECT_LE((of_dense[i] - of_sparse[i]).norm(), 7e-3) << "centre " << i;
  }
}

TEST(SparseMeanValueWeightsTest, WeldedCopiesCarryOnceAndLeftOutVerticesNever) {
  const mesh::BodyMesh ball = Ball({{0, 0, 0}, 1.0}, 3);
  std::vector<std::int32_t> sources = {-1};
  std::vector<Vector3d> callers = {{50, 50, 50}};
  for (std::size_t v = 0; v < ball.vertices().size(); ++v) {
    for (std::size_t copy = 0; copy <= v % 3; ++copy) {
      sources.push_back(static_cast<std::int32_t>(v));
      callers.push_back(ball.vertices()[v]);
    }
  }
  const mesh::BodyMesh welded(VerticesOf(ball), {ball.triangles().begin(), ball.triangles().end()},
                              sources);
  const std::vector<Vector3d> centers = {{0.1, 0.2, 0.3}, {-0.7, 0.1, 0.0}};
  const SparseWeights weights = Sparse(welded, centers);
  EXPECT_EQ(weights.vertex_count, callers.size());
  ExpectSoundRows(weights, centers, callers, 1e-9);
  for (const std::uint32_t vertex : weights.vertices) {
    ASSERT_NE(vertex, 0u);
    EXPECT_NE(sources[vertex - 1], sources[vertex]) << "not the first copy";
  }
}

TEST(SparseMeanValueWeightsTest, VerticesThatTheCallerDoesNotHaveCarryNothing) {
  const mesh::BodyMesh ball = Ball({{0, 0, 0}, 1.0}, 4);
  std::vector<std::int32_t> sources;
  std::vector<Vector3d> callers;
  for (std::size_t v = 0; v < ball.vertices().size(); ++v) {
    if (ball.vertices()[v].z() > 0.8) continue;  // a closed hole
    sources.push_back(static_cast<std::int32_t>(v));
    callers.push_back(ball.vertices()[v]);
  }
  const mesh::BodyMesh closed(VerticesOf(ball), {ball.triangles().begin(), ball.triangles().end()},
                              sources);
  const std::vector<Vector3d> centers = {{0.0, 0.1, 0.7}, {0.2, 0.1, -0.4}};
  ExpectSoundRows(Sparse(closed, centers), centers, callers, 1e-9);
}

TEST(SparseMeanValueWeightsTest, CarriersStandInForTheMesh) {
  const mesh::BodyMesh solid = Ball({{0, 0, 0}, 1.0}, 3);
  // A shell a little outside, in another order, of which every second vertex is the caller's.
  std::vector<Vector3d> shell;
  std::vector<std::uint32_t> nearest;
  std::vector<std::int32_t> sources;
  const std::size_t count = solid.vertices().size();
  for (std::size_t v = 0; v < count; ++v) shell.push_back(1.02 * solid.vertices()[count - 1 - v]);
  for (std::size_t v = 0; v < count; ++v) {
    nearest.push_back(static_cast<std::uint32_t>(count - 1 - v));
    if (v % 2 == 0) sources.push_back(static_cast<std::int32_t>(v));
  }
  std::vector<Vector3d> callers;
  for (const std::int32_t s : sources) callers.push_back(shell[s]);
  const std::vector<Vector3d> centers = {{0.3, 0.2, -0.1}, {0.0, -0.8, 0.2}};
  const SparseWeights weights = SparseMeanValueWeights(solid, centers, One(), NullObserver(), {},
                                                       Carriers{shell, nearest, sources});
  EXPECT_EQ(weights.vertex_count, callers.size());
  ExpectSoundRows(weights, centers, callers, 1e-9);
}

// Two halves that part: with parts told, a centre deep in one of them follows it alone.
TEST(SparseMeanValueWeightsTest, PartsAreKeptApart) {
  const mesh::BodyMesh box = Box({0, 0, 0}, {1, 1, 1}, 10);
  std::vector<std::uint8_t> parts;
  for (const Vector3d& p : box.vertices()) parts.push_back(p.x() < 0.5 ? 3 : 12);
  const std::vector<Vector3d> center = {{0.4, 0.5, 0.5}};
  const SparseWeights weights = SparseMeanValueWeights(box, center, One(), NullObserver(), parts);
  ExpectSoundRows(weights, center, VerticesOf(box), 1e-9);
  const DenseWeights dense = MeanValueWeights(box, center, One(), NullObserver());
  double of_sparse = 0.0;
  double of_dense = 0.0;
  for (std::size_t i = 0; i < weights.vertices.size(); ++i) {
    if (parts[weights.vertices[i]] == 3) of_sparse += weights.weights[i];
  }
  for (std::size_t v = 0; v < parts.size(); ++v) of_dense += parts[v] == 3 ? dense.weights[v] : 0.0;
  EXPECT_NEAR(of_sparse, of_dense, 0.01);
}

TEST(SparseMeanValueWeightsTest, SameBitsForAnyThreadsAndCompany) {
  const mesh::BodyMesh ball = Ball({{0, 0, 0}, 1.0}, 4);
  const std::vector<Vector3d> centers = PointsIn({-1, -1, -1}, {1, 1, 1}, 23, 6);
  const SparseWeights together = Sparse(ball, centers);
  for (const int threads : {2, 7}) {
    const ThreadPool pool(threads);
    const SparseWeights other = SparseMeanValueWeights(ball, centers, pool, NullObserver());
    EXPECT_EQ(other.vertices, together.vertices);
    EXPECT_EQ(other.weights, together.weights);
  }
  const SparseWeights alone = Sparse(ball, {centers[7]});
  EXPECT_TRUE(
      std::equal(alone.weights.begin(), alone.weights.end(),
                 together.weights.begin() + static_cast<std::ptrdiff_t>(together.RowBegin(7))));
}

TEST(SparseMeanValueWeightsTest, NoCentresGiveNoRows) {
  EXPECT_EQ(Sparse(Bracket(), {}).sphere_count(), 0u);
}

TEST(SparseApplyTest, FollowsTurnsMovesAndScales) {
  const mesh::BodyMesh ball = Ball({{0.2, 0.9, -0.1}, 0.9}, 4);
  const std::vector<Vector3d> centers = PointsIn({-0.5, 0.2, -0.7}, {0.8, 1.6, 0.5}, 30, 7);
  const SparseWeights weights = Sparse(ball, centers);
  geometry::Similarity similarity;
  similarity.rotation = Eigen::AngleAxisd(2.0, Vector3d(1, 1, 3).normalized()).toRotationMatrix();
  similarity.scale = 100.0;
  similarity.translation = {1e6, -1e6, 1e6};
  std::vector<Vector3d> moved;
  for (const Vector3d& p : ball.vertices()) moved.push_back(similarity.Apply(p));
  const std::vector<Vector3d> found = Apply(weights, moved);
  for (std::size_t i = 0; i < centers.size(); ++i) {
    EXPECT_LE((found[i] - similarity.Apply(centers[i])).norm(), 3e-7);
  }
}

}  // namespace
}  // namespace capfit::skinning
