#include "core/mesh/overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace capfit::mesh {
namespace {

constexpr double kColumnsAlongLongest = 128.0;
// Crossings of all columns together; a body of 200,000 triangles has about 30,000.
constexpr std::size_t kMostCrossings = 2'000'000;
// Looked-at columns of all triangles together.
constexpr std::size_t kMostLooks = 20'000'000;

struct Crossing {
  std::uint32_t column;
  float along;  // from the low end of the box
  int step;     // +1 into the body, -1 out of it
};

class OverlapColumns {
 public:
  explicit OverlapColumns(const BodyMesh& mesh) : mesh_(mesh) {
    const Eigen::Vector3d size = mesh.box_max() - mesh.box_min();
    size.maxCoeff(&along_);
    across_ = {(along_ + 1) % 3, (along_ + 2) % 3};
    cell_ = size[along_] / kColumnsAlongLongest;
    for (std::size_t k = 0; k < 2; ++k) {
      counts_[k] = 1 + static_cast<int>(size[across_[k]] / cell_);
    }
  }

  Overlap Run() {
    for (const Triangle& t : mesh_.triangles()) {
      if (!AddTriangle(t)) return {};
    }
    std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& a, const Crossing& b) {
      return a.column != b.column ? a.column < b.column : a.along < b.along;
    });
    for (std::size_t first = 0; first < crossings_.size();) {
      std::size_t last = first;
      while (last < crossings_.size() && crossings_[last].column == crossings_[first].column) {
        ++last;
      }
      Sweep(std::span(crossings_).subspan(first, last - first));
      first = last;
    }
    if (result_.volume > 0.0) result_.middle /= result_.volume;
    return result_;
  }

 private:
  // Where a column runs, across it, from the low corner of the box. (Not through the corners of
  // regular grids.)
  [[nodiscard]] double Center(int index) const { return (index + 0.4713) * cell_; }

  // False where it becomes too much.
  bool AddTriangle(const Triangle& t) {
    std::array<Eigen::Vector3d, 3> p;  // along, and the two across
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d v = mesh_.vertices()[t[k]] - mesh_.box_min();
      p[k] = {v[along_], v[across_[0]], v[across_[1]]};
    }
    std::array<int, 2> low{};
    std::array<int, 2> high{};
    for (int k = 0; k < 2; ++k) {
      const auto [least, most] = std::minmax({p[0][k + 1], p[1][k + 1], p[2][k + 1]});
      const auto at = static_cast<std::size_t>(k);
      low[at] = std::max(0, static_cast<int>(std::ceil(least / cell_ - 0.4713)));
      high[at] = std::min(counts_[at] - 1, static_cast<int>(std::floor(most / cell_ - 0.4713)));
      if (low[at] > high[at]) return true;
    }
    looks_ += static_cast<std::size_t>(high[0] - low[0] + 1) *
              static_cast<std::size_t>(high[1] - low[1] + 1);
    if (looks_ > kMostLooks || crossings_.size() > kMostCrossings) return false;
    for (int i = low[0]; i <= high[0]; ++i) {
      for (int j = low[1]; j <= high[1]; ++j) Cross(p, i, j);
    }
    return true;
  }

  void Cross(const std::array<Eigen::Vector3d, 3>& p, int i, int j) {
    const Eigen::Vector2d at(Center(i), Center(j));
    std::array<double, 3> shares{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector2d a = p[(k + 1) % 3].tail<2>() - at;
      const Eigen::Vector2d b = p[(k + 2) % 3].tail<2>() - at;
      shares[k] = a.x() * b.y() - a.y() * b.x();
    }
    const bool is_upward = shares[0] > 0.0 && shares[1] > 0.0 && shares[2] > 0.0;
    const bool is_downward = shares[0] < 0.0 && shares[1] < 0.0 && shares[2] < 0.0;
    if (!is_upward && !is_downward) return;
    const double along = (shares[0] * p[0].x() + shares[1] * p[1].x() + shares[2] * p[2].x()) /
                         (shares[0] + shares[1] + shares[2]);
    crossings_.push_back({static_cast<std::uint32_t>(i * counts_[1] + j), static_cast<float>(along),
                          is_upward ? -1 : 1});
  }

  void Sweep(std::span<const Crossing> column) {
    int inside = 0;
    for (const Crossing& crossing : column) inside += crossing.step;
    if (inside != 0) return;  // grazes an edge
    for (std::size_t k = 0; k + 1 < column.size(); ++k) {
      inside += column[k].step;
      if (inside < 2) continue;
      const double length = column[k + 1].along - column[k].along;
      const double volume = length * cell_ * cell_;
      Eigen::Vector3d middle;
      middle[along_] = column[k].along + 0.5 * length;
      middle[across_[0]] = Center(static_cast<int>(column[k].column) / counts_[1]);
      middle[across_[1]] = Center(static_cast<int>(column[k].column) % counts_[1]);
      result_.volume += volume;
      result_.middle += volume * (mesh_.box_min() + middle);
    }
  }

  const BodyMesh& mesh_;
  int along_ = 0;
  std::array<int, 2> across_{};
  std::array<int, 2> counts_{};
  double cell_ = 0.0;
  std::size_t looks_ = 0;
  std::vector<Crossing> crossings_;
  Overlap result_;
};

}  // namespace

Overlap MeasureOverlap(const BodyMesh& mesh) { return OverlapColumns(mesh).Run(); }

}  // namespace capfit::mesh
