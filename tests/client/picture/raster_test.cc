#include "client/picture/raster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "client/picture/view.h"

namespace capfit::client {
namespace {

using Eigen::Vector3d;
using geometry::Sphere;
using geometry::TaperedCapsule;

constexpr double kHalfTurn = std::numbers::pi;

int CoveredSamples(const Raster& raster) {
  int count = 0;
  for (int j = 0; j < raster.height(); ++j) {
    for (int i = 0; i < raster.width(); ++i) count += raster.at(i, j).id >= 0;
  }
  return count;
}

TEST(ViewTest, FrontSideAndBackShowTheRightAxes) {
  const Vector3d left(1, 0, 0);
  const Vector3d front(0, 0, 1);
  const View from_front(0.0, Vector3d::Zero(), 100, 100, 10);
  EXPECT_NEAR(from_front.Project(left).x(), 110, 1e-9);
  EXPECT_NEAR(from_front.Project(front).z(), 1, 1e-9);
  EXPECT_NEAR(from_front.Project({0, 1, 0}).y(), 90, 1e-9);  // up is up
  const View from_left(kHalfTurn / 2, Vector3d::Zero(), 100, 100, 10);
  EXPECT_NEAR(from_left.Project(left).z(), 1, 1e-9);
  EXPECT_NEAR(from_left.Project(front).x(), 90, 1e-9);
  const View from_behind(kHalfTurn, Vector3d::Zero(), 100, 100, 10);
  EXPECT_NEAR(from_behind.Project(left).x(), 90, 1e-9);
}

TEST(ViewTest, PointAtIsTheInverseOfProject) {
  const View view(0.7, {0.1, 0.9, -0.2}, 240, 200, 300);
  const Vector3d point = view.PointAt(13.5, 371.25) + 0.4 * view.toward_eye();
  const Vector3d seen = view.Project(point);
  EXPECT_LT((seen - Vector3d(13.5, 371.25, 0.4)).norm(), 1e-9);
}

TEST(RasterTest, SphereCoversExactlyItsDisc) {
  const View view(0.3, {0, 1, 0}, 100, 100, 200);
  const Sphere sphere{{0.05, 1.1, 0.2}, 0.25};
  Raster raster(200, 200);
  raster.DrawCapsules(std::vector<TaperedCapsule>{{sphere, sphere}}, view);
  const Vector3d center = view.Project(sphere.center_m);
  for (int j = 0; j < 200; ++j) {
    for (int i = 0; i < 200; ++i) {
      const double distance = std::hypot(i + 0.5 - center.x(), j + 0.5 - center.y());
      if (std::abs(distance - 50.0) < 1e-6) continue;
      ASSERT_EQ(raster.at(i, j).id >= 0, distance < 50.0) << i << ", " << j;
    }
  }
  EXPECT_NEAR(CoveredSamples(raster), kHalfTurn * 50 * 50, 30);
}

TEST(ViewTest, AxesStaySquareFromAbove) {
  for (const double yaw_rad : {0.0, 0.7, 1.5, 3.0, 4.5}) {
    for (const double pitch_rad : {-0.9, 0.0, 0.4, 1.2}) {
      const View view(yaw_rad, {0.1, 1, 0}, 10, 20, 50, pitch_rad);
      EXPECT_NEAR(view.right().cross(view.up()).dot(view.toward_eye()), 1.0, 1e-12);
      EXPECT_NEAR(view.toward_eye().y(), std::sin(pitch_rad), 1e-12);
      EXPECT_EQ(view.right().y(), 0.0);
      const Vector3d seen = view.Project({0.3, 0.7, -0.2});
      const Vector3d back = view.PointAt(seen.x(), seen.y()) + seen.z() * view.toward_eye();
      EXPECT_LT((back - Vector3d(0.3, 0.7, -0.2)).norm(), 1e-12);
    }
  }
}

TEST(RasterTest, SphereIsAsNearAsItsSurface) {
  const View view(0.0, Vector3d::Zero(), 100.5, 100.5, 100);
  const Sphere sphere{{0, 0, 0.3}, 0.2};
  Raster raster(201, 201);
  raster.DrawCapsules(std::vector<TaperedCapsule>{{sphere, sphere}}, view);
  EXPECT_NEAR(raster.at(100, 100).depth, 0.5, 1e-6);
}

TEST(RasterTest, CapsuleCoversTheAreaOfItsOutline) {
  // Across the view: two half discs and the trapezium between their tangent points.
  const double length = 1.0;
  const double ra = 0.3;
  const double rb = 0.1;
  const double sine = (ra - rb) / length;
  const double cosine = std::sqrt(1 - sine * sine);
  const double lean = std::asin(sine);
  const double area = ra * ra * (kHalfTurn / 2 + lean) + rb * rb * (kHalfTurn / 2 - lean) +
                      (ra + rb) * length * cosine;
  const View view(0.0, Vector3d::Zero(), 300, 150, 200);
  Raster raster(600, 300);
  raster.DrawCapsules(
      std::vector<TaperedCapsule>{{Sphere{{-0.5, 0, 0}, ra}, Sphere{{0.5, 0, 0}, rb}}}, view);
  EXPECT_NEAR(CoveredSamples(raster), area * 200 * 200, 60);
}

TEST(RasterTest, NearerTriangleHidesTheOther) {
  const std::vector<Vector3d> vertices = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0},
                                          {-1, -1, 1}, {1, -1, 1}, {0, 1, 1}};
  const std::vector<mesh::Triangle> triangles = {{0, 1, 2}, {3, 4, 5}};
  Raster front(100, 100);
  front.DrawMesh(vertices, triangles, View(0.0, Vector3d::Zero(), 50, 50, 40));
  EXPECT_EQ(front.at(50, 50).id, 1);
  EXPECT_NEAR(front.at(50, 50).depth, 1.0, 1e-6);
  EXPECT_EQ(front.at(1, 1).id, -1);
  Raster back(100, 100);
  back.DrawMesh(vertices, triangles, View(kHalfTurn, Vector3d::Zero(), 50, 50, 40));
  EXPECT_EQ(back.at(50, 50).id, 0);
}

TEST(RasterTest, TriangleCoversItsAreaAndNeighboursLeaveNoGap) {
  const std::vector<Vector3d> vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  const std::vector<mesh::Triangle> triangles = {{0, 1, 2}, {0, 2, 3}};
  Raster raster(120, 120);
  raster.DrawMesh(vertices, triangles, View(0.0, Vector3d::Zero(), 60, 60, 50));
  EXPECT_EQ(CoveredSamples(raster), 100 * 100);
}

TEST(RasterTest, WhatLiesOutsideThePictureIsCutOff) {
  const Sphere huge{{0, 0, 0}, 10.0};
  Raster raster(40, 30);
  raster.DrawCapsules(std::vector<TaperedCapsule>{{huge, huge}},
                      View(0.0, Vector3d::Zero(), 20, 15, 100));
  EXPECT_EQ(CoveredSamples(raster), 40 * 30);
  Raster away(40, 30);
  away.DrawCapsules(std::vector<TaperedCapsule>{{huge, huge}}, View(0.0, {100, 0, 0}, 20, 15, 100));
  EXPECT_EQ(CoveredSamples(away), 0);
}

}  // namespace
}  // namespace capfit::client
