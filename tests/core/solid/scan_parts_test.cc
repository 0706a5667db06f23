#include "core/solid/scan_parts.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/formats/read_mesh.h"
#include "core/mannequin/mannequin.h"
#include "tests/core/mesh/soups.h"
#include "tests/core/solid/solid_shapes.h"
#include "tests/support/avatars.h"
#include "tests/support/bodies.h"

namespace capfit::solid {
namespace {

Triangles Somebody() { return TrianglesOf(*mannequin::MakeMannequin({})); }

ScanParts Parts(const Triangles& scan) {
  return FindScanParts(scan.positions, scan.triangles, NullObserver());
}

std::size_t CountOf(const ScanParts& parts, ScanPart part) {
  return static_cast<std::size_t>(
      std::count(parts.of_triangle.begin(), parts.of_triangle.end(), part));
}

Triangles Noisy(Triangles scan, double amplitude) {
  Random random(3);
  for (Eigen::Vector3d& p : scan.positions) {
    for (int k = 0; k < 3; ++k) p[k] += amplitude * (2.0 * random.NextUnit() - 1.0);
  }
  return scan;
}

// The floor's triangles and no other, although the soles touch it.
void ExpectFloorIsFound(const Triangles& body, const Triangles& floor, const char* what) {
  const ScanParts parts = Parts(Both(body, floor));
  ASSERT_TRUE(parts.floor.has_value()) << what;
  EXPECT_EQ(CountOf(parts, ScanPart::kFloor), floor.triangles.size()) << what;
  EXPECT_EQ(std::count(parts.of_triangle.begin(), parts.of_triangle.begin() + body.triangles.size(),
                       ScanPart::kBody),
            body.triangles.size())
      << what;
}

TEST(ScanPartsTest, FindsFloorsBelowUnjoinedFeet) {
  const Triangles body = Somebody();
  ExpectFloorIsFound(body, Sheet(0.6, -0.002, 60), "sheet");
  ExpectFloorIsFound(body, Sheet(0.6, -0.002, 1), "sheet of two triangles");
  ExpectFloorIsFound(Noisy(body, 0.003), Noisy(Sheet(0.5, -0.002, 50), 0.003), "noisy sheet");
  Triangles tilted = Sheet(0.6, 0.0, 60);
  const Eigen::AngleAxisd lean(5.0 * std::numbers::pi / 180.0,
                               Eigen::Vector3d(1.0, 0.0, 0.4).normalized());
  for (Eigen::Vector3d& p : tilted.positions) p = lean * p - Eigen::Vector3d(0.0, 0.03, 0.0);
  ExpectFloorIsFound(body, tilted, "leaning sheet");
  Triangles disc = Tube(1.0, 0.0, 1.0, 90, 8);  // rings become circles of a turntable
  for (Eigen::Vector3d& p : disc.positions) {
    p = Eigen::Vector3d(0.35 * (0.05 + p.y()) * p.x(), -0.002, 0.35 * (0.05 + p.y()) * p.z());
  }
  ExpectFloorIsFound(body, disc, "turntable");
  ExpectFloorIsFound(body, TrianglesOf(mesh::Box({-0.3, -0.35, -0.3}, {0.3, -0.001, 0.3})), "box");
}

TEST(ScanPartsTest, FindsFloorsAlongAnyAxis) {
  const Triangles scan = Both(Somebody(), Sheet(0.6, -0.002, 60));
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 1)}) {
    Triangles turned = scan;
    const Eigen::AngleAxisd turn(-std::numbers::pi / 2.0, axis);
    for (Eigen::Vector3d& p : turned.positions) p = turn * p;
    const ScanParts parts = Parts(turned);
    ASSERT_TRUE(parts.floor.has_value());
    EXPECT_GT(parts.floor->up.dot(turn * Eigen::Vector3d::UnitY()), 0.999);
    EXPECT_EQ(CountOf(parts, ScanPart::kFloor), Sheet(0.6, 0.0, 60).triangles.size());
  }
}

