#include "core/body/cross_section.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace capfit::body {
namespace {

using EdgeKey = std::uint64_t;

constexpr std::size_t kGroupSize = 8;
constexpr std::size_t kClansPerTask = 64;
constexpr std::size_t kUsualPieces = 256;
// Rounding must not lose a triangle that just touches the plane.
constexpr double kBoxSlack = 1.000001;
constexpr double kRounding = 1e-12;

EdgeKey KeyOf(std::uint32_t a, std::uint32_t b) {
  return (static_cast<EdgeKey>(std::min(a, b)) << 32) | std::max(a, b);
}

// The piece of the section inside one triangle, from one of its edges to another.
struct Piece {
  EdgeKey from = 0;
  EdgeKey to = 0;
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
};

void CutTriangle(std::span<const Eigen::Vector3d> points, const mesh::Triangle& t,
                 const CutPlane& plane, std::vector<Piece>& pieces) {
  const double height[3] = {plane.Height(points[t[0]]), plane.Height(points[t[1]]),
                            plane.Height(points[t[2]])};
  const int above = (height[0] >= 0.0) + 2 * (height[1] >= 0.0) + 4 * (height[2] >= 0.0);
  if (above == 0 || above == 7) return;
  // Outward normals: the outline comes in where the triangle's edge goes down, from corner `in` to
  // the next, and goes out where it rises from corner `out`.
  constexpr std::array<int, 8> kIn = {0, 0, 1, 1, 2, 0, 2, 0};
  constexpr std::array<int, 8> kOut = {0, 2, 0, 2, 1, 1, 0, 0};
  const auto edge = [&](int k) { return std::minmax(t[k], t[(k + 1) % 3]); };
  const auto [low, high] = edge(kIn[above]);
  // From the lower index, so that both triangles at the edge get the same bits.
  const bool is_swapped = low != t[kIn[above]];
  const double from = height[is_swapped ? (kIn[above] + 1) % 3 : kIn[above]];
  const double to = height[is_swapped ? kIn[above] : (kIn[above] + 1) % 3];
  pieces.push_back({KeyOf(low, high), KeyOf(t[kOut[above]], t[(kOut[above] + 1) % 3]),
                    points[low] + (from / (from - to)) * (points[high] - points[low])});
}

struct Bounds {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;

  void Add(const Eigen::Vector3d& least, const Eigen::Vector3d& most) {
    low = low.cwiseMin(least);
    high = high.cwiseMax(most);
  }
};

// Fan around the first point: exact for any simple outline.
void Measure(SectionLoop& loop, const Eigen::Vector3d& normal) {
  const std::size_t count = loop.outline.size();
  const Eigen::Vector3d& o = loop.outline.front();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d a = loop.outline[i] - o;
    const Eigen::Vector3d b = loop.outline[(i + 1) % count] - o;
    if (i + 1 < count || loop.is_closed) {
      const double length = (b - a).norm();
      loop.girth += length;
      mean += 0.5 * length * (a + b);
    }
    const double twice_area = normal.dot(a.cross(b));
    loop.area += 0.5 * twice_area;
    moment += twice_area / 6.0 * (a + b);
  }
  if (std::abs(loop.area) > 1e-6 * loop.girth * loop.girth && loop.is_closed) {
    loop.centroid = o + moment / loop.area;
  } else if (loop.girth > 0.0) {
    loop.centroid = o + mean / loop.girth;
  } else {
    loop.centroid = o;
  }
}

// The pieces by the edge they come in over: a hash table with open addresses.
class PiecesByEdge {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  explicit PiecesByEdge(const std::vector<Piece>& pieces) : pieces_(pieces) {
    while ((std::size_t{1} << bits_) < 2 * pieces.size()) ++bits_;
    slots_.assign(std::size_t{1} << bits_, kNone);
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
      std::size_t slot = SlotOf(pieces[i].from);
      while (slots_[slot] != kNone) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = i;
    }
  }
  [[nodiscard]] std::uint32_t Find(EdgeKey edge) const {
    std::size_t slot = SlotOf(edge);
    while (slots_[slot] != kNone && pieces_[slots_[slot]].from != edge) {
      slot = (slot + 1) & (slots_.size() - 1);
    }
    return slots_[slot];
  }

 private:
  // The upper bits of a product with the golden ratio.
  [[nodiscard]] std::size_t SlotOf(EdgeKey edge) const {
    return (edge * 0x9E3779B97F4A7C15u) >> (64 - bits_);
  }

  const std::vector<Piece>& pieces_;
  int bits_ = 4;
  std::vector<std::uint32_t> slots_;
};

