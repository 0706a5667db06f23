// The pieces that the finders stand on, against closed forms and brute force.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/base/status.h"
#include "core/body/body_unit.h"
#include "core/body/branches.h"
#include "core/body/cross_section.h"
#include "core/body/surface_graph.h"

namespace capfit::body {
namespace {

struct Surface {
  std::vector<Eigen::Vector3d> points;
  std::vector<mesh::Triangle> triangles;
};

SurfaceGraph GraphOf(const Surface& surface, const ThreadPool& pool = ThreadPool(1)) {
  return {surface.points, surface.triangles,
          mesh::FindEdgeMates(surface.triangles, surface.points.size()).mate, pool};
}

// A closed tube of radius 1 along Z from 0 to `length`, capped at both ends.
Surface Tube(int around, int along, double length) {
  Surface tube;
  for (int i = 0; i <= along; ++i) {
    for (int k = 0; k < around; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / around;
      tube.points.emplace_back(std::cos(angle), std::sin(angle), length * i / along);
    }
  }
  const auto id = [&](int i, int k) { return static_cast<std::uint32_t>(i * around + k % around); };
  for (int i = 0; i < along; ++i) {
    for (int k = 0; k < around; ++k) {
      tube.triangles.push_back({id(i, k), id(i, k + 1), id(i + 1, k + 1)});
      tube.triangles.push_back({id(i, k), id(i + 1, k + 1), id(i + 1, k)});
    }
  }
  const std::uint32_t bottom = static_cast<std::uint32_t>(tube.points.size());
  tube.points.emplace_back(0, 0, 0);
  tube.points.emplace_back(0, 0, length);
  for (int k = 0; k < around; ++k) {
    tube.triangles.push_back({bottom, id(0, k + 1), id(0, k)});
    tube.triangles.push_back({bottom + 1, id(along, k), id(along, k + 1)});
  }
  return tube;
}

TEST(CutSurface, TubeSectionsHaveTheirClosedForms) {
  const Surface tube = Tube(64, 40, 4.0);
  const CutSurface surface(tube.points, tube.triangles);
  const double polygon_area = 0.5 * 64 * std::sin(2.0 * std::numbers::pi / 64);
  for (const double tilt : {0.0, 0.3, 0.6}) {
    const CutPlane plane = {{0.1, 0.0, 2.03}, {std::sin(tilt), 0.0, std::cos(tilt)}};
    const auto loops = surface.Cut(plane);
    ASSERT_EQ(loops.size(), 1u);
    EXPECT_TRUE(loops[0].is_closed);
    EXPECT_NEAR(loops[0].area, polygon_area / std::cos(tilt), 1e-9);  // positive: orientation
    EXPECT_NEAR(loops[0].centroid.x(), 0.0, 1e-9);
    EXPECT_NEAR(plane.Height(loops[0].centroid), 0.0, 1e-12);
    EXPECT_NEAR(loops[0].Max(Eigen::Vector3d::UnitX()), 1.0, 1e-9);
  }
  EXPECT_NEAR(surface.Cut({{0, 0, 1.01}, {0, 0, 1}})[0].girth,
              64 * 2 * std::sin(std::numbers::pi / 64), 1e-9);
  EXPECT_TRUE(surface.Cut({{0, 0, 9}, {0, 0, 1}}).empty());
}

TEST(CutSurface, TwoTubesGiveTwoLoopsAndTheNearestIsTheOneAsked) {
  Surface both = Tube(24, 10, 2.0);
  const std::uint32_t shift = static_cast<std::uint32_t>(both.points.size());
  const Surface other = Tube(16, 10, 2.0);
  for (const Eigen::Vector3d& p : other.points) both.points.push_back(p + Eigen::Vector3d(5, 0, 0));
  for (const mesh::Triangle& t : other.triangles) {
    both.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  }
  const CutSurface surface(both.points, both.triangles);
  EXPECT_EQ(surface.Cut({{0, 0, 1.03}, {0, 0, 1}}).size(), 2u);
  const auto nearest = surface.CutNearest({{4.5, 0, 1.03}, {0, 0, 1}}, 0.1);
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(nearest->centroid.x(), 5.0, 1e-9);
  EXPECT_FALSE(surface.CutNearest({{4.5, 0, 1.03}, {0, 0, 1}}, 100.0));
}

TEST(SurfaceGraph, DistancesOnATubeAreNearThoseOnTheUnrolledSheet) {
  const int around = 48;
  const Surface tube = Tube(around, 60, 6.0);
  const SurfaceGraph graph = GraphOf(tube);
  const std::uint32_t source = 30 * around;  // at angle 0, z = 3
  const auto distance = graph.Distances(std::vector<GeodesicSource>{{source, 0.0}});
  for (int i = 5; i <= 55; ++i) {
    for (int k = 0; k < around; ++k) {
      const double angle = 2.0 * std::numbers::pi * std::min(k, around - k) / around;
      const double truth = std::hypot(angle, 6.0 * i / 60 - 3.0);
      EXPECT_GE(distance[i * around + k], 0.99 * truth);
      EXPECT_LE(distance[i * around + k], 1.12 * truth + 1e-9);
    }
  }
}

TEST(SurfaceGraph, NoEdgeCanShortenADistanceAndSourcesKeepTheirHeadStart) {
  const Surface tube = Tube(20, 30, 5.0);
  const SurfaceGraph graph = GraphOf(tube);
  const std::vector<GeodesicSource> sources = {{7, 0.25}, {433, 0.0}};
  const auto distance = graph.Distances(sources);
  EXPECT_LE(distance[7], 0.25);
  EXPECT_EQ(distance[433], 0.0);
  for (std::uint32_t v = 0; v < tube.points.size(); ++v) {
    for (const std::uint32_t n : graph.Neighbours(v)) {
      EXPECT_LE(distance[n], distance[v] + (tube.points[n] - tube.points[v]).norm() + 1e-6);
    }
  }
}

// Around the middle of a tube all four regions of the search meet, and ways lead back and forth
// between them.
TEST(SurfaceGraph, RegionsAndThreadsLeaveNoTrace) {
  Surface tube = Tube(40, 60, 8.0);
  Random random(5);
  for (Eigen::Vector3d& p : tube.points) {
    p += 0.03 * Eigen::Vector3d(random.NextUnit(), random.NextUnit(), random.NextUnit());
  }
  Surface beside = tube;  // all in one region
  for (Eigen::Vector3d& p : beside.points) p += Eigen::Vector3d(64.0, 64.0, 0.0);
  const SurfaceGraph graph = GraphOf(tube);
  const std::vector<GeodesicSource> sources = {{7, 0.25}, {1233, 0.0}, {2000, 3.0}};
  const std::vector<double> distance = graph.Distances(sources);
  const std::vector<double> in_one_region = GraphOf(beside).Distances(sources);
  for (std::size_t v = 0; v < distance.size(); ++v) {
    EXPECT_NEAR(distance[v], in_one_region[v], 1e-5);
  }
  for (const int threads : {2, 3}) {
    const ThreadPool pool(threads);
    EXPECT_EQ(GraphOf(tube, pool).Distances(sources, pool), distance);
  }
}

// A wedge whose edge is a row of vertices a thousand times closer than the mean edge is long, all
// of them joined to two hubs: neither the row nor the hubs may cost the square of their number.
TEST(SurfaceGraph, DenseRowsAndHubsAreNoTrap) {
  constexpr std::uint32_t kCount = 60'000;
  Surface wedge;
  wedge.points = {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  for (std::uint32_t i = 0; i <= kCount; ++i) {
    wedge.points.emplace_back(1.0 + i / static_cast<double>(kCount), 0.0, 0.0);
  }
  for (std::uint32_t i = 3; i < 3 + kCount; ++i) {
    wedge.triangles.push_back({1, i, i + 1});
    wedge.triangles.push_back({i, 2, i + 1});
  }
  wedge.triangles.push_back({0, 3, 1});
  wedge.triangles.push_back({0, 2, 3});
  wedge.triangles.push_back({3 + kCount, 2, 1});
  wedge.triangles.push_back({0, 1, 2});
  const SurfaceGraph graph = GraphOf(wedge);
  for (const std::uint32_t source : {0u, 3u, 3 + kCount}) {
    const auto distance = graph.Distances(std::vector<GeodesicSource>{{source, 0.0}});
    for (std::uint32_t v = 3; v <= 3 + kCount; v += 500) {
      EXPECT_NEAR(distance[v], std::abs(wedge.points[v].x() - wedge.points[source].x()), 1e-3);
    }
    for (std::uint32_t v = 0; v < wedge.points.size(); v += 100) {
      for (const std::uint32_t n : graph.Neighbours(v)) {
        EXPECT_LE(distance[n], distance[v] + (wedge.points[n] - wedge.points[v]).norm() + 1e-6);
      }
    }
  }
}

TEST(Branches, TheEndsOfATubeStandOutFromItsMiddle) {
  const int around = 24;
  const Surface tube = Tube(around, 40, 8.0);
  const SurfaceGraph graph = GraphOf(tube);
  std::vector<GeodesicSource> ring;  // a little below the middle, so the top is farther
  for (int k = 0; k < around; ++k) {
    ring.push_back({static_cast<std::uint32_t>(19 * around + k), 0.0});
  }
  const auto distance = graph.Distances(ring);
  const auto branches = FindBranches(graph, distance, 0.5);
  ASSERT_EQ(branches.size(), 2u);
  EXPECT_EQ(branches[0].tip, tube.points.size() - 1);
  EXPECT_EQ(branches[1].tip, tube.points.size() - 2);
  EXPECT_EQ(branches[1].parent, 0);
  EXPECT_NEAR(branches[1].saddle_distance, 0.0, 1e-9);
  EXPECT_NEAR(JunctionLevel(branches, 0, 1), 0.0, 1e-9);
}

TEST(BodyUnit, IsTheOneThatMakesAHuman) {
  const auto unit = [](double height) { return ChooseUnit(Unit::kAuto, height)->unit; };
  EXPECT_EQ(unit(1.59), Unit::kMetre);
  EXPECT_EQ(unit(0.75), Unit::kMetre);
  EXPECT_EQ(unit(63.0), Unit::kInch);
  EXPECT_EQ(unit(40.0), Unit::kInch);
  EXPECT_EQ(unit(159.0), Unit::kCentimetre);
  EXPECT_EQ(unit(110.0), Unit::kCentimetre);
  EXPECT_EQ(unit(1590.0), Unit::kMillimetre);
  EXPECT_EQ(ChooseUnit(Unit::kInch, 20.0)->unit, Unit::kInch);  // told
  EXPECT_EQ(ChooseUnit(Unit::kMetre, 0.26)->unit, Unit::kMetre);
  EXPECT_EQ(ChooseUnit(Unit::kMetre, 2.99)->unit, Unit::kMetre);
  EXPECT_EQ(ReasonOf(ChooseUnit(Unit::kAuto, 12.0).status()), ErrorReason::kUnitUnknown);
  EXPECT_EQ(ReasonOf(ChooseUnit(Unit::kAuto, 0.01).status()), ErrorReason::kUnitUnknown);
}

TEST(BodyUnit, ToldWithoutABodyOfThatSizeIsRefused) {
  for (const auto& [unit, height] :
       {std::pair(Unit::kMetre, 159.0), std::pair(Unit::kMetre, 3.01),
        std::pair(Unit::kMetre, 0.24), std::pair(Unit::kCentimetre, 1.59),
        std::pair(Unit::kMillimetre, 159.0), std::pair(Unit::kInch, 159.0)}) {
    const absl::Status status = ChooseUnit(unit, height).status();
    EXPECT_EQ(ReasonOf(status), ErrorReason::kContradictsBody) << height;
    EXPECT_EQ(FieldOf(status), "mesh.unit");
  }
  EXPECT_EQ(std::string(ChooseUnit(Unit::kMetre, 159.0).status().message()),
            "mesh.unit is metres, which makes the body 159 m tall; in centimetres it would be "
            "1.59 m");
}

TEST(BodyUnit, ToldIsDoubtedWhereAnotherIsFarMoreUsualOrNobodyIsSoStout) {
  const auto doubt = [](Unit unit, double height, double volume) {
    return JudgeToldUnit(*ChooseUnit(unit, height), height, volume);
  };
  EXPECT_FALSE(doubt(Unit::kMetre, 1.59, 0.06));     // a woman
  EXPECT_FALSE(doubt(Unit::kMetre, 1.1, 0.018));     // a child
  EXPECT_FALSE(doubt(Unit::kCentimetre, 50, 3400));  // newborn
  EXPECT_FALSE(doubt(Unit::kMetre, 1.6, 0.2));       // among the heaviest
  EXPECT_FALSE(doubt(Unit::kMetre, 2.3, 0.12));
  EXPECT_TRUE(doubt(Unit::kCentimetre, 63, 3700));  // inches: an adult's shape
  EXPECT_TRUE(doubt(Unit::kInch, 112, 18'000));     // centimetres: 2.84 m
  EXPECT_TRUE(doubt(Unit::kMetre, 1.6, 0.02));
  EXPECT_TRUE(doubt(Unit::kMetre, 1.6, 0.3));
  const auto warning = doubt(Unit::kCentimetre, 63, 3700);
  EXPECT_EQ(warning->code, "UNIT_CONTRADICTS_BODY");
  EXPECT_EQ(warning->message,
            "told to be in centimetres, which makes the body 0.63 m tall with 3.7 litres; in "
            "inches it would be 1.6 m");
}

}  // namespace
}  // namespace capfit::body
