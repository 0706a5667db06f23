#include "core/circle/partition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/ties.h"
#include "core/circle/circle_outside_area.h"

namespace capfit::circle {
namespace {

// Radii in a table, evenly spaced up to the farthest point. Costs only rank circles against each
// other; half the spacing or twice changes no result noticeably, and each entry costs an exact
// area.
constexpr int kTableRadii = 10;

double Rounded(double value, double quantum) { return std::rint(value / quantum) * quantum; }

// Outside area of circles around one centre as a function of the radius.
class AreaByRadius {
 public:
  AreaByRadius(const Eigen::Vector2d& center, double largest, const section::Polygon& outline)
      : center_(center), step_(std::max(largest, 1e-12) / kTableRadii), outline_(&outline) {
    known_.fill(false);
  }

  double At(double radius) {
    const double at = radius / step_;
    const int index = std::clamp(static_cast<int>(at), 0, kTableRadii - 1);
    const Entry& low = EntryAt(index);
    const Entry& high = EntryAt(index + 1);
    const double t = at - index;
    const double s = 1.0 - t;
    return s * s * (1.0 + 2.0 * t) * low.area + t * t * (1.0 + 2.0 * s) * high.area +
           step_ * s * t * (s * low.slope - t * high.slope);
  }

 private:
  struct Entry {
    double area = 0.0;
    double slope = 0.0;
  };

  const Entry& EntryAt(int index) {
    if (!known_[index]) {
      const OutsideArea area = CircleOutsideAreaWithGradient({center_, index * step_}, *outline_);
      entries_[index] = {area.area_m2, area.by_radius_m};
      known_[index] = true;
    }
    return entries_[index];
  }

  Eigen::Vector2d center_;
  double step_;
  const section::Polygon* outline_;
  std::array<Entry, kTableRadii + 1> entries_;
  std::array<bool, kTableRadii + 1> known_;
};

// A circle that grows while points come in.
struct Growing {
  AreaByRadius table;
  double weight = 1.0;
  double radius = 0.0;
  double area = 0.0;
};

class Partitioner {
 public:
  Partitioner(std::span<const Eigen::Vector2d> points, std::span<const Seed> seeds,
              const section::Polygon& outline)
      : point_count_(points.size()), seed_count_(seeds.size()) {
    distances_.resize(point_count_ * seed_count_);
    const double quantum = kTie * std::sqrt(outline.area_m2());
    tie_ = kTie * outline.area_m2();
    for (std::size_t i = 0; i < seed_count_; ++i) {
      double largest = 0.0;
      for (std::size_t p = 0; p < point_count_; ++p) {
        const double d = Rounded((points[p] - seeds[i].center_m).norm(), quantum);
        distances_[p * seed_count_ + i] = d;
        largest = std::max(largest, d);
      }
      const double weight = seeds[i].place == Place::kPaired ? 2.0 : 1.0;
      circles_.push_back({AreaByRadius(seeds[i].center_m, largest, outline), weight});
    }
  }

  std::vector<int> Run() {
    std::vector<int> owners(point_count_);
    for (const std::size_t p : Order()) owners[p] = Assign(&distances_[p * seed_count_]);
    return owners;
  }

 private:
  std::vector<std::size_t> Order() const {
    std::vector<double> nearest(point_count_);
    for (std::size_t p = 0; p < point_count_; ++p) {
      const auto begin = distances_.begin() + static_cast<std::ptrdiff_t>(p * seed_count_);
      nearest[p] = *std::min_element(begin, begin + static_cast<std::ptrdiff_t>(seed_count_));
    }
    std::vector<std::size_t> order(point_count_);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&nearest](std::size_t a, std::size_t b) {
      return nearest[a] != nearest[b] ? nearest[a] < nearest[b] : a < b;
    });
    return order;
  }

  int Assign(const double* distances) {
    const int inside = NearestInPower(distances);
    if (inside >= 0) return inside;
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    double best_area = 0.0;
    double best_distance = 0.0;
    for (std::size_t i = 0; i < seed_count_; ++i) {
      Growing& circle = circles_[i];
      const double area = std::max(circle.area, circle.table.At(distances[i]));
      const double cost = circle.weight * (area - circle.area);
      if (cost > least + tie_ || (cost > least - tie_ && distances[i] >= best_distance)) continue;
      best = static_cast<int>(i);
      least = cost;
      best_area = area;
      best_distance = distances[i];
    }
    Growing& winner = circles_[best];
    winner.radius = best_distance;
    winner.area = best_area;
    return best;
  }

  // The circle that has the point inside already; of several the one with the smallest power.
  int NearestInPower(const double* distances) const {
    int best = -1;
    double least = 0.0;
    for (std::size_t i = 0; i < seed_count_; ++i) {
      const double r = circles_[i].radius;
      if (distances[i] > r) continue;
      const double power = distances[i] * distances[i] - r * r;
      if (best < 0 || power < least) {
        best = static_cast<int>(i);
        least = power;
      }
    }
    return best;
  }

  double tie_ = 0.0;  // of costs, m2
  std::size_t point_count_;
  std::size_t seed_count_;
  std::vector<double> distances_;  // point-major
  std::vector<Growing> circles_;
};

}  // namespace

std::vector<int> Partition(std::span<const Eigen::Vector2d> points_m, std::span<const Seed> seeds,
                           const section::Polygon& outline) {
  return Partitioner(points_m, seeds, outline).Run();
}

}  // namespace capfit::circle
