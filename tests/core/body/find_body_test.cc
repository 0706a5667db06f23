// The body's own frame, its symmetry, the caller's wishes, and inputs that are awkward or no body.
#include "core/body/find_body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <vector>

#include "absl/strings/str_format.h"
#include "core/base/random.h"
#include "core/base/status.h"
#include "core/mesh/prepare_mesh.h"
#include "tests/core/body/body_files.h"
#include "tests/support/bodies.h"
#include "tests/support/random_mannequin.h"

namespace capfit::body {
namespace {

mesh::BodyMesh Mannequin(const mannequin::MannequinOptions& options) {
  const auto soup = mannequin::MakeMannequin(options);
  EXPECT_TRUE(soup.ok()) << soup.status();
  auto prepared = mesh::PrepareMesh(*soup);
  EXPECT_TRUE(prepared.ok()) << prepared.status();
  return std::move(prepared->mesh);
}

mesh::BodyMesh SmallMannequin() {
  mannequin::MannequinOptions options;
  options.faces = 4000;
  return Mannequin(options);
}

geometry::Similarity Moved(double angle_rad, const Eigen::Vector3d& axis, double scale,
                           const Eigen::Vector3d& translation) {
  geometry::Similarity similarity;
  similarity.rotation = Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
  similarity.scale = scale;
  similarity.translation = translation;
  return similarity;
}

// Everything that a later room sees, to 1e-6 of the height.
void ExpectSameBody(const Body& a, const Body& b) {
  const double tolerance = 1e-6 * a.height_m;
  EXPECT_NEAR(a.height_m, b.height_m, tolerance);
  EXPECT_EQ(a.is_symmetric, b.is_symmetric);
  for (int i = 0; i < kLandmarkCount; ++i) {
    ASSERT_EQ(a.landmarks[i].has_value(), b.landmarks[i].has_value());
    if (!a.landmarks[i]) continue;
    EXPECT_LE((a.landmarks[i]->position_m - b.landmarks[i]->position_m).norm(), tolerance)
        << LandmarkName(static_cast<LandmarkId>(i));
  }
  ASSERT_EQ(a.mesh.vertices().size(), b.mesh.vertices().size());
  for (std::size_t v = 0; v < a.mesh.vertices().size(); ++v) {
    ASSERT_LE((a.mesh.vertices()[v] - b.mesh.vertices()[v]).norm(), tolerance);
  }
  EXPECT_EQ(a.vertex_segments, b.vertex_segments);
  for (int c = 0; c < kChainCount; ++c) {
    ASSERT_EQ(a.chains[c].has_value(), b.chains[c].has_value());
    if (!a.chains[c]) continue;
    for (const double share : {0.0, 0.3, 0.7, 1.0}) {
      EXPECT_LE((a.chains[c]->PointAt(share * a.chains[c]->length_m()) -
                 b.chains[c]->PointAt(share * b.chains[c]->length_m()))
                    .norm(),
                tolerance);
    }
  }
}

// The same surface with vertices and faces in another order, faces begun at another corner.
formats::PolygonSoup Shuffled(const formats::PolygonSoup& soup, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::uint32_t> place(soup.positions.size());
  for (std::uint32_t v = 0; v < place.size(); ++v) place[v] = v;
  for (std::size_t v = place.size(); v > 1; --v) {
    std::swap(place[v - 1], place[random.NextBelow(v)]);
  }
  formats::PolygonSoup shuffled = soup;
  for (std::size_t v = 0; v < place.size(); ++v) shuffled.positions[place[v]] = soup.positions[v];
  const std::size_t faces = soup.face_vertices.size() / 3;
  for (std::size_t f = 0; f < faces; ++f) {
    const std::size_t from = 3 * (faces - 1 - f);
    for (std::size_t k = 0; k < 3; ++k) {
      shuffled.face_vertices[3 * f + k] = place[soup.face_vertices[from + (k + f) % 3]];
    }
  }
  return shuffled;
}

TEST(FindBody, TheOrderOfTheFileLeavesNoTrace) {
  mannequin::MannequinOptions options;
  options.faces = 4000;
  options.quads = false;
  const auto soup = mannequin::MakeMannequin(options);
  ASSERT_TRUE(soup.ok());
  const ThreadPool pool(1);
  const auto find = [&](const formats::PolygonSoup& some) {
    const auto prepared = mesh::PrepareMesh(some);
    return *FindBody(prepared->mesh, {}, pool, NullObserver());
  };
  const Body expected = find(*soup);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const formats::PolygonSoup other = Shuffled(*soup, seed);
    const Body body = find(other);
    EXPECT_TRUE(std::equal(body.mesh.vertices().begin(), body.mesh.vertices().end(),
                           expected.mesh.vertices().begin(), expected.mesh.vertices().end()));
    EXPECT_TRUE(std::equal(body.mesh.triangles().begin(), body.mesh.triangles().end(),
                           expected.mesh.triangles().begin(), expected.mesh.triangles().end()));
    EXPECT_EQ(body.vertex_segments, expected.vertex_segments);
    // And the caller's numbers still lead to their places.
    for (std::size_t v = 0; v < other.positions.size(); v += 97) {
      const auto mine = static_cast<std::size_t>(body.mesh.vertex_of_source()[v]);
      EXPECT_LE(
          (body.body_from_caller.Apply(other.positions[v]) - body.mesh.vertices()[mine]).norm(),
          1e-6);
    }
  }
}

struct Motion {
  std::string name;
  geometry::Similarity similarity;
  friend void PrintTo(const Motion& m, std::ostream* os) { *os << m.name; }
};
class MovedBody : public testing::TestWithParam<Motion> {};

TEST_P(MovedBody, IsTheSameBody) {
  CAPFIT_REQUIRE_BODIES();
  for (const char* const file : {"broken/good_5k.obj", "broken/one_arm_up.obj"}) {
    const mesh::BodyMesh mesh = LoadBody(file);
    const auto still = Find(mesh);
    const auto moved = Find(mesh.Transformed(GetParam().similarity));
    ASSERT_TRUE(still.ok() && moved.ok());
    ExpectSameBody(*still, *moved);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Motions, MovedBody,
    testing::Values(Motion{"Turned37", Moved(0.6458, {0, 1, 0}, 1, {0, 0, 0})},
                    Motion{"FacingBack", Moved(3.14159265, {0, 1, 0}, 1, {0, 0, 0})},
                    Motion{"LyingOnBack", Moved(-1.57079633, {1, 0, 0}, 1, {0, 0, 0})},
                    Motion{"Rolled", Moved(1.57079633, {0, 0, 1}, 1, {0, 0, 0})},
                    Motion{"UpsideDown", Moved(3.14159265, {0, 0, 1}, 1, {0, 0, 0})},
                    Motion{"Anyhow", Moved(2.2, {0.3, -0.7, 0.9}, 1, {3, -2, 7})},
                    Motion{"FarAway", Moved(0.0, {0, 1, 0}, 1, {10000, 5000, -20000})},
                    Motion{"Centimetres", Moved(0.0, {0, 1, 0}, 100, {0, 0, 0})},
                    Motion{"InchesAnyhow", Moved(1.1, {1, 2, 3}, 1 / 0.0254, {40, 0, 9})}),
    [](const auto& tested) { return tested.param.name; });

TEST(FindBody, NamesTheUnitThatItAssumed) {
  const mesh::BodyMesh mesh = SmallMannequin();
  const auto metres = Find(mesh);
  const auto inches = Find(mesh.Transformed(Moved(0, {0, 1, 0}, 1 / 0.0254, {0, 0, 0})));
  ASSERT_TRUE(metres.ok() && inches.ok());
  EXPECT_TRUE(metres->warnings.empty());
  ASSERT_EQ(inches->warnings.size(), 1u);
  EXPECT_EQ(inches->warnings[0].code, "UNIT_ASSUMED");
  EXPECT_NE(inches->warnings[0].message.find("inches"), std::string::npos);
  EXPECT_NEAR(inches->body_from_caller.scale, 0.0254, 1e-12);
}

TEST(FindBody, TakesTheUnitAndTheAxisThatItIsTold) {
  const mesh::BodyMesh lying =
      SmallMannequin().Transformed(Moved(1.57079633, {1, 0, 0}, 1 / 0.0254, {0, 0, 0}));  // +Z
  BodyOptions options;
  options.up = UpAxis::kZ;
  options.unit = Unit::kInch;
  const auto body = Find(lying, options);
  ASSERT_TRUE(body.ok()) << body.status();
  EXPECT_TRUE(body->warnings.empty());
  EXPECT_EQ(body->body_from_caller.scale, 0.0254);
  EXPECT_LT(
      (body->body_from_caller.Turn(Eigen::Vector3d::UnitZ()) - Eigen::Vector3d::UnitY()).norm(),
      1e-12);
}

TEST(FindBody, RefusesAUnitInWhichThereIsNoSuchBody) {
  BodyOptions options;
  options.unit = Unit::kCentimetre;
  const absl::Status tiny = Find(SmallMannequin(), options).status();
  EXPECT_EQ(tiny.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(ReasonOf(tiny), ErrorReason::kContradictsBody);
  EXPECT_EQ(FieldOf(tiny), "mesh.unit");
  const double height_m = Find(SmallMannequin())->height_m;
  EXPECT_NE(tiny.message().find(absl::StrFormat("makes the body %.3g m tall; in metres it would "
                                                "be %.3g m",
                                                0.01 * height_m, height_m)),
            absl::string_view::npos)
      << tiny;
  EXPECT_THAT(FactsOf(tiny), testing::Contains(testing::Pair("limit", "[0.25, 3] m")));
  options.unit = Unit::kMetre;
  const mesh::BodyMesh large = SmallMannequin().Transformed(Moved(0, {0, 1, 0}, 100, {0, 0, 0}));
  EXPECT_EQ(FieldOf(Find(large, options).status()), "mesh.unit");
}

TEST(FindBody, WarnsOfAUnitThatIsHardlyMeant) {
  const mesh::BodyMesh inches =
      SmallMannequin().Transformed(Moved(0, {0, 1, 0}, 1 / 0.0254, {0, 0, 0}));
  BodyOptions options;
  options.unit = Unit::kCentimetre;  // 63 cm tall and as slim as an adult
  const auto body = Find(inches, options);
  ASSERT_TRUE(body.ok()) << body.status();
  ASSERT_EQ(body->warnings.size(), 1u);
  EXPECT_EQ(body->warnings[0].code, "UNIT_CONTRADICTS_BODY");
  EXPECT_NE(body->warnings[0].message.find("in inches it would be"), std::string::npos);
  EXPECT_EQ(body->body_from_caller.scale, 0.01);
}

// A told axis across the body gives the same as none, with a warning that names both.
TEST(FindBody, FitsAsTheBodyStandsWhereTheToldAxisLiesAcrossIt) {
  CAPFIT_REQUIRE_BODIES();
  for (const char* const name : {"female_average_rest.obj", "male_muscular_tpose.obj",
                                 "female_average_sides.obj", "male_heavy_rest.obj"}) {
    const mesh::BodyMesh mesh = LoadBody(name);  // stands along +Y
    const auto untold = Find(mesh);
    ASSERT_TRUE(untold.ok()) << untold.status();
    for (const UpAxis axis : {UpAxis::kX, UpAxis::kZ}) {
      BodyOptions options;
      options.up = axis;
      const auto told = Find(mesh, options);
      ASSERT_TRUE(told.ok()) << told.status();
      const Warning& warning = told->warnings.front();
      EXPECT_EQ(warning.code, "UP_AXIS_CONTRADICTS_BODY") << name;
      EXPECT_NE(warning.message.find(axis == UpAxis::kX ? "to be x," : "to be z,"),
                std::string::npos);
      EXPECT_NE(warning.message.find("stands along y"), std::string::npos);
      EXPECT_EQ(told->body_from_caller.rotation, untold->body_from_caller.rotation);
      EXPECT_EQ(told->height_m, untold->height_m);
      for (int i = 0; i < kLandmarkCount; ++i) {
        const LandmarkId id = static_cast<LandmarkId>(i);
        EXPECT_EQ(told->landmark(id)->position_m, untold->landmark(id)->position_m);
      }
    }
    BodyOptions options;
    options.up = UpAxis::kY;
    const auto right = Find(mesh, options);
    ASSERT_TRUE(right.ok()) << right.status();
    EXPECT_EQ(right->warnings.size(), untold->warnings.size());
    for (int i = 0; i < kLandmarkCount; ++i) {
      const LandmarkId id = static_cast<LandmarkId>(i);
      EXPECT_LT((right->landmark(id)->position_m - untold->landmark(id)->position_m).norm(), 0.03)
          << name << " " << LandmarkName(id);
    }
  }
}

// A body that leans against its told axis is found as well as without.
TEST(FindBody, LeaningBodiesAreFoundWithTheirToldAxis) {
  for (const double degrees : {-40.0, -13.0, 13.0, 40.0, 50.0}) {
    for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 1)}) {
      const mesh::BodyMesh mesh =
          SmallMannequin().Transformed(Moved(degrees * 0.0174532925, axis, 1, {0, 0, 0}));
      const auto untold = Find(mesh);
      BodyOptions options;
      options.up = UpAxis::kY;
      const auto told = Find(mesh, options);
      ASSERT_TRUE(untold.ok() && told.ok()) << told.status();
      const auto place = [](const Body& body, LandmarkId id) {
        return Eigen::Vector3d(
            body.body_from_caller.Inverse().Apply(body.landmark(id)->position_m));
      };
      for (int i = 0; i < kLandmarkCount; ++i) {
        const LandmarkId id = static_cast<LandmarkId>(i);
        ASSERT_TRUE(told->landmark(id)) << LandmarkName(id) << " " << degrees;
        EXPECT_LT((place(*told, id) - place(*untold, id)).norm(), 0.05)
            << LandmarkName(id) << " " << degrees << " about " << axis.transpose();
      }
    }
  }
}

