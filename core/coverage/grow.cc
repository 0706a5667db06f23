#include "core/coverage/grow.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/tighten/set_variables.h"
#include "core/tighten/solid_table.h"

namespace capfit::coverage {
namespace {

using geometry::TaperedCapsule;

constexpr int kBisections = 40;
constexpr std::size_t kLocatedTogether = 16;
constexpr double kTableAccuracyM = 1e-6;  // more than tighten::SolidTable errs

// The nearest of the solids.
struct Nearest {
  double distance_m = std::numeric_limits<double>::infinity();
  int solid = -1;
};

void Lower(const std::vector<TaperedCapsule>& shapes, int solid, const Eigen::Vector3d& point,
           Nearest& nearest) {
  const double distance = shapes[solid].SignedDistance(point);
  if (distance < nearest.distance_m) nearest = {distance, solid};
}

geometry::Sphere BallAround(std::span<const Demand> demands) {
  Eigen::AlignedBox3d box;
  for (const Demand& demand : demands) box.extend(demand.point_m);
  geometry::Sphere ball = {box.center(), 0.0};
  for (const Demand& demand : demands) {
    ball.radius_m = std::max(ball.radius_m, (demand.point_m - ball.center_m).norm());
  }
  return ball;
}

class Grower {
 public:
  explicit Grower(capsule::PrimitiveSet& set)
      : set_(set), variables_(set), shapes_(capsule::Solids(set)) {}

  // Of each demand. Those that follow each other mostly lie close together, and few solids can be
  // the nearest of any of them.
  std::vector<Nearest> LocateAll(std::span<const Demand> demands) const {
    std::vector<Nearest> nearest(demands.size());
    if (shapes_.empty()) return nearest;
    const tighten::SolidTable table(shapes_);
    std::vector<double> from_center_m(shapes_.size());
    for (std::size_t begin = 0; begin < demands.size(); begin += kLocatedTogether) {
      const std::size_t end = std::min(demands.size(), begin + kLocatedTogether);
      const geometry::Sphere around = BallAround(demands.subspan(begin, end - begin));
      table.DistancesFrom(around.center_m, from_center_m);
      // No distance changes faster than the point moves.
      const double limit_m = *std::min_element(from_center_m.begin(), from_center_m.end()) +
                             2.0 * around.radius_m + kTableAccuracyM;
      for (int k = 0; k < static_cast<int>(shapes_.size()); ++k) {
        if (from_center_m[k] > limit_m) continue;
        for (std::size_t i = begin; i < end; ++i) Lower(shapes_, k, demands[i].point_m, nearest[i]);
      }
    }
    return nearest;
  }

  // Grows `solid` until it meets the demand; returns the solids that changed.
  std::vector<int> Grow(const Demand& demand, int solid) {
    const capsule::PrimitiveSet before = set_;
    const Eigen::VectorXd direction = DirectionTo(demand.point_m, solid);
    const double missing = shapes_[solid].SignedDistance(demand.point_m) - demand.allowed_m;
    const auto meets = [&](double growth) {
      set_ = before;
      variables_.Apply(growth * direction, set_);
      return ShapeOf(solid).SignedDistance(demand.point_m) <= demand.allowed_m;
    };
    // Half the way is what an unhindered pair of ends needs, but for rounding. Growing all the way
    // is enough wherever the ends may move.
    double low = 0.5 * missing;
    double high = low + 1e-9 * missing + 1e-15;
    if (!meets(high)) {
      high = missing * (1.0 + 1e-9) + 1e-15;
      for (int i = 0; i < kBisections; ++i) {
        const double middle = 0.5 * (low + high);
        (meets(middle) ? high : low) = middle;
      }
    }
    meets(high);
    return Refresh();
  }

  void Relocate(const std::vector<int>& changed, const Eigen::Vector3d& point,
                Nearest& nearest) const {
    for (const int k : changed) Lower(shapes_, k, point, nearest);
  }

