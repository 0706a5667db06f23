#include "core/section/slice.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace capfit::section {
namespace {

// A mesh edge that the plane cuts, by its two vertices, smaller first.
using EdgeKey = std::pair<std::uint32_t, std::uint32_t>;

// Where the plane runs through one triangle: it enters by one edge and leaves by another, with the
// body on its left.
struct Cut {
  EdgeKey from;
  EdgeKey to;
  Eigen::Vector2d start_m;
  Eigen::Vector2d end_m;
};

using Line = std::vector<Eigen::Vector2d>;

class Cutter {
 public:
  Cutter(const mesh::BodyMesh& mesh, const geometry::PlaneFrame& frame)
      : mesh_(mesh), frame_(frame), normal_(frame.Normal()) {}

  // The cuts of all named triangles, in their order.
  std::vector<Cut> CutAll(std::span<const int> triangle_indices) const {
    std::vector<Cut> cuts;
    for (const int index : triangle_indices) {
      const mesh::Triangle& t = mesh_.triangles()[static_cast<std::size_t>(index)];
      const std::array<double, 3> heights_m = {Height(t[0]), Height(t[1]), Height(t[2])};
      const int above = (heights_m[0] >= 0) + (heights_m[1] >= 0) + (heights_m[2] >= 0);
      if (above != 0 && above != 3) cuts.push_back(CutOne(t, heights_m, above));
    }
    return cuts;
  }

 private:
  double Height(std::uint32_t vertex) const {
    return (mesh_.vertices()[vertex] - frame_.origin_m).dot(normal_);
  }

  Cut CutOne(const mesh::Triangle& t, const std::array<double, 3>& heights_m, int above) const {
    // The corner that is alone on its side; the other two follow in the triangle's sense.
    std::size_t alone = 0;
    while ((heights_m[alone] >= 0) != (above == 1)) ++alone;
    const std::size_t next = (alone + 1) % 3;
    const std::size_t last = (alone + 2) % 3;
    const auto [first_key, first_m] = Crossing(t, heights_m, alone, next);
    const auto [second_key, second_m] = Crossing(t, heights_m, alone, last);
    // With outward normals and the plane's normal up, the body lies on the left of the way from the
    // edge (alone, next) to the edge (alone, last) when `alone` is below.
    if (above == 1) return {second_key, first_key, second_m, first_m};
    return {first_key, second_key, first_m, second_m};
  }

  std::pair<EdgeKey, Eigen::Vector2d> Crossing(const mesh::Triangle& t,
                                               const std::array<double, 3>& heights_m,
                                               std::size_t i, std::size_t j) const {
    // Always from the smaller index: both triangles of the edge then get the same bits.
    if (t[i] > t[j]) std::swap(i, j);
    const Eigen::Vector3d& a = mesh_.vertices()[t[i]];
    const Eigen::Vector3d& b = mesh_.vertices()[t[j]];
    const double s = heights_m[i] / (heights_m[i] - heights_m[j]);
    return {{t[i], t[j]}, frame_.ToPlane(a + s * (b - a))};
  }

  const mesh::BodyMesh& mesh_;
  const geometry::PlaneFrame& frame_;
  Eigen::Vector3d normal_;
};

struct Pieces {
  std::vector<Line> closed;
  std::vector<Line> open;
};

// Follows each cut to the one that begins where it ends.
Pieces Chain(std::vector<Cut> cuts) {
  std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.from < b.from; });
  const auto starting_at = [&cuts](const EdgeKey& key) {
    const auto it = std::lower_bound(cuts.begin(), cuts.end(), key,
                                     [](const Cut& c, const EdgeKey& k) { return c.from < k; });
    return it != cuts.end() && it->from == key ? static_cast<std::size_t>(it - cuts.begin())
                                               : cuts.size();
  };
  std::vector<std::size_t> next(cuts.size());
  std::vector<char> has_previous(cuts.size(), 0);
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    next[i] = starting_at(cuts[i].to);
    if (next[i] < cuts.size()) has_previous[next[i]] = 1;
  }
  Pieces pieces;
  std::vector<char> done(cuts.size(), 0);
  const auto follow = [&](std::size_t first) {
    Line line = {cuts[first].start_m};
    std::size_t i = first;
    for (; i < cuts.size() && !done[i]; i = next[i]) {
      done[i] = 1;
      line.push_back(cuts[i].end_m);
    }
    const bool is_closed = i == first;
    if (is_closed) line.pop_back();
    (is_closed ? pieces.closed : pieces.open).push_back(std::move(line));
  };
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    if (!has_previous[i]) follow(i);
  }
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    if (!done[i]) follow(i);
  }
  return pieces;
}

