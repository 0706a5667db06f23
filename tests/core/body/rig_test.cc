// What a skeleton adds to the surface, where the surface alone is mistaken or says nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/body/find_body.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"
#include "tests/core/body/body_files.h"
#include "tests/core/body/cut_bodies.h"

namespace capfit::body {
namespace {

using Eigen::Vector3d;

struct RiggedName {
  const char* name;
  LandmarkId id;
};
constexpr RiggedName kNames[] = {
    {"Neck", LandmarkId::kNeck},
    {"LeftArm", LandmarkId::kLeftShoulder},
    {"LeftForeArm", LandmarkId::kLeftElbow},
    {"LeftHand", LandmarkId::kLeftWrist},
    {"LeftUpLeg", LandmarkId::kLeftHip},
    {"LeftLeg", LandmarkId::kLeftKnee},
    {"LeftFoot", LandmarkId::kLeftAnkle},
    {"RightArm", LandmarkId::kRightShoulder},
    {"RightForeArm", LandmarkId::kRightElbow},
    {"RightHand", LandmarkId::kRightWrist},
    {"RightUpLeg", LandmarkId::kRightHip},
    {"RightLeg", LandmarkId::kRightKnee},
    {"RightFoot", LandmarkId::kRightAnkle},
};

// A mannequin (metres, +Y up, facing +Z, left at +X) with a skeleton at its own landmarks.
struct Rigged {
  formats::PolygonSoup soup;
  std::vector<formats::NamedJoint> joints;