 private:
  TaperedCapsule ShapeOf(int solid) const {
    const capsule::CapsuleEnds& ends = variables_.solids()[solid];
    return {set_.spheres[ends[0]], set_.spheres[ends[1]]};
  }

  // Change of the variables per unit of growth. A move never exceeds the growth, so that every
  // sphere contains what it was.
  Eigen::VectorXd DirectionTo(const Eigen::Vector3d& point, int solid) const {
    const geometry::CapsuleDistance at = shapes_[solid].Locate(point);
    const capsule::CapsuleEnds& ends = variables_.solids()[solid];
    Eigen::VectorXd direction = Eigen::VectorXd::Zero(variables_.count());
    std::vector<int> growing;
    if (at.axis_parameter < 1.0) growing.push_back(ends[0]);
    if (at.axis_parameter > 0.0) growing.push_back(ends[1]);
    if (growing.size() == 2 && variables_.of(growing[0]).first == variables_.of(growing[1]).first) {
      // A bar between two images: what one gains sideways the other loses.
      const Eigen::Vector4d common(0.0, at.normal.y(), at.normal.z(), 1.0);
      direction.segment<4>(variables_.of(growing[0]).first) = common;
      return direction;
    }
    for (const int sphere : growing) {
      const Eigen::Vector4d own(at.normal.x(), at.normal.y(), at.normal.z(), 1.0);
      direction.segment<4>(variables_.of(sphere).first) = variables_.ToVariables(sphere, own);
    }
    return direction;
  }

  std::vector<int> Refresh() {
    const std::vector<TaperedCapsule> now = capsule::Solids(set_);
    std::vector<int> changed;
    for (std::size_t k = 0; k < now.size(); ++k) {
      const bool is_same = now[k].a().center_m == shapes_[k].a().center_m &&
                           now[k].b().center_m == shapes_[k].b().center_m &&
                           now[k].a().radius_m == shapes_[k].a().radius_m &&
                           now[k].b().radius_m == shapes_[k].b().radius_m;
      if (!is_same) changed.push_back(static_cast<int>(k));
    }
    shapes_ = now;
    return changed;
  }

  capsule::PrimitiveSet& set_;
  tighten::SetVariables variables_;
  std::vector<TaperedCapsule> shapes_;
};

struct Open {
  Demand demand;
  Nearest nearest;
  double missing() const { return nearest.distance_m - demand.allowed_m; }
};

}  // namespace

bool GrowTo(const Demand& demand, capsule::PrimitiveSet& set) {
  Grower grower(set);
  const Nearest nearest = grower.LocateAll({&demand, 1}).front();
  if (nearest.solid < 0 || nearest.distance_m <= demand.allowed_m) return false;
  grower.Grow(demand, nearest.solid);
  return true;
}

int GrowToAll(std::span<const Demand> demands, const FitObserver& observer,
              capsule::PrimitiveSet& set) {
  Grower grower(set);
  std::vector<Open> open;
  const std::vector<Nearest> nearest = grower.LocateAll(demands);
  for (std::size_t i = 0; i < demands.size(); ++i) {
    const Open candidate{demands[i], nearest[i]};
    if (candidate.nearest.solid >= 0 && candidate.missing() > 0.0) open.push_back(candidate);
  }
  int steps = 0;
  while (!open.empty() && !observer.IsCancelled()) {
    const auto furthest =
        std::max_element(open.begin(), open.end(),
                         [](const Open& a, const Open& b) { return a.missing() < b.missing(); });
    const std::vector<int> changed = grower.Grow(furthest->demand, furthest->nearest.solid);
    ++steps;
    open.erase(furthest);  // met, whatever the last digit says
    for (Open& other : open) grower.Relocate(changed, other.demand.point_m, other.nearest);
    std::erase_if(open, [](const Open& other) { return other.missing() <= 0.0; });
  }
  return steps;
}

}  // namespace capfit::coverage
