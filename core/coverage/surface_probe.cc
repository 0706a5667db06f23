#include "core/coverage/surface_probe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/chunk_sums.h"

namespace capfit::coverage {
namespace {

using geometry::TaperedCapsule;
using Corners = std::array<Eigen::Vector3d, 3>;

constexpr std::size_t kChunk = 2048;
constexpr std::size_t kFewChunk = 32;  // where each is probed
// Distances by tighten::PointGrid are good to this.
constexpr double kGridAccuracy = 1e-6;
constexpr double kFloatAccuracy = 1e-7;  // of distances up to a metre

Eigen::Vector3d MiddleOf(const Corners& corners) {
  return (corners[0] + corners[1] + corners[2]) / 3.0;
}

double ReachOf(const Corners& corners, const Eigen::Vector3d& middle) {
  double squared = 0.0;
  for (const Eigen::Vector3d& corner : corners) {
    squared = std::max(squared, (corner - middle).squaredNorm());
  }
  return std::sqrt(squared);
}

std::array<Corners, 4> Quarter(const Corners& c) {
  const Eigen::Vector3d ab = 0.5 * (c[0] + c[1]);
  const Eigen::Vector3d bc = 0.5 * (c[1] + c[2]);
  const Eigen::Vector3d ca = 0.5 * (c[2] + c[0]);
  return {Corners{c[0], ab, ca}, Corners{ab, c[1], bc}, Corners{ca, bc, c[2]}, Corners{ab, bc, ca}};
}

// One triangle of the mesh against the solids that can matter for it.
class TriangleProbe {
 public:
  TriangleProbe(const Corners& corners, const std::vector<TaperedCapsule>& solids)
      : corners_(corners) {
    const Eigen::Vector3d middle = MiddleOf(corners);
    const double reach = ReachOf(corners, middle);
    std::vector<double> at_middle;
    double least = std::numeric_limits<double>::infinity();
    for (const TaperedCapsule& solid : solids) {
      at_middle.push_back(solid.SignedDistance(middle));
      least = std::min(least, at_middle.back());
    }
    for (std::size_t k = 0; k < solids.size(); ++k) {
      if (at_middle[k] <= least + 2.0 * reach) near_.push_back(&solids[k]);
    }
  }

  double Distance(const Eigen::Vector3d& point) const {
    double least = std::numeric_limits<double>::infinity();
    for (const TaperedCapsule* solid : near_) least = std::min(least, solid->SignedDistance(point));
    return least;
  }

  // No point of a piece is further out than this: the distance from one solid is convex, so its
  // corners bound it; and no distance changes faster than the point moves.
  double UpperBound(const Corners& piece) const {
    const Eigen::Vector3d middle = MiddleOf(piece);
    double bound = Distance(middle) + ReachOf(piece, middle);
    for (const TaperedCapsule* solid : near_) {
      double furthest = -std::numeric_limits<double>::infinity();
      for (const Eigen::Vector3d& corner : piece) {
        furthest = std::max(furthest, solid->SignedDistance(corner));
        if (furthest >= bound) break;
      }
      bound = std::min(bound, furthest);
    }
    return bound;
  }

  const Corners& corners() const { return corners_; }