  [[nodiscard]] Vector3d at(LandmarkId id) const {
    for (std::size_t i = 0; i < std::size(kNames); ++i) {
      if (kNames[i].id == id) return joints[i].position;
    }
    return Vector3d::Zero();
  }
  [[nodiscard]] absl::StatusOr<Body> Found(bool with_skeleton = true) const {
    const auto prepared = mesh::PrepareMesh(soup);
    if (!prepared.ok()) return prepared.status();
    BodyOptions options;
    if (with_skeleton) options.skeleton = joints;
    return Find(prepared->mesh, options);
  }
};

const Rigged& PlainMannequin() {
  static const Rigged& kRigged = *[] {
    auto* const rigged = new Rigged;
    mannequin::MannequinOptions made;
    made.faces = 4000;
    rigged->soup = *mannequin::MakeMannequin(made);
    const auto body = rigged->Found(false);
    EXPECT_TRUE(body.ok()) << body.status();
    for (const RiggedName& entry : kNames) {
      formats::NamedJoint joint;
      joint.name = entry.name;
      joint.position = body->body_from_caller.Inverse().Apply(body->landmark(entry.id)->position_m);
      rigged->joints.push_back(joint);
    }
    return rigged;
  }();
  return kRigged;
}

std::ptrdiff_t Ignored(const Body& body) {
  return std::count_if(body.warnings.begin(), body.warnings.end(),
                       [](const Warning& w) { return w.code == "SKELETON_IGNORED"; });
}

double OffMm(const Body& body, LandmarkId id, const Vector3d& want) {
  if (!body.landmark(id)) return 1e9;
  const Vector3d at = body.body_from_caller.Inverse().Apply(body.landmark(id)->position_m);
  return 1e3 * (at - want).norm();
}

void ExpectAllFromSkeleton(const Rigged& rigged, const Body& body) {
  EXPECT_EQ(Ignored(body), 0);
  for (const RiggedName& entry : kNames) {
    EXPECT_EQ(body.landmark(entry.id)->method, LandmarkMethod::kSkeleton) << entry.name;
    EXPECT_LE(OffMm(body, entry.id, rigged.at(entry.id)), 3.0) << entry.name;
  }
}

// The mannequin with a sword in the left hand: what is beyond the wrist, five times as long.
Rigged WithSword() {
  Rigged rigged = PlainMannequin();
  const Vector3d wrist = rigged.at(LandmarkId::kLeftWrist);
  const Vector3d along = (wrist - rigged.at(LandmarkId::kLeftElbow)).normalized();
  for (Vector3d& p : rigged.soup.positions) {
    const double beyond = along.dot(p - wrist) - 0.06;
    if (p.x() > 0.15 && (p - wrist).norm() < 0.3 && beyond > 0.0) p += 4.0 * beyond * along;
  }
  return rigged;
}

TEST(Rig, BelievesAnArmWhoseHandHoldsASword) {
  const Rigged rigged = WithSword();
  const auto alone = rigged.Found(false);
  ASSERT_TRUE(!alone.ok() ||
              OffMm(*alone, LandmarkId::kLeftWrist, rigged.at(LandmarkId::kLeftWrist)) > 175.0)
      << "the surface alone is not mistaken enough to prove anything";
  const auto body = rigged.Found();
  ASSERT_TRUE(body.ok()) << body.status();
  ExpectAllFromSkeleton(rigged, *body);
}

// Stilts: the soles a quarter of a metre lower.
// A head's joint may have a name in any language; the neck's often lies between the shoulders.
TEST(Rig, FindsAHeadOfWhichItSaysNothing) {
  Rigged rigged = PlainMannequin();
  rigged.joints[0].position.y() -= 0.08;
  const auto body = rigged.Found();
  ASSERT_TRUE(body.ok()) << body.status();
  EXPECT_TRUE(body->landmark(LandmarkId::kHeadTop).has_value());
  for (const Warning& warning : body->warnings) EXPECT_NE(warning.code, "PART_MISSING");
}

TEST(Rig, BelievesAnklesFarAboveTheSoles) {
  Rigged rigged = PlainMannequin();
  const double ankle = rigged.at(LandmarkId::kLeftAnkle).y();
  for (Vector3d& p : rigged.soup.positions) {
    if (p.y() < ankle - 0.03) p.y() -= 0.25;
  }
  const auto body = rigged.Found();
  ASSERT_TRUE(body.ok()) << body.status();
  ExpectAllFromSkeleton(rigged, *body);
}

struct Contradiction {
  const char* name;
  std::function<void(Rigged& rigged)> spoil;
  std::ptrdiff_t least_ignored = 0;
  std::ptrdiff_t most_ignored = 0;
  friend void PrintTo(const Contradiction& c, std::ostream* os) { *os << c.name; }
};
class RigContradiction : public testing::TestWithParam<Contradiction> {};

// A bone that is not believed leaves the measured landmark as it is without any skeleton.
TEST_P(RigContradiction, LeavesTheMeasuredLandmark) {
  Rigged rigged = PlainMannequin();
  GetParam().spoil(rigged);
  const auto body = rigged.Found();
  ASSERT_TRUE(body.ok()) << body.status();
  EXPECT_GE(Ignored(*body), GetParam().least_ignored);
  EXPECT_LE(Ignored(*body), GetParam().most_ignored);
  for (const RiggedName& entry : kNames) {
    if (body->landmark(entry.id)->method == LandmarkMethod::kSkeleton) continue;
    EXPECT_LE(OffMm(*body, entry.id, PlainMannequin().at(entry.id)), 20.0) << entry.name;
  }
}

void MoveAll(Rigged& rigged, const std::function<Vector3d(const Vector3d&)>& move) {
  for (formats::NamedJoint& joint : rigged.joints) joint.position = move(joint.position);
}

INSTANTIATE_TEST_SUITE_P(
    Of, RigContradiction,
    testing::Values(
        Contradiction{
            "AChild",  // standing beside the same soles
            [](Rigged& r) { MoveAll(r, [](const Vector3d& p) { return Vector3d(0.5 * p); }); }, 13,
            13},
        Contradiction{
            "AGiant",
            [](Rigged& r) { MoveAll(r, [](const Vector3d& p) { return Vector3d(2.0 * p); }); }, 13,
            13},
        Contradiction{"ANeighbour",
                      [](Rigged& r) {
                        MoveAll(
                            r, [](const Vector3d& p) { return Vector3d(p + Vector3d(0.7, 0, 0)); });
                      },
                      13, 13},
        Contradiction{"AHandstand",
                      [](Rigged& r) {
                        MoveAll(r, [](const Vector3d& p) {
                          return Vector3d(p.x(), 1.7 - p.y(), p.z());
                        });
                      },
                      9, 13},
        Contradiction{"ArmsRaised",  // the legs' bones are believed all the same
                      [](Rigged& r) {
                        for (formats::NamedJoint& joint : r.joints) {
                          const bool is_arm = joint.name.find("ForeArm") != std::string::npos ||
                                              joint.name.find("Hand") != std::string::npos;
                          if (is_arm) joint.position.y() = 2.9 - joint.position.y();
                        }
                      },
                      4, 4},
        Contradiction{"OneKneeAtTheHip",
                      [](Rigged& r) { r.joints[5].position = r.joints[4].position; }, 1, 1}),
    [](const auto& tested) { return std::string(tested.param.name); });

TEST(Rig, SameBitsForAnyNumberOfThreads) {
  const Rigged rigged = WithSword();
  const auto prepared = mesh::PrepareMesh(rigged.soup);
  ASSERT_TRUE(prepared.ok());
  BodyOptions options;
  options.skeleton = rigged.joints;
  const auto one = FindBody(prepared->mesh, options, ThreadPool(1), NullObserver());
  ASSERT_TRUE(one.ok()) << one.status();
  for (const int threads : {2, 7}) {
    const auto many = FindBody(prepared->mesh, options, ThreadPool(threads), NullObserver());
    ASSERT_TRUE(many.ok()) << many.status();
    EXPECT_EQ(many->vertex_segments, one->vertex_segments);
    for (std::size_t i = 0; i < one->landmarks.size(); ++i) {
      ASSERT_EQ(many->landmarks[i].has_value(), one->landmarks[i].has_value());
      if (!one->landmarks[i]) continue;
      EXPECT_EQ(many->landmarks[i]->position_m, one->landmarks[i]->position_m);
    }
  }
}

// The skeleton says which side is the left, whatever the feet say.
TEST(Rig, TellsFrontFromBack) {
  Rigged rigged = PlainMannequin();
  const auto alone = rigged.Found(false);
  const auto with = rigged.Found();
  ASSERT_TRUE(alone.ok() && with.ok());
  EXPECT_GT(with->body_from_caller.rotation(0, 0), 0.99);
  for (formats::NamedJoint& joint : rigged.joints) joint.position.x() *= -1.0;
  const auto turned = rigged.Found();  // with its left at -X
  ASSERT_TRUE(turned.ok()) << turned.status();
  EXPECT_LT(turned->body_from_caller.rotation(0, 0), -0.99);
  EXPECT_EQ(Ignored(*turned), 0);
  EXPECT_LT(turned->body_from_caller.Inverse()
                .Apply(turned->landmark(LandmarkId::kLeftFingertip)->position_m)
                .x(),
            -0.1);
}

// Hands that have crossed to the other side stay the hands that the skeleton says they are.
// Knees and ankles are there only in the skeleton.
TEST(Rig, GoesWithAnUpperBody) {
  Rigged rigged = PlainMannequin();
  const Vector3d hip = rigged.at(LandmarkId::kLeftHip);
  rigged.soup = Without(rigged.soup, [&](const Vector3d& middle, std::uint32_t) {
    return middle.y() < hip.y() && std::abs(middle.x()) < 2.5 * hip.x();
  });
  const auto body = rigged.Found();
  ASSERT_TRUE(body.ok()) << body.status();
  const auto count_of = [&](const std::string& code) {
    return std::count_if(body->warnings.begin(), body->warnings.end(),
                         [&](const Warning& w) { return w.code == code; });
  };
  EXPECT_EQ(Ignored(*body), 0);
  EXPECT_EQ(count_of("FACING_UNSURE"), 0);
  EXPECT_EQ(count_of("PART_MISSING"), 2);  // both legs
  EXPECT_FALSE(body->landmark(LandmarkId::kLeftKnee));
  for (const LandmarkId id : {LandmarkId::kNeck, LandmarkId::kRightElbow, LandmarkId::kLeftWrist}) {
    ASSERT_TRUE(body->landmark(id)) << LandmarkName(id);
    EXPECT_EQ(body->landmark(id)->method, LandmarkMethod::kSkeleton) << LandmarkName(id);
    EXPECT_LE(OffMm(*body, id, rigged.at(id)), 0.01) << LandmarkName(id);
  }
}

TEST(Rig, KeepsTheSidesOfCrossedHands) {
  Rigged rigged = PlainMannequin();
  // Hands alone exchange their names: a skeleton of crossed forearms.
  std::swap(rigged.joints[3].position, rigged.joints[9].position);
  std::swap(rigged.joints[2].position, rigged.joints[8].position);
  std::swap(rigged.joints[1].position, rigged.joints[7].position);
  const auto body = rigged.Found();
  ASSERT_TRUE(body.ok()) << body.status();
  const Vector3d fingertip = body->body_from_caller.Inverse().Apply(
      body->landmark(LandmarkId::kLeftFingertip)->position_m);
  EXPECT_LT(fingertip.x(), -0.1);
}

}  // namespace
}  // namespace capfit::body
