#include "core/export/uniform_pieces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/base/status.h"

namespace capfit::exports {
namespace {

using geometry::Sphere;
using geometry::TaperedCapsule;
using Vec3 = Eigen::Vector3d;

constexpr double kOvershoot = 0.004;

class Scenes {
 public:
  TaperedCapsule Next() {
    std::uniform_real_distribution<double> place(-0.3, 0.3);
    std::uniform_real_distribution<double> radius(0.002, 0.2);
    const Sphere a{Vec3(place(rng_), place(rng_), place(rng_)), radius(rng_)};
    return {a, {Vec3(place(rng_), place(rng_), place(rng_)), radius(rng_)}};
  }
  Vec3 Direction() {
    std::normal_distribution<double> normal;
    return Vec3(normal(rng_), normal(rng_), normal(rng_)).normalized();
  }
  double Fraction() { return std::uniform_real_distribution<double>(0.0, 1.0)(rng_); }
  // A point of the hull's surface or within.
  Vec3 PointOf(const TaperedCapsule& hull) {
    const double t = Fraction();
    return (1 - t) * hull.a().center_m + t * hull.b().center_m +
           ((1 - t) * hull.a().radius_m + t * hull.b().radius_m) * Direction();
  }

 private:
  std::mt19937 rng_{11};
};

double Distance(const std::vector<UniformPiece>& pieces, const Vec3& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const UniformPiece& piece : pieces) {
    const TaperedCapsule solid({piece.a, piece.radius_m}, {piece.b, piece.radius_m});
    nearest = std::min(nearest, solid.SignedDistance(point));
  }
  return nearest;
}

TEST(UniformPieces, HoldTheHullAndStandOutByNoMore) {
  Scenes scenes;
  for (int scene = 0; scene < 200; ++scene) {
    const TaperedCapsule hull = scenes.Next();
    const std::vector<UniformPiece> pieces = UniformPieces(hull, kOvershoot);
    for (int i = 0; i < 100; ++i) {
      EXPECT_LE(Distance(pieces, scenes.PointOf(hull)), 1e-9);
      const UniformPiece& piece = pieces[static_cast<std::size_t>(i) % pieces.size()];
      const double t = scenes.Fraction();
      const Vec3 outer = (1 - t) * piece.a + t * piece.b + piece.radius_m * scenes.Direction();
      EXPECT_LE(hull.SignedDistance(outer), kOvershoot + 1e-9);
    }
  }
}

TEST(UniformPieces, AreOneWhereOneDoes) {
  const Sphere a{Vec3(0, 0, 0), 0.1};
  const std::vector<UniformPiece> uniform = UniformPieces({a, {Vec3(0, 0.5, 0), 0.1}}, kOvershoot);
  ASSERT_EQ(uniform.size(), 1U);
  EXPECT_EQ(uniform[0].a, a.center_m);
  EXPECT_TRUE(uniform[0].b.isApprox(Vec3(0, 0.5, 0)));
  EXPECT_FALSE(uniform[0].IsBall());
  const std::vector<UniformPiece> inner = UniformPieces({a, {Vec3(0, 0.01, 0), 0.05}}, kOvershoot);
  ASSERT_EQ(inner.size(), 1U);
  EXPECT_TRUE(inner[0].IsBall());
  EXPECT_EQ(inner[0].radius_m, 0.1);
}

TEST(UniformPieces, HaveNoLengthThatEnginesRefuse) {
  // As steep as can be: each piece would be shorter than what its round end spares.
  const TaperedCapsule steep({Vec3(0, 0, 0), 0.1}, {Vec3(0, 0.0500000001, 0), 0.05});
  ASSERT_FALSE(steep.IsSphere());
  for (const UniformPiece& piece : UniformPieces(steep, 0.001)) {
    EXPECT_TRUE(piece.IsBall() || (piece.b - piece.a).norm() >= 1e-9);
  }
}

TEST(ConeCylinders, WithTheSpheresHoldTheHullAndStandOutByNoMore) {
  Scenes scenes;
  for (int scene = 0; scene < 200; ++scene) {
    const TaperedCapsule hull = scenes.Next();
    const std::vector<UniformPiece> cylinders = ConeCylinders(hull, kOvershoot);
    EXPECT_EQ(cylinders.empty(), hull.IsSphere());
    for (int i = 0; i < 100; ++i) {
      const Vec3 point = scenes.PointOf(hull);
      bool is_in =
          SignedDistance(hull.a(), point) <= 1e-9 || SignedDistance(hull.b(), point) <= 1e-9;
      for (const UniformPiece& c : cylinders) {
        const double along = (point - c.a).dot(hull.axis());
        const double across = (point - c.a - along * hull.axis()).norm();
        is_in = is_in || (along >= -1e-9 && along <= (c.b - c.a).norm() + 1e-9 &&
                          across <= c.radius_m + 1e-9);
      }
      EXPECT_TRUE(is_in);
    }
    for (const UniformPiece& c : cylinders) {
      const Vec3 out = c.radius_m * hull.axis().unitOrthogonal();
      EXPECT_LE(hull.SignedDistance(c.a + out), kOvershoot + 1e-9);
      EXPECT_LE(hull.SignedDistance(c.b + out), kOvershoot + 1e-9);
    }
  }
}

TEST(CheckOvershoot, NamesItsRange) {
  EXPECT_TRUE(CheckOvershoot(kMinOvershootM).ok());
  EXPECT_TRUE(CheckOvershoot(kMaxOvershootM).ok());
  for (const double bad : {0.0, -1.0, 1.0, std::nan("")}) {
    EXPECT_EQ(FieldOf(CheckOvershoot(bad)).value_or(""), "max_overshoot_m");
  }
}

}  // namespace
}  // namespace capfit::exports
