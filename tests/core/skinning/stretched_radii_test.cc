#include "core/skinning/stretched_radii.h"

#include <gtest/gtest.h>

#include "tests/core/metrics/shapes.h"

namespace capfit::skinning {
namespace {

using Eigen::Vector3d;

class StretchTest : public testing::Test {
 protected:
  StretchTest()
      : ball_(test_shapes::Ball({{0, 0, 0}, 1.0}, 3)),
        rest_(ball_.vertices().begin(), ball_.vertices().end()),
        dense_(MeanValueWeights(ball_, centers_, ThreadPool(1), NullObserver())),
        sparse_(SparseMeanValueWeights(ball_, centers_, ThreadPool(1), NullObserver())) {}

  // Both forms, with all lengths changed by a factor.
  std::vector<double> Factors(double scale) const {
    std::vector<Vector3d> now;
    for (const Vector3d& p : rest_) now.emplace_back(scale * p + Vector3d(7, 8, 9));
    const std::vector<Vector3d> rest_centers = Apply(sparse_, rest_);
    const std::vector<Vector3d> now_centers = Apply(sparse_, now);
    std::vector<double> factors = Stretch(sparse_, {rest_, rest_centers}, {now, now_centers});
    for (const double factor : Stretch(dense_, {rest_, rest_centers}, {now, now_centers})) {
      factors.push_back(factor);
    }
    return factors;
  }

  std::vector<Vector3d> centers_ = {{0, 0, 0}, {0.3, 0.2, -0.1}};
  mesh::BodyMesh ball_;
  std::vector<Vector3d> rest_;
  DenseWeights dense_;
  SparseWeights sparse_;
};

TEST_F(StretchTest, AScaledBodyScalesItsRadii) {
  for (const double scale : {0.9, 1.0, 1.2}) {
    for (const double factor : Factors(scale)) EXPECT_NEAR(factor, scale, 1e-9);
  }
}

TEST_F(StretchTest, StaysWithinItsLimits) {
  for (const double factor : Factors(0.5)) EXPECT_EQ(factor, kLeastStretch);
  for (const double factor : Factors(3.0)) EXPECT_EQ(factor, kMostStretch);
}

TEST(StretchOfBonesTest, TurnsKeepRadiiAndScalesScaleThem) {
  BoneWeights bones;
  bones.joint_count = 2;
  bones.joints = {0, 1};
  bones.weights = {0.25F, 0.75F};
  bones.offsets = {Vector3d(1, 2, 3), Vector3d(3, 2, 1)};
  bones.row_ends = {2};
  std::vector<formats::Placing> rest(2, formats::Placing::Identity());
  rest[1].leftCols<3>() *= 0.01;
  std::vector<formats::Placing> turned = rest;
  turned[0].leftCols<3>() = Eigen::AngleAxisd(1.0, Vector3d::UnitY()).toRotationMatrix();
  EXPECT_NEAR(Stretch(bones, rest, turned)[0], 1.0, 1e-12);
  std::vector<formats::Placing> scaled = rest;
  scaled[1].leftCols<3>() *= 1.2;
  EXPECT_NEAR(Stretch(bones, rest, scaled)[0], 0.25 + 0.75 * 1.2, 1e-7);
  scaled[1].leftCols<3>().setZero();
  EXPECT_EQ(Stretch(bones, rest, scaled)[0], kLeastStretch);
}

}  // namespace
}  // namespace capfit::skinning
