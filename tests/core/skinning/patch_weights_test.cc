#include "core/skinning/patch_weights.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/skinning/spherical_triangles.h"
#include "tests/core/metrics/shapes.h"

namespace capfit::skinning {
namespace {

using Eigen::Vector3d;

// The whole surface once, and each patch with nearly the weight that its vertices have.
void ExpectWeightsOf(const mesh::BodyMesh& mesh, const Vector3d& center, double tolerance) {
  const SurfaceTree tree(mesh, {});
  std::array<Vector3d, kLanes> centers;
  centers.fill(center);
  const RawWeights raw = MeanValueRawWeights(mesh, centers);
  double sizes = 0.0;
  for (const Lanes& weight : raw.weights) sizes += std::abs(weight[0]);
  std::uint32_t next = 0;
  const std::vector<SeenPatch> seen = PatchesSeenFrom(center, tree, {});
  EXPECT_LE(seen.size(), PatchCounts().most);
  for (const SeenPatch& patch : seen) {
    EXPECT_EQ(patch.begin, next);
    EXPECT_GT(patch.end, patch.begin);
    next = patch.end;
    double weight = 0.0;
    Vector3d moment = Vector3d::Zero();
    for (std::uint32_t i = patch.begin; i < patch.end; ++i) {
      const std::uint32_t vertex = tree.order()[i];
      weight += raw.weights[vertex][0];
      moment += raw.weights[vertex][0] * (mesh.vertices()[vertex] - center);
    }
    EXPECT_NEAR(patch.weight, weight, tolerance * sizes);
    EXPECT_LE((patch.moment - moment).norm(), tolerance * sizes * mesh.diagonal());
  }
  EXPECT_EQ(next, mesh.vertices().size());
}

TEST(PatchesSeenFromTest, HaveTheWeightsOfTheirVerticesInABall) {
  const mesh::BodyMesh ball = test_shapes::Ball({{0.1, 0.2, 0.3}, 1.0}, 4);
  for (const double at : {0.0, 0.5, 0.9, 0.97, 0.995, 1.02}) {
    ExpectWeightsOf(ball, Vector3d(0.1 + at, 0.2, 0.3), 2e-3);
  }
}

TEST(PatchesSeenFromTest, HaveTheWeightsOfTheirVerticesInABar) {
  const mesh::BodyMesh bar = test_shapes::Capsule({{0, 0, 0}, 0.08}, {{0, 0, 1.2}, 0.1}, 60, 12);
  for (const double z : {-0.05, 0.0, 0.3, 1.0}) {
    ExpectWeightsOf(bar, Vector3d(0.03, 0.01, z), 3e-3);
  }
}

TEST(SurfaceTreeTest, PatchesAreTheSumsOfTheirVertices) {
  const mesh::BodyMesh ball = test_shapes::Ball({{5, 2, 3}, 1.0}, 3);
  std::vector<std::uint8_t> parts;
  for (const Vector3d& p : ball.vertices()) parts.push_back(p.x() > 5.3 ? 9 : 2);
  const SurfaceTree tree(ball, parts);
  EXPECT_EQ(tree.root().begin, 0u);
  EXPECT_EQ(tree.root().end, ball.vertices().size());
  EXPECT_FALSE(tree.root().is_of_one);
  EXPECT_NEAR(tree.root().area, ball.area(), 1e-4);
  EXPECT_LE(tree.root().area_vector.abs().maxCoeff(), 1e-5F);  // it is closed
  std::vector<bool> seen(ball.vertices().size(), false);
  for (std::size_t i = 0; i < tree.order().size(); ++i) {
    seen[tree.order()[i]] = true;
    EXPECT_EQ(tree.PlaceOf(tree.order()[i]), i);
    EXPECT_EQ(mesh::StartOf(ball.triangles(), tree.HalfEdgeFrom(tree.order()[i])), tree.order()[i]);
  }
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](bool one) { return one; }));
  // The one part first, then the other, none of whose patches mix.
  std::vector<const SurfacePatch*> open = {&tree.root()};
  while (!open.empty()) {
    const SurfacePatch& patch = *open.back();
    open.pop_back();
    bool is_of_one = true;
    for (std::uint32_t i = patch.begin; i < patch.end; ++i) {
      is_of_one &= parts[tree.order()[i]] == parts[tree.order()[patch.begin]];
    }
    EXPECT_EQ(patch.is_of_one, is_of_one);
    if (patch.is_bucket()) continue;
    for (const std::int32_t part : patch.parts) open.push_back(&tree.patch(part));
  }
}

}  // namespace
}  // namespace capfit::skinning
