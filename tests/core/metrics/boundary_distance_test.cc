#include "core/metrics/boundary_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/metrics/revolved_surface.h"
#include "core/metrics/solid_images.h"

namespace capfit::metrics {
namespace {

using Eigen::Vector3d;
using geometry::Sphere;
using geometry::TaperedCapsule;

const ThreadPool& OneThread() {
  static const ThreadPool pool(1);
  return pool;
}

double At(const BoundaryDistance& boundary, const Vector3d& point) {
  return std::abs(boundary.SignedAt({&point, 1}, OneThread())[0]);
}

Vector3d PointAt(const RevolvedSurface& surface, double arc_length, double angle) {
  const RevolvedSurface::Ring ring = surface.RingAt(arc_length);
  return ring.center_m + ring.radius_m * surface.Outward(angle);
}

double LeastDistance(const std::vector<TaperedCapsule>& solids, const Vector3d& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const TaperedCapsule& solid : solids) {
    least = std::min(least, solid.SignedDistance(point));
  }
  return least;
}

Vector3d RandomPoint(Random& random, double reach) {
  return {random.NextIn(-reach, reach), random.NextIn(-reach, reach), random.NextIn(-reach, reach)};
}

std::vector<TaperedCapsule> RandomSolids(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Sphere> spheres;
  for (int i = 0; i < count; ++i) {
    spheres.push_back({RandomPoint(random, 0.8), random.NextIn(0.2, 0.6)});
  }
  std::vector<TaperedCapsule> solids;
  for (int i = 0; i < count; ++i) solids.emplace_back(spheres[i], spheres[(i + 1) % count]);
  return solids;
}

// The solids and their images in the plane x = 0, with a bar across it.
std::vector<TaperedCapsule> WithImages(const std::vector<TaperedCapsule>& solids) {
  const auto image = [](const Sphere& s) {
    return Sphere{{-s.center_m.x(), s.center_m.y(), s.center_m.z()}, s.radius_m};
  };
  std::vector<TaperedCapsule> all = solids;
  for (const TaperedCapsule& solid : solids) {
    all.emplace_back(image(solid.b()), image(solid.a()));  // whichever end comes first
  }
  all.emplace_back(solids.front().a(), image(solids.front().a()));
  return all;
}

TEST(RevolvedSurfaceTest, LiesOnTheSolidAndReachesItsPoles) {
  for (const TaperedCapsule& solid : {TaperedCapsule({{0, 0, 0}, 0.5}, {{0, 1, 1}, 0.2}),
                                      TaperedCapsule({{0, 0, 0}, 0.1}, {{2, 0, 0}, 0.9}),
                                      TaperedCapsule({{0, 0, 0}, 0.1}, {{0.2, 0, 0}, 0.9}),
                                      TaperedCapsule({{1, 2, 3}, 0.4}, {{1, 2, 3}, 0.4})}) {
    const RevolvedSurface surface(solid);
    for (int i = 0; i <= 40; ++i) {
      const Vector3d point = PointAt(surface, surface.profile_length_m() * i / 40, 0.7 * i);
      EXPECT_NEAR(solid.SignedDistance(point), 0.0, 1e-12);
    }
    const Vector3d first = PointAt(surface, 0, 0);
    const Vector3d last = PointAt(surface, surface.profile_length_m(), 0);
    EXPECT_GT((last - first).dot(solid.axis()), 0.0);
    EXPECT_NEAR((last - first).cross(solid.axis()).norm(), 0.0, 1e-12);
  }
}

class TwoBallsTest : public testing::Test {
 protected:
  // Unit balls at x = -0.5 and 0.5: the crease is the circle of radius sqrt(3)/2 at x = 0.
  const std::vector<TaperedCapsule> solids_ = {{{{-0.5, 0, 0}, 1}, {{-0.5, 0, 0}, 1}},
                                               {{{0.5, 0, 0}, 1}, {{0.5, 0, 0}, 1}}};
  const BoundaryDistance boundary_{solids_, 2000, OneThread()};
};

TEST_F(TwoBallsTest, MeasuresToTheCreaseWhereTheNearestSurfaceIsHidden) {
  const double ring = std::sqrt(0.75);
  EXPECT_NEAR(At(boundary_, {0, 0, 0}), ring, 1e-6);
  EXPECT_NEAR(At(boundary_, {0, 0.3, 0.4}), ring - 0.5, 1e-6);
  EXPECT_NEAR(At(boundary_, {0.05, 0, 0.2}), std::hypot(0.05, ring - 0.2), 1e-5);
  EXPECT_NEAR(At(boundary_, {-0.1, 0.1, 0}), std::hypot(0.1, ring - 0.1), 1e-5);
}

TEST_F(TwoBallsTest, MeasuresToTheBallWhereItsSurfaceIsExposed) {
  EXPECT_NEAR(At(boundary_, {0.9, 0, 0}), 0.6, 1e-12);
  EXPECT_NEAR(At(boundary_, {-0.6, 0.5, 0}), 1 - std::hypot(0.1, 0.5), 1e-12);
}

TEST_F(TwoBallsTest, MeasuresFromOutside) {
  EXPECT_NEAR(At(boundary_, {2, 0, 0}), 0.5, 1e-12);
  EXPECT_NEAR(At(boundary_, {0, 1.5, 0}), std::hypot(0.5, 1.5) - 1, 1e-12);
}

// The cloud's points lie on the boundary, so the truth is not further than the nearest of them, and
// by at most their spacing (some 9 mm) nearer.
TEST(BoundaryDistanceTest, AgreesWithADenseCloudOnRandomSets) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const std::vector<TaperedCapsule> solids =
        seed <= 4 ? RandomSolids(6, 10 + seed) : WithImages(RandomSolids(3, 10 + seed));
    const BoundaryDistance boundary(solids, 20'000, OneThread());
    std::vector<Vector3d> cloud;
    for (const TaperedCapsule& solid : solids) {
      const RevolvedSurface surface(solid);
      for (int row = 0; row < 300; ++row) {
        for (int column = 0; column < 300; ++column) {
          const Vector3d point =
              PointAt(surface, surface.profile_length_m() * (row + 0.5) / 300, 0.0209439 * column);
          if (LeastDistance(solids, point) >= -1e-6) cloud.push_back(point);
        }
      }
    }
    Random random(seed);
    int hidden = 0;
    for (int i = 0; i < 300; ++i) {
      const Vector3d point = RandomPoint(random, 0.9);
      const double least = LeastDistance(solids, point);
      if (least >= 0.0) continue;
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vector3d& p : cloud) nearest = std::min(nearest, (p - point).norm());
      const double found = At(boundary, point);
      hidden += found > -least + 1e-6 ? 1 : 0;
      EXPECT_GE(found, -least);
      EXPECT_GE(found, nearest - 0.009) << "seed " << seed << " point " << point.transpose();
      EXPECT_LE(found, nearest + 2e-4) << "seed " << seed << " point " << point.transpose();
    }
    EXPECT_GT(hidden, 10) << "the cloud must test creases";
  }
}

