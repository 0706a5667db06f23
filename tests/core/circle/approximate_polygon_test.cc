#include "core/circle/approximate_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/circle/cover_outline.h"
#include "core/circle/union_area.h"
#include "tests/core/circle/outlines.h"

namespace capfit::circle {
namespace {

const NullObserver kObserver;

double OutOf(const std::vector<Circle>& circles, const Eigen::Vector2d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Circle& c : circles) least = std::min(least, (p - c.center_m).norm() - c.radius_m);
  return least;
}

// Points on the edges and inside, chosen without regard to what the fit samples.
void ExpectCovers(const PolygonApproximation& approximation, const section::Polygon& outline,
                  Random& random) {
  const auto vertices = outline.vertices();
  for (int i = 0; i < 400; ++i) {
    const auto k = static_cast<std::size_t>(random.NextBelow(vertices.size()));
    const double t = random.NextUnit();
    const Eigen::Vector2d p = (1 - t) * vertices[k] + t * vertices[(k + 1) % vertices.size()];
    EXPECT_LE(OutOf(approximation.circles, p), 2e-9);
    const auto j = static_cast<std::size_t>(random.NextBelow(vertices.size()));
    const double s = random.NextUnit();
    const Eigen::Vector2d inner = (1 - s) * p + s * vertices[j];
    if (!outline.Contains(inner)) continue;
    EXPECT_LE(OutOf(approximation.circles, inner), 2e-9);
  }
}

TEST(ApproximatePolygonTest, CoversRandomOutlinesWithTheAskedNumber) {
  Random random(51);
  for (int scene = 0; scene < 40; ++scene) {
    const section::FeaturePolygon polygon =
        AsFeature(scene % 2 == 0 ? RandomStar(random, 40, 0.5) : MirroredTrunk(random, 96, 0.2));
    const int count = 1 + scene % 8;
    const PolygonApproximation result = ApproximatePolygon(polygon, count, {}, kObserver);
    EXPECT_EQ(static_cast<int>(result.circles.size()), count);
    ExpectCovers(result, polygon.outline, random);
    EXPECT_NEAR(result.outside_area_m2, UnionArea(result.circles) - polygon.outline.area_m2(),
                1e-7);
  }
}

TEST(ApproximatePolygonTest, DraftsCoverAndWasteLittleMore) {
  Random random(57);
  double best = 0.0;
  double drafts = 0.0;
  for (int scene = 0; scene < 40; ++scene) {
    const section::FeaturePolygon polygon =
        AsFeature(scene % 2 == 0 ? RandomStar(random, 40, 0.5) : MirroredTrunk(random, 96, 0.2));
    const int count = 2 + scene % 4;
    const PolygonApproximation draft =
        ApproximatePolygon(polygon, count, DraftOptions({}), kObserver);
    EXPECT_EQ(static_cast<int>(draft.circles.size()), count);
    ExpectCovers(draft, polygon.outline, random);
    drafts += draft.outside_area_m2;
    best += ApproximatePolygon(polygon, count, {}, kObserver).outside_area_m2;
  }
  EXPECT_LT(drafts, 1.2 * best);
  EXPECT_GT(drafts, best);
}

TEST(ApproximatePolygonTest, DraftsKeepWhatElseIsAsked) {
  const CircleOptions draft = DraftOptions({.symmetric = true, .seed = 7});
  EXPECT_TRUE(draft.symmetric);
  EXPECT_EQ(draft.seed, 7u);
}

TEST(ApproximatePolygonTest, OneCircleIsTheSmallestEnclosingOne) {
  const PolygonApproximation result =
      ApproximatePolygon(AsFeature(Ellipse(0.3, 0.2, 64)), 1, {}, kObserver);
  ASSERT_EQ(result.circles.size(), 1u);
  EXPECT_NEAR(result.circles[0].radius_m, 0.3, 1e-12);
  EXPECT_NEAR(result.circles[0].center_m.norm(), 0.0, 1e-12);
}

TEST(ApproximatePolygonTest, ACircleNeedsOneCircle) {
  const section::Polygon outline = Ellipse(0.1, 0.1, 256);
  const double waste = kPi * 0.01 - outline.area_m2();
  for (const int count : {1, 2, 3}) {
    const PolygonApproximation result =
        ApproximatePolygon(AsFeature(outline), count, {}, kObserver);
    EXPECT_LE(result.outside_area_m2, waste + 0.02 * outline.area_m2()) << count;
  }
}

TEST(ApproximatePolygonTest, FindsTheDiscsThatAnOutlineIsMadeOf) {
  // A stadium's outline has two half discs; two touching discs are found where they are.
  std::vector<Eigen::Vector2d> vertices;
  const int half = 60;
  const double cut = 0.6;  // the discs of radius 1 meet where their centres' line is 2 * 0.8 long
  const double from = std::asin(cut);
  for (const double side : {1.0, -1.0}) {
    for (int i = 0; i < half; ++i) {
      const double a = -(kPi - from) + 2 * (kPi - from) * i / half;
      vertices.emplace_back(side * (0.8 + std::cos(a)), side * std::sin(a));
    }
  }
  const PolygonApproximation result =
      ApproximatePolygon(AsFeature(MakePolygon(vertices)), 2, {}, kObserver);
  EXPECT_NEAR(result.circles[0].center_m.x(), -0.8, 0.02);
  EXPECT_NEAR(result.circles[1].center_m.x(), 0.8, 0.02);
  EXPECT_NEAR(result.circles[0].radius_m, 1.0, 0.02);
}

TEST(ApproximatePolygonTest, MoreCirclesWasteLess) {
  Random random(52);
  for (int scene = 0; scene < 6; ++scene) {
    const section::FeaturePolygon polygon = AsFeature(MirroredTrunk(random, 96, 0.15));
    std::vector<double> areas;
    for (const int count : {1, 2, 4, 8}) {
      areas.push_back(ApproximatePolygon(polygon, count, {}, kObserver).outside_area_m2);
    }
    for (std::size_t i = 0; i + 1 < areas.size(); ++i) EXPECT_LT(areas[i + 1], areas[i]);
    EXPECT_LT(areas.back(), 0.4 * areas.front());
    EXPECT_LT(areas.back(), 0.06 * polygon.outline.area_m2());
  }
}

TEST(ApproximatePolygonTest, SymmetricFitsMirrorToTheBit) {
  Random random(53);
  CircleOptions options;
  options.symmetric = true;
  for (int scene = 0; scene < 24; ++scene) {
    const section::FeaturePolygon polygon = AsFeature(MirroredTrunk(random, 96, 0.2));
    const int count = 1 + scene % 8;
    const PolygonApproximation result = ApproximatePolygon(polygon, count, options, kObserver);
    ASSERT_EQ(static_cast<int>(result.circles.size()), count);
    ExpectCovers(result, polygon.outline, random);
    for (const Circle& c : result.circles) {
      const bool has_image =
          std::any_of(result.circles.begin(), result.circles.end(), [&](const Circle& d) {
            return d.center_m.x() == -c.center_m.x() && d.center_m.y() == c.center_m.y() &&
                   d.radius_m == c.radius_m;
          });
      EXPECT_TRUE(has_image);
    }
  }
}

TEST(ApproximatePolygonTest, SymmetryCostsLittle) {
  Random random(54);
  double free = 0.0;
  double symmetric = 0.0;
  for (int scene = 0; scene < 12; ++scene) {
    const section::FeaturePolygon polygon = AsFeature(MirroredTrunk(random, 96, 0.15));
    CircleOptions options;
    free += ApproximatePolygon(polygon, 2 + scene % 5, options, kObserver).outside_area_m2;
    options.symmetric = true;
    symmetric += ApproximatePolygon(polygon, 2 + scene % 5, options, kObserver).outside_area_m2;
  }
  EXPECT_LT(symmetric, 1.15 * free);
}

TEST(ApproximatePolygonTest, SameSeedSameBits) {
  Random random(55);
  const section::FeaturePolygon polygon = AsFeature(RandomStar(random, 60, 0.4));
  CircleOptions options;
  options.seed = 7;
  const PolygonApproximation a = ApproximatePolygon(polygon, 5, options, kObserver);
  const PolygonApproximation b = ApproximatePolygon(polygon, 5, options, kObserver);
  for (std::size_t i = 0; i < a.circles.size(); ++i) {
    EXPECT_EQ(a.circles[i].center_m, b.circles[i].center_m);
    EXPECT_EQ(a.circles[i].radius_m, b.circles[i].radius_m);
  }
}

TEST(ApproximatePolygonTest, ScalingTheOutlineScalesTheCircles) {
  Random random(56);
  const section::FeaturePolygon polygon = AsFeature(RandomStar(random, 60, 0.2));
  std::vector<Eigen::Vector2d> moved;
  for (const Eigen::Vector2d& v : polygon.outline.vertices()) {
    moved.push_back(4.0 * v);  // by a power of two: no rounding, so even choices stay the same
  }
  const auto a = ApproximatePolygon(polygon, 3, {}, kObserver);
  const auto b = ApproximatePolygon(AsFeature(MakePolygon(moved)), 3, {}, kObserver);
  EXPECT_NEAR(b.outside_area_m2, 16.0 * a.outside_area_m2, 1e-3 * b.outside_area_m2);
}

// A big disc with two smaller ones in front (-y), as a section of a chest: star-shaped about 0.
section::Polygon ThreeDiscs(int count) {
  const std::vector<Circle> discs{
      {{0, 0.04}, 0.13}, {{0.075, -0.10}, 0.065}, {{-0.075, -0.10}, 0.065}};
  std::vector<Eigen::Vector2d> vertices(static_cast<std::size_t>(count));
  for (int i = 0; i <= count / 2; ++i) {  // from the front over x > 0 to the back
    const double a = kPi * i / (count / 2);
    const Eigen::Vector2d ray(std::sin(a), -std::cos(a));
    double reach = 0.0;
    for (const Circle& d : discs) {
      const double along = d.center_m.dot(ray);
      const double root2 = along * along - d.center_m.squaredNorm() + d.radius_m * d.radius_m;
      if (root2 > 0.0) reach = std::max(reach, along + std::sqrt(root2));
    }
    const bool on_axis = i == 0 || i == count / 2;
    const Eigen::Vector2d p(on_axis ? 0.0 : reach * ray.x(), reach * ray.y());
    vertices[i] = p;
    if (!on_axis) vertices[count - i] = {-p.x(), p.y()};
  }
  return MakePolygon(std::move(vertices));
}

section::FeaturePolygon SplitInThree(section::Polygon outline) {
  section::FeaturePolygon polygon = AsFeature(std::move(outline));
  section::PolygonSplit split{{{}, {}, {}}};
  const auto vertices = polygon.outline.vertices();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    // The two small discs, and what lies on the big one.
    const Eigen::Vector2d& v = vertices[i];
    const bool on_big = (v - Eigen::Vector2d(0, 0.04)).norm() < 0.13 + 1e-9;
    split.pieces[on_big ? 2 : v.x() > 0 ? 0 : 1].push_back(static_cast<int>(i));
  }
  polygon.split = split;
  return polygon;
}

