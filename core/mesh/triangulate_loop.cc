#include "core/mesh/triangulate_loop.h"

#include <Eigen/Geometry>  // cross
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>

namespace capfit::mesh {
namespace {

constexpr double kImpossible = std::numeric_limits<double>::infinity();

// Price of an edge, as a share of its squared length. Small against any change of area that
// matters, large against rounding: it picks the rounder of two triangulations of a flat loop.
constexpr double kEdgePrice = 1e-3;

class SmallestArea {
 public:
  SmallestArea(std::span<const Eigen::Vector3d> loop, const MayJoin& may_join)
      : loop_(loop),
        count_(loop.size()),
        price_(count_ * count_, kImpossible),
        middle_(count_ * count_, 0) {
    for (std::size_t i = 0; i + 1 < count_; ++i) price_[At(i, i + 1)] = 0.0;
    for (std::size_t length = 2; length < count_; ++length) {
      for (std::size_t i = 0; i + length < count_; ++i) Fill(i, i + length, may_join);
    }
  }

  [[nodiscard]] std::optional<std::vector<Triangle>> Triangles() const {
    if (price_[At(0, count_ - 1)] == kImpossible) return std::nullopt;
    std::vector<Triangle> triangles;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> open = {
        {0u, static_cast<std::uint32_t>(count_ - 1)}};
    while (!open.empty()) {
      const auto [i, k] = open.back();
      open.pop_back();
      if (k - i < 2) continue;
      const std::uint32_t m = middle_[At(i, k)];
      triangles.push_back({i, m, k});
      open.emplace_back(m, k);
      open.emplace_back(i, m);
    }
    return triangles;
  }

 private:
  [[nodiscard]] std::size_t At(std::size_t i, std::size_t k) const { return i * count_ + k; }

  // The cheapest way to fill the chain from i to k: the triangle (i, m, k) and both sides.
  void Fill(std::size_t i, std::size_t k, const MayJoin& may_join) {
    const bool closes_loop = i == 0 && k + 1 == count_;
    const auto i32 = static_cast<std::uint32_t>(i);
    const auto k32 = static_cast<std::uint32_t>(k);
    if (!closes_loop && !may_join(i32, k32)) return;
    const Eigen::Vector3d side = loop_[k] - loop_[i];
    double best = kImpossible;
    for (std::size_t m = i + 1; m < k; ++m) {
      const double sides = price_[At(i, m)] + price_[At(m, k)];
      if (!(sides < best)) continue;
      const double price = sides + 0.5 * side.cross(loop_[m] - loop_[i]).norm();
      if (price < best) {
        best = price;
        middle_[At(i, k)] = static_cast<std::uint32_t>(m);
      }
    }
    price_[At(i, k)] = best + (closes_loop ? 0.0 : kEdgePrice * side.squaredNorm());
  }

  std::span<const Eigen::Vector3d> loop_;
  std::size_t count_;
  std::vector<double> price_;
  std::vector<std::uint32_t> middle_;
};

class EarCutter {
 public:
  EarCutter(std::span<const Eigen::Vector3d> loop, const MayJoin& may_join)
      : loop_(loop), may_join_(may_join), version_(loop.size(), 0) {
    const auto count = static_cast<std::uint32_t>(loop.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      next_.push_back((i + 1) % count);
      previous_.push_back((i + count - 1) % count);
      normal_ += (loop[i] - loop[0]).cross(loop[(i + 1) % count] - loop[0]);
    }
    for (std::uint32_t i = 0; i < count; ++i) Offer(i);
  }

  std::optional<std::vector<Triangle>> Run() {
    std::vector<Triangle> triangles;
    const std::size_t wanted = loop_.size() - 2;
    while (triangles.size() < wanted) {
      if (ears_.empty()) return std::nullopt;
      const auto [angle, corner, version] = ears_.top();
      ears_.pop();
      if (version != version_[corner]) continue;
      const std::uint32_t before = previous_[corner];
      const std::uint32_t after = next_[corner];
      if (triangles.size() + 1 < wanted && !may_join_(before, after)) continue;
      triangles.push_back({before, corner, after});
      ++version_[corner];
      next_[before] = after;
      previous_[after] = before;
      Offer(before);
      Offer(after);
    }
    return triangles;
  }

 private:
  using Ear = std::tuple<double, std::uint32_t, std::uint32_t>;  // angle, corner, version

  void Offer(std::uint32_t corner) { ears_.emplace(AngleAt(corner), corner, ++version_[corner]); }

  // Inner angle, in [0, 2 pi), seen along the loop's mean normal.
  [[nodiscard]] double AngleAt(std::uint32_t corner) const {
    const Eigen::Vector3d to_next = loop_[next_[corner]] - loop_[corner];
    const Eigen::Vector3d to_previous = loop_[previous_[corner]] - loop_[corner];
    const Eigen::Vector3d cross = to_next.cross(to_previous);
    const double angle = std::atan2(cross.norm(), to_next.dot(to_previous));
    return cross.dot(normal_) < 0.0 ? 2.0 * std::numbers::pi - angle : angle;
  }

  std::span<const Eigen::Vector3d> loop_;
  const MayJoin& may_join_;
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> previous_;
  std::vector<std::uint32_t> version_;
  std::priority_queue<Ear, std::vector<Ear>, std::greater<>> ears_;
};

}  // namespace

std::optional<std::vector<Triangle>> FillBySmallestArea(std::span<const Eigen::Vector3d> loop,
                                                        const MayJoin& may_join) {
  return SmallestArea(loop, may_join).Triangles();
}

std::optional<std::vector<Triangle>> FillByCuttingEars(std::span<const Eigen::Vector3d> loop,
                                                       const MayJoin& may_join) {
  return EarCutter(loop, may_join).Run();
}

}  // namespace capfit::mesh
