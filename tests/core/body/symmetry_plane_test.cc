#include "core/body/symmetry_plane.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "core/mannequin/mannequin.h"
#include "core/mesh/prepare_mesh.h"

namespace capfit::body {
namespace {

// A mannequin's nodes; its plane is x = 0 in its own frame.
struct Mirrored {
  CoarseSurface surface;
  MirrorPlane plane;
};

Mirrored Nodes() {
  mannequin::MannequinOptions options;
  options.faces = 64'000;
  options.quads = false;
  const ThreadPool pool(1);
  const mesh::BodyMesh mesh =
      std::move(mesh::PrepareMesh(*mannequin::MakeMannequin(options))->mesh);
  const WorkingCopy copy = MakeWorkingCopy(mesh, pool, NullObserver());
  const Eigen::Vector3d normal = copy.frame.axes * Eigen::Vector3d::UnitX();
  const double offset = normal.dot(copy.frame.FromMesh(Eigen::Vector3d::Zero()));
  return {MakeCoarseSurface(copy, pool), {normal, offset}};
}

// By some thousandths and millimetres, as rings of nodes have it.
MirrorPlane Off(const MirrorPlane& plane) {
  const Eigen::Vector3d across = plane.normal.unitOrthogonal();
  const Eigen::Vector3d other = plane.normal.cross(across);
  return {(plane.normal + 0.004 * across - 0.003 * other).normalized(), plane.offset + 0.002};
}

double AngleTo(const MirrorPlane& a, const MirrorPlane& b) {
  return a.normal.cross(b.normal).norm();
}

TEST(SharpenedPlane, LiesWhereTheBodyMirrorsItself) {
  const Mirrored body = Nodes();
  const MirrorPlane sharp =
      SharpenedPlane(Off(body.plane), MirrorSurface(body.surface), ThreadPool(1));
  EXPECT_LT(AngleTo(sharp, body.plane), 3e-4);
  EXPECT_NEAR(sharp.offset, body.plane.offset, 2e-4);
}

// As by hair to one side, or a bag.
TEST(SharpenedPlane, WhatHasNoImageHasNoSay) {
  Mirrored body = Nodes();
  for (Eigen::Vector3d& p : body.surface.points) {
    const double height = body.plane.normal.dot(p) - body.plane.offset;
    if (height > 0.0 && p.z() > 0.0) p += 0.04 * height * body.plane.normal + 0.02 * p;
  }
  const Mirrored whole = Nodes();
  const MirrorPlane sharp =
      SharpenedPlane(Off(whole.plane), MirrorSurface(body.surface), ThreadPool(1));
  EXPECT_LT(AngleTo(sharp, whole.plane), 2e-3);
  EXPECT_NEAR(sharp.offset, whole.plane.offset, 1e-3);
}

TEST(SharpenedPlane, IsTheSameForAnyNumberOfThreads) {
  const Mirrored body = Nodes();
  const MirrorPlane one =
      SharpenedPlane(Off(body.plane), MirrorSurface(body.surface), ThreadPool(1));
  const MirrorPlane three =
      SharpenedPlane(Off(body.plane), MirrorSurface(body.surface), ThreadPool(3));
  EXPECT_EQ(one.normal, three.normal);
  EXPECT_EQ(one.offset, three.offset);
}

}  // namespace
}  // namespace capfit::body