// Feet that melt into the floor, without soles: the body ends just above it.
TEST(ScanPartsTest, CutsJoinedFloors) {
  Triangles scan = Somebody();
  std::erase_if(scan.triangles, [&](const mesh::Triangle& t) {
    return std::all_of(t.begin(), t.end(),
                       [&](std::uint32_t v) { return scan.positions[v].y() < 0.01; });
  });
  std::vector<std::uint32_t> rim;
  for (std::uint32_t v = 0; v < scan.positions.size(); ++v) {
    if (scan.positions[v].y() < 0.01) rim.push_back(v);
    scan.positions[v].y() = std::max(scan.positions[v].y(), 0.0);
  }
  const auto floor_begin = static_cast<std::uint32_t>(scan.positions.size());
  scan = Both(scan, Sheet(0.5, 0.0, 50));
  for (const std::uint32_t v : rim) scan.triangles.push_back({v, floor_begin, floor_begin + 1});
  const ScanParts parts = Parts(scan);
  ASSERT_TRUE(parts.floor.has_value());
  for (std::size_t t = 0; t < scan.triangles.size(); ++t) {
    double top = 0.0;
    for (const std::uint32_t v : scan.triangles[t]) top = std::max(top, scan.positions[v].y());
    // The plane is fitted to samples of feet, too: it may lean a little.
    if (std::abs(top - parts.floor->margin) < 0.002) continue;
    EXPECT_EQ(parts.of_triangle[t] == ScanPart::kFloor, top < parts.floor->margin) << top;
  }
  EXPECT_LT(parts.floor->margin, 0.01);
}

TEST(ScanPartsTest, NobodyLosesSolesWithoutAFloor) {
  for (const mannequin::MannequinPose pose :
       {mannequin::MannequinPose::kT, mannequin::MannequinPose::kA}) {
    mannequin::MannequinOptions options;
    options.pose = pose;
    const ScanParts parts = Parts(TrianglesOf(*mannequin::MakeMannequin(options)));
    EXPECT_FALSE(parts.floor.has_value());
    EXPECT_EQ(CountOf(parts, ScanPart::kBody), parts.of_triangle.size());
  }
  CAPFIT_REQUIRE_BODIES();
  for (const std::filesystem::path& file : test_support::BodyFiles()) {
    const std::string bytes = test_support::ReadFile(file);
    const auto soup = formats::ReadMesh(std::as_bytes(std::span(bytes)));
    ASSERT_TRUE(soup.ok()) << soup.status();
    const ScanParts parts = Parts(TrianglesOf(*soup));
    EXPECT_FALSE(parts.floor.has_value()) << file;
    EXPECT_EQ(CountOf(parts, ScanPart::kBody), parts.of_triangle.size()) << file;
  }
}

// A column with a flat end, as of a robe: nothing of its end is bare.
TEST(ScanPartsTest, FlatEndsOfClosedPartsAreNoFloor) {
  const Triangles column = TrianglesOf(mesh::Box({-0.25, 0.0, -0.2}, {0.25, 1.6, 0.2}));
  EXPECT_FALSE(Parts(column).floor.has_value());
}

TEST(ScanPartsTest, SmallPiecesAreFragments) {
  const Triangles body = Somebody();
  const Triangles crumb = TrianglesOf(mesh::Moved(mesh::Ball(6, 4, 0.02), {0.5, 1.5, 0.0}));
  const ScanParts parts = Parts(Both(Both(body, crumb), crumb));
  EXPECT_EQ(CountOf(parts, ScanPart::kBody), body.triangles.size());
  // Both crumbs lie in one place: they are one piece.
  EXPECT_EQ(parts.fragments, 1u);
  EXPECT_EQ(CountOf(parts, ScanPart::kFragment), 2 * crumb.triangles.size());
}

TEST(ScanPartsTest, TellsTheScanWithTruthApart) {
  CAPFIT_REQUIRE_AVATARS();
  const std::string bytes = test_support::ReadFile(test_support::AvatarsFolder() / "scan_like.glb");
  const auto soup = formats::ReadMesh(std::as_bytes(std::span(bytes)));
  ASSERT_TRUE(soup.ok()) << soup.status();
  const ScanParts parts = Parts(TrianglesOf(*soup));
  // As truth.json has it: body, floor, seven fragments, in this order.
  ASSERT_EQ(parts.of_triangle.size(), 60'592u);
  for (std::size_t t = 0; t < parts.of_triangle.size(); ++t) {
    const ScanPart expected = t < 57'508   ? ScanPart::kBody
                              : t < 60'122 ? ScanPart::kFloor
                                           : ScanPart::kFragment;
    ASSERT_EQ(parts.of_triangle[t], expected) << t;
  }
  EXPECT_EQ(parts.fragments, 7u);
}

}  // namespace
}  // namespace capfit::solid
