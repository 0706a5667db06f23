#include "core/mesh/prepare_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/random.h"
#include "core/base/status.h"
#include "tests/core/mesh/soups.h"
#include "tests/fuzz/mesh_promises.h"
#include "tests/support/told.h"

namespace capfit::mesh {
namespace {

using testing::Each;
using testing::HasSubstr;

// The prepared mesh; the test fails where there is none or it breaks a promise.
PreparedMesh Prepared(const formats::PolygonSoup& soup) {
  absl::StatusOr<PreparedMesh> prepared = PrepareMesh(soup);
  EXPECT_TRUE(prepared.ok()) << prepared.status();
  if (!prepared.ok()) return PreparedMesh{BodyMesh({}, {}, {}), {}};
  EXPECT_EQ(fuzz::BrokenPromiseOfPrepare(*prepared, soup.positions.size()), "");
  return *std::move(prepared);
}

// "REASON message" of a refusal.
std::string RefusalOf(const formats::PolygonSoup& soup) {
  const absl::StatusOr<PreparedMesh> prepared = PrepareMesh(soup);
  if (prepared.ok()) return "accepted with " + CodesOf(*prepared);
  return Told(prepared.status());
}

TEST(PrepareMeshTest, PassesSoundMeshThroughUnchanged) {
  const formats::PolygonSoup ball = Ball(12, 7);
  const PreparedMesh prepared = Prepared(ball);
  EXPECT_EQ(CodesOf(prepared), "");
  EXPECT_TRUE(fuzz::IsReordered(ball, prepared.mesh));
  EXPECT_FALSE(prepared.mesh.first_triangle().empty());
}

TEST(PrepareMeshTest, SameBitsForAnyNumberOfThreads) {
  const formats::PolygonSoup sound = Ball(120, 90);
  formats::PolygonSoup broken = sound;
  broken.face_vertices.resize(broken.face_vertices.size() - 300);
  for (const formats::PolygonSoup& soup : {sound, broken}) {
    const PreparedMesh one = Prepared(soup);
    for (const int threads : {2, 3}) {
      const auto other = PrepareMesh(soup, {}, ThreadPool(threads));
      ASSERT_TRUE(other.ok()) << other.status();
      EXPECT_TRUE(std::ranges::equal(one.mesh.vertices(), other->mesh.vertices()));
      EXPECT_TRUE(std::ranges::equal(one.mesh.triangles(), other->mesh.triangles()));
      EXPECT_TRUE(std::ranges::equal(one.mesh.mates(), other->mesh.mates()));
      EXPECT_EQ(one.mesh.volume(), other->mesh.volume());
      EXPECT_EQ(one.mesh.area(), other->mesh.area());
      EXPECT_EQ(CodesOf(one), CodesOf(*other));
    }
  }
}

// Such faces leave as many triangles as a closed surface may have.
TEST(PrepareMeshTest, DropsDegenerateFacesOfASoupOfTriangles) {
  formats::PolygonSoup soup = Ball(12, 7);
  for (const std::uint32_t v : {5u, 5u, 9u, 3u, 8u, 8u, 4u, 7u, 4u, 6u, 6u, 6u}) {
    soup.face_vertices.push_back(v);
  }
  const PreparedMesh prepared = Prepared(soup);
  EXPECT_EQ(CodesOf(prepared), "DEGENERATE_FACES");
  EXPECT_EQ(CountOf(prepared, "DEGENERATE_FACES"), 4);
}

// Which two corners of a quad of the cube are joined.
bool HasEdge(const PreparedMesh& prepared, std::size_t a, std::size_t b) {
  const auto from = static_cast<std::uint32_t>(prepared.mesh.vertex_of_source()[a]);
  const auto to = static_cast<std::uint32_t>(prepared.mesh.vertex_of_source()[b]);
  return std::any_of(
      prepared.mesh.triangles().begin(), prepared.mesh.triangles().end(), [&](const Triangle& t) {
        return std::count(t.begin(), t.end(), from) == 1 && std::count(t.begin(), t.end(), to) == 1;
      });
}

TEST(PrepareMeshTest, CutsQuadsFromTheirFirstCorner) {
  const formats::PolygonSoup cube = Cube();
  const PreparedMesh prepared = Prepared(cube);
  EXPECT_EQ(CodesOf(prepared), "");
  for (std::size_t first = 0; first < cube.face_vertices.size(); first += 4) {
    EXPECT_TRUE(HasEdge(prepared, cube.face_vertices[first], cube.face_vertices[first + 2]));
    EXPECT_FALSE(HasEdge(prepared, cube.face_vertices[first + 1], cube.face_vertices[first + 3]));
  }
  EXPECT_DOUBLE_EQ(prepared.mesh.volume(), 1.0);
  EXPECT_DOUBLE_EQ(prepared.mesh.area(), 6.0);
}

// A prism over an arrow head of four corners: the diagonal between its barbs would lie outside.
TEST(PrepareMeshTest, CutsQuadsWithAnInwardCornerFromThere) {
  const std::array<Eigen::Vector2d, 4> arrow = {{{-2, -2}, {0, -1}, {2, -2}, {0, 2}}};
  for (std::uint32_t turn = 0; turn < 4; ++turn) {
    formats::PolygonSoup prism;
    for (const double z : {0.0, 1.0}) {
      for (const Eigen::Vector2d& p : arrow) prism.positions.emplace_back(p.x(), p.y(), z);
    }
    const auto at = [&](std::uint32_t k) { return (k + turn) % 4; };
    prism.face_vertices = {at(3), at(2), at(1), at(0), 4 + at(0), 4 + at(1), 4 + at(2), 4 + at(3)};
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t next = (k + 1) % 4;
      prism.face_vertices.insert(prism.face_vertices.end(), {k, next, 4 + next, 4 + k});
    }
    prism.face_sizes.assign(6, 4);
    const PreparedMesh prepared = Prepared(prism);
    EXPECT_EQ(CodesOf(prepared), "");
    EXPECT_TRUE(HasEdge(prepared, 1, 3) && HasEdge(prepared, 5, 7)) << turn;
    double walls = 0.0;
    for (std::size_t k = 0; k < 4; ++k) walls += (arrow[(k + 1) % 4] - arrow[k]).norm();
    EXPECT_NEAR(prepared.mesh.area(), walls + 2 * 6.0, 1e-12);
  }
}

// A prism over an arrow head: its fans would fold over the inward corner.
TEST(PrepareMeshTest, CutsLargeFacesWithInwardCornersWithoutFolds) {
  formats::PolygonSoup prism;
  const double outline[5][2] = {{0, 0}, {2, 2}, {0, 4}, {0.2, 2.2}, {0.2, 1.8}};
  for (int side = 0; side < 2; ++side) {
    for (const auto& point : outline) prism.positions.emplace_back(point[0], point[1], side);
  }
  prism = WithFace(prism, {4, 3, 2, 1, 0});
  prism = WithFace(prism, {5, 6, 7, 8, 9});
  for (std::uint32_t k = 0; k < 5; ++k) {
    const std::uint32_t next = (k + 1) % 5;
    prism = WithFace(prism, {k, next, next + 5, k + 5});
  }
  const double outline_area = 4.0 - 0.5 * 0.2 * (4.0 + 0.4);
  const PreparedMesh prepared = Prepared(prism);
  EXPECT_EQ(CodesOf(prepared), "");
  EXPECT_NEAR(prepared.mesh.volume(), outline_area, 1e-12);
  double walls = 0.0;
  for (int k = 0; k < 5; ++k) {
    walls += std::hypot(outline[k][0] - outline[(k + 1) % 5][0],
                        outline[k][1] - outline[(k + 1) % 5][1]);
  }
  EXPECT_NEAR(prepared.mesh.area(), 2.0 * outline_area + walls, 1e-12);
}

TEST(PrepareMeshTest, IgnoresUnusedVertices) {
  formats::PolygonSoup soup = Cube();
  soup.positions.insert(soup.positions.begin(), {1e6, 0.0, 0.0});
  for (std::uint32_t& v : soup.face_vertices) ++v;
  const PreparedMesh prepared = Prepared(soup);
  EXPECT_EQ(CodesOf(prepared), "UNUSED_VERTICES");
  EXPECT_EQ(CountOf(prepared, "UNUSED_VERTICES"), 1);
  EXPECT_EQ(prepared.mesh.vertices().size(), 8u);
  EXPECT_EQ(prepared.mesh.vertex_of_source()[0], -1);
  EXPECT_EQ(prepared.mesh.vertices()[prepared.mesh.vertex_of_source()[1]], soup.positions[1]);
}

TEST(PrepareMeshTest, WeldsEqualVerticesOfSoup) {
  const formats::PolygonSoup cube = Cube();
  const PreparedMesh prepared = Prepared(SplitApart(cube));
  EXPECT_EQ(CodesOf(prepared), "VERTICES_WELDED");
  EXPECT_EQ(CountOf(prepared, "VERTICES_WELDED"), 24 - 8);
  EXPECT_EQ(KeyOf(prepared.mesh, 1e-6), KeyOf(Prepared(cube).mesh, 1e-6));
  for (std::size_t i = 0; i < cube.face_vertices.size(); ++i) {
    const std::int32_t v = prepared.mesh.vertex_of_source()[i];
    ASSERT_GE(v, 0);
    EXPECT_EQ(prepared.mesh.vertices()[v], cube.positions[cube.face_vertices[i]]);
  }
}

// The lid of a box a little above its walls: just inside and just outside the tolerance.
TEST(PrepareMeshTest, WeldsWithinOneHundredThousandthOfDiagonal) {
  const double diagonal = std::sqrt(3.0);
  for (const double gap : {0.9e-5 * diagonal, 1.1e-5 * diagonal}) {
    formats::PolygonSoup soup = WithoutFaces(Cube(), 3);
    for (const double z : {0.0, 1.0}) {
      for (const double x : {0.0, 1.0}) soup.positions.emplace_back(x, 1.0 + gap, z);
    }
    const PreparedMesh prepared = Prepared(WithFace(soup, {8, 10, 11, 9}));
    if (gap < 1e-5 * diagonal) {
      EXPECT_EQ(CodesOf(prepared), "VERTICES_WELDED");
      EXPECT_EQ(prepared.mesh.vertices().size(), 8u);
    } else {
      EXPECT_EQ(CodesOf(prepared), "PARTS_LEFT_OUT HOLES_CLOSED");
    }
    EXPECT_NEAR(prepared.mesh.volume(), 1.0, 1e-4);
  }
}

TEST(PrepareMeshTest, WeldsNoisySoup) {
  formats::PolygonSoup soup = SplitApart(Ball(24, 15));
  Random random(7);
  for (Eigen::Vector3d& position : soup.positions) {
    for (int axis = 0; axis < 3; ++axis) position[axis] += random.NextIn(-1e-6, 1e-6);
  }
  const PreparedMesh prepared = Prepared(soup);
  EXPECT_EQ(CodesOf(prepared), "VERTICES_WELDED");
  EXPECT_EQ(prepared.mesh.vertices().size(), Ball(24, 15).positions.size());
}

TEST(PrepareMeshTest, KeepsClosedSurfacesThatTouchApart) {
  // The two share four positions, but not four vertices.
  const formats::PolygonSoup small = Box({1.0, 0.0, 0.0}, {1.2, 1.0, 1.0});
  const PreparedMesh prepared = Prepared(Together(Cube(), small));
  EXPECT_EQ(CodesOf(prepared), "PARTS_LEFT_OUT");
  EXPECT_DOUBLE_EQ(prepared.mesh.volume(), 1.0);
}

TEST(PrepareMeshTest, DropsDegenerateFaces) {
  formats::PolygonSoup soup = Cube();
  soup = WithFace(soup, {0, 1, 1});
  soup = WithFace(soup, {2, 3});
  soup = WithFace(soup, {4, 4, 4, 4, 4});
  soup.is_from_file = true;  // else the face of two corners is refused
  const PreparedMesh prepared = Prepared(soup);
  EXPECT_EQ(CodesOf(prepared), "DEGENERATE_FACES");
  EXPECT_EQ(CountOf(prepared, "DEGENERATE_FACES"), 1 + 1 + 3);
  EXPECT_EQ(prepared.mesh.triangles().size(), 12u);
}

TEST(PrepareMeshTest, DropsCopiesOfFacesWhicheverWayRound) {
  formats::PolygonSoup ball = Ball(12, 7);
  const std::vector<std::uint32_t> v = ball.face_vertices;
  for (std::size_t f = 10; f < 20; ++f)
    ball = WithFace(ball, {v[3 * f], v[3 * f + 1], v[3 * f + 2]});
  for (std::size_t f = 15; f < 25; ++f)
    ball = WithFace(ball, {v[3 * f + 1], v[3 * f], v[3 * f + 2]});
  const PreparedMesh prepared = Prepared(ball);
  EXPECT_EQ(CodesOf(prepared), "DUPLICATE_FACES");
  EXPECT_EQ(CountOf(prepared, "DUPLICATE_FACES"), 20);
  EXPECT_EQ(KeyOf(prepared.mesh, 1e-6), KeyOf(Prepared(Ball(12, 7)).mesh, 1e-6));
}

// A vertex in the middle of an edge of the cube, which only one side's faces use: the other side
// has a face without area there.
TEST(PrepareMeshTest, TurnsEdgesOfFacesWhoseCornersLieOnALine) {
  formats::PolygonSoup soup = WithoutFaces(Cube(), 3);  // the face 2, 3, 7, 6
  soup.positions.emplace_back(0.5, 1.0, 1.0);           // between 3 and 7
  soup = WithFace(soup, {6, 2, 8});
  soup = WithFace(soup, {2, 3, 8});
  soup = WithFace(soup, {6, 8, 7});
  soup = WithFace(soup, {3, 7, 8});
  const PreparedMesh prepared = Prepared(soup);
  EXPECT_EQ(CodesOf(prepared), "FLAT_FACES");
  EXPECT_EQ(CountOf(prepared, "FLAT_FACES"), 1);
  EXPECT_EQ(prepared.mesh.triangles().size(), 14u);
  EXPECT_DOUBLE_EQ(prepared.mesh.volume(), 1.0);
  EXPECT_DOUBLE_EQ(prepared.mesh.area(), 6.0);
}

TEST(PrepareMeshTest, MergesNeighboursInOnePlace) {
  // The ball's last parallel shrinks onto the pole: every face round it loses its area.
  formats::PolygonSoup ball = Ball(6, 9);
  for (int m = 0; m < 6; ++m) ball.positions[6 * 8 + m] = ball.positions.back();
  const PreparedMesh prepared = Prepared(ball);
  EXPECT_EQ(CodesOf(prepared), "FLAT_FACES");
  EXPECT_EQ(CountOf(prepared, "FLAT_FACES"), 6);
  EXPECT_EQ(prepared.mesh.vertices().size(), ball.positions.size() - 6);
  const std::int32_t pole = prepared.mesh.vertex_of_source().back();
  for (int m = 0; m < 6; ++m) EXPECT_EQ(prepared.mesh.vertex_of_source()[6 * 8 + m], pole);
  EXPECT_EQ(prepared.mesh.vertices()[pole], ball.positions.back());
}

// A row of faces without area that can only be mended from its far end, one after the other.
TEST(PrepareMeshTest, MendsLongRowsOfFacesWithoutArea) {
  constexpr std::uint32_t kCount = 100'000;
  formats::PolygonSoup soup;
  soup.positions = {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  for (std::uint32_t i = 0; i <= kCount; ++i) soup.positions.emplace_back(1.0 + i / 1e5, 0, 0);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    for (const std::uint32_t v : {0u, 3 + i, 4 + i, 3 + i, 2u, 4 + i}) {
      soup.face_vertices.push_back(v);
    }
  }
  for (const std::uint32_t v : {0u, 2u, 3u, 0u, 3 + kCount, 1u, 3 + kCount, 2u, 1u, 0u, 1u, 2u}) {
    soup.face_vertices.push_back(v);
  }
  const absl::StatusOr<PreparedMesh> prepared = PrepareMesh(soup);
  ASSERT_TRUE(prepared.ok()) << prepared.status();
  EXPECT_EQ(CountOf(*prepared, "FLAT_FACES"), kCount);
  EXPECT_NEAR(prepared->mesh.volume(), 2.0 / 6.0, 1e-12);
}

// Cancels when it has been asked that often.
class ImpatientObserver final : public FitObserver {
 public:
  explicit ImpatientObserver(int patience) : left_(patience) {}
  void OnStage(Stage, double) override {}
  [[nodiscard]] bool IsCancelled() const override { return left_-- <= 0; }

