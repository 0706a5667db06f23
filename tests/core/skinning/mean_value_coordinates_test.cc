#include "core/skinning/mean_value_coordinates.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "core/base/random.h"
#include "core/formats/read_mesh.h"
#include "core/mesh/prepare_mesh.h"
#include "tests/core/metrics/shapes.h"
#include "tests/support/bodies.h"

namespace capfit::skinning {
namespace {

using Eigen::Vector3d;
using test_shapes::Ball;
using test_shapes::Box;
using test_shapes::Bracket;

const ThreadPool& OneThread() {
  static const ThreadPool pool(1);
  return pool;
}

DenseWeights Weights(const mesh::BodyMesh& mesh, const std::vector<Vector3d>& centers) {
  return MeanValueWeights(mesh, centers, OneThread(), NullObserver());
}

double Sum(std::span<const float> row) { return std::accumulate(row.begin(), row.end(), 0.0); }

std::vector<Vector3d> Positions(const mesh::BodyMesh& mesh) {
  return {mesh.vertices().begin(), mesh.vertices().end()};
}

std::vector<Vector3d> RandomPoints(const Vector3d& low, const Vector3d& high, int count,
                                   std::uint64_t seed) {
  Random random(seed);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(random.NextIn(low.x(), high.x()), random.NextIn(low.y(), high.y()),
                        random.NextIn(low.z(), high.z()));
  }
  return points;
}

void ExpectReproduces(const mesh::BodyMesh& mesh, const std::vector<Vector3d>& centers,
                      double tolerance) {
  const DenseWeights weights = Weights(mesh, centers);
  const std::vector<Vector3d> found = Apply(weights, mesh.vertices(), OneThread());
  for (std::size_t i = 0; i < centers.size(); ++i) {
    EXPECT_NEAR(Sum(weights.Row(i)), 1.0, 1e-9) << "centre " << i;
    EXPECT_LE((found[i] - centers[i]).norm(), tolerance) << "centre " << centers[i].transpose();
  }
}

TEST(MeanValueWeightsTest, CentreOfACubeWeighsAllCorners) {
  const mesh::BodyMesh cube = Box({0, 0, 0}, {1, 1, 1});
  const DenseWeights weights = Weights(cube, {{0.5, 0.5, 0.5}});
  ASSERT_EQ(weights.weights.size(), 8u);
  EXPECT_NEAR(Sum(weights.Row(0)), 1.0, 1e-12);
  for (const float weight : weights.weights) {
    EXPECT_GT(weight, 0.05f);
    EXPECT_LT(weight, 0.25f);
  }
}

TEST(MeanValueWeightsTest, OctahedronCentreWeighsAllCornersAlike) {
  const DenseWeights weights = Weights(Ball({{1, 2, 3}, 0.7}, 0), {{1, 2, 3}});
  for (const float weight : weights.weights) EXPECT_NEAR(weight, 1.0 / 6.0, 1e-7);
}

TEST(MeanValueWeightsTest, ReproducesCentresInABall) {
  const mesh::BodyMesh ball = Ball({{0.3, -0.2, 0.1}, 1.0}, 4);
  ExpectReproduces(ball, RandomPoints({-0.3, -0.7, -0.4}, {0.8, 0.3, 0.6}, 40, 1), 1e-7);
}

TEST(MeanValueWeightsTest, ReproducesCentresInsideOnAndOutsideABracket) {
  ExpectReproduces(Bracket(), RandomPoints({-1, -1, -1}, {3, 3, 2}, 200, 2), 1e-6);
}

TEST(MeanValueWeightsTest, ReproducesCentresFarOutside) {
  ExpectReproduces(Box({0, 0, 0}, {1, 1, 1}, 6), {{10, 0, 0}, {-5, 20, 7}, {0.5, 0.5, -12}}, 2e-5);
}

TEST(MeanValueWeightsTest, IsPositiveInsideConvexShapes) {
  const std::vector<Vector3d> inside = RandomPoints({0.01, 0.01, 0.01}, {0.99, 0.99, 0.99}, 60, 3);
  for (const int steps : {1, 2, 15}) {
    for (const float weight : Weights(Box({0, 0, 0}, {1, 1, 1}, steps), inside).weights) {
      ASSERT_GT(weight, 0.0f) << steps << " steps";
    }
  }
}

TEST(MeanValueWeightsTest, IsNegativeSomewhereBehindACorner) {
  const DenseWeights weights = Weights(Bracket(), {{0.3, 1.8, 0.5}});
  EXPECT_LT(*std::min_element(weights.weights.begin(), weights.weights.end()), 0.0f);
}

TEST(MeanValueWeightsTest, AVertexHasAllTheWeightOfACentreThatTouchesIt) {
  const mesh::BodyMesh ball = Ball({{0, 0, 0}, 1.0}, 3);
  for (const std::size_t at : {std::size_t{0}, std::size_t{17}, std::size_t{100}}) {
    const DenseWeights weights = Weights(ball, {ball.vertices()[at]});
    for (std::size_t i = 0; i < weights.vertex_count; ++i) {
      ASSERT_EQ(weights.weights[i], i == at ? 1.0f : 0.0f) << "vertex " << i;
    }
  }
}

TEST(MeanValueWeightsTest, ApproachesTheVertexContinuously) {
  const mesh::BodyMesh ball = Ball({{0, 0, 0}, 1.0}, 2);
  for (const double distance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
    const DenseWeights weights = Weights(ball, {(1.0 - distance) * ball.vertices()[9]});
    EXPECT_NEAR(weights.weights[9], 1.0, 20 * distance + 1e-7) << distance;
  }
}

TEST(MeanValueWeightsTest, OnAFaceTheWeightsAreBarycentric) {
  const mesh::BodyMesh bracket = Bracket();
  const mesh::Triangle triangle = bracket.triangles()[5];
  const Vector3d shares(0.2, 0.5, 0.3);
  Vector3d center = Vector3d::Zero();
  for (int k = 0; k < 3; ++k) center += shares[k] * bracket.vertices()[triangle[k]];
  const DenseWeights weights = Weights(bracket, {center});
  for (std::size_t i = 0; i < weights.vertex_count; ++i) {
    double expected = 0.0;
    for (int k = 0; k < 3; ++k) expected += triangle[k] == i ? shares[k] : 0.0;
    EXPECT_NEAR(weights.weights[i], expected, 1e-7) << "vertex " << i;
  }
  EXPECT_EQ(Sum(weights.Row(0)), 1.0);  // exactly: laid on a grid
}

TEST(MeanValueWeightsTest, OnAnEdgeTheTwoEndsShare) {
  const mesh::BodyMesh cube = Box({0, 0, 0}, {1, 1, 1});
  const mesh::Triangle triangle = cube.triangles()[0];
  const Vector3d center = 0.25 * cube.vertices()[triangle[0]] + 0.75 * cube.vertices()[triangle[1]];
  const DenseWeights weights = Weights(cube, {center});
  EXPECT_NEAR(weights.weights[triangle[0]], 0.25, 1e-7);
  EXPECT_NEAR(weights.weights[triangle[1]], 0.75, 1e-7);
  EXPECT_EQ(Sum(weights.Row(0)), 1.0);
}

TEST(MeanValueWeightsTest, InThePlaneOfAFaceButOutsideItReproducesTheCentre) {
  const mesh::BodyMesh cube = Box({0, 0, 0}, {1, 1, 1}, 3);
  ExpectReproduces(cube, {{1.5, 0.4, 0.0}, {0.2, 0.3, 2.0}, {1.0, 1.0, 1.7}, {2, 2, 1}}, 3e-7);
}

TEST(MeanValueWeightsTest, CloseToAFaceReproducesTheCentreAtEveryDistance) {
  const mesh::BodyMesh cube = Box({0, 0, 0}, {1, 1, 1}, 2);
  std::vector<Vector3d> centers;
  for (double distance = 1e-2; distance > 1e-17; distance *= 0.1) {
    centers.emplace_back(0.31, 0.22, distance);
    centers.emplace_back(0.31, 0.22, -distance);
    centers.emplace_back(0.31, 0.31 + distance, 0.0);  // beside a diagonal
    centers.emplace_back(0.31, distance, distance);    // beside an edge of the cube
  }
  ExpectReproduces(cube, centers, 4e-7);
}

// The interpolant of z * z is linear on each triangle, so cutting the flat sides finer brings it to
// its limit with the square of the step. Two steps take the careful path, forty the lanes'.
TEST(MeanValueWeightsTest, CuttingFlatSidesConvergesWithTheSquareOfTheStep) {
  const auto interpolated = [](int steps) {
    const mesh::BodyMesh box = Box({0, 0, 0}, {1, 1, 1}, steps);
    const DenseWeights weights = Weights(box, {{0.6, 0.35, 0.45}});
    double value = 0.0;
    for (std::size_t i = 0; i < weights.vertex_count; ++i) {
      value += weights.weights[i] * std::pow(box.vertices()[i].z(), 2);
    }
    return value;
  };
  const double at_2 = interpolated(2);
  const double at_20 = interpolated(20);
  const double at_40 = interpolated(40);
  EXPECT_NEAR((at_20 - at_40) / (at_2 - at_40), (1.0 / 400 - 1.0 / 1600) / (0.25 - 1.0 / 1600),
              2e-3);
}

TEST(MeanValueWeightsTest, DoesNotDependOnPlaceTurnOrSize) {
  const mesh::BodyMesh bracket = Bracket();
  const std::vector<Vector3d> centers = RandomPoints({-0.5, -0.5, -0.5}, {2.5, 2.5, 1.5}, 20, 5);
  const DenseWeights before = Weights(bracket, centers);
  geometry::Similarity similarity;
  similarity.rotation = Eigen::AngleAxisd(1.1, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  similarity.scale = 37.0;
  similarity.translation = {40, -70, 15};
  std::vector<Vector3d> moved;
  for (const Vector3d& c : centers) moved.push_back(similarity.Apply(c));
  const DenseWeights after = Weights(bracket.Transformed(similarity), moved);
  for (std::size_t i = 0; i < before.weights.size(); ++i) {
    EXPECT_NEAR(after.weights[i], before.weights[i], 3e-6) << i;
  }
}

TEST(MeanValueWeightsTest, WeldedCopiesShareAndLeftOutVerticesWeighNothing) {
  const mesh::BodyMesh cube = Box({0, 0, 0}, {1, 1, 1});
  const std::vector<Vector3d> center = {{0.3, 0.4, 0.6}};
  const DenseWeights plain = Weights(cube, center);
  // Vertex 2 came in three copies, two sources were left out, the order is turned round.
  std::vector<std::int32_t> sources = {7, -1, 6, 5, 2, 4, 3, 2, -1, 2, 1, 0};
  const mesh::BodyMesh welded({cube.vertices().begin(), cube.vertices().end()},
                              {cube.triangles().begin(), cube.triangles().end()}, sources);
  const DenseWeights shared = Weights(welded, center);
  ASSERT_EQ(shared.vertex_count, sources.size());
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const double whole = sources[s] < 0 ? 0.0 : plain.weights[sources[s]];
    EXPECT_NEAR(shared.weights[s], sources[s] == 2 ? whole / 3 : whole, 1e-7) << "source " << s;
  }
  EXPECT_NEAR(Sum(shared.Row(0)), 1.0, 1e-9);
}

TEST(MeanValueWeightsTest, VerticesThatTheCallerDoesNotHavePassTheirWeightOn) {
  // As if a hole had been closed round vertex `added` of a ball.
  const mesh::BodyMesh ball = Ball({{0, 0, 0}, 1.0}, 3);
  const std::size_t added = 40;
  std::vector<std::int32_t> sources;
  std::vector<Vector3d> callers;
  for (std::size_t v = 0; v < ball.vertices().size(); ++v) {
    if (v == added) continue;
    sources.push_back(static_cast<std::int32_t>(v));
    callers.push_back(ball.vertices()[v]);
  }
  const mesh::BodyMesh closed(Positions(ball), {ball.triangles().begin(), ball.triangles().end()},
                              sources);
  const std::vector<Vector3d> centers = {{0.1, 0.2, -0.3}, 0.9 * ball.vertices()[added]};
  const DenseWeights weights = Weights(closed, centers);
  const std::vector<Vector3d> found = Apply(weights, callers, OneThread());
  for (std::size_t i = 0; i < centers.size(); ++i) {
    EXPECT_LE((found[i] - centers[i]).norm(), 1e-6);
    EXPECT_NEAR(Sum(weights.Row(i)), 1.0, 1e-9);
  }
}

TEST(MeanValueWeightsTest, EveryRowIsTheSameBitsAloneInCompanyAndOnManyThreads) {
  const mesh::BodyMesh ball = Ball({{0, 0, 0}, 1.0}, 3);
  std::vector<Vector3d> centers = RandomPoints({-1, -1, -1}, {1, 1, 1}, 11, 6);
  centers[3] = ball.vertices()[12];  // a neighbour that takes the special path
  const DenseWeights together = Weights(ball, centers);
  for (const int threads : {2, 7}) {
    const ThreadPool pool(threads);
    EXPECT_EQ(MeanValueWeights(ball, centers, pool, NullObserver()).weights, together.weights);
  }
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const DenseWeights alone = Weights(ball, {centers[i]});
    const auto row = together.Row(i);
    EXPECT_TRUE(std::equal(row.begin(), row.end(), alone.weights.begin())) << "centre " << i;
  }
}