TEST(FindBody, RefusesAnUpAxisThatIsUpsideDown) {
  BodyOptions options;
  options.up = UpAxis::kY;
  const mesh::BodyMesh turned = SmallMannequin().Transformed(Moved(3.0, {0, 0, 1}, 1, {0, 0, 0}));
  const absl::Status status = Find(turned, options).status();
  EXPECT_EQ(ReasonOf(status), ErrorReason::kContradictsBody);
  EXPECT_EQ(FieldOf(status), "mesh.up_axis");
  EXPECT_THAT(FactsOf(status),
              testing::ElementsAre(testing::Pair("value", "y"), testing::Pair("limit", "-y")));
}

TEST(FindBody, MirroredMeshesGiveMirroredBodies) {
  CAPFIT_REQUIRE_BODIES();
  const mesh::BodyMesh mesh = LoadBody("broken/one_arm_up.obj");
  std::vector<Eigen::Vector3d> points(mesh.vertices().begin(), mesh.vertices().end());
  std::vector<mesh::Triangle> triangles(mesh.triangles().begin(), mesh.triangles().end());
  for (Eigen::Vector3d& p : points) p.x() = -p.x();
  for (mesh::Triangle& t : triangles) std::swap(t[1], t[2]);
  const auto body = Find(mesh);
  const auto mirrored = Find(mesh::BodyMesh(points, triangles, {}));
  ASSERT_TRUE(body.ok() && mirrored.ok());
  for (int i = 0; i < kLandmarkCount; ++i) {
    const LandmarkId id = static_cast<LandmarkId>(i);
    const Eigen::Vector3d here = body->landmark(id)->position_m;
    const Eigen::Vector3d there = mirrored->landmark(MirrorLandmark(id))->position_m;
    EXPECT_LE((here - Eigen::Vector3d(-there.x(), there.y(), there.z())).norm(), 2e-6)
        << LandmarkName(id);
  }
}

