#include "core/refine/best_fit/thin_out.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "core/refine/internal.h"

namespace capfit::refine {

std::vector<Eigen::Vector3f> ThinOut(std::span<const Eigen::Vector3f> points, double cell_m) {
  constexpr int kDirections = 26;
  std::array<Eigen::Vector3f, kDirections> directions;
  int count = 0;
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3f d(static_cast<float>(i % 3 - 1), static_cast<float>(i / 3 % 3 - 1),
                            static_cast<float>(i / 9 - 1));
    if (d.squaredNorm() > 0.0f) directions[count++] = d.normalized();
  }
  std::vector<std::pair<std::uint64_t, int>> cells(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f q =
        points[i] / static_cast<float>(cell_m) + Eigen::Vector3f::Constant(100'000.0f);
    const auto part = [](float v) { return static_cast<std::uint64_t>(v) & 0x1fffff; };
    cells[i] = {part(q.x()) << 42 | part(q.y()) << 21 | part(q.z()), static_cast<int>(i)};
  }
  std::sort(cells.begin(), cells.end());
  std::vector<Eigen::Vector3f> kept;
  for (std::size_t begin = 0; begin < cells.size();) {
    std::size_t end = begin;
    while (end < cells.size() && cells[end].first == cells[begin].first) ++end;
    std::vector<int> chosen;
    for (const Eigen::Vector3f& d : directions) {
      int best = cells[begin].second;
      for (std::size_t k = begin; k < end; ++k) {
        const int i = cells[k].second;
        if (points[i].dot(d) > points[best].dot(d)) best = i;
      }
      chosen.push_back(best);
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    for (const int i : chosen) kept.push_back(points[i]);
    begin = end;
  }
  return kept;
}

}  // namespace capfit::refine
