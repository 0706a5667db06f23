// Growing the set until nothing of the body sticks out (paper, III-D), and proving it.
#ifndef CAPFIT_CORE_COVERAGE_COVER_BODY_H_
#define CAPFIT_CORE_COVERAGE_COVER_BODY_H_

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/backlog.h"
#include "core/base/fit_observer.h"
#include "core/base/thread_pool.h"
#include "core/capsule/primitive_set.h"
#include "core/tighten/cover_target.h"
#include "core/tighten/point_grid.h"

namespace capfit::coverage {

// Whether tightening begins with points left out at a low price, which finds the shape anew.
enum class Loosening {
  kNone,     // the set has its shape already
  kQuick,    // two fifths of the steps: 2 to 7 % more E_r (means over 19 bodies, by budget)
  kThorough  // until more steps change little
};

struct CoverOptions {
  // How far a vertex may stick out; 0: none does. What is between vertices may as far, and
  // max_gap_m more.
  double tolerance_m = 0.0;
  // Between vertices: triangles are cut finer until no point of them is further out than this (and
  // tolerance_m).
  double max_gap_m = 1e-3;
  // Fit centres and radii together for the least volume before growing (see tighten.h). Without, it
  // is the paper's own step, furthest point first.
  bool tighten = true;
  Loosening loosening = Loosening::kQuick;
  // Both ends of a capsule end up with one radius. Capsules must not share spheres then (see
  // capsule::WithUniformRadii).
  bool uniform_radius = false;
  // Capsules that an end sphere has come to swallow stay: the smaller sphere is made to show by a
  // hundredth of a millimetre, so that engines take the capsule for one.
  bool keeps_swallowed = false;
  // CoverReport::volume_m3 is looked at: where the smallest of several sets is chosen.
  bool wants_volume = false;
};

// Vertices end up this deep inside at least, so that writing the result in another unit or with
// fewer digits does not bring them out again. A hundredth of what anybody can measure.
inline constexpr double kVertexDepthM = 1e-6;

// How far outside a vertex may be with a tolerance; negative: how deep it must be.
[[nodiscard]] constexpr double AllowedAtVertices(double tolerance_m) {
  return tolerance_m > kVertexDepthM ? tolerance_m - kVertexDepthM : -kVertexDepthM;
}

struct CoverReport {
  int growth_steps = 0;
  int added_points = 0;                // inside triangles, where vertices alone were not enough
  double max_vertex_distance_m = 0.0;  // furthest vertex outside; <= 0 when all are inside
  double volume_m3 = 0.0;              // of the union, where it was wanted
  double certified_gap_m = 0.0;        // no point of the surface is further out than this (proved)
  // Of the target's points, with solids of the set as it is at the end; empty where one went.
  tighten::UnionDistances at_vertices;
};

// Few points that stand for all while the set finds its shape (see tighten::MakeSparse).
struct SparseGround {
  tighten::PointGrid points{{}};
  std::vector<double> weights;  // by the index that the points came with
};

// What covering takes from the points alone: made once for several sets, and before there is one.
struct CoverGround {
  tighten::PointGrid::Fold fold = tighten::PointGrid::Fold::kNone;
  tighten::PointGrid points{{}};  // folded, all of the target's
  double size_m = 0.0;            // tighten::SizeOf
  SparseGround sparse;            // of `points`; none where nothing is loosened
};

// For sets that are `mirrored`, that is their own mirror images, or for others. There must be a
// point. `primitives`: about as many as the set will have; more need closer points to find their
// shape by. O(points + triangles).
[[nodiscard]] CoverGround MakeCoverGround(const tighten::CoverTarget& target, bool mirrored,
                                          const CoverOptions& options, int primitives,
                                          const ThreadPool& pool);

// Moves, shrinks and grows spheres until every point is inside and no triangle sticks out by more
// than options.max_gap_m, with the least volume it can find. Spheres and capsules stay the same
// ones, but for capsules that an end sphere has come to swallow: those go. Mirrored spheres stay
// exact images of each other, whatever the small asymmetries of the points.
//
// Tells the observer the fraction of its own work. With no tolerance, vertices end up 1 um deep or
// more, unless the observer cancels: then the set is as far as it came, and the report says that
// nothing is proved (infinite distances). Terminates: every growing step covers a point and
// uncovers none. Some 20 ms for 14k vertices at n_p 64. A `ground` that was made for the set's kind
// of symmetry and these options spares a tenth of the time; another is not used.
// A backlog is done in part beside what runs on one thread alone.
[[nodiscard]] CoverReport CoverBody(const tighten::CoverTarget& target, const CoverOptions& options,
                                    const ThreadPool& pool, FitObserver& observer,
                                    capsule::PrimitiveSet& set, const CoverGround* ground = nullptr,
                                    Backlog* backlog = nullptr);

// Upper bound of the distance by which any point of the target's triangles sticks out of the set,
// by branch and bound (no distance changes faster than the point moves), at most `tolerance_m`
// above the truth. 0 when nothing sticks out.
[[nodiscard]] double CertifiedGap(const tighten::CoverTarget& target,
                                  const capsule::PrimitiveSet& set, double tolerance_m,
                                  const ThreadPool& pool);

}  // namespace capfit::coverage

#endif  // CAPFIT_CORE_COVERAGE_COVER_BODY_H_