TEST(FindBody, DoesNotDependOnTheOrderOfVerticesAndFaces) {
  CAPFIT_REQUIRE_BODIES();
  const mesh::BodyMesh mesh = LoadBody("broken/good_5k.obj");
  const std::uint32_t count = static_cast<std::uint32_t>(mesh.vertices().size());
  const auto renamed = [&](std::uint32_t v) { return (v * 7u + 11u) % count; };  // 7: coprime
  ASSERT_NE(count % 7, 0u);
  std::vector<Eigen::Vector3d> points(count);
  for (std::uint32_t v = 0; v < count; ++v) points[renamed(v)] = mesh.vertices()[v];
  std::vector<mesh::Triangle> triangles;
  for (const mesh::Triangle& t : mesh.triangles()) {
    triangles.push_back({renamed(t[1]), renamed(t[2]), renamed(t[0])});
  }
  std::reverse(triangles.begin(), triangles.end());
  const auto body = Find(mesh);
  const auto shuffled = Find(mesh::BodyMesh(points, triangles, {}));
  ASSERT_TRUE(body.ok() && shuffled.ok());
  for (int i = 0; i < kLandmarkCount; ++i) {
    EXPECT_LE((body->landmarks[i]->position_m - shuffled->landmarks[i]->position_m).norm(), 1e-6);
  }
}

