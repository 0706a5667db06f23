#include "core/metrics/column_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/random.h"
#include "core/mesh/surface_sums.h"
#include "tests/core/mesh/boxes.h"
#include "tests/core/metrics/shapes.h"

namespace capfit::metrics {
namespace {

using Eigen::Vector3d;
using geometry::Interval;
using geometry::TaperedCapsule;

ColumnGrid GridOver(const mesh::BodyMesh& mesh, int columns) {
  return MakeColumnGrid({mesh.box_min(), mesh.box_max()}, columns);
}

const ThreadPool& SerialPool() {
  static const ThreadPool pool(1);
  return pool;
}

// The mesh as the body and the fitted part alike.
FittedSurface SurfaceOf(const mesh::BodyMesh& mesh) {
  FittedSurface surface;
  surface.points_m.own().assign(mesh.vertices().begin(), mesh.vertices().end());
  surface.triangles.own().assign(mesh.triangles().begin(), mesh.triangles().end());
  surface.parts.assign(surface.triangles.size(), body::Part::kTorso);
  surface.skin_end = surface.triangles.size();
  return surface;
}

double VolumeByColumns(const mesh::BodyMesh& mesh, int columns) {
  const ColumnGrid grid = GridOver(mesh, columns);
  const FittedSurface surface = SurfaceOf(mesh);
  const BodyRows rows(surface, grid, SerialPool());
  double volume = 0.0;
  for (std::size_t row = 0; row < grid.y.size(); ++row) volume += rows.Cut(row).body.Length();
  return volume * grid.cell_area();
}

bool IsInside(std::span<const Interval> intervals, double z) {
  return std::any_of(intervals.begin(), intervals.end(),
                     [z](const Interval& i) { return i.begin <= z && z <= i.end; });
}

Overlap OverlapOf(const std::vector<std::array<Vector3d, 2>>& boxes, int columns = 100) {
  const mesh::BodyMesh mesh = mesh::BoxesOf(boxes);
  const ColumnGrid grid = GridOver(mesh, columns);
  const FittedSurface surface = SurfaceOf(mesh);
  return BodyRows(surface, grid, SerialPool()).MeasureOverlap();
}

TEST(ColumnGridTest, IsRisingAndMirrorSymmetric) {
  const ColumnGrid grid = MakeColumnGrid({Vector3d(-1, 0, 0), Vector3d(3, 2, 1)}, 7);
  ASSERT_EQ(grid.x.size(), 8u);
  EXPECT_TRUE(std::is_sorted(grid.x.begin(), grid.x.end()));
  EXPECT_TRUE(std::is_sorted(grid.y.begin(), grid.y.end()));
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(grid.x[i], -grid.x[7 - i]);
  EXPECT_LT(grid.x.back(), 3.0);
  EXPECT_GT(grid.x.back(), 2.0);
  EXPECT_DOUBLE_EQ(grid.cell_area(), 6.0 / 8 * 2.0 / 8);
}

TEST(ColumnGridTest, FindsTheFirstColumnAtOrAfterAPlace) {
  const ColumnGrid grid = MakeColumnGrid({Vector3d(-1, 0, 0), Vector3d(1, 2, 1)}, 20);
  Random random(1);
  for (int k = 0; k < 2000; ++k) {
    const double at = k < 40 ? grid.x[k % 20] : random.NextIn(-1.5, 1.5);
    const auto expected = std::lower_bound(grid.x.begin(), grid.x.end(), at) - grid.x.begin();
    EXPECT_EQ(grid.FirstColumn(at), static_cast<std::size_t>(expected)) << at;
  }
}

TEST(WidenTest, AddsCellsAroundThoseThatStay) {
  const ColumnGrid grid = MakeColumnGrid({Vector3d(-1, 0, 0), Vector3d(1, 2, 1)}, 20);
  const auto wider = Widen(grid, {Vector3d(-0.5, -0.25, -5), Vector3d(1.35, 2.4, 5)});
  ASSERT_TRUE(wider.has_value());
  EXPECT_EQ(wider->margin.beside, 4u);  // of 0.1
  EXPECT_EQ(wider->margin.below, 3u);
  ASSERT_EQ(wider->grid.x.size(), 28u);
  ASSERT_EQ(wider->grid.y.size(), 27u);
  EXPECT_DOUBLE_EQ(wider->grid.cell_area(), grid.cell_area());
  EXPECT_TRUE(std::equal(grid.x.begin(), grid.x.end(), wider->grid.x.begin() + 4));
  EXPECT_TRUE(std::equal(grid.y.begin(), grid.y.end(), wider->grid.y.begin() + 3));
  for (std::size_t i = 0; i < 28; ++i) {
    EXPECT_EQ(wider->grid.x[i], -wider->grid.x[27 - i]);
    EXPECT_NEAR(wider->grid.x[i], -1.35 + 0.1 * static_cast<double>(i), 0.0051);
    EXPECT_EQ(wider->grid.FirstColumn(wider->grid.x[i]), i);
  }
  for (std::size_t j = 0; j < 27; ++j) {
    EXPECT_NEAR(wider->grid.y[j], -0.25 + 0.1 * static_cast<double>(j), 0.0051);
    EXPECT_EQ(wider->grid.FirstRow(wider->grid.y[j]), j);
  }
}

TEST(WidenTest, ABoxWithinTakesNoMoreAndOneFarBeyondIsRefused) {
  const ColumnGrid grid = MakeColumnGrid({Vector3d(-1, 0, 0), Vector3d(1, 2, 1)}, 20);
  const auto same = Widen(grid, {Vector3d(-0.9, 0.1, 0), Vector3d(0.5, 1.9, 1)});
  ASSERT_TRUE(same.has_value());
  EXPECT_EQ(same->grid.x, grid.x);
  EXPECT_EQ(same->grid.y, grid.y);
  EXPECT_FALSE(Widen(grid, {Vector3d(-0.9, 0.1, 0), Vector3d(2.2, 1.9, 1)}).has_value());
  EXPECT_FALSE(Widen(grid, {Vector3d(-0.9, -1.5, 0), Vector3d(0.5, 3.5, 1)}).has_value());
  EXPECT_FALSE(Widen(grid, {Vector3d(-1e300, 0, 0), Vector3d(1, 2, 1)}).has_value());
}

TEST(BodyRowsTest, AMarginShiftsWhatTheColumnsMeet) {
  const mesh::BodyMesh mesh = test_shapes::Bracket();
  const ColumnGrid grid = GridOver(mesh, 24);
  const FittedSurface surface = SurfaceOf(mesh);
  const BodyRows rows(surface, grid, SerialPool());
  const GridMargin margin{5, 3};
  for (std::size_t row = 0; row < grid.y.size() + 8; ++row) {
    const RowIntervals shifted = rows.Cut(row, margin).body;
    const bool is_own = row >= 3 && row < 3 + grid.y.size();
    const RowIntervals own = is_own ? rows.Cut(row - 3).body : RowIntervals({}, grid.x.size());
    EXPECT_EQ(shifted.Length(), own.Length());
    for (std::size_t i = 0; i < grid.x.size(); ++i) {
      ASSERT_EQ(shifted.Column(i + 5).size(), own.Column(i).size());
    }
    EXPECT_TRUE(shifted.Column(4).empty());
    EXPECT_TRUE(shifted.Column(5 + grid.x.size()).empty());
  }
}

TEST(CommonLengthTest, AddsUpWhatIsInBoth) {
  const std::vector<Interval> a = {{0, 2}, {3, 5}, {8, 9}};
  const std::vector<Interval> b = {{1, 4}, {4.5, 8.5}};
  EXPECT_DOUBLE_EQ(CommonLength(a, b), 1 + 1 + 0.5 + 0.5);
  EXPECT_DOUBLE_EQ(CommonLength(b, a), 3.0);
  EXPECT_DOUBLE_EQ(CommonLength(a, {}), 0.0);
}

TEST(BodyRowsTest, BoxesAndBracketsHaveTheirVolume) {
  EXPECT_NEAR(VolumeByColumns(test_shapes::Box({-1, 0, 0}, {1, 3, 2}, 4), 50), 12.0, 1e-12);
  // Half of the widened grid misses the bracket, and a cell in the middle is cut by its notch.
  EXPECT_NEAR(VolumeByColumns(test_shapes::Bracket(), 200), 3.0, 0.03);
}

TEST(BodyRowsTest, ABallHasItsVolume) {
  const mesh::BodyMesh ball = test_shapes::Ball({{0.1, 2, -1}, 0.7}, 4);
  EXPECT_NEAR(VolumeByColumns(ball, 240) / ball.volume(), 1.0, 5e-4);
}

// Rows and columns that run exactly through vertices and edges must still close: a box whose
// triangulation is full of edges parallel to the axes, cut exactly there.
TEST(BodyRowsTest, ColumnsThroughVerticesAndEdgesCloseExactly) {
  const mesh::BodyMesh box = test_shapes::Box({-1, -1, -1}, {1, 1, 1}, 4);
  ColumnGrid grid = GridOver(box, 4);
  grid.x = {-0.5, 0.0, 0.5, 0.9};
  grid.y = {-0.5, 0.0, 0.5, 0.9};
  const FittedSurface surface = SurfaceOf(box);
  const BodyRows rows(surface, grid, SerialPool());
  for (std::size_t row = 0; row < 4; ++row) {
    const RowIntervals cut = rows.Cut(row).body;
    for (std::size_t column = 0; column < 4; ++column) {
      ASSERT_EQ(cut.Column(column).size(), 1u) << row << ' ' << column;
      EXPECT_EQ(cut.Column(column)[0].begin, -1.0);
      EXPECT_EQ(cut.Column(column)[0].end, 1.0);
    }
  }
}

TEST(BodyRowsTest, InsideIsWhereTheWindingNumberIsOne) {
  for (const mesh::BodyMesh& mesh :
       {test_shapes::Bracket(), test_shapes::Ball({{0.2, 0, 0}, 1}, 1),
        test_shapes::Capsule({{-1, 0, 0}, 0.3}, {{1, 1, 1}, 0.6}, 12, 3)}) {
    const ColumnGrid grid = GridOver(mesh, 24);
    const FittedSurface surface = SurfaceOf(mesh);
    const BodyRows rows(surface, grid, SerialPool());
    Random random(2);
    for (int k = 0; k < 300; ++k) {
      const auto row = static_cast<std::size_t>(random.NextBelow(24));
      const auto column = static_cast<std::size_t>(random.NextBelow(24));
      const double z = random.NextIn(mesh.box_min().z() - 0.1, mesh.box_max().z() + 0.1);
      const double winding = test_shapes::WindingNumber(mesh, {grid.x[column], grid.y[row], z});
      EXPECT_EQ(IsInside(rows.Cut(row).body.Column(column), z), winding > 0.5);
    }
  }
}

TEST(BodyRowsTest, WhereASurfaceOverlapsItselfCountsOnce) {
  const mesh::BodyMesh one = test_shapes::Box({0, 0, 0}, {2, 1, 1});
  std::vector<Vector3d> vertices(one.vertices().begin(), one.vertices().end());
  std::vector<mesh::Triangle> triangles(one.triangles().begin(), one.triangles().end());
  for (const Vector3d& v : one.vertices()) vertices.push_back(v + Vector3d(0, 0, 0.5));
  for (mesh::Triangle t : one.triangles()) {
    for (std::uint32_t& corner : t) corner += 8;
    triangles.push_back(t);
  }
  const mesh::BodyMesh both = test_shapes::MeshOf(vertices, triangles);
  EXPECT_NEAR(both.volume(), 4.0, 1e-12);  // by signs: the overlap twice
  EXPECT_NEAR(VolumeByColumns(both, 40), 3.0, 1e-12);
}

// A box whose lower half (in z) is one part and the upper half another: each column through it is
// cut in the middle. A lid on top of the fitted part alone leaves out what is above it.
TEST(BodyRowsTest, HalvesHaveThePartOfTheirEndAndSurfacesShareTriangles) {
  const mesh::BodyMesh box = test_shapes::Box({-1, -1, 0}, {1, 1, 4}, 2);
  constexpr body::Part kLow = body::Part::kLeftArm;
  constexpr body::Part kHigh = body::Part::kRightArm;
  FittedSurface surface;
  std::vector<mesh::Triangle> below;
  for (const mesh::Triangle& t : box.triangles()) {
    if (mesh::Middle(box.vertices(), t).z() > 2.0) {
      surface.triangles.own().push_back(t);
    } else {
      below.push_back(t);
    }
  }
  surface.skin_begin = surface.triangles.size();
  surface.parts.assign(surface.skin_begin, kHigh);
  surface.triangles.own().insert(surface.triangles.own().end(), below.begin(), below.end());
  surface.skin_end = surface.triangles.size();
  surface.points_m.own().assign(box.vertices().begin(), box.vertices().end());
  const auto first = static_cast<std::uint32_t>(surface.points_m.size());
  surface.points_m.own().insert(surface.points_m.own().end(),
                                {{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}});
  surface.triangles.own().push_back({first, first + 1, first + 2});
  surface.triangles.own().push_back({first, first + 2, first + 3});
  surface.parts.resize(surface.triangles.size(), kLow);
  const ColumnGrid grid = GridOver(box, 10);
  const BodyRows rows(surface, grid, SerialPool());
  for (std::size_t row = 0; row < 10; ++row) {
    const BodyRows::Cuts cuts = rows.Cut(row);
    for (std::size_t column = 0; column < 10; ++column) {
      const auto body = cuts.body.Column(column);
      ASSERT_EQ(body.size(), 2u);
      EXPECT_EQ(body[0].end, body[1].begin);
      EXPECT_DOUBLE_EQ(body[0].end, 2.0);
      EXPECT_EQ(cuts.body.Labels(column)[0], static_cast<int>(kLow));
      EXPECT_EQ(cuts.body.Labels(column)[1], static_cast<int>(kHigh));
      const auto fitted = cuts.fitted().Column(column);
      ASSERT_EQ(fitted.size(), 1u);
      EXPECT_EQ(fitted[0].end, 2.0);
      EXPECT_EQ(cuts.fitted().Labels(column)[0], static_cast<int>(kLow));
    }
  }
}

TEST(SolidRowLabelsTest, NameASolidThatHoldsTheInterval) {
  const std::vector<TaperedCapsule> solids = {{{{0, 0, 0}, 0.5}, {{0, 0, 0}, 0.5}},
                                              {{{0, 0, 0.4}, 0.5}, {{0, 0, 0.4}, 0.5}},
                                              {{{0, 0, 0.1}, 0.2}, {{0, 0, 0.1}, 0.2}}};
  const ColumnGrid grid = MakeColumnGrid({Vector3d(-0.5, -0.5, -1), Vector3d(0.5, 0.5, 1)}, 20);
  for (std::size_t row = 0; row < 20; ++row) {
    const RowIntervals cut = SolidRows(solids, grid).Cut(row);
    for (std::size_t column = 0; column < 20; ++column) {
      const auto intervals = cut.Column(column);
      for (std::size_t k = 0; k < intervals.size(); ++k) {
        const Vector3d middle(grid.x[column], grid.y[row],
                              0.5 * (intervals[k].begin + intervals[k].end));
        EXPECT_LT(solids[cut.Labels(column)[k]].SignedDistance(middle), 0.0);
        EXPECT_NE(cut.Labels(column)[k], 2) << "always entered after another";
        if (k == 0) continue;
        EXPECT_LE(intervals[k - 1].end, intervals[k].begin);
      }
    }
  }
}

// Free ones, and a set that is its own mirror image: a mirrored pair, a bar between two images and
// a capsule on the plane.
class SolidRowsTest : public testing::TestWithParam<std::vector<TaperedCapsule>> {};

TEST_P(SolidRowsTest, AgreeWithTheDistanceToTheUnion) {
  const std::vector<TaperedCapsule>& solids = GetParam();
  const ColumnGrid grid = MakeColumnGrid({Vector3d(-1.2, -0.6, 0), Vector3d(1.3, 1.7, 1)}, 30);
  for (std::size_t row = 0; row < 30; ++row) {
    const RowIntervals cut = SolidRows(solids, grid).Cut(row);
    Random random(row);
    for (std::size_t column = 0; column < 30; ++column) {
      const double z = random.NextIn(-1, 3.5);
      const Vector3d point(grid.x[column], grid.y[row], z);
      double distance = std::numeric_limits<double>::infinity();
      for (const TaperedCapsule& solid : solids) {
        distance = std::min(distance, solid.SignedDistance(point));
      }
      if (std::abs(distance) < 1e-9) continue;
      EXPECT_EQ(IsInside(cut.Column(column), z), distance < 0) << point.transpose();
      for (std::size_t k = 0; k < cut.Column(column).size(); ++k) {
        const geometry::Interval interval = cut.Column(column)[k];
        const Vector3d middle(point.x(), point.y(), 0.5 * (interval.begin + interval.end));
        EXPECT_LT(solids[cut.Labels(column)[k]].SignedDistance(middle), 1e-12);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Sets, SolidRowsTest,
    testing::Values(std::vector<TaperedCapsule>{{{{0, 0.2, 0}, 0.5}, {{1, 0.8, 0.3}, 0.2}},
                                                {{{-0.8, 0, 0}, 0.3}, {{-0.8, 0, 0}, 0.3}},
                                                {{{0, 1, 0}, 0.1}, {{0.1, 1, 0}, 0.6}},
                                                {{{0.4, 0.1, 2}, 0.2}, {{0.4, 0.1, 3}, 0.2}}},
                    std::vector<TaperedCapsule>{{{{0.3, 0.2, 0}, 0.4}, {{1, 0.8, 0.3}, 0.2}},
                                                {{{0, 0.9, 0.2}, 0.3}, {{0, 0.4, 1}, 0.2}},
                                                {{{-0.3, 0.2, 0}, 0.4}, {{-1, 0.8, 0.3}, 0.2}},
                                                {{{-0.6, 0, 0.5}, 0.2}, {{0.6, 0, 0.5}, 0.2}}}));

TEST(BodyRowsTest, MeasureWhatIsEnclosedTwice) {
  using BoxCorners = std::array<Vector3d, 2>;
  const BoxCorners tall = {Vector3d(0, 0, 0), Vector3d(1, 4, 1)};
  const BoxCorners beside = {Vector3d(2, 0, 0), Vector3d(3, 1, 1)};
  const BoxCorners half_in = {Vector3d(0.5, 1, 0.25), Vector3d(2, 2, 0.75)};
  EXPECT_EQ(OverlapOf({tall}).volume_m3, 0.0);
  EXPECT_EQ(OverlapOf({tall, beside}).volume_m3, 0.0);
  const Overlap overlap = OverlapOf({tall, half_in});
  EXPECT_NEAR(overlap.volume_m3, 0.25, 0.02);
  EXPECT_LT((overlap.middle_m - Vector3d(0.75, 1.5, 0.5)).norm(), 0.03);
  EXPECT_NEAR(OverlapOf({tall, tall}).volume_m3, 4.0, 0.2);
  EXPECT_NEAR(OverlapOf({tall, tall, tall}).volume_m3, 4.0, 0.2);  // counted once
}

// The flat caps of what is fitted enclose nothing of the body.
TEST(BodyRowsTest, OverlapIsOfTheBodyAlone) {
  const mesh::BodyMesh mesh = mesh::BoxesOf(std::vector<std::array<Vector3d, 2>>{
      {Vector3d(0, 0, 0), Vector3d(1, 1, 1)}, {Vector3d(0, 0, 0), Vector3d(1, 1, 1)}});
  const ColumnGrid grid = GridOver(mesh, 20);
  FittedSurface surface = SurfaceOf(mesh);
  surface.skin_end /= 2;
  EXPECT_EQ(BodyRows(surface, grid, SerialPool()).MeasureOverlap().volume_m3, 0.0);
}

}  // namespace
}  // namespace capfit::metrics
