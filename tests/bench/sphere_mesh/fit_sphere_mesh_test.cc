#include "tests/bench/sphere_mesh/fit_sphere_mesh.h"

#include <gtest/gtest.h>

#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"

namespace capfit::bench {
namespace {

mesh::BodyMesh Mannequin() {
  mannequin::MannequinOptions options;
  options.faces = 4000;
  return mesh::PrepareMesh(*mannequin::MakeMannequin(options))->mesh;
}

TEST(SphereMeshFitter, EachStepIsBetterAndNoneIsOverBudget) {
  const mesh::BodyMesh body = Mannequin();
  const VolumeError error(body, 200);
  double before[3] = {1.0, 1.0, 1.0};
  for (const Steps steps : {Steps::kCollapse, Steps::kDrop, Steps::kSettle}) {
    const SphereMeshFitter fitter(body, 128, {.steps = steps});
    std::size_t at = 0;
    for (const int budget : {22, 64, 128}) {
      const SphereMesh mesh = fitter.Fit(budget);
      EXPECT_LE(PrimitiveCount(mesh), budget);
      for (const geometry::Sphere& sphere : mesh.spheres) EXPECT_GE(sphere.radius_m, 0.0);
      const double found = error.Of(mesh);
      EXPECT_LT(found, 0.95 * before[at]) << static_cast<int>(steps) << " at " << budget;
      before[at++] = found;
    }
  }
}

TEST(SphereMeshFitter, SeveralSettingsAreAtLeastAsGoodAsTheirBest) {
  const mesh::BodyMesh body = Mannequin();
  const VolumeError error(body, 200);
  const SphereMeshFitter all(body, 64, {.steps = Steps::kCollapse});
  for (const double bound : FitOptions().radius_bounds) {
    const SphereMeshFitter one(body, 64, {.radius_bounds = {bound}, .steps = Steps::kCollapse});
    for (const int budget : {22, 64}) {
      EXPECT_LE(error.Of(all.Fit(budget)), error.Of(one.Fit(budget)) + 0.005) << bound;
    }
  }
}

TEST(SphereMeshFitter, TheSameBodyGivesTheSameMesh) {
  const mesh::BodyMesh body = Mannequin();
  EXPECT_EQ(ToJson(SphereMeshFitter(body, 48, {}).Fit(48), 0.0),
            ToJson(SphereMeshFitter(body, 346, {}).Fit(48), 0.0));
}

TEST(SphereMeshFitter, TheLeastBudgetsAreMet) {
  const mesh::BodyMesh body = Mannequin();
  const SphereMeshFitter fitter(body, 3, {});
  EXPECT_EQ(PrimitiveCount(fitter.Fit(3)), 3);
  EXPECT_EQ(PrimitiveCount(fitter.Fit(2)), 1);
  EXPECT_EQ(PrimitiveCount(fitter.Fit(1)), 1);
}

}  // namespace
}  // namespace capfit::bench
