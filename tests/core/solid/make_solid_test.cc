#include "core/solid/make_solid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/formats/read_mesh.h"
#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"
#include "tests/core/mesh/soups.h"
#include "tests/core/metrics/shapes.h"
#include "tests/core/solid/solid_shapes.h"
#include "tests/support/bodies.h"

namespace capfit::solid {
namespace {

using mesh::Ball;
using mesh::Box;
using testing::HasSubstr;
using testing::StartsWith;

constexpr double kPi = std::numbers::pi;

double BallVolume(double radius) { return 4.0 / 3.0 * kPi * radius * radius * radius; }

TEST(MakeSolidTest, BallStaysABall) {
  const Solid solid = Made(TrianglesOf(Ball(120, 60)));
  EXPECT_EQ(WarningCodes(solid), "");
  EXPECT_EQ(GenusOf(solid.mesh), 0);
  EXPECT_NEAR(solid.mesh.volume(), BallVolume(1.0), 0.005 * BallVolume(1.0));
  for (const Eigen::Vector3d& v : solid.mesh.vertices()) {
    EXPECT_NEAR(v.norm(), 1.0, 0.25 * solid.cell) << v.transpose();
  }
}

TEST(MakeSolidTest, OverlappingBallsAreTheirUnion) {
  const Triangles both =
      Both(TrianglesOf(Ball(120, 60)), TrianglesOf(mesh::Moved(Ball(120, 60), {1.2, 0.0, 0.0})));
  const Solid solid = Made(both);
  const double lens = kPi * (4.0 + 1.2) * (2.0 - 1.2) * (2.0 - 1.2) / 12.0;
  const double expected = 2.0 * BallVolume(1.0) - lens;
  EXPECT_NEAR(solid.mesh.volume(), expected, 0.005 * expected);
  EXPECT_EQ(GenusOf(solid.mesh), 0);
}

// Turned, doubled, taken apart: the volume is that of the plain ball.
TEST(MakeSolidTest, WaysToSpoilAShellChangeNothing) {
  const formats::PolygonSoup ball = Ball(60, 30);
  const double expected = Made(TrianglesOf(ball)).mesh.volume();
  Triangles inside_out = TrianglesOf(ball);
  for (mesh::Triangle& t : inside_out.triangles) std::swap(t[1], t[2]);
  const std::vector<Triangles> spoilt = {
      inside_out,
      TrianglesOf(mesh::RandomlyTurned(ball, 0.5, 1)),
      TrianglesOf(mesh::SplitApart(ball)),
      TrianglesOf(mesh::SplitApart(mesh::RandomlyTurned(ball, 0.5, 2))),
      Both(TrianglesOf(ball), TrianglesOf(ball)),
      Both(TrianglesOf(ball), inside_out),
      Both(TrianglesOf(ball), TrianglesOf(Ball(40, 20, 0.5))),
  };
  for (std::size_t i = 0; i < spoilt.size(); ++i) {
    EXPECT_NEAR(Made(spoilt[i]).mesh.volume(), expected, 0.002 * expected) << i;
  }
}

// A body deleted under its clothes: open tubes that overlap, or leave a gap, like trousers and top.
TEST(MakeSolidTest, OpenShellsTogetherSurroundABody) {
  const double expected = kPi * 0.15 * 0.15 * 1.0;
  for (const double gap : {-0.05, -0.01, 0.0, 0.004, 0.015}) {
    const Triangles clothes =
        Both(Tube(0.15, 0.0, 0.5 - gap / 2.0, 96, 40), Tube(0.15, 0.5 + gap / 2.0, 1.0, 96, 40));
    const Solid solid = Made(clothes, {20'000});
    EXPECT_NEAR(solid.mesh.volume(), expected, 0.01 * expected) << gap;
    EXPECT_EQ(GenusOf(solid.mesh), 0) << gap;
  }
}

// A cloth of two layers without anything inside, between the ends of two thick parts.
TEST(MakeSolidTest, LiningOverADeletedBodyIsFilled) {
  Triangles coat = Tube(0.15, 0.0, 0.6, 96, 60);
  Triangles lining = Tube(0.147, 0.0, 0.6, 96, 60);
  for (mesh::Triangle& t : lining.triangles) std::swap(t[1], t[2]);
  const auto outer = static_cast<std::uint32_t>(coat.positions.size());
  coat = Both(std::move(coat), lining);
  for (const std::uint32_t ring : {0u, 60u}) {  // hems
    for (std::uint32_t k = 0; k < 96; ++k) {
      const std::uint32_t a = ring * 96 + k;
      const std::uint32_t b = ring * 96 + (k + 1) % 96;
      coat.triangles.push_back({a, b, b + outer});
      coat.triangles.push_back({a, b + outer, a + outer});
    }
  }
  const Triangles with_ends =
      Both(Both(coat, Tube(0.14, 0.55, 0.8, 96, 20)), Tube(0.14, -0.2, 0.05, 96, 20));
  const double expected = kPi * (0.15 * 0.15 * 0.6 + 0.14 * 0.14 * 0.4);
  EXPECT_NEAR(Made(with_ends).mesh.volume(), expected, 0.02 * expected);
}

TEST(MakeSolidTest, PlateOverSkinIsOneWithIt) {
  const Triangles armour = Both(TrianglesOf(Box({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2})),
                                TrianglesOf(Box({-0.15, -0.15, 0.208}, {0.15, 0.15, 0.212})));
  const Solid solid = Made(armour, {20'000});
  const double expected = 0.4 * 0.4 * 0.4 + 0.3 * 0.3 * 0.012;
  EXPECT_NEAR(solid.mesh.volume(), expected, 0.005 * expected);
  EXPECT_EQ(GenusOf(solid.mesh), 0);
}

TEST(MakeSolidTest, CavitiesAreInside) {
  Triangles hollow = TrianglesOf(Ball(80, 40));
  Triangles inner = TrianglesOf(Ball(80, 40, 0.9));
  for (mesh::Triangle& t : inner.triangles) std::swap(t[1], t[2]);
  const Solid solid = Made(Both(hollow, inner));
  EXPECT_NEAR(solid.mesh.volume(), BallVolume(1.0), 0.01 * BallVolume(1.0));
}

// Two legs under one bar: the space between them stays outside down to a cell or so.
TEST(MakeSolidTest, LimbsStayApart) {
  for (const double gap : {0.1, 0.02, 0.012}) {
    const Triangles legs = Both(Both(TrianglesOf(Box({-0.2, 0.0, -0.1}, {-gap / 2, 0.8, 0.1})),
                                     TrianglesOf(Box({gap / 2, 0.0, -0.1}, {0.2, 0.8, 0.1}))),
                                TrianglesOf(Box({-0.2, 0.75, -0.1}, {0.2, 1.0, 0.1})));
    const Solid solid = Made(legs);
    ASSERT_LT(solid.cell, 0.006);
    EXPECT_NEAR(test_shapes::WindingNumber(solid.mesh, {0.0, 0.4, 0.0}), 0.0, 1e-6) << gap;
    EXPECT_NEAR(test_shapes::WindingNumber(solid.mesh, {0.1, 0.4, 0.0}), 1.0, 1e-6) << gap;
    EXPECT_EQ(GenusOf(solid.mesh), 0) << gap;
  }
}

// Thinner than a cell: a hand's finger, a fin.
TEST(MakeSolidTest, ThinPartsHaveNoHoles) {
  const double thin = 0.002;
  const Triangles fin = Both(TrianglesOf(Box({-0.2, 0.0, -0.2}, {0.2, 0.4, 0.2})),
                             TrianglesOf(Box({-0.1, 0.35, -thin / 2}, {0.1, 0.6, thin / 2})));
  const Solid solid = Made(fin, {20'000});
  EXPECT_GT(solid.cell, 2.0 * thin);
  EXPECT_EQ(GenusOf(solid.mesh), 0);
  EXPECT_NEAR(solid.mesh.box_max().y(), 0.6, solid.cell);
}

TEST(MakeSolidTest, BridgesNarrowGapsAndTellsOfFarPieces) {
  const formats::PolygonSoup ball = Ball(80, 40);
  const auto apart = [&](double gap, double radius) {
    return Both(TrianglesOf(ball),
                TrianglesOf(mesh::Moved(Ball(80, 40, radius), {1.0 + gap + radius, 0.0, 0.0})));
  };
  const Solid near = Made(apart(0.05, 1.0));
  EXPECT_EQ(WarningCodes(near), "GAPS_BRIDGED");
  EXPECT_NEAR(near.mesh.volume(), 2.0 * BallVolume(1.0), 0.02 * BallVolume(1.0));
  EXPECT_EQ(GenusOf(near.mesh), 0);
  const Solid small = Made(apart(0.5, 0.4));
  EXPECT_EQ(WarningCodes(small), "PARTS_LEFT_OUT");
  EXPECT_NEAR(small.mesh.volume(), BallVolume(1.0), 0.01 * BallVolume(1.0));
  EXPECT_THAT(RefusalOfSolid(apart(0.5, 1.0)), StartsWith("TWO_BODIES"));
}

TEST(MakeSolidTest, RefusesWhatEnclosesNothing) {
  EXPECT_THAT(RefusalOfSolid({}), StartsWith("NO_SURFACE"));
  EXPECT_THAT(RefusalOfSolid({{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}}}), StartsWith("NO_SURFACE"));
  EXPECT_THAT(RefusalOfSolid({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}),
              StartsWith("NO_VOLUME"));
  EXPECT_THAT(RefusalOfSolid(Sheet(1.0, 0.0, 20)), StartsWith("NO_VOLUME"));
  EXPECT_THAT(RefusalOfSolid(Both(Sheet(1.0, 0.0, 20), Sheet(1.0, 0.0, 20))),
              StartsWith("NO_VOLUME"));
}

// Coordinates that would ask for an endless grid: an answer, soon.
TEST(MakeSolidTest, AnswersHostileInput) {
  Random random(7);
  Triangles far = TrianglesOf(Ball(40, 20));
  far = Both(far, {{{1e9, 0, 0}, {1e9, 1, 0}, {1e9, 0, 1}}, {{0, 1, 2}}});
  (void)RefusalOfSolid(far);
  Triangles huge = TrianglesOf(Ball(40, 20));
  huge = Both(huge, {{{-1e6, 0, 0}, {1e6, 1e-3, 0}, {0, 1e6, 1e6}}, {{0, 1, 2}}});
  (void)RefusalOfSolid(huge);
  Triangles slivers;
  for (std::uint32_t i = 0; i < 100'000; ++i) {
    const Eigen::Vector3d a(random.NextUnit(), random.NextUnit(), random.NextUnit());
    const Eigen::Vector3d b(random.NextUnit(), random.NextUnit(), random.NextUnit());
    slivers.positions.insert(slivers.positions.end(), {a, b, b + Eigen::Vector3d(1e-9, 0, 0)});
    slivers.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  (void)RefusalOfSolid(slivers);
  for (const Triangles& shells : {far, huge, slivers}) {
    const absl::StatusOr<Solid> solid = MakeSolid(shells.positions, shells.triangles);
    if (solid.ok()) (void)Made(shells);
  }
}

TEST(MakeSolidTest, KeepsUnitAndPlaceOfTheCaller) {
  const formats::PolygonSoup ball = Ball(60, 30);
  const double expected = Made(TrianglesOf(ball)).mesh.volume();
  Triangles far = TrianglesOf(ball);
  for (Eigen::Vector3d& p : far.positions) p = 1000.0 * p + Eigen::Vector3d(5e4, -3e4, 1e4);
  const Solid solid = Made(far);
  EXPECT_NEAR(solid.mesh.volume(), 1e9 * expected, 1e9 * 1e-3 * expected);
  EXPECT_NEAR(solid.mesh.box_min().x(), 4.9e4, 10.0);
}

TEST(MakeSolidTest, SameBitsForAnyNumberOfThreads) {
  const Triangles shells = Both(TrianglesOf(*mannequin::MakeMannequin({})),
                                TrianglesOf(mesh::Moved(Ball(50, 30, 0.2), {0.0, 1.2, 0.1})));
  const Solid one = Made(shells);
  for (const int threads : {2, 7}) {
    const absl::StatusOr<Solid> many =
        MakeSolid(shells.positions, shells.triangles, {}, ThreadPool(threads));
    ASSERT_TRUE(many.ok()) << many.status();
    EXPECT_TRUE(std::ranges::equal(many->mesh.vertices(), one.mesh.vertices()));
    EXPECT_TRUE(std::ranges::equal(many->mesh.triangles(), one.mesh.triangles()));
  }
}

TEST(MakeSolidTest, RealBodiesKeepTheirVolume) {
  CAPFIT_REQUIRE_BODIES();
  for (const char* const name : {"female_average_apose", "male_muscular_tpose", "child_rest"}) {
    const std::string bytes =
        test_support::ReadFile(test_support::BodiesFolder() / (std::string(name) + ".obj"));
    const auto soup = formats::ReadMesh(std::as_bytes(std::span(bytes)));
    ASSERT_TRUE(soup.ok()) << soup.status();
    const auto prepared = mesh::PrepareMesh(*soup);
    ASSERT_TRUE(prepared.ok()) << prepared.status();
    const Solid solid = Made(TrianglesOf(*soup));
    // The mouth, which the bodies have as a bag, is filled.
    EXPECT_NEAR(solid.mesh.volume() / prepared->mesh.volume(), 1.0, 0.005) << name;
  }
}

}  // namespace
}  // namespace capfit::solid