// Joins open lines, end to nearest start. All run the same way round, so this closes the outline
// along the straight line across the gap.
std::vector<Line> CloseOpenLines(std::vector<Line> open) {
  std::vector<Line> closed;
  while (!open.empty()) {
    Line line = std::move(open.front());
    open.erase(open.begin());
    for (;;) {
      double best_m = (line.front() - line.back()).norm();
      std::size_t best = open.size();
      for (std::size_t i = 0; i < open.size(); ++i) {
        const double gap_m = (open[i].front() - line.back()).norm();
        if (gap_m < best_m) {
          best_m = gap_m;
          best = i;
        }
      }
      if (best == open.size()) break;
      line.insert(line.end(), open[best].begin(), open[best].end());
      open.erase(open.begin() + static_cast<std::ptrdiff_t>(best));
    }
    closed.push_back(std::move(line));
  }
  return closed;
}

// Walks `line` and calls emit at each multiple of `step_m`, from 0, `count` times.
Line Walk(std::span<const Eigen::Vector2d> line, double step_m, int count) {
  Line points;
  std::size_t segment = 0;
  double before_m = 0.0;
  double length_m = (line[1] - line[0]).norm();
  for (int k = 0; k < count; ++k) {
    const double at_m = step_m * k;
    while (at_m > before_m + length_m && segment + 2 < line.size()) {
      before_m += length_m;
      ++segment;
      length_m = (line[segment + 1] - line[segment]).norm();
    }
    const double s = length_m > 0 ? std::clamp((at_m - before_m) / length_m, 0.0, 1.0) : 0.0;
    points.push_back(line[segment] + s * (line[segment + 1] - line[segment]));
  }
  return points;
}

double Length(std::span<const Eigen::Vector2d> line) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length_m += (line[i] - line[i - 1]).norm();
  return length_m;
}

}  // namespace

std::vector<Polygon> SliceTriangles(const mesh::BodyMesh& mesh,
                                    std::span<const int> triangle_indices,
                                    const geometry::PlaneFrame& frame) {
  Pieces pieces = Chain(Cutter(mesh, frame).CutAll(triangle_indices));
  std::vector<Line> lines = std::move(pieces.closed);
  for (Line& line : CloseOpenLines(std::move(pieces.open))) lines.push_back(std::move(line));
  std::vector<Polygon> polygons;
  for (Line& line : lines) {
    absl::StatusOr<Polygon> polygon = Polygon::Create(std::move(line));
    if (polygon.ok()) polygons.push_back(*std::move(polygon));
  }
  std::stable_sort(polygons.begin(), polygons.end(),
                   [](const Polygon& a, const Polygon& b) { return a.area_m2() > b.area_m2(); });
  return polygons;
}

std::vector<Eigen::Vector2d> ResampleClosed(std::span<const Eigen::Vector2d> outline_m, int count) {
  Line line(outline_m.begin(), outline_m.end());
  line.push_back(line.front());
  return Walk(line, Length(line) / count, count);
}

std::vector<Eigen::Vector2d> ResampleOpen(std::span<const Eigen::Vector2d> line_m, int count) {
  return Walk(line_m, Length(line_m) / (count - 1), count);
}

}  // namespace capfit::section