 private:
  Corners corners_;
  std::vector<const TaperedCapsule*> near_;
};

Corners CornersOf(const tighten::CoverTarget& target, std::size_t triangle) {
  const mesh::Triangle& t = target.triangles[triangle];
  return {target.points_m[t[0]], target.points_m[t[1]], target.points_m[t[2]]};
}

// Whether one corner is so deep that nothing of the triangle can be further out than `limit_m`: no
// distance changes faster than the point moves.
bool IsDeepEnough(const tighten::CoverTarget& target, const mesh::Triangle& t,
                  const tighten::UnionDistances& at, double limit_m) {
  const auto deepest =
      static_cast<std::size_t>(std::min_element(t.begin(), t.end(),
                                                [&at](std::uint32_t a, std::uint32_t b) {
                                                  return at.distance_m[a] < at.distance_m[b];
                                                }) -
                               t.begin());
  const double room = limit_m - kGridAccuracy - at.distance_m[t[deepest]];
  if (room <= 0.0) return false;
  const Eigen::Vector3d& corner = target.points_m[t[deepest]];
  const auto is_within = [&](std::uint32_t other) {
    return (target.points_m[other] - corner).squaredNorm() <= room * room;
  };
  return is_within(t[(deepest + 1) % 3]) && is_within(t[(deepest + 2) % 3]);
}

// Whether all corners are within `limit_m` of one solid. Of those that it is nearest to that is
// known.
bool IsNearTo(const tighten::CoverTarget& target, const mesh::Triangle& t,
              const tighten::UnionDistances& at, std::int32_t solid,
              const std::vector<TaperedCapsule>& solids, double limit_m) {
  return std::all_of(t.begin(), t.end(), [&](std::uint32_t corner) {
    if (at.solid[corner] == solid && at.distance_m[corner] <= limit_m - kGridAccuracy) return true;
    return solids[solid].SignedDistance(target.points_m[corner]) <= limit_m;
  });
}

// All corners within `limit_m` of the same solid, or one deep inside: true of nearly every
// triangle, and quick to see.
bool IsPlainlyNear(const tighten::CoverTarget& target, std::size_t triangle,
                   const tighten::UnionDistances& at, const std::vector<TaperedCapsule>& solids,
                   double limit_m) {
  const mesh::Triangle& t = target.triangles[triangle];
  if (at.solid[t[0]] == at.solid[t[1]] && at.solid[t[0]] == at.solid[t[2]]) {
    return std::max({at.distance_m[t[0]], at.distance_m[t[1]], at.distance_m[t[2]]}) <=
           limit_m - kGridAccuracy;
  }
  if (IsDeepEnough(target, t, at, limit_m)) return true;
  for (std::size_t k = 0; k < 3; ++k) {
    if (k > 0 && at.solid[t[k]] == at.solid[t[k - 1]]) continue;
    if (IsNearTo(target, t, at, at.solid[t[k]], solids, limit_m)) return true;
  }
  return false;
}

// Where the same solid is nearest to all three corners, which holds for nine of ten triangles, and
// no corner is out by more than the limit, nothing is. As many as pass are listed without branches.
class NearbyTriangles {
 public:
  NearbyTriangles(const tighten::CoverTarget& target, const tighten::UnionDistances& at,
                  const ThreadPool& pool)
      : target_(target), at_(at.solid.size()) {
    pool.ForChunks(at_.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        at_[v] = {static_cast<float>(at.distance_m[v]), at.solid[v]};
      }
    });
  }

  // Of the triangles [begin, end) those that are not so, in order; `others` has room for all.
  [[nodiscard]] std::size_t ListOthers(std::size_t begin, std::size_t end, double limit_m,
                                       std::span<std::uint32_t> others) const {
    const auto limit = static_cast<float>(limit_m - kGridAccuracy - kFloatAccuracy);
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const mesh::Triangle& t = target_.triangles[i];
      const AtVertex a = at_[t[0]];
      const AtVertex b = at_[t[1]];
      const AtVertex c = at_[t[2]];
      const bool is_near = (a.solid == b.solid) & (a.solid == c.solid) & (a.distance_m <= limit) &
                           (b.distance_m <= limit) & (c.distance_m <= limit);
      others[count] = static_cast<std::uint32_t>(i);
      count += is_near ? 0 : 1;
    }
    return count;
  }

 private:
  struct AtVertex {
    float distance_m;
    std::int32_t solid;
  };
  const tighten::CoverTarget& target_;
  std::vector<AtVertex> at_;
};

struct Largest {
  double value;

  Largest& operator+=(const Largest& other) {
    value = std::max(value, other.value);
    return *this;
  }
};

bool HasCornerOutside(const mesh::Triangle& t, const tighten::UnionDistances& at, double limit_m) {
  return std::max({at.distance_m[t[0]], at.distance_m[t[1]], at.distance_m[t[2]]}) > limit_m;
}