TEST(BoundaryDistanceTest, SameBitsForAnyNumberOfThreads) {
  const std::vector<TaperedCapsule> solids = RandomSolids(9, 30);
  Random random(31);
  std::vector<Vector3d> points;
  for (int i = 0; i < 2000; ++i) points.push_back(RandomPoint(random, 0.9));
  const std::vector<double> one =
      BoundaryDistance(solids, 5000, OneThread()).SignedAt(points, OneThread());
  for (const int threads : {2, 3, 7}) {
    const ThreadPool pool(threads);
    EXPECT_EQ(BoundaryDistance(solids, 5000, pool).SignedAt(points, pool), one);
  }
}

TEST(BoundaryDistanceTest, OfASetThatIsItsOwnImageIsItsOwnImage) {
  const std::vector<TaperedCapsule> solids = WithImages(RandomSolids(5, 40));
  const BoundaryDistance boundary(solids, 5000, OneThread());
  Random random(41);
  for (int i = 0; i < 500; ++i) {
    const Vector3d point = RandomPoint(random, 0.9);
    const Vector3d image(-point.x(), point.y(), point.z());
    EXPECT_NEAR(At(boundary, image), At(boundary, point), 1e-4);
  }
}

TEST(SolidImagesTest, AreFoundWhicheverEndComesFirst) {
  const std::vector<TaperedCapsule> solids = WithImages(RandomSolids(4, 50));
  EXPECT_EQ(ImagesByPlace(solids), (std::vector<std::int32_t>{4, 5, 6, 7, 0, 1, 2, 3, 8}));
  EXPECT_TRUE(ImagesByPlace({}).empty());
  // Rounding is no matter; one that has no image leaves all without.
  for (const double off_m : {1e-12, 1e-6}) {
    std::vector<TaperedCapsule> off = solids;
    const Sphere a = off[6].a();
    off[6] = TaperedCapsule({a.center_m, a.radius_m + off_m}, off[6].b());
    EXPECT_EQ(ImagesByPlace(off).empty(), off_m > 1e-9);
  }
}

TEST(BoundaryDistanceTest, WithoutSolidsIsInfinite) {
  EXPECT_EQ(At(BoundaryDistance({}, 100, OneThread()), {0, 0, 0}),
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace capfit::metrics