TEST(FindBody, SymmetricBodiesMirrorExactly) {
  const auto body = Find(SmallMannequin());
  ASSERT_TRUE(body.ok()) << body.status();
  ASSERT_TRUE(body->is_symmetric);
  for (int i = 0; i < kLandmarkCount; ++i) {
    const LandmarkId id = static_cast<LandmarkId>(i);
    ASSERT_TRUE(body->landmark(id)) << LandmarkName(id);
    const Eigen::Vector3d here = body->landmark(id)->position_m;
    const Eigen::Vector3d there = body->landmark(MirrorLandmark(id))->position_m;
    EXPECT_EQ(here, Eigen::Vector3d(-there.x(), there.y(), there.z())) << LandmarkName(id);
  }
  for (const Part part : {Part::kTorso, Part::kLeftArm, Part::kLeftLeg}) {
    const auto& left = body->chain(part)->points_m;
    const auto& right = body->chain(MirrorPart(part))->points_m;
    ASSERT_EQ(left.size(), right.size());
    for (std::size_t i = 0; i < left.size(); ++i) {
      EXPECT_EQ(left[i], Eigen::Vector3d(-right[i].x(), right[i].y(), right[i].z()));
    }
  }
}

TEST(FindBody, AsymmetricPosesAreNotSymmetric) {
  CAPFIT_REQUIRE_BODIES();
  EXPECT_FALSE(Find(LoadBody("broken/one_arm_up.obj"))->is_symmetric);
}