 private:
  mutable int left_;
};

TEST(PrepareMeshTest, StopsBetweenStepsWhenCancelled) {
  const formats::PolygonSoup open = WithoutFaces(SplitApart(Ball(12, 7)), 3, 2);
  int patience = 0;
  absl::StatusOr<PreparedMesh> prepared = absl::CancelledError();
  for (; !prepared.ok(); ++patience) {
    const ImpatientObserver observer(patience);
    prepared = PrepareMesh(open, {}, ThreadPool(1), observer);
    EXPECT_TRUE(prepared.ok() || prepared.status().code() == absl::StatusCode::kCancelled);
    ASSERT_LT(patience, 30);
  }
  EXPECT_GE(patience, 5);
}

TEST(PrepareMeshTest, DropsFins) {
  formats::PolygonSoup soup = Cube();
  soup.positions.emplace_back(2.0, 2.0, 0.0);
  soup.positions.emplace_back(3.0, 3.0, 0.0);
  soup = WithFace(soup, {6, 7, 8});
  soup = WithFace(soup, {7, 9, 8});
  const PreparedMesh prepared = Prepared(soup);
  EXPECT_EQ(CountOf(prepared, "FINS_DROPPED"), 1);
  EXPECT_EQ(CountOf(prepared, "PARTS_LEFT_OUT"), 1);  // the rest of the fin
  EXPECT_EQ(KeyOf(prepared.mesh, 1e-6), KeyOf(Prepared(Cube()).mesh, 1e-6));
}

TEST(PrepareMeshTest, TakesBoxesWithCommonEdgeApart) {
  // The edge from (1, 1, 0) to (1, 1, 1) belongs to four faces.
  formats::PolygonSoup soup = Together(Cube(), Box({1.0, 1.0, 0.0}, {1.2, 1.2, 1.0}));
  for (std::uint32_t& v : soup.face_vertices) {
    if (v == 8 || v == 9) v -= 2;
  }
  const PreparedMesh prepared = Prepared(soup);
  EXPECT_EQ(CountOf(prepared, "NONMANIFOLD_EDGES"), 1);
  // Joined or apart, both are right.
  EXPECT_NEAR(prepared.mesh.volume(), CountOf(prepared, "PARTS_LEFT_OUT") == 1 ? 1.0 : 1.04, 1e-12);
}

TEST(PrepareMeshTest, SplitsVerticesInWhichTheSurfaceTouchesItself) {
  formats::PolygonSoup ball = Ball(12, 7);  // its poles are the last two vertices
  const auto south = static_cast<std::uint32_t>(ball.positions.size() - 1);
  for (std::uint32_t& v : ball.face_vertices) v = v == south ? south - 1 : v;
  const PreparedMesh prepared = Prepared(ball);
  EXPECT_EQ(CountOf(prepared, "NONMANIFOLD_VERTICES"), 1);
  EXPECT_EQ(prepared.mesh.vertices().size(), ball.positions.size());
  EXPECT_EQ(std::count(prepared.mesh.vertices().begin(), prepared.mesh.vertices().end(),
                       ball.positions[south - 1]),
            2);
}

TEST(PrepareMeshTest, TurnsFacesTheSameWayRoundAndOutward) {
  const formats::PolygonSoup ball = Ball(24, 15);
  const SurfaceKey expected = KeyOf(Prepared(ball).mesh, 1e-6);
  const PreparedMesh some = Prepared(RandomlyTurned(ball, 0.3, 1));
  EXPECT_EQ(CodesOf(some), "FACES_TURNED");
  EXPECT_EQ(KeyOf(some.mesh, 1e-6), expected);
  const PreparedMesh all = Prepared(RandomlyTurned(ball, 1.0, 1));
  EXPECT_EQ(CodesOf(all), "INSIDE_OUT");
  EXPECT_EQ(CountOf(all, "INSIDE_OUT"), 24 * 15 * 2);
  EXPECT_EQ(KeyOf(all.mesh, 1e-6), expected);
}

TEST(PrepareMeshTest, KeepsTheLargestPart) {
  const formats::PolygonSoup big = Ball(24, 15);
  formats::PolygonSoup soup = Together(Moved(Ball(8, 5, 0.2), {3.0, 0.0, 0.0}), big);
  soup = Together(soup, Ball(8, 5, 0.9));  // within the big one
  const PreparedMesh prepared = Prepared(soup);
  EXPECT_EQ(CodesOf(prepared), "PARTS_LEFT_OUT");
  EXPECT_EQ(CountOf(prepared, "PARTS_LEFT_OUT"), 2);
  EXPECT_EQ(KeyOf(prepared.mesh, 1e-6), KeyOf(Prepared(big).mesh, 1e-6));
  EXPECT_EQ(prepared.mesh.vertex_of_source()[0], -1);
  const std::size_t first_of_big = Ball(8, 5).positions.size();
  EXPECT_EQ(prepared.mesh.vertices()[prepared.mesh.vertex_of_source()[first_of_big]],
            big.positions[0]);
}

TEST(PrepareMeshTest, RefusesTwoBodies) {
  const formats::PolygonSoup ball = Ball(12, 7);
  EXPECT_THAT(RefusalOf(Together(ball, Moved(ball, {3.0, 0.0, 0.0}))),
              HasSubstr("TWO_BODIES two separate parts are of similar size"));
  // Also where both are open.
  const formats::PolygonSoup open = WithoutFaces(ball, 0, 3);
  EXPECT_THAT(RefusalOf(Together(open, Moved(open, {3.0, 0.0, 0.0}))), HasSubstr("TWO_BODIES"));
}

TEST(PrepareMeshTest, ClosesFlatHoleExactly) {
  const PreparedMesh prepared = Prepared(WithoutFaces(Cube(), 3));
  EXPECT_EQ(CodesOf(prepared), "HOLES_CLOSED");
  EXPECT_DOUBLE_EQ(prepared.mesh.volume(), 1.0);
  EXPECT_DOUBLE_EQ(prepared.mesh.area(), 6.0);
  EXPECT_EQ(prepared.mesh.vertices().size(), 8u);
  EXPECT_THAT(prepared.warnings[0].message, HasSubstr("1 holes (the largest is 4 round, near"));
}

TEST(PrepareMeshTest, ClosesHolesOfInsideOutMeshes) {
  const PreparedMesh prepared = Prepared(RandomlyTurned(WithoutFaces(Cube(), 3), 1.0, 1));
  EXPECT_EQ(CodesOf(prepared), "HOLES_CLOSED INSIDE_OUT");
  EXPECT_EQ(CountOf(prepared, "INSIDE_OUT"), 10);  // those of the caller
  EXPECT_DOUBLE_EQ(prepared.mesh.volume(), 1.0);
}

TEST(PrepareMeshTest, ClosesHolesThatTouchInVertices) {
  // Every other triangle round the pole is missing: all holes meet there.
  formats::PolygonSoup ball = Ball(12, 15);
  formats::PolygonSoup open;
  open.positions = ball.positions;
  const auto pole = static_cast<std::uint32_t>(ball.positions.size() - 2);
  int at_pole = 0;
  for (std::size_t i = 0; i < ball.face_vertices.size(); i += 3) {
    if (ball.face_vertices[i] == pole && at_pole++ % 2 == 0) continue;
    for (int k = 0; k < 3; ++k) open.face_vertices.push_back(ball.face_vertices[i + k]);
  }
  const PreparedMesh prepared = Prepared(open);
  EXPECT_EQ(CodesOf(prepared), "HOLES_CLOSED");
  EXPECT_EQ(CountOf(prepared, "HOLES_CLOSED"), 6);
  EXPECT_EQ(KeyOf(prepared.mesh, 1e-6), KeyOf(Prepared(ball).mesh, 1e-6));
}

// An open tube with n corners round each end: the small loops are filled by least area, the large
// ones by cutting ears. Both ends are flat, so the volume is that of the prism.
TEST(PrepareMeshTest, ClosesLongLoops) {
  for (const int n : {30, 400, 1000}) {
    formats::PolygonSoup tube;
    for (int i = 0; i < n; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / n;
      for (const double z : {0.0, 3.0}) {
        tube.positions.emplace_back(std::cos(angle), std::sin(angle), z);
      }
    }
    for (int i = 0; i < n; ++i) {
      const auto a = static_cast<std::uint32_t>(2 * i);
      const auto b = static_cast<std::uint32_t>(2 * ((i + 1) % n));
      tube.face_sizes.push_back(4);
      tube.face_vertices.insert(tube.face_vertices.end(), {a, b, b + 1, a + 1});
    }
    const PreparedMesh prepared = Prepared(tube);
    EXPECT_EQ(CountOf(prepared, "HOLES_CLOSED"), 2);
    const double end_area = 0.5 * n * std::sin(2.0 * std::numbers::pi / n);
    EXPECT_NEAR(prepared.mesh.volume(), 3.0 * end_area, 1e-9) << n;
    const double wall = 3.0 * n * 2.0 * std::sin(std::numbers::pi / n);
    EXPECT_NEAR(prepared.mesh.area(), 2.0 * end_area + wall, 1e-9) << n;
  }
}

TEST(PrepareMeshTest, RefusesSurfacesThatAreMostlyHole) {
  const formats::PolygonSoup ball = Ball(24, 15);
  formats::PolygonSoup half;
  half.positions = ball.positions;
  for (std::size_t i = 0; i < ball.face_vertices.size(); i += 3) {
    const bool above = ball.positions[ball.face_vertices[i]].z() > -0.01 &&
                       ball.positions[ball.face_vertices[i + 1]].z() > -0.01;
    if (!above) continue;
    for (int k = 0; k < 3; ++k) half.face_vertices.push_back(ball.face_vertices[i + k]);
  }
  EXPECT_THAT(RefusalOf(half), HasSubstr("OPEN_SURFACE the surface is not closed"));
}

TEST(PrepareMeshTest, RefusesSurfacesWithoutInside) {
  formats::PolygonSoup plane;  // the projective plane on six vertices
  plane.positions = {{0, 0, 0}, {3, 0, 1}, {0, 4, 1}, {1, 1, 5}, {4, 3, 2}, {2, 5, 4}};
  plane.face_vertices = {0, 1, 4, 0, 1, 5, 0, 2, 3, 0, 2, 5, 0, 3, 4,
                         1, 2, 3, 1, 2, 4, 1, 3, 5, 2, 4, 5, 3, 4, 5};
  EXPECT_THAT(RefusalOf(plane), HasSubstr("NOT_ORIENTABLE"));
}

TEST(PrepareMeshTest, RefusesFlatAndEmptySurfaces) {
  formats::PolygonSoup soup = Cube();
  for (Eigen::Vector3d& position : soup.positions) position.x() = 0.0;
  EXPECT_THAT(RefusalOf(soup), HasSubstr("NO_VOLUME"));
  for (Eigen::Vector3d& position : soup.positions) position.setZero();
  EXPECT_THAT(RefusalOf(soup), HasSubstr("NO_VOLUME"));
  for (std::uint32_t& v : soup.face_vertices) v = 3;
  EXPECT_THAT(RefusalOf(soup), HasSubstr("NO_SURFACE all 12 faces are degenerate"));
}

// (Bad arrays: refusals_test.cc.)
TEST(PrepareMeshTest, TakesSizesUpToTheLimits) {
  formats::MeshLimits limits;
  limits.max_vertices = 8;
  limits.max_faces = 6;
  EXPECT_TRUE(PrepareMesh(Cube(), limits).ok());
}

// Whatever is done to the arrays of a ball, the same surface comes out.
TEST(PrepareMeshProperty, OrderTurnsAndCopiesDoNotChangeTheSurface) {
  const formats::PolygonSoup ball = Ball(16, 9);
  const SurfaceKey expected = KeyOf(Prepared(ball).mesh, 1e-6);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    formats::PolygonSoup soup = RandomlyTurned(Shuffled(ball, seed), 0.4, seed);
    if (seed % 2 == 1) soup = SplitApart(soup);
    EXPECT_EQ(KeyOf(Prepared(soup).mesh, 1e-6), expected) << seed;
  }
}

