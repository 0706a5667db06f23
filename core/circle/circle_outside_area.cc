#include "core/circle/circle_outside_area.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace capfit::circle {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

constexpr int kEdges = 16;                          // at once
using Lanes = Eigen::Array<double, kEdges, 1>;      // of edges
using Block = Eigen::Array<double, kEdges + 1, 1>;  // of their ends

// What walking along the outline, seen from the circle's centre, adds up to.
//
// The part of the walk inside the disc sweeps triangles (eq. 3's A_tri), twice whose area goes to
// `twice_inside`. The part outside is replaced by its central projection onto the circle: an angle
// and the chord between its ends. Green's theorem then gives the area of disc-and-outline as
// twice_inside / 2 + r^2 angle / 2, signs included, wherever the centre lies.
//
// Angles of one outside stretch telescope: only its ends matter, and the turns in between are
// counted where the walk crosses the negative x axis. Those ends are directions, whose angles add
// up as complex numbers multiply: one arc tangent serves the whole walk.
class Walk {
 public:
  explicit Walk(double radius) : radius_(radius), radius2_(radius * radius) {}

  // The edges from each point to the next, given around the circle's centre. Nearly all lie wholly
  // inside or wholly outside and are done together, a few operations each.
  void Edges(const Block& x, const Block& y) {
    const auto ux = x.head<kEdges>();
    const auto uy = y.head<kEdges>();
    const auto vx = x.tail<kEdges>();
    const auto vy = y.tail<kEdges>();
    const Block square = x * x + y * y;
    const auto u2 = square.head<kEdges>();
    const auto v2 = square.tail<kEdges>();
    const Lanes inside = (u2.max(v2) <= radius2_).select(ux * vy - uy * vx, Lanes::Zero());
    twice_inside_ += inside.sum();
    // No point of an edge is nearer than its nearer end by more than Pythagoras allows.
    const Lanes length2 = (vx - ux).square() + (vy - uy).square();
    const Lanes clearance = 4.0 * (u2.min(v2) - radius2_) - length2;
    for (int i = 0; i < kEdges; ++i) {
      const bool u_inside = square[i] <= radius2_;
      const bool v_inside = square[i + 1] <= radius2_;
      if (u_inside && v_inside) continue;
      if (clearance[i] > 0.0 && (y[i] < 0.0) == (y[i + 1] < 0.0)) continue;
      Clip(x[i], y[i], square[i], x[i + 1], y[i + 1], u_inside, v_inside, length2[i]);
    }
  }

  [[nodiscard]] OutsideArea Result() const {
    OutsideArea result;
    const double angle = std::atan2(direction_y_ + 0.0, direction_x_);  // no -0.0
    const double outside_angle = kTwoPi * (1.0 - turns_) - angle;
    result.area_m2 = std::clamp(0.5 * radius2_ * outside_angle - 0.5 * twice_inside_, 0.0,
                                std::numbers::pi * radius2_);
    result.by_radius_m = radius_ * outside_angle;
    // A move of the circle gains area on its outside arcs: minus the integral of the normal over
    // the arcs inside the outline, because over the whole circle it is 0.
    result.by_center_m = Eigen::Vector2d(-radius_ * chord_y_, radius_ * chord_x_);
    return result;
  }

 private:
  void Clip(double ux, double uy, double u2, double vx, double vy, bool u_inside, bool v_inside,
            double length2) {
    const double ex = vx - ux;
    const double ey = vy - uy;
    const double half_b = ux * ex + uy * ey;  // |u + t e|^2 = u2 + 2 t half_b + t^2 length2
    const double root2 = half_b * half_b - length2 * (u2 - radius2_);
    if (!u_inside && !v_inside && (root2 <= 0.0 || half_b >= 0.0 || half_b + length2 <= 0.0)) {
      CountCrossing(uy, vy, ux * vy - uy * vx);
      return;
    }
    const double root = std::sqrt(std::max(0.0, root2));
    const double t_in = u_inside ? 0.0 : std::clamp((-half_b - root) / length2, 0.0, 1.0);
    const double t_out = v_inside ? 1.0 : std::clamp((-half_b + root) / length2, t_in, 1.0);
    const double ax = ux + t_in * ex;
    const double ay = uy + t_in * ey;
    const double bx = ux + t_out * ex;
    const double by = uy + t_out * ey;
    twice_inside_ += ax * by - ay * bx;
    if (!u_inside) {
      CountCrossing(uy, ay, ux * ay - uy * ax);
      Enter(ax, ay);
    }
    if (!v_inside) {
      Leave(bx, by);
      CountCrossing(by, vy, bx * vy - by * vx);
    }
  }