TEST(FindBody, CallersLandmarksReplaceAndSteer) {
  const mesh::BodyMesh mesh = SmallMannequin();
  const auto found = Find(mesh);
  ASSERT_TRUE(found.ok());
  BodyOptions options;
  const Eigen::Vector3d wrist = found->body_from_caller.Inverse().Apply(
      0.7 * found->landmark(LandmarkId::kLeftWrist)->position_m +
      0.3 * found->landmark(LandmarkId::kLeftElbow)->position_m);
  options.landmarks[LandmarkId::kLeftWrist] = wrist;
  const auto body = Find(mesh, options);
  ASSERT_TRUE(body.ok()) << body.status();
  const auto& landmark = body->landmark(LandmarkId::kLeftWrist);
  EXPECT_EQ(landmark->method, LandmarkMethod::kCaller);
  EXPECT_LT((body->body_from_caller.Inverse().Apply(landmark->position_m) - wrist).norm(), 1e-9);
  // The curve ends there, and the hand has grown.
  EXPECT_LT((body->chain(Part::kLeftArm)->points_m.back() - landmark->position_m).norm(), 1e-9);
  const auto count = [](const Body& b, Segment s) {
    return std::count(b.vertex_segments.begin(), b.vertex_segments.end(), s);
  };
  EXPECT_GT(count(*body, Segment::kLeftHand), count(*found, Segment::kLeftHand));
  EXPECT_EQ(count(*body, Segment::kRightHand), count(*found, Segment::kRightHand));
}

struct Refusal {
  std::string file;
  ErrorReason reason;
  std::string evidence;
  friend void PrintTo(const Refusal& r, std::ostream* os) { *os << r.file; }
};
class Refused : public testing::TestWithParam<Refusal> {};