struct Limits {
  double asked_m;
  double max_gap_m;
};

void FindOutside(const TriangleProbe& probe, const Limits& limits,
                 std::vector<Eigen::Vector3d>& out) {
  const auto [asked_m, max_gap_m] = limits;
  std::vector<Corners> pieces = {probe.corners()};
  while (!pieces.empty()) {
    const Corners piece = pieces.back();
    pieces.pop_back();
    if (probe.UpperBound(piece) <= max_gap_m) continue;
    const std::array<Corners, 4> quarters = Quarter(piece);
    // The middle quarter's corners are the new points; the piece's middle is the fourth.
    const std::array<Eigen::Vector3d, 4> candidates = {quarters[3][0], quarters[3][1],
                                                       quarters[3][2], MiddleOf(piece)};
    const std::size_t count_before = out.size();
    for (const Eigen::Vector3d& candidate : candidates) {
      if (probe.Distance(candidate) > asked_m) out.push_back(candidate);
    }
    if (out.size() > count_before) {
      continue;  // looked at again when they are covered
    } else if (ReachOf(piece, candidates[3]) > 0.5 * (max_gap_m - asked_m)) {
      pieces.insert(pieces.end(), quarters.begin(), quarters.end());
    }
  }
}

void Probe(const tighten::CoverTarget& target, std::size_t triangle,
           const std::vector<TaperedCapsule>& solids, const Limits& limits, Unproved& found) {
  const std::size_t before = found.points_m.size();
  FindOutside(TriangleProbe(CornersOf(target, triangle), solids), limits, found.points_m);
  if (found.points_m.size() > before) {
    found.triangles.push_back(static_cast<std::uint32_t>(triangle));
  }
}

// What `look`(begin, end, found) finds in each chunk, in their order.
template <typename Look>
Unproved InChunks(std::size_t count, std::size_t chunk, const ThreadPool& pool, const Look& look) {
  std::vector<Unproved> found((count + chunk - 1) / chunk);
  pool.ForChunks(count, chunk, [&](std::size_t begin, std::size_t end) {
    look(begin, end, found[begin / chunk]);
  });
  Unproved all;
  for (const Unproved& some : found) {
    all.points_m.insert(all.points_m.end(), some.points_m.begin(), some.points_m.end());
    all.triangles.insert(all.triangles.end(), some.triangles.begin(), some.triangles.end());
  }
  return all;
}

// The largest upper bound left when every piece's is within tolerance of a point that is out.
double GapOf(const TriangleProbe& probe, double tolerance_m) {
  double lower = 0.0;
  double upper = 0.0;
  for (const Eigen::Vector3d& corner : probe.corners()) {
    lower = std::max(lower, probe.Distance(corner));
  }
  std::vector<Corners> pieces = {probe.corners()};
  while (!pieces.empty()) {
    const Corners piece = pieces.back();
    pieces.pop_back();
    const double bound = probe.UpperBound(piece);
    if (bound <= std::max(lower + tolerance_m, upper)) {
      upper = std::max(upper, bound);
      continue;
    }
    const std::array<Corners, 4> quarters = Quarter(piece);
    for (const Eigen::Vector3d& corner : quarters[3]) {
      lower = std::max(lower, probe.Distance(corner));
    }
    pieces.insert(pieces.end(), quarters.begin(), quarters.end());
  }
  return upper;
}

}  // namespace

tighten::UnionDistances InCallersOrder(const tighten::PointGrid& points,
                                       const tighten::UnionDistances& distances,
                                       const ThreadPool& pool) {
  tighten::UnionDistances sorted{std::vector<double>(points.size()),
                                 std::vector<std::int32_t>(points.size())};
  pool.ForChunks(points.size(), kMeshChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      sorted.distance_m[points.order()[i]] = distances.distance_m[i];
      sorted.solid[points.order()[i]] = distances.solid[i];
    }
  });
  return sorted;
}

