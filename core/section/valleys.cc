#include "core/section/valleys.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace capfit::section {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kMiddleReach = 25.0 * kDegree;
constexpr double kSideNear = 35.0 * kDegree;
constexpr double kSideFar = 110.0 * kDegree;
constexpr double kSmoothing = 4.0 / 360.0;  // of the outline's vertices: standard deviation

// The outline as seen from the middle of its extents, `outward` ahead and the left hand positive.
class View {
 public:
  View(std::span<const Eigen::Vector2d> outline, const Eigen::Vector2d& outward)
      : count_(outline.size()) {
    const Eigen::Vector2d left(-outward.y(), outward.x());
    for (const Eigen::Vector2d& p : outline) {
      ahead_.push_back(p.dot(outward));
      aside_.push_back(p.dot(left));
    }
    const auto [back, front] = std::minmax_element(ahead_.begin(), ahead_.end());
    const auto [right, far_left] = std::minmax_element(aside_.begin(), aside_.end());
    half_depth_ = 0.5 * (*front - *back);
    half_width_ = 0.5 * (*far_left - *right);
    const double middle_ahead = 0.5 * (*front + *back);
    const double middle_aside = 0.5 * (*far_left + *right);
    for (std::size_t i = 0; i < count_; ++i) {
      ahead_[i] -= middle_ahead;
      aside_[i] -= middle_aside;
      angles_.push_back(std::atan2(aside_[i], ahead_[i]));
    }
    Smooth(Residuals());
  }

  [[nodiscard]] double width() const { return 2.0 * half_width_; }
  [[nodiscard]] double ahead(int i) const { return ahead_[i]; }
  [[nodiscard]] double aside(int i) const { return aside_[i]; }
  [[nodiscard]] double angle(int i) const { return angles_[i]; }

  // The deepest local minimum with an angle in [low, high]; -1 where there is none.
  [[nodiscard]] int DeepestValley(double low, double high) const {
    int best = -1;
    for (std::size_t i = 0; i < count_; ++i) {
      if (angles_[i] < low || angles_[i] > high) continue;
      const double here = depth_[i];
      if (here > depth_[(i + 1) % count_] || here > depth_[(i + count_ - 1) % count_]) continue;
      if (best < 0 || here < depth_[best]) best = static_cast<int>(i);
    }
    return best;
  }

  // The widest place on one side (+1: left).
  [[nodiscard]] int Widest(double side) const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < count_; ++i) {
      if (side * aside_[i] > side * aside_[best]) best = i;
    }
    return static_cast<int>(best);
  }

  // The vertex furthest ahead from `first` to `last`, counter-clockwise.
  [[nodiscard]] int Apex(int first, int last) const {
    int best = first;
    for (int i = first; i != last; i = (i + 1) % static_cast<int>(count_)) {
      if (ahead(i) > ahead(best)) best = i;
    }
    return best;
  }

 private:
  // How far each vertex lies outside the ellipse with the same extents.
  std::vector<double> Residuals() const {
    std::vector<double> residuals;
    for (std::size_t i = 0; i < count_; ++i) {
      const double radius = std::hypot(ahead_[i], aside_[i]);
      const double x = radius > 0.0 ? ahead_[i] / radius : 1.0;
      const double y = radius > 0.0 ? aside_[i] / radius : 0.0;
      residuals.push_back(radius - 1.0 / std::hypot(x / half_depth_, y / half_width_));
    }
    return residuals;
  }

  // Adds neighbours in pairs, so that mirrored outlines give mirrored sums to the bit.
  void Smooth(const std::vector<double>& residuals) {
    const double sigma = std::max(0.5, kSmoothing * static_cast<double>(count_));
    const auto reach = std::min(static_cast<std::size_t>(std::ceil(3.0 * sigma)), count_ / 2 - 1);
    for (std::size_t i = 0; i < count_; ++i) {
      double sum = residuals[i];
      double weights = 1.0;
      for (std::size_t k = 1; k <= reach; ++k) {
        const double step = static_cast<double>(k) / sigma;
        const double weight = std::exp(-0.5 * step * step);
        sum += weight * (residuals[(i + k) % count_] + residuals[(i + count_ - k) % count_]);
        weights += 2.0 * weight;
      }
      depth_.push_back(sum / weights);
    }
  }

  std::size_t count_;
  double half_depth_ = 0.0;
  double half_width_ = 0.0;
  std::vector<double> ahead_;
  std::vector<double> aside_;
  std::vector<double> angles_;
  std::vector<double> depth_;
};

std::vector<int> Arc(int first, int last, int count) {
  std::vector<int> indices{first};
  for (int i = first; i != last;) {
    i = (i + 1) % count;
    indices.push_back(i);
  }
  return indices;
}

}  // namespace

std::optional<Valleys> FindValleys(std::span<const Eigen::Vector2d> outline,
                                   const Eigen::Vector2d& outward) {
  if (outline.size() < 12) return std::nullopt;
  const View view(outline, outward);
  Valleys valleys;
  valleys.middle = view.DeepestValley(-kMiddleReach, kMiddleReach);
  if (valleys.middle < 0) return std::nullopt;
  const double from = view.angle(valleys.middle);
  valleys.side[0] = view.DeepestValley(from - kSideFar, from - kSideNear);
  valleys.side[1] = view.DeepestValley(from + kSideNear, from + kSideFar);
  if (valleys.side[0] < 0) valleys.side[0] = view.Widest(-1.0);
  if (valleys.side[1] < 0) valleys.side[1] = view.Widest(1.0);
  const int apex_a = view.Apex(valleys.side[0], valleys.middle);
  const int apex_c = view.Apex(valleys.middle, valleys.side[1]);
  valleys.apex = {apex_a, apex_c};
  const double middle = view.ahead(valleys.middle);
  const double span = view.aside(apex_c) - view.aside(apex_a);
  const double t = span > 0.0 ? (view.aside(valleys.middle) - view.aside(apex_a)) / span : 0.5;
  valleys.middle_depth_m = (1.0 - t) * view.ahead(apex_a) + t * view.ahead(apex_c) - middle;
  valleys.bulge_height_m = std::min(view.ahead(apex_a), view.ahead(apex_c)) - middle;
  valleys.width_m = view.width();
  return valleys;
}

PolygonSplit SplitAtValleys(std::size_t vertex_count, const Valleys& valleys) {
  const int count = static_cast<int>(vertex_count);
  return {{Arc(valleys.side[0], valleys.middle, count), Arc(valleys.middle, valleys.side[1], count),
           Arc(valleys.side[1], valleys.side[0], count)}};
}

}  // namespace capfit::section