TEST_P(Refused, WithReasonAndEvidence) {
  CAPFIT_REQUIRE_BODIES();
  const auto body = Find(LoadBody("broken/" + GetParam().file + ".obj"));
  ASSERT_FALSE(body.ok());
  EXPECT_EQ(body.status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(ReasonOf(body.status()), GetParam().reason);
  EXPECT_NE(body.status().ToString().find(GetParam().evidence), std::string::npos) << body.status();
}

INSTANTIATE_TEST_SUITE_P(
    NoBody, Refused,
    testing::Values(Refusal{"cube", ErrorReason::kNotABody, "found 0 of 5 extremities"},
                    Refusal{"sphere", ErrorReason::kNotABody, "found 0 of 5 extremities"},
                    Refusal{"torus", ErrorReason::kNotABody, "found 0 of 5 extremities"}),
    [](const auto& tested) { return tested.param.file; });

struct Acceptance {
  std::string file;
  std::vector<std::string> missing;  // as the warnings begin
  friend void PrintTo(const Acceptance& a, std::ostream* os) { *os << a.file; }
};
class Accepted : public testing::TestWithParam<Acceptance> {};

TEST_P(Accepted, WithAWarningForEachPartThatIsMissing) {
  CAPFIT_REQUIRE_BODIES();
  const auto body = Find(LoadBody("broken/" + GetParam().file + ".obj"));
  ASSERT_TRUE(body.ok()) << body.status();
  std::vector<std::string> missing;
  for (const Warning& w : body->warnings) {
    if (w.code == "PART_MISSING") missing.push_back(w.message.substr(0, w.message.find(" was")));
  }
  for (std::string& m : missing) m = m.substr(0, m.find(" is missing"));
  EXPECT_EQ(missing, GetParam().missing);
  const auto is_missing = [&](const char* part) {
    return std::find(missing.begin(), missing.end(), part) != missing.end();
  };
  EXPECT_EQ(body->chain(Part::kLeftArm).has_value(), !is_missing("the left arm"));
  EXPECT_EQ(body->chain(Part::kRightArm).has_value(), !is_missing("the right arm"));
  EXPECT_EQ(body->chain(Part::kLeftLeg).has_value(), !is_missing("the left leg"));
  EXPECT_TRUE(body->chain(Part::kTorso));
}

INSTANTIATE_TEST_SUITE_P(
    Awkward, Accepted,
    testing::Values(Acceptance{"no_left_arm", {"the left arm"}},
                    Acceptance{"arms_fused_to_torso", {"the left arm", "the right arm"}},
                    Acceptance{"arms_through_torso", {}}, Acceptance{"one_arm_up", {}},
                    Acceptance{"anisotropic", {"the left foot", "the right foot"}},
                    Acceptance{"mixed_polygons", {}},
                    Acceptance{"upper_half", {"the left leg", "the right leg"}},
                    Acceptance{"upper_half_open", {"the left leg", "the right leg"}},
                    Acceptance{"open_neck_wrists_ankles",
                               {"the head", "the left hand", "the left foot", "the right hand",
                                "the right foot"}}),
    [](const auto& tested) { return tested.param.file; });

TEST(FindBody, AnUpperBodyIsMeasuredAsAPieceOfAWholeOne) {
  CAPFIT_REQUIRE_BODIES();
  const auto whole = Find(LoadBody("broken/good_5k.obj"));
  const auto half = Find(LoadBody("broken/upper_half.obj"));
  ASSERT_TRUE(whole.ok() && half.ok()) << half.status();
  EXPECT_EQ(half->body_from_caller.scale, 1.0);
  EXPECT_FALSE(half->landmark(LandmarkId::kCrotch));
  EXPECT_FALSE(half->landmark(LandmarkId::kLeftKnee));
  for (const LandmarkId id : {LandmarkId::kNeck, LandmarkId::kHeadTop, LandmarkId::kLeftShoulder,
                              LandmarkId::kRightElbow, LandmarkId::kLeftWrist}) {
    ASSERT_TRUE(half->landmark(id)) << LandmarkName(id);
    const auto at = [&](const Body& b) {
      return b.body_from_caller.Inverse().Apply(b.landmark(id)->position_m);
    };
    EXPECT_LE((at(*half) - at(*whole)).norm(), 0.03) << LandmarkName(id);
  }
}

TEST(FindBody, RefusesBodiesWithoutTheRequiredParts) {
  CAPFIT_REQUIRE_BODIES();
  BodyOptions options;
  options.required.torso = true;
  options.required.arms = true;
  EXPECT_TRUE(Find(LoadBody("broken/good_5k.obj"), options).ok());
  const auto one_armed = Find(LoadBody("broken/no_left_arm.obj"), options);
  EXPECT_EQ(ReasonOf(one_armed.status()), ErrorReason::kPartMissing);
  EXPECT_NE(one_armed.status().ToString().find("left_arm"), std::string::npos);
  EXPECT_EQ(one_armed.status().ToString().find("right_arm"), std::string::npos);
  const mesh::BodyMesh cut = LoadBody("female_average_rest_no_hands_feet_head.obj");
  EXPECT_TRUE(Find(cut, options).ok());
  options.required.head = options.required.hands = options.required.feet = true;
  const auto refused = Find(cut, options);
  for (const char* const part : {"head", "left_hand", "right_hand", "left_foot", "right_foot"}) {
    EXPECT_NE(refused.status().ToString().find(part), std::string::npos) << part;
  }
}

TEST(FindBody, RefusesLandmarksThatAreNonsense) {
  const mesh::BodyMesh mesh = SmallMannequin();
  const auto found = Find(mesh);
  ASSERT_TRUE(found.ok());
  const auto at = [&](LandmarkId id) {
    return found->body_from_caller.Inverse().Apply(found->landmark(id)->position_m);
  };
  BodyOptions options;
  options.landmarks[LandmarkId::kLeftKnee] = 100.0 * at(LandmarkId::kLeftKnee);  // centimetres
  const auto far_off = Find(mesh, options);
  EXPECT_EQ(far_off.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(far_off.status().ToString().find("landmarks.left_knee"), std::string::npos);
  EXPECT_NE(far_off.status().ToString().find("outside the body"), std::string::npos);
  options.landmarks[LandmarkId::kLeftKnee] = at(LandmarkId::kNeck);
  const auto at_the_neck = Find(mesh, options);
  EXPECT_EQ(at_the_neck.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(at_the_neck.status().ToString().find("from where the body shows it"),
            std::string::npos);
}

// Every landmark alone, then all of them: what is told comes back as it was, the rest stays near.
TEST(FindBody, TakesAnySubsetOfLandmarks) {
  const mesh::BodyMesh mesh = SmallMannequin();
  const auto found = Find(mesh);
  ASSERT_TRUE(found.ok());
  BodyOptions all;
  for (int i = 0; i < kLandmarkCount; ++i) {
    const LandmarkId id = static_cast<LandmarkId>(i);
    const Eigen::Vector3d at =
        found->body_from_caller.Inverse().Apply(found->landmarks[i]->position_m);
    BodyOptions one;
    one.landmarks[id] = at + Eigen::Vector3d(0.004, -0.006, 0.005);
    all.landmarks[id] = one.landmarks[id];
    const auto body = Find(mesh, one);
    ASSERT_TRUE(body.ok()) << LandmarkName(id) << body.status();
    for (int k = 0; k < kLandmarkCount; ++k) {
      EXPECT_LE((body->landmarks[k]->position_m - found->landmarks[k]->position_m).norm(), 0.04)
          << LandmarkName(id) << " moves " << LandmarkName(static_cast<LandmarkId>(k));
    }
  }
  const auto body = Find(mesh, all);
  ASSERT_TRUE(body.ok()) << body.status();
  for (const auto& landmark : body->landmarks) {
    EXPECT_EQ(landmark->method, LandmarkMethod::kCaller);
  }
}

// The way along the inside of the arm: shoulder, elbow and wrist follow each other; so do the legs.
TEST(FindBody, MannequinsByLotHaveAllTheirLandmarksInOrder) {
  mannequin::RandomMannequinLimits limits;
  limits.max_faces = 5000;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE(seed);
    const mannequin::MannequinOptions options = mannequin::RandomMannequin(seed, limits);
    const auto body = Find(Mannequin(options));
    ASSERT_TRUE(body.ok()) << body.status();
    EXPECT_TRUE(body->is_symmetric);
    EXPECT_EQ(body->landmark(LandmarkId::kHeadTop).has_value(), options.with_head);
    EXPECT_EQ(body->landmark(LandmarkId::kLeftFingertip).has_value(), options.with_hands);
    EXPECT_EQ(body->landmark(LandmarkId::kLeftToe).has_value(), options.with_feet);
    // Made upright and facing +Z, so the way to the body frame hardly turns.
    EXPECT_GT(body->body_from_caller.rotation.trace(), 3.0 - 0.01);
    const auto y = [&](LandmarkId id) { return body->landmark(id)->position_m.y(); };
    EXPECT_LT(y(LandmarkId::kLeftAnkle), y(LandmarkId::kLeftKnee));
    EXPECT_LT(y(LandmarkId::kLeftKnee), y(LandmarkId::kCrotch));
    EXPECT_LT(y(LandmarkId::kCrotch), y(LandmarkId::kLeftHip));
    EXPECT_LT(y(LandmarkId::kHip), y(LandmarkId::kWaist));
    EXPECT_LT(y(LandmarkId::kWaist), y(LandmarkId::kBust));
    EXPECT_LT(y(LandmarkId::kBust), y(LandmarkId::kLeftShoulder));
    EXPECT_LT(y(LandmarkId::kLeftShoulder), y(LandmarkId::kNeck));
    for (const auto& chain : body->chains) EXPECT_TRUE(chain.has_value());
  }
}

}  // namespace
}  // namespace capfit::body
