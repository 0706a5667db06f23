#include "core/skinning/bone_weights.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>

#include "core/base/random.h"

namespace capfit::skinning {
namespace {

using Eigen::Vector3d;
using formats::Placing;

Placing PlacingOf(const Eigen::Affine3d& transform) { return transform.matrix().topRows<3>(); }

Eigen::Affine3d Frame(Random& random, double scale = 1.0) {
  const auto number = [&random] { return random.NextIn(-1.0, 1.0); };
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  // In braces arguments are drawn in order, with every compiler.
  frame.translate(Vector3d{number(), number(), number()});
  frame.rotate(Eigen::Quaterniond{number(), number(), number(), number()}.normalized());
  return frame.scale(scale);
}

Eigen::Affine3d Full(const Placing& placing) {
  Eigen::Affine3d full = Eigen::Affine3d::Identity();
  full.matrix().topRows<3>() = placing;
  return full;
}

// Vertices stored in a bind pose, joints that now stand elsewhere, sparse rows over the vertices.
class Rigged {
 public:
  explicit Rigged(bool is_in_bind_pose, std::uint64_t seed = 5) : random_(seed) {
    for (int j = 0; j < 5; ++j) {
      formats::NamedJoint joint;
      joint.parent = j - 1;
      joint.bind = PlacingOf(Frame(random_, 0.01));
      joint.to_mesh = is_in_bind_pose ? joint.bind : PlacingOf(Frame(random_, 0.01));
      joint.position = joint.to_mesh.col(3);
      soup.joints.push_back(joint);
    }
    for (int v = 0; v < 60; ++v) {
      stored_.push_back(
          Vector3d{random_.NextIn(-1, 1), random_.NextIn(-1, 1), random_.NextIn(-1, 1)});
      formats::JointInfluences influences;
      const int first = v % 4;
      const auto share = static_cast<float>(random_.NextIn(0.4, 1.0));
      influences.joint = {static_cast<std::uint16_t>(first), static_cast<std::uint16_t>(first + 1)};
      influences.weight = {share, 1.0F - share};
      soup.influences.push_back(influences);
    }
    soup.positions = Posed(Joints());
    sparse.vertex_count = stored_.size();
    for (int s = 0; s < 6; ++s) {
      Vector3d center = Vector3d::Zero();
      for (std::uint32_t k = 0; k < 20; ++k) {
        const std::uint32_t vertex = 3 * k + static_cast<std::uint32_t>(s) / 2;
        const float weight = k == 19 ? -0.14F : 0.06F;
        sparse.vertices.push_back(vertex);
        sparse.weights.push_back(weight);
        center += static_cast<double>(weight) * soup.positions[vertex];
      }
      double sum = 0.0;
      for (std::uint32_t k = 0; k < 20; ++k) sum += k == 19 ? -0.14F : 0.06F;
      centers.push_back(center / sum);
      sparse.row_ends.push_back(static_cast<std::uint32_t>(sparse.vertices.size()));
    }
  }

  [[nodiscard]] std::vector<Placing> Joints() const {
    std::vector<Placing> joints;
    for (const formats::NamedJoint& joint : soup.joints) joints.push_back(joint.to_mesh);
    return joints;
  }
  [[nodiscard]] std::vector<Placing> OtherPose() {
    std::vector<Placing> joints;
    for (std::size_t j = 0; j < soup.joints.size(); ++j) {
      joints.push_back(PlacingOf(Frame(random_, 0.012)));
    }
    return joints;
  }
  // Linear blend skinning by its definition.
  [[nodiscard]] std::vector<Vector3d> Posed(const std::vector<Placing>& joints) const {
    std::vector<Vector3d> posed;
    for (std::size_t v = 0; v < stored_.size(); ++v) {
      Vector3d sum = Vector3d::Zero();
      for (std::size_t k = 0; k < 2; ++k) {
        const std::size_t j = soup.influences[v].joint[k];
        sum += static_cast<double>(soup.influences[v].weight[k]) *
               (Full(joints[j]) * Full(soup.joints[j].bind).inverse() * stored_[v]);
      }
      posed.push_back(sum);
    }
    return posed;
  }

  formats::PolygonSoup soup;
  SparseWeights sparse;
  std::vector<Vector3d> centers;