  // An outside stretch ends, respectively begins, at this point of the circle.
  void Enter(double x, double y) {
    const double scale = 1.0 / std::sqrt(x * x + y * y);
    chord_x_ += scale * x;
    chord_y_ += scale * y;
    AddAngle(scale * x, scale * y);
  }
  void Leave(double x, double y) {
    const double scale = 1.0 / std::sqrt(x * x + y * y);
    chord_x_ -= scale * x;
    chord_y_ -= scale * y;
    // The negative x axis is its own image: half a turn once more, not half a turn back.
    if (y == 0.0 && x < 0.0) --turns_;
    AddAngle(scale * x, -scale * y);
  }
  // Angles lie in (-pi, pi]; where a sum leaves them a turn is counted. That needs two that turn
  // the same way, not both by less than a quarter, and is certain where both turn by more.
  void AddAngle(double x, double y) {
    const double sum_x = direction_x_ * x - direction_y_ * y;
    const double sum_y = direction_x_ * y + direction_y_ * x;
    const bool is_up = y >= 0.0;
    if ((direction_y_ >= 0.0) == is_up && !(direction_x_ > 0.0 && x > 0.0)) {
      const bool is_sure = direction_x_ < 0.0 && x < 0.0;
      if (is_sure || (sum_y >= 0.0) != is_up) turns_ += is_up ? 1 : -1;
    }
    direction_x_ = sum_x;
    direction_y_ = sum_y;
  }
  void CountCrossing(double from_y, double to_y, double cross) {
    if (from_y >= 0.0 && to_y < 0.0 && cross > 0.0) ++turns_;
    if (from_y < 0.0 && to_y >= 0.0 && cross < 0.0) --turns_;
  }

  double radius_;
  double radius2_;
  double twice_inside_ = 0.0;
  double direction_x_ = 1.0;  // whose angle is that of the stretches' ends but for turns
  double direction_y_ = 0.0;
  double chord_x_ = 0.0;
  double chord_y_ = 0.0;
  int turns_ = 0;
};

}  // namespace

OutsideArea CircleOutsideAreaWithGradient(const Circle& circle, const section::Polygon& outline) {
  if (!(circle.radius_m > 0.0)) return {};
  const std::span<const Eigen::Vector2d> vertices = outline.vertices();
  Walk walk(circle.radius_m);
  Block x;
  Block y;
  const auto put = [&](Eigen::Index at, const Eigen::Vector2d& vertex) {
    x[at] = vertex.x() - circle.center_m.x();
    y[at] = vertex.y() - circle.center_m.y();
  };
  put(kEdges, vertices.back());
  for (std::size_t begin = 0; begin < vertices.size(); begin += kEdges) {
    x[0] = x[kEdges];
    y[0] = y[kEdges];
    // After the last vertex edges of length 0, which add nothing.
    for (std::size_t i = 0; i < kEdges; ++i) {
      put(static_cast<Eigen::Index>(i) + 1, vertices[std::min(begin + i, vertices.size() - 1)]);
    }
    walk.Edges(x, y);
  }
  return walk.Result();
}

double CircleOutsideArea(const Circle& circle, const section::Polygon& outline) {
  return CircleOutsideAreaWithGradient(circle, outline).area_m2;
}

}  // namespace capfit::circle
