// What a best fit leaves out by far: the part of its objective that is no volume.
#ifndef CAPFIT_CORE_REFINE_BEST_FIT_FAR_MISSES_H_
#define CAPFIT_CORE_REFINE_BEST_FIT_FAR_MISSES_H_

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/capsule/mirrored_set.h"
#include "core/refine/best_fit/fill_error.h"
#include "core/refine/graph/cone.h"
#include "core/tighten/point_grid.h"

namespace capfit::refine {

// What is left out further than this counts beside E_r, so that a body keeps its forearms and
// hands: a mean miss of 1 cm over the surface as much as a tenth of the volume.
inline constexpr double kFarMissM = 0.04;

// The points of the fitted surface (at x >= 0 for mirrored sets), and how far one may stick out.
struct SurfacePoints {
  tighten::PointGrid grid;
  double allowed_m = 0.0;
};

// How far each point sticks out of the set beyond what is allowed, in the grid's order; some number
// <= 0 inside.
[[nodiscard]] std::vector<double> ExcessOf(const SurfacePoints& points,
                                           const capsule::MirroredSet& graph,
                                           const ThreadPool& pool);

// How much further out than kFarMissM each point is; 0 within.
[[nodiscard]] std::vector<double> FarMisses(const SurfacePoints& points,
                                            const capsule::MirroredSet& graph,
                                            const ThreadPool& pool);

// By cone: how much more is missed by far without it and its image (ImagesOfCones), if all else
// stays; in metres, summed up. Both of a pair have what the two have together.
[[nodiscard]] std::vector<double> MissedWithout(const SurfacePoints& points,
                                                const std::vector<Cone>& cones,
                                                const std::vector<int>& images,
                                                const ThreadPool& pool);

// The points in groups of eight neighbours, for many quick looks at some of them.
class PointGroups {
 public:
  // `points` must outlive the groups.
  explicit PointGroups(const SurfacePoints& points);

  // FarMisses, as LessMissed takes them.
  struct Misses {
    std::vector<std::array<float, 8>> by_group_m;
    std::vector<char> any;  // by group
  };
  [[nodiscard]] Misses Group(const std::vector<double>& misses_m) const;

  // By how much less the points in the box are missed by the union of `cones` than they were
  // before; in metres, summed up.
  [[nodiscard]] double LessMissed(const Misses& before, const Box& box,
                                  const std::vector<Cone>& cones) const;

 private:
  static constexpr int kLane = 8;
  struct Eight {
    alignas(32) std::array<float, kLane> x, y, z;
    Eigen::AlignedBox3f box;
  };

  // How much further out than kFarMissM each point of the group is; false where none is. `near`:
  // the cone to try first, and in the end one that misses none of them, if any; neighbours mostly
  // have the same.
  [[nodiscard]] bool FindMisses(const Eight& group, const std::vector<Cone>& cones,
                                std::size_t& near, std::array<float, kLane>& misses_m) const;

  const SurfacePoints& points_;
  std::vector<Eight> groups_;
};

// What a sum of misses, in metres, counts beside E_r.
[[nodiscard]] double MissPenalty(const SurfacePoints& points, double miss_m);

}  // namespace capfit::refine

#endif  // CAPFIT_CORE_REFINE_BEST_FIT_FAR_MISSES_H_