std::vector<SectionLoop> Link(const std::vector<Piece>& pieces) {
  std::vector<SectionLoop> loops;
  std::vector<char> used(pieces.size(), 0);
  const PiecesByEdge by_edge(pieces);
  for (std::uint32_t first = 0; first < pieces.size(); ++first) {
    if (used[first]) continue;
    SectionLoop loop;
    std::uint32_t at = first;
    while (at != PiecesByEdge::kNone && !used[at]) {
      used[at] = 1;
      loop.outline.push_back(pieces[at].start);
      at = by_edge.Find(pieces[at].to);
    }
    loop.is_closed = at == first;
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

double SectionLoop::Max(const Eigen::Vector3d& direction) const {
  double best = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p : outline) best = std::max(best, direction.dot(p));
  return best;
}

double SectionLoop::Min(const Eigen::Vector3d& direction) const { return -Max(-direction); }

CutSurface::CutSurface(std::span<const Eigen::Vector3d> points,
                       std::span<const mesh::Triangle> triangles, const ThreadPool& pool)
    : points_(points), triangles_(triangles) {
  groups_.resize((triangles.size() + kGroupSize - 1) / kGroupSize);
  clans_.resize((groups_.size() + kGroupSize - 1) / kGroupSize);
  pool.ForChunks(clans_.size(), kClansPerTask, [this](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      Bounds clan;
      for (std::size_t g = c * kGroupSize; g < std::min((c + 1) * kGroupSize, groups_.size());
           ++g) {
        Bounds group;
        for (std::size_t i = g * kGroupSize; i < std::min((g + 1) * kGroupSize, triangles_.size());
             ++i) {
          for (const std::uint32_t v : triangles_[i]) group.Add(points_[v], points_[v]);
        }
        groups_[g] = {0.5 * (group.low + group.high), 0.5 * (group.high - group.low)};
        clan.Add(groups_[g].center - groups_[g].half, groups_[g].center + groups_[g].half);
      }
      clans_[c] = {0.5 * (clan.low + clan.high), 0.5 * (clan.high - clan.low)};
    }
  });
}

std::vector<SectionLoop> CutSurface::Cut(const CutPlane& plane) const {
  std::vector<Piece> pieces;
  pieces.reserve(kUsualPieces);
  const Eigen::Vector3d steepness = kBoxSlack * plane.normal.cwiseAbs();
  const double offset = plane.normal.dot(plane.origin);
  const auto touches = [&](const Box& box) {
    return std::abs(plane.normal.dot(box.center) - offset) <= steepness.dot(box.half) + kRounding;
  };
  for (std::size_t c = 0; c < clans_.size(); ++c) {
    if (!touches(clans_[c])) continue;
    const std::size_t last_group = std::min((c + 1) * kGroupSize, groups_.size());
    for (std::size_t g = c * kGroupSize; g < last_group; ++g) {
      if (!touches(groups_[g])) continue;
      const std::size_t last = std::min((g + 1) * kGroupSize, triangles_.size());
      for (std::size_t i = g * kGroupSize; i < last; ++i) {
        CutTriangle(points_, triangles_[i], plane, pieces);
      }
    }
  }
  std::vector<SectionLoop> loops = Link(pieces);
  for (SectionLoop& loop : loops) Measure(loop, plane.normal);
  std::stable_sort(loops.begin(), loops.end(), [](const SectionLoop& a, const SectionLoop& b) {
    return std::abs(a.area) > std::abs(b.area);
  });
  return loops;
}

std::vector<std::vector<SectionLoop>> CutSurface::CutAll(std::span<const CutPlane> planes,
                                                         const ThreadPool& pool) const {
  std::vector<std::vector<SectionLoop>> sections(planes.size());
  pool.ForEach(planes.size(), [&](std::size_t i) { sections[i] = Cut(planes[i]); });
  return sections;
}

std::optional<SectionLoop> CutSurface::CutNearest(const CutPlane& plane, double min_girth) const {
  std::optional<SectionLoop> best;
  double best_distance = std::numeric_limits<double>::infinity();
  for (SectionLoop& loop : Cut(plane)) {
    if (!loop.is_closed || loop.girth < min_girth) continue;
    const double distance = (loop.centroid - plane.origin).norm();
    if (distance >= best_distance) continue;
    best_distance = distance;
    best = std::move(loop);
  }
  return best;
}

}  // namespace capfit::body