Unproved FindPointsOutside(const tighten::CoverTarget& target,
                           const tighten::UnionDistances& at_vertices,
                           const std::vector<TaperedCapsule>& solids, double asked_m,
                           double max_gap_m, const ThreadPool& pool) {
  const NearbyTriangles nearby(target, at_vertices, pool);
  const auto may_stick_out = [&](std::size_t triangle) {
    return !IsPlainlyNear(target, triangle, at_vertices, solids, max_gap_m) &&
           !HasCornerOutside(target.triangles[triangle], at_vertices, max_gap_m);
  };
  return InChunks(target.triangles.size(), kChunk, pool,
                  [&](std::size_t begin, std::size_t end, Unproved& found) {
                    std::array<std::uint32_t, kChunk> others;
                    const std::size_t count = nearby.ListOthers(begin, end, max_gap_m, others);
                    for (const std::uint32_t i : std::span(others).first(count)) {
                      if (may_stick_out(i)) {
                        Probe(target, i, solids, {asked_m, max_gap_m}, found);
                      }
                    }
                  });
}

Unproved FindPointsOutside(const tighten::CoverTarget& target,
                           std::span<const std::uint32_t> triangles,
                           const std::vector<TaperedCapsule>& solids, double asked_m,
                           double max_gap_m, const ThreadPool& pool) {
  return InChunks(triangles.size(), kFewChunk, pool,
                  [&](std::size_t begin, std::size_t end, Unproved& found) {
                    for (const std::uint32_t i : triangles.subspan(begin, end - begin)) {
                      Probe(target, i, solids, {asked_m, max_gap_m}, found);
                    }
                  });
}

double CertifiedGap(const tighten::CoverTarget& target, const capsule::PrimitiveSet& set,
                    double tolerance_m, const ThreadPool& pool) {
  const std::vector<TaperedCapsule> solids = capsule::Solids(set);
  if (target.points_m.empty()) return 0.0;
  if (solids.empty()) return std::numeric_limits<double>::infinity();
  const tighten::PointGrid grid(target.points_m);
  const tighten::UnionDistances at_vertices = InCallersOrder(
      grid, grid.DistancesTo(solids, -std::numeric_limits<double>::infinity(), pool), pool);
  return CertifiedGap(target, at_vertices, solids,
                      MaxVertexDistance(target, at_vertices, solids, pool), tolerance_m, pool);
}

double MaxVertexDistance(const tighten::CoverTarget& target,
                         const tighten::UnionDistances& at_vertices,
                         const std::vector<TaperedCapsule>& solids, const ThreadPool& pool) {
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  const auto most_of = [&](std::size_t begin, std::size_t end) {
    Largest most{kNone};
    for (std::size_t v = begin; v < end; ++v) {
      if (at_vertices.distance_m[v] < most.value - kGridAccuracy) continue;
      most += {solids[at_vertices.solid[v]].SignedDistance(target.points_m[v])};
    }
    return most;
  };
  return SumOverChunks(pool, target.points_m.size(), Largest{kNone}, most_of).value;
}

double CertifiedGap(const tighten::CoverTarget& target, const tighten::UnionDistances& at_vertices,
                    const std::vector<TaperedCapsule>& solids, double at_least_m,
                    double tolerance_m, const ThreadPool& pool) {
  double gap = std::max(0.0, at_least_m);
  const NearbyTriangles nearby(target, at_vertices, pool);
  const std::size_t count = target.triangles.size();
  std::vector<double> gaps((count + kChunk - 1) / kChunk, gap);
  const double tolerance = std::max(tolerance_m, 1e-7);
  pool.ForChunks(count, kChunk, [&](std::size_t begin, std::size_t end) {
    double& most = gaps[begin / kChunk];
    std::array<std::uint32_t, kChunk> others;
    const std::size_t others_count = nearby.ListOthers(begin, end, most, others);
    for (const std::uint32_t i : std::span(others).first(others_count)) {
      if (IsPlainlyNear(target, i, at_vertices, solids, most)) continue;
      most = std::max(most, GapOf(TriangleProbe(CornersOf(target, i), solids), tolerance));
    }
  });
  for (const double most : gaps) gap = std::max(gap, most);
  return gap;
}

}  // namespace capfit::coverage