TEST(MeanValueWeightsTest, NoCentresGiveNoRows) {
  const DenseWeights weights = Weights(Bracket(), {});
  EXPECT_EQ(weights.sphere_count, 0u);
  EXPECT_TRUE(weights.weights.empty());
}

class CancelledObserver final : public FitObserver {
 public:
  void OnStage(Stage, double) override {}
  [[nodiscard]] bool IsCancelled() const override { return true; }
};

TEST(MeanValueWeightsTest, StopsWhenCancelled) {
  const std::vector<Vector3d> center = {{0.5, 0.5, 0.5}};
  const DenseWeights weights =
      MeanValueWeights(Bracket(), center, OneThread(), CancelledObserver());
  EXPECT_EQ(Sum(weights.Row(0)), 0.0);
}

TEST(ApplyTest, FollowsTurnsMovesAndScalesExactly) {
  const mesh::BodyMesh ball = Ball({{0.2, 0.9, -0.1}, 0.9}, 4);
  const std::vector<Vector3d> centers = RandomPoints({-0.5, 0.2, -0.7}, {0.8, 1.6, 0.5}, 30, 7);
  const DenseWeights weights = Weights(ball, centers);
  const double height = ball.box_max().y() - ball.box_min().y();
  for (const double far : {0.0, 1e3, 1e6}) {
    for (const double scale : {0.01, 1.0, 100.0}) {
      geometry::Similarity similarity;
      similarity.rotation =
          Eigen::AngleAxisd(2.2, Vector3d(3, -1, 2).normalized()).toRotationMatrix();
      similarity.scale = scale;
      similarity.translation = far * Vector3d(1, -2, 0.5);
      std::vector<Vector3d> moved;
      for (const Vector3d& v : ball.vertices()) moved.push_back(similarity.Apply(v));
      const std::vector<Vector3d> found = Apply(weights, moved, OneThread());
      for (std::size_t i = 0; i < centers.size(); ++i) {
        EXPECT_LE((found[i] - similarity.Apply(centers[i])).norm(),
                  1e-6 * height * scale + 1e-15 * far)
            << "far " << far << " scale " << scale;
      }
    }
  }
}