TEST(PrepareMeshProperty, DroppedFacesAreFilledAgain) {
  const double whole = Prepared(Ball(32, 19)).mesh.volume();
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const formats::PolygonSoup shuffled = Shuffled(Ball(32, 19), seed);
    const std::size_t faces = shuffled.face_sizes.size();
    const PreparedMesh prepared = Prepared(WithoutFaces(shuffled, 0, faces / 20));
    EXPECT_GT(CountOf(prepared, "HOLES_CLOSED"), 10);
    EXPECT_NEAR(prepared.mesh.volume(), whole, 0.01 * whole);
  }
}

TEST(PrepareMeshProperty, PlaceAndSizeDoNotMatter) {
  const formats::PolygonSoup spoilt =
      RandomlyTurned(WithoutFaces(SplitApart(Ball(16, 9)), 3, 2), 0.3, 5);
  const PreparedMesh near = Prepared(spoilt);
  const Eigen::Vector3d away(2e5, -1e5, 3e5);
  const PreparedMesh far = Prepared(Moved(spoilt, away));
  EXPECT_EQ(CodesOf(far), CodesOf(near));
  const BodyMesh back = far.mesh.Transformed({Eigen::Matrix3d::Identity(), 1.0, -away});
  EXPECT_EQ(KeyOf(back, 1e-6), KeyOf(near.mesh, 1e-6));
  EXPECT_NEAR(far.mesh.volume(), near.mesh.volume(), 1e-8);
  formats::PolygonSoup tiny = spoilt;
  for (Eigen::Vector3d& position : tiny.positions) position *= 0x1p-20;
  const PreparedMesh small = Prepared(tiny);
  EXPECT_EQ(CodesOf(small).substr(0, 12), CodesOf(near).substr(0, 12));
  EXPECT_TRUE(std::equal(small.mesh.triangles().begin(), small.mesh.triangles().end(),
                         near.mesh.triangles().begin(), near.mesh.triangles().end()));
}

}  // namespace
}  // namespace capfit::mesh