TEST(ApproximatePolygonTest, SplitOutlinesGiveEachPieceItsCircles) {
  Random random(57);
  const section::FeaturePolygon polygon = SplitInThree(ThreeDiscs(128));
  for (const bool symmetric : {false, true}) {
    for (int count = 3; count <= 8; ++count) {
      CircleOptions options;
      options.symmetric = symmetric;
      const PolygonApproximation result = ApproximatePolygon(polygon, count, options, kObserver);
      EXPECT_EQ(static_cast<int>(result.circles.size()), count);
      ExpectCovers(result, polygon.outline, random);
      if (count > 3) continue;
      // One circle for each piece covers the whole piece.
      for (const auto& piece : polygon.split->pieces) {
        const bool covered =
            std::any_of(result.circles.begin(), result.circles.end(), [&](const Circle& c) {
              return std::all_of(piece.begin(), piece.end(), [&](int v) {
                return OutOf({c}, polygon.outline.vertices()[v]) < 2e-9;
              });
            });
        EXPECT_TRUE(covered) << "symmetric " << symmetric;
      }
    }
  }
}

TEST(ApproximatePolygonTest, ASplitThatWastesMuchIsNotUsed) {
  // The rest of this thin ellipse would need a circle as large as all of it.
  section::FeaturePolygon polygon = AsFeature(Ellipse(0.2, 0.08, 128));
  polygon.split = section::PolygonSplit{{{}, {}, {}}};
  for (int i = 0; i < 128; ++i) {
    polygon.split->pieces[i < 12 ? 0 : i < 24 ? 1 : 2].push_back(i);
  }
  section::FeaturePolygon plain = polygon;
  plain.split.reset();
  const auto a = ApproximatePolygon(polygon, 3, {}, kObserver);
  const auto b = ApproximatePolygon(plain, 3, {}, kObserver);
  EXPECT_EQ(a.outside_area_m2, b.outside_area_m2);
}

TEST(ApproximatePolygonTest, TooFewCirclesIgnoreTheSplit) {
  const section::FeaturePolygon polygon = SplitInThree(ThreeDiscs(96));
  section::FeaturePolygon plain = polygon;
  plain.split.reset();
  const auto a = ApproximatePolygon(polygon, 2, {}, kObserver);
  const auto b = ApproximatePolygon(plain, 2, {}, kObserver);
  EXPECT_EQ(a.outside_area_m2, b.outside_area_m2);
}

}  // namespace
}  // namespace capfit::circle