 private:
  Random random_;
  std::vector<Vector3d> stored_;
};

void ExpectFollows(Rigged rigged) {
  const auto bones = BonesOfSparse(rigged.sparse, rigged.centers, rigged.soup);
  ASSERT_TRUE(bones.has_value());
  const std::vector<Vector3d> at_rest = Apply(*bones, rigged.Joints());
  for (std::size_t s = 0; s < at_rest.size(); ++s) {
    EXPECT_LE((at_rest[s] - rigged.centers[s]).norm(), 1e-12);
  }
  for (int pose = 0; pose < 20; ++pose) {
    const std::vector<Placing> joints = rigged.OtherPose();
    const std::vector<Vector3d> found = Apply(*bones, joints);
    const std::vector<Vector3d> expected = Apply(rigged.sparse, rigged.Posed(joints));
    for (std::size_t s = 0; s < found.size(); ++s) {
      // Weights are floats: each of up to five is off by 3e-8, at points some metres away.
      EXPECT_LE((found[s] - expected[s]).norm(), 4e-7) << "sphere " << s;
    }
  }
}

TEST(BonesOfSparseTest, IsExactForLinearBlendSkinningFromTheBindPose) {
  ExpectFollows(Rigged(/*is_in_bind_pose=*/true));
}

TEST(BonesOfSparseTest, IsExactWhereNodesDoNotStandInTheBindPose) {
  ExpectFollows(Rigged(/*is_in_bind_pose=*/false));
}

TEST(BonesOfSparseTest, RowsSumToOneAndNameEachJointOnce) {
  const Rigged rigged(true);
  const auto bones = BonesOfSparse(rigged.sparse, rigged.centers, rigged.soup);
  ASSERT_TRUE(bones.has_value());
  EXPECT_EQ(bones->joint_count, 5u);
  for (std::size_t s = 0; s < bones->sphere_count(); ++s) {
    double sum = 0.0;
    for (std::size_t i = bones->RowBegin(s); i < bones->row_ends[s]; ++i) {
      EXPECT_TRUE(i == bones->RowBegin(s) || bones->joints[i] > bones->joints[i - 1]);
      sum += bones->weights[i];
    }
    EXPECT_NEAR(sum, 1.0, 1e-9);
  }
}

TEST(BonesOfSparseTest, SmallSharesAreLeftOutAndTheRestCentreStaysExact) {
  Rigged rigged(true);
  for (std::size_t v = 0; v < rigged.soup.influences.size(); ++v) {
    formats::JointInfluences& influences = rigged.soup.influences[v];
    influences.joint = {1, 4};
    influences.weight = {0.9995F, 0.0005F};
  }
  const auto bones = BonesOfSparse(rigged.sparse, rigged.centers, rigged.soup);
  ASSERT_TRUE(bones.has_value());
  for (const std::uint16_t joint : bones->joints) EXPECT_EQ(joint, 1);
  const std::vector<Vector3d> at_rest = Apply(*bones, rigged.Joints());
  for (std::size_t s = 0; s < at_rest.size(); ++s) {
    EXPECT_LE((at_rest[s] - rigged.centers[s]).norm(), 1e-12);
  }
}

TEST(BonesOfSparseTest, SmallSharesGoToTheJointAbove) {
  Rigged rigged(true);
  for (formats::JointInfluences& influences : rigged.soup.influences) {
    influences.joint = {0, 4};
    influences.weight = {0.9995F, 0.0005F};
  }
  rigged.soup.joints[4].parent = 2;
  // As long as what is below moves with what is above, nothing is lost: turn 0, 2 with 4.
  const auto bones = BonesOfSparse(rigged.sparse, rigged.centers, rigged.soup);
  ASSERT_TRUE(bones.has_value());
  // 4 and 2 have less than a thousandth together, and so on up to 0, which has all.
  for (const std::uint16_t joint : bones->joints) EXPECT_EQ(joint, 0);
  for (const float weight : bones->weights) EXPECT_EQ(weight, 1.0F);
}

TEST(BonesOfSparseTest, VerticesThatNothingHoldsMoveWithTheNearestThatSomethingDoes) {
  Rigged rigged(true);
  for (std::size_t v = 0; v < rigged.soup.influences.size(); ++v) {
    formats::JointInfluences& influences = rigged.soup.influences[v];
    influences = {};
    if (v % 7 == 0) {
      influences.joint[0] = 3;
      influences.weight[0] = 1.0F;
    }
  }
  const auto bones = BonesOfSparse(rigged.sparse, rigged.centers, rigged.soup);
  ASSERT_TRUE(bones.has_value());
  for (std::size_t i = 0; i < bones->joints.size(); ++i) {
    EXPECT_EQ(bones->joints[i], 3);
    EXPECT_EQ(bones->weights[i], 1.0F);
  }
}

TEST(BonesOfSparseTest, NothingWithoutJointsThatCarry) {
  Rigged rigged(true);
  formats::PolygonSoup bare = rigged.soup;
  bare.influences.clear();
  EXPECT_FALSE(BonesOfSparse(rigged.sparse, rigged.centers, bare).has_value());
  for (formats::NamedJoint& joint : rigged.soup.joints) joint.to_mesh.setZero();
  EXPECT_FALSE(BonesOfSparse(rigged.sparse, rigged.centers, rigged.soup).has_value());
}

}  // namespace
}  // namespace capfit::skinning
