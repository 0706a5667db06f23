#include "core/mesh/column_caster.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/mesh/surface_sums.h"
#include "tests/core/metrics/shapes.h"

namespace capfit::mesh {
namespace {

using Eigen::Vector3d;

ColumnGrid GridOver(const BodyMesh& mesh, const ColumnCaster::Axes& axes, int count) {
  ColumnGrid grid;
  Random random(3);
  const Vector3d step = (mesh.box_max() - mesh.box_min()) / count;
  grid.low_x = mesh.box_min()[axes[0]];
  grid.low_y = mesh.box_min()[axes[1]];
  grid.step_x = step[axes[0]];
  grid.step_y = step[axes[1]];
  for (int i = 0; i < count; ++i) {
    grid.x.push_back(grid.low_x + (i + random.NextUnit()) * grid.step_x);
    grid.y.push_back(grid.low_y + (i + random.NextUnit()) * grid.step_y);
  }
  return grid;
}

std::vector<BodyMesh> Shapes() {
  return {test_shapes::Bracket(), test_shapes::Ball({{0.2, 0, 0}, 1}, 3),
          test_shapes::Box({0, 0, 0}, {1, 2, 3}, 5),
          test_shapes::Capsule({{-1, 0, 0}, 0.3}, {{1, 1, 1}, 0.6}, 12, 3)};
}

// Whether the column through (x, y) passes the triangle, by the side of each edge that it is on.
bool Passes(const BodyMesh& mesh, const Triangle& t, const ColumnCaster::Axes& axes, double x,
            double y) {
  int left = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& a = mesh.vertices()[t[k]];
    const Vector3d& b = mesh.vertices()[t[(k + 1) % 3]];
    const double side =
        (b[axes[0]] - a[axes[0]]) * (y - a[axes[1]]) - (b[axes[1]] - a[axes[1]]) * (x - a[axes[0]]);
    left += side > 0.0 ? 1 : 0;
  }
  return left == 0 || left == 3;
}

TEST(ColumnCasterTest, FindsWhatEveryTriangleIsAskedFor) {
  for (const BodyMesh& mesh : Shapes()) {
    for (const ColumnCaster::Axes& axes : {ColumnCaster::Axes{0, 1, 2}, {1, 2, 0}, {2, 0, 1}}) {
      const ColumnGrid grid = GridOver(mesh, axes, 23);
      const ColumnCaster caster(mesh.vertices(), mesh.triangles(), grid, axes, ThreadPool(1));
      for (std::size_t row = 0; row < grid.y.size(); ++row) {
        std::vector<int> found(grid.x.size() * mesh.triangles().size(), 0);
        for (const ColumnCrossing& crossing : caster.Row(row)) {
          ++found[crossing.column * mesh.triangles().size() + crossing.triangle];
          const Vector3d normal = AreaVector(mesh.vertices(), mesh.triangles()[crossing.triangle]);
          EXPECT_EQ(crossing.turn, normal[axes[2]] > 0.0 ? -1 : 1);
          Vector3d at;
          at[axes[0]] = grid.x[crossing.column];
          at[axes[1]] = grid.y[row];
          at[axes[2]] = crossing.along;
          const Vector3d& corner = mesh.vertices()[mesh.triangles()[crossing.triangle][0]];
          EXPECT_NEAR(normal.normalized().dot(at - corner), 0.0, 1e-12);
        }
        for (std::size_t i = 0; i < found.size(); ++i) {
          const Triangle& t = mesh.triangles()[i % mesh.triangles().size()];
          const double x = grid.x[i / mesh.triangles().size()];
          EXPECT_EQ(found[i], Passes(mesh, t, axes, x, grid.y[row]) ? 1 : 0);
        }
      }
    }
  }
}

TEST(ColumnCasterTest, ColumnsComeInOrderAndCloseEvenThroughCorners) {
  const BodyMesh box = test_shapes::Box({-1, -1, -1}, {1, 1, 1}, 4);
  ColumnGrid grid;
  grid.x = grid.y = {-1.0, -0.5, 0.0, 0.5};
  grid.low_x = grid.low_y = -1.25;
  grid.step_x = grid.step_y = 0.5;
  const ColumnCaster caster(box.vertices(), box.triangles(), grid, {0, 1, 2}, ThreadPool(1));
  for (std::size_t row = 0; row < 4; ++row) {
    const std::vector<ColumnCrossing> crossings = caster.Row(row);
    int winding = 0;
    for (std::size_t i = 0; i < crossings.size(); ++i) {
      winding += crossings[i].turn;
      const bool is_last = i + 1 == crossings.size();
      if (is_last || crossings[i + 1].column != crossings[i].column) {
        EXPECT_EQ(winding, 0);
      } else {
        EXPECT_LE(crossings[i].along, crossings[i + 1].along);
      }
    }
  }
}

TEST(ColumnCasterTest, SameBitsForAnyNumberOfThreads) {
  const BodyMesh ball = test_shapes::Ball({{0.1, 2, -1}, 0.7}, 6);  // several chunks
  const ColumnGrid grid = GridOver(ball, {0, 1, 2}, 50);
  const auto all = [&](int threads) {
    const ThreadPool pool(threads);
    const ColumnCaster caster(ball.vertices(), ball.triangles(), grid, {0, 1, 2}, pool);
    std::vector<double> numbers;
    for (std::size_t row = 0; row < grid.y.size(); ++row) {
      caster.ForEachInRow(row, [&](const ColumnCrossing& crossing) {
        numbers.insert(numbers.end(), {crossing.along, 1.0 * crossing.triangle, 1.0 * crossing.row,
                                       1.0 * crossing.column, 1.0 * crossing.turn});
      });
    }
    return numbers;
  };
  const std::vector<double> one = all(1);
  EXPECT_GT(one.size(), 5000u);
  EXPECT_EQ(all(2), one);
  EXPECT_EQ(all(3), one);
}

TEST(SurfaceSumsTest, AddUpToAreaAndVolume) {
  for (const BodyMesh& mesh : Shapes()) {
    double area = 0.0;
    double volume = 0.0;
    Vector3d closed = Vector3d::Zero();
    for (const Triangle& t : mesh.triangles()) {
      area += AreaVector(mesh.vertices(), t).norm();
      volume += AreaVector(mesh.vertices(), t).z() * Middle(mesh.vertices(), t).z();
      closed += AreaVector(mesh.vertices(), t);
    }
    EXPECT_NEAR(area, mesh.area(), 1e-12 * mesh.area());
    EXPECT_NEAR(volume, mesh.volume(), 1e-12 * mesh.volume());
    EXPECT_NEAR(closed.norm(), 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace capfit::mesh