TEST(ApplyTest, SameBitsOnManyThreads) {
  const mesh::BodyMesh ball = Ball({{0, 0, 0}, 1.0}, 3);
  const DenseWeights weights = Weights(ball, RandomPoints({-1, -1, -1}, {1, 1, 1}, 9, 8));
  const std::vector<Vector3d> one = Apply(weights, ball.vertices(), OneThread());
  for (const int threads : {2, 7}) {
    const std::vector<Vector3d> many = Apply(weights, ball.vertices(), ThreadPool(threads));
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(many[i], one[i]);
  }
}

TEST(RealBodiesTest, ReproduceCentresInsideEveryBody) {
  CAPFIT_REQUIRE_BODIES();
  for (const auto& file : test_support::BodyFiles()) {
    const std::string bytes = test_support::ReadFile(file);
    const auto soup = formats::ReadMesh(std::as_bytes(std::span(bytes)));
    ASSERT_TRUE(soup.ok()) << file << soup.status();
    const auto prepared = mesh::PrepareMesh(*soup);
    ASSERT_TRUE(prepared.ok()) << file << prepared.status();
    const mesh::BodyMesh& body = prepared->mesh;
    const double height = body.box_max().y() - body.box_min().y();
    const std::vector<Vector3d> centers = RandomPoints(body.box_min(), body.box_max(), 8, 9);
    const DenseWeights weights = Weights(body, centers);
    const std::vector<Vector3d> found = Apply(weights, soup->positions, OneThread());
    for (std::size_t i = 0; i < centers.size(); ++i) {
      EXPECT_LE((found[i] - centers[i]).norm(), 1e-6 * height) << file;
      EXPECT_NEAR(Sum(weights.Row(i)), 1.0, 1e-9) << file;
    }
  }
}

}  // namespace
}  // namespace capfit::skinning
