#include "core/section/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace capfit::section {
namespace {

// A stretch of the part shorter than this share of its longest one is a stray label, not a side.
constexpr double kStrayShare = 0.05;
// A loop is a candidate when the part owns this share of the longest owned length of any loop.
constexpr double kFairShare = 0.4;

struct Run {
  std::vector<Eigen::Vector2d> points;
  double length = 0.0;
};

Run RunFrom(const SectionLoop& loop, std::size_t first, std::size_t count) {
  Run run;
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector2d& p = loop[(first + k) % loop.size()].position_m;
    if (k > 0) run.length += (p - run.points.back()).norm();
    run.points.push_back(p);
  }
  return run;
}

// Stretches of the loop that belong to the part, in order.
std::vector<Run> OwnedRuns(const SectionLoop& loop, const BelongsTo& belongs) {
  const std::size_t n = loop.size();
  std::vector<bool> owned(n);
  for (std::size_t i = 0; i < n; ++i) owned[i] = belongs(loop[i].nearest_vertex);
  const auto foreign = std::find(owned.begin(), owned.end(), false);
  if (foreign == owned.end()) {
    Run whole = RunFrom(loop, 0, n);
    whole.length += (whole.points.front() - whole.points.back()).norm();
    return {whole};
  }
  // Starting behind a foreign point, no stretch is torn by the end of the list.
  const auto start = static_cast<std::size_t>(foreign - owned.begin());
  std::vector<Run> runs;
  for (std::size_t k = 0; k < n;) {
    std::size_t count = 0;
    while (k + count < n && owned[(start + k + count) % n]) ++count;
    if (count > 0) runs.push_back(RunFrom(loop, (start + k) % n, count));
    k += count + 1;
  }
  return runs;
}

struct LoopCandidate {
  std::vector<Eigen::Vector2d> points;
  double owned_length = 0.0;
  double area = 0.0;
};

LoopCandidate LoopCandidateFrom(const SectionLoop& loop, const BelongsTo& belongs) {
  const std::vector<Run> runs = OwnedRuns(loop, belongs);
  double longest = 0.0;
  for (const Run& run : runs) longest = std::max(longest, run.length);
  LoopCandidate candidate;
  for (const Run& run : runs) {
    if (run.length < kStrayShare * longest) continue;
    candidate.owned_length += run.length;
    candidate.points.insert(candidate.points.end(), run.points.begin(), run.points.end());
  }
  if (candidate.points.size() >= 3) candidate.area = SignedArea(candidate.points);
  return candidate;
}

double DistanceFromOrigin(std::span<const Eigen::Vector2d> points) {
  Eigen::Vector2d low = points.front();
  Eigen::Vector2d high = low;
  for (const Eigen::Vector2d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (0.5 * (low + high)).norm();
}

// Cumulative length at each point of an open path; the last is the whole.
std::vector<double> Lengths(std::span<const Eigen::Vector2d> path) {
  std::vector<double> lengths{0.0};
  for (std::size_t i = 1; i < path.size(); ++i) {
    lengths.push_back(lengths.back() + (path[i] - path[i - 1]).norm());
  }
  return lengths;
}

// `count` points at equal steps of an open path, both ends included.
std::vector<Eigen::Vector2d> ResamplePath(std::span<const Eigen::Vector2d> path, int count) {
  const std::vector<double> lengths = Lengths(path);
  std::vector<Eigen::Vector2d> points;
  std::size_t segment = 0;
  for (int k = 0; k < count; ++k) {
    const double target = lengths.back() * k / (count - 1);
    while (segment + 2 < lengths.size() && lengths[segment + 1] < target) ++segment;
    const double step = lengths[segment + 1] - lengths[segment];
    const double t = step > 0.0 ? std::clamp((target - lengths[segment]) / step, 0.0, 1.0) : 0.0;
    points.push_back(path[segment] + t * (path[segment + 1] - path[segment]));
  }
  return points;
}

// A point of the axis x = 0 on the edge that begins at `index`.
struct AxisCrossing {
  std::size_t index = 0;
  double y = 0.0;
};

std::vector<AxisCrossing> AxisCrossings(std::span<const Eigen::Vector2d> points) {
  std::vector<AxisCrossing> crossings;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d& a = points[i];
    const Eigen::Vector2d& b = points[(i + 1) % points.size()];
    if ((a.x() < 0.0) == (b.x() < 0.0)) continue;
    const double t = a.x() / (a.x() - b.x());
    crossings.push_back({i, a.y() + t * (b.y() - a.y())});
  }
  return crossings;
}

// The path along the curve from one crossing to another, ends on the axis.
std::vector<Eigen::Vector2d> PathBetween(std::span<const Eigen::Vector2d> points,
                                         const AxisCrossing& from, const AxisCrossing& to) {
  std::vector<Eigen::Vector2d> path{{0.0, from.y}};
  for (std::size_t i = from.index; i != to.index;) {
    i = (i + 1) % points.size();
    path.push_back(points[i]);
  }
  path.emplace_back(0.0, to.y);
  return path;
}

}  // namespace

double SignedArea(std::span<const Eigen::Vector2d> points) {
  double twice = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d a = points[i] - points[0];
    const Eigen::Vector2d b = points[(i + 1) % points.size()] - points[0];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

std::optional<std::vector<Eigen::Vector2d>> PartOutline(const std::vector<SectionLoop>& loops,
                                                        const BelongsTo& belongs) {
  std::vector<LoopCandidate> candidates;
  double longest = 0.0;
  for (const SectionLoop& loop : loops) {
    LoopCandidate candidate = LoopCandidateFrom(loop, belongs);
    if (candidate.area <= 0.0) continue;  // nothing owned, or the wall of a hollow
    longest = std::max(longest, candidate.owned_length);
    candidates.push_back(std::move(candidate));
  }
  LoopCandidate* best = nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  for (LoopCandidate& candidate : candidates) {
    if (candidate.owned_length < kFairShare * longest) continue;
    const double distance = DistanceFromOrigin(candidate.points);
    if (distance >= nearest) continue;
    nearest = distance;
    best = &candidate;
  }
  if (best == nullptr) return std::nullopt;
  return std::move(best->points);
}

std::vector<Eigen::Vector2d> Resample(std::span<const Eigen::Vector2d> points, int count) {
  std::vector<Eigen::Vector2d> path(points.begin(), points.end());
  path.push_back(points.front());
  std::vector<Eigen::Vector2d> result = ResamplePath(path, count + 1);
  result.pop_back();
  return result;
}

std::optional<std::vector<Eigen::Vector2d>> Symmetrised(std::span<const Eigen::Vector2d> points,
                                                        int count) {
  const std::vector<AxisCrossing> crossings = AxisCrossings(points);
  if (crossings.size() < 2) return std::nullopt;
  const auto by_y = [](const AxisCrossing& a, const AxisCrossing& b) { return a.y < b.y; };
  const auto [low, high] = std::minmax_element(crossings.begin(), crossings.end(), by_y);
  // Counter-clockwise: from the lower crossing up the side of x > 0, down the other.
  const int half = std::max(4, count / 2);
  const std::vector<Eigen::Vector2d> right =
      ResamplePath(PathBetween(points, *low, *high), half + 1);
  const std::vector<Eigen::Vector2d> left =
      ResamplePath(PathBetween(points, *high, *low), half + 1);
  std::vector<Eigen::Vector2d> result(2 * half);
  for (int k = 0; k <= half; ++k) {
    const Eigen::Vector2d& a = right[k];
    const Eigen::Vector2d& b = left[half - k];
    const bool on_axis = k == 0 || k == half;
    const double x = on_axis ? 0.0 : std::max(0.0, 0.5 * (a.x() - b.x()));
    const double y = 0.5 * (a.y() + b.y());
    result[k] = {x, y};
    if (!on_axis) result[result.size() - k] = {-x, y};
  }
  return result;
}

}  // namespace capfit::section
