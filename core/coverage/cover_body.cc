#include "core/coverage/cover_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "core/base/chunk_sums.h"
#include "core/capsule/capsule_profile.h"
#include "core/coverage/grow.h"
#include "core/coverage/point_distances.h"
#include "core/coverage/surface_probe.h"
#include "core/tighten/point_grid.h"
#include "core/tighten/set_variables.h"
#include "core/tighten/sparse_points.h"
#include "core/tighten/tighten.h"
#include "core/tighten/union_volume.h"

namespace capfit::coverage {
namespace {

// Points this far apart over the root of the number of primitives, relative to the body's size, are
// enough to find the shape by: smaller solids need closer ones (with the largest spacing for all
// numbers E_r is 4 % higher at 250 primitives and 8 % at 346). All points have their say in the
// second phase.
constexpr double kSparseSpacing = 0.25;
constexpr double kMostSparse = 0.024;

// Where all must come in one row for each cell of this size and solid is as good as one for each
// vertex: over 19 bodies and six budgets E_r is the same to .3 % on average as with cells of .015,
// where it was half a per cent above, with .6 times the rows.
constexpr double kRowSpacing = 0.025;

// The set finds its shape with points left out at a price, which rises; then they must all come in.
// Starting with a low price matters most (a fifth of E_r): where everything must be inside from the
// start, each sphere is caught in the circle it came with. A programme's optimum is no better to go
// to than a point of its central path, which costs half as much and follows the points smoothly.
// One nearer to the centre costs E_r (5 % at 250 primitives with 1e-3).
constexpr tighten::TightenPhase kThoroughLoosening{.steps = 24,
                                                   .first_trust = 0.012,
                                                   .last_trust = 0.003,
                                                   .first_penalty = 1.2,
                                                   .last_penalty = 12.0,
                                                   .solve_to = {.centrality = 1e-4}};
// Ten steps lead nearly as far when the first ones may be twice as long: 2 to 7 % more E_r. Fewer
// or longer ones save little: eight cost up to 2 % of E_r.
constexpr tighten::TightenPhase kQuickLoosening{.steps = 10,
                                                .first_trust = 0.025,
                                                .last_trust = 0.003,
                                                .first_penalty = 1.4,
                                                .last_penalty = 12.0,
                                                .solve_to = {.centrality = 3e-4}};
// Of more than kFewPrimitives. Four steps more take 3 % of E_r for a twentieth of a fit's time.
// With as low a price to begin with, small solids come loose from what they came to hold and find
// another place by chance: 1 to 2 % more E_r above 200 primitives, and a tenth more scatter between
// budgets that are alike.
constexpr tighten::TightenPhase kLooseningOfMany{.steps = 14,
                                                 .first_trust = 0.021,
                                                 .last_trust = 0.003,
                                                 .first_penalty = 2.4,
                                                 .last_penalty = 12.0,
                                                 .solve_to = {.centrality = 3e-4}};
constexpr int kFewPrimitives = 150;
// A step each, relative to the body's size; before each but the first what sticks out between
// vertices is looked for anew. (Nine steps with three such looks, as many as they were, lead to the
// same E_r. So do programmes solved to a gap, or not as near to the central path's end, but where
// their iterations end hangs on the last digits: of 160 made bodies whose vertices are rounded to
// floats 95 keep their spheres to a tenth of a millimetre, and 7 with a centrality of 3e-4;
// tests/bench/rounding_trials. Longer first steps win .1 % with found shapes, which move less well
// with a skeleton then.)
constexpr std::array kTightTrusts = {0.004, 0.0028, 0.002, 0.0014, 0.001};
// After a quick loosening of kFewPrimitives at most: the other steps would win 1 % of E_r at 64
// primitives for a twentieth of a fit's time. Of more and smaller solids more sticks out.
constexpr std::array kQuickTightTrusts = {0.008, 0.004, 0.0015};
constexpr tighten::TightenPhase kTightStep{.steps = 1,
                                           .first_penalty = 0.4,
                                           .last_penalty = 0.4,
                                           .solve_to = {.centrality = 1e-5},
                                           .row_spacing = kRowSpacing};
// Where growing has made the set so much larger, points were left that no step could reach: beside
// the cut of a part that is fitted alone, or at the rim of a garment. Of whole bodies growing takes
// a few thousandths. The set then takes all steps once more from there, the long way: arms alone
// end with two thirds or half of the E_r, dressed torsos with two thirds.
constexpr double kMuchGrown = 1.1;
constexpr std::array kFarTrusts = {0.03,  0.02,   0.014, 0.01,   0.007,
                                   0.004, 0.0028, 0.002, 0.0014, 0.001};
// A set that tightening leaves so much larger than it came is compared with the paper's growing
// alone; on sound layouts tightening has won by far wherever the two were compared.
constexpr double kSuspectGrowth = 1.25;
constexpr int kShowingRounds = 4;
constexpr double kShownBy = 1e-5;  // metres, see CoverOptions::keeps_swallowed
// How much of the time has gone by at the end of each phase, as measured.
constexpr double kLooseUntil = 0.5;
constexpr double kTightUntil = 0.8;
constexpr double kGrownUntil = 0.9;
constexpr double kGridAccuracyM = 1e-6;   // of distances, see tighten::PointGrid
constexpr double kVolumeSpacing = 0.015;  // of samples, relative to the body's size

// Of a set that may cover nothing.
CoverReport NothingProved() {
  CoverReport report;
  report.max_vertex_distance_m = std::numeric_limits<double>::infinity();
  report.certified_gap_m = std::numeric_limits<double>::infinity();
  return report;
}

bool Loosens(const CoverOptions& options) {
  return options.tighten && options.loosening != Loosening::kNone;
}

bool Serves(const CoverGround* ground, bool mirrored, const CoverOptions& options) {
  return ground != nullptr && (ground->fold != tighten::PointGrid::Fold::kNone) == mirrored &&
         (!Loosens(options) || !ground->sparse.weights.empty());
}

class Coverer {
 public:
  Coverer(const tighten::CoverTarget& target, const CoverOptions& options, const ThreadPool& pool,
          FitObserver& observer, capsule::PrimitiveSet& set, const CoverGround* ground,
          Backlog* backlog)
      : target_(target),
        options_(options),
        pool_(pool),
        backlog_(backlog),
        meter_(observer),
        set_(set),
        variables_(set),
        own_ground_(Serves(ground, variables_.is_symmetric(), options)
                        ? std::nullopt
                        : std::optional(MakeCoverGround(target, variables_.is_symmetric(), options,
                                                        set.primitive_count(), pool))),
        ground_(own_ground_ ? *own_ground_ : *ground),
        distances_(target, ground_.points, ground_.size_m, variables_, set_, pool_) {}

  CoverReport Run() {
    if (options_.tighten) {
      TightenAndGrow();
    } else {
      Grow();
    }
    if (meter_.IsCancelled()) return NothingProved();
    meter_.Expect(1.0, 1);
    if (options_.keeps_swallowed) ShowSwallowed();
    report_.max_vertex_distance_m =
        MaxVertexDistance(target_, distances_.ByTargetIndex(), capsule::Solids(set_), pool_);
    // Tightening has measured it already.
    const bool is_measured = report_.volume_m3 > 0.0 && !options_.keeps_swallowed;
    if (options_.wants_volume && !is_measured) report_.volume_m3 = Volume();
    report_.certified_gap_m = CertifiedGap(
        target_, distances_.ByTargetIndex(), capsule::Solids(set_),
        std::max(KnownGap(), report_.max_vertex_distance_m), 0.05 * options_.max_gap_m, pool_);
    // Growing ends with a proof for every triangle, which may be sharper by the tolerance.
    report_.certified_gap_m = std::min(report_.certified_gap_m, MaxGap());
    report_.added_points = static_cast<int>(between_.size());
    const std::size_t capsules = set_.capsules.size();
    if (!options_.keeps_swallowed) RemoveSwallowed();
    if (set_.capsules.size() == capsules) report_.at_vertices = distances_.TakeByTargetIndex();
    return std::move(report_);
  }

 private:
  // What an end sphere swallows is that sphere, which stays.
  void RemoveSwallowed() {
    std::erase_if(set_.capsules, [this](const capsule::CapsuleEnds& ends) {
      return geometry::TaperedCapsule(set_.spheres[ends[0]], set_.spheres[ends[1]]).IsSphere();
    });
  }

  // Grows the smaller end of each swallowed capsule out of the larger one. That may be too much for
  // a next capsule, hence the rounds.
  void ShowSwallowed() {
    for (int round = 0; round < kShowingRounds; ++round) {
      for (std::size_t k = 0; k < set_.capsules.size(); ++k) {
        if (!set_.Capsule(k).IsSphere()) continue;
        geometry::Sphere* small = &set_.spheres[set_.capsules[k][0]];
        geometry::Sphere* large = &set_.spheres[set_.capsules[k][1]];
        if (small->radius_m > large->radius_m) std::swap(small, large);
        small->radius_m = large->radius_m - (small->center_m - large->center_m).norm() + kShownBy;
      }
    }
  }

  // What a way to cover the body led to.
  struct Outcome {
    capsule::PrimitiveSet set;
    std::vector<Eigen::Vector3d> between;
    CoverReport report;
  };

  void TightenAndGrow() {
    if (meter_.IsCancelled()) return;
    const Outcome before = {set_, {}, {}};
    const double volume_before = Volume();
    const double tightened = TightenThenGrow();
    if (report_.volume_m3 > kMuchGrown * tightened) {
      const Outcome grown = {set_, between_, report_};
      goes_far_ = true;
      TightenThenGrow();
      KeepSmaller(grown);
    }
    if (meter_.IsCancelled() || report_.volume_m3 <= kSuspectGrowth * volume_before) return;
    const Outcome tight = {set_, between_, report_};
    Restore(before);
    Grow();
    report_.volume_m3 = Volume();
    KeepSmaller(tight);
  }

  // Returns the volume between the two.
  double TightenThenGrow() {
    Tighten();
    const double tightened = Volume();
    Grow();
    report_.volume_m3 = Volume();
    return tightened;
  }

  void KeepSmaller(const Outcome& other) {
    if (report_.volume_m3 >= other.report.volume_m3) Restore(other);
  }

  void Restore(const Outcome& outcome) {
    set_ = outcome.set;
    between_ = outcome.between;
    report_ = outcome.report;
  }

  double Volume() const {
    return tighten::UnionVolumeGradient(set_, variables_, kVolumeSpacing * ground_.size_m,
                                        /*seed=*/7, pool_)
        .volume_m3;
  }

  void Tighten() {
    if (Loosens(options_) && !meter_.IsCancelled()) {
      const tighten::TightenPhase& phase = LooseningPhase();
      meter_.Expect(kLooseUntil, std::int64_t{phase.steps} * set_.primitive_count());
      RunPhase(phase, {{ground_.sparse.points, AllowedAtVertices(), ground_.sparse.weights}},
               /*seed=*/1);
    }
    // What sticks out between vertices shows only where the vertices are in, and asking for it
    // moves the set on to other such places: looked at before each step, little is left to growing.
    const std::span<const double> trusts = TightTrusts();
    for (std::size_t i = 0; i < trusts.size() && !meter_.IsCancelled(); ++i) {
      if (i > 0) Collect();
      tighten::TightenPhase step = kTightStep;
      step.first_trust = step.last_trust = trusts[i];
      const tighten::PointGrid between(between_, ground_.fold);
      meter_.ExpectShare(1.0 / static_cast<double>(trusts.size() - i), kTightUntil,
                         set_.primitive_count());
      tighten::PointsToHold vertices{ground_.points, AllowedAtVertices()};
      vertices.at_first = distances_.Known();
      RunPhase(step, {vertices, {between, AllowedBetween()}}, 101 + i);
    }
  }

  [[nodiscard]] const tighten::TightenPhase& LooseningPhase() const {
    if (options_.loosening == Loosening::kThorough || goes_far_) return kThoroughLoosening;
    return set_.primitive_count() > kFewPrimitives ? kLooseningOfMany : kQuickLoosening;
  }

  [[nodiscard]] std::span<const double> TightTrusts() const {
    if (goes_far_) return kFarTrusts;
    const bool is_quick =
        options_.loosening == Loosening::kQuick && set_.primitive_count() <= kFewPrimitives;
    return is_quick ? std::span<const double>(kQuickTightTrusts) : kTightTrusts;
  }

  void RunPhase(tighten::TightenPhase phase, const std::vector<tighten::PointsToHold>& points,
                std::uint64_t seed) {
    phase.uniform_radius = options_.uniform_radius;
    tighten::Tighten(points, ground_.size_m, phase, seed, pool_, meter_, set_, backlog_);
  }

  double AllowedAtVertices() const { return coverage::AllowedAtVertices(options_.tolerance_m); }
  double MaxGap() const { return options_.tolerance_m + options_.max_gap_m; }
  double AllowedBetween() const { return options_.tolerance_m + 0.8 * options_.max_gap_m; }

  Unproved FindUnproved() {
    return FindPointsOutside(target_, distances_.ByTargetIndex(), capsule::Solids(set_),
                             AllowedBetween(), MaxGap(), pool_);
  }

  // Adds points between vertices where the surface sticks out.
  void Collect() {
    const std::vector<Eigen::Vector3d> found = FindUnproved().points_m;
    between_.insert(between_.end(), found.begin(), found.end());
  }

  // How far the points between vertices that had to be asked for still stick out.
  double KnownGap() const {
    const tighten::UnionDistances at =
        tighten::PointGrid(between_).DistancesTo(capsule::Solids(set_), 0.0, pool_);
    double gap = 0.0;
    for (const double distance : at.distance_m) gap = std::max(gap, distance - kGridAccuracyM);
    return gap;
  }

  // Vertices first, then what lies between them. Solids only grow here: no point is met twice, what
  // is proved stays so, and the rounds come to an end.
  void Grow() {
    if (meter_.IsCancelled()) return;
    if (backlog_ == nullptr) return GrowAndProve();
    backlog_->Beside([this] { GrowAndProve(); });
  }

  void GrowAndProve() {
    meter_.Expect(kGrownUntil, 1);
    report_.growth_steps += GrowToAll(OpenDemands(), meter_.observer(), set_);
    Unproved open;
    if (!meter_.IsCancelled()) open = FindUnproved();
    while (!meter_.IsCancelled() && !open.points_m.empty()) {
      between_.insert(between_.end(), open.points_m.begin(), open.points_m.end());
      std::vector<Demand> demands;
      for (const Eigen::Vector3d& point : open.points_m) {
        demands.push_back({point, AllowedBetween()});
      }
      report_.growth_steps += GrowToAll(demands, meter_.observer(), set_);
      open = FindPointsOutside(target_, open.triangles, capsule::Solids(set_), AllowedBetween(),
                               MaxGap(), pool_);
    }
    // Only contains more by that, and still all that it has to.
    if (options_.uniform_radius) capsule::RaiseToUniformRadii(set_);
  }

  std::vector<Demand> OpenDemands() {
    const std::vector<double>& distance_m = distances_.InOrderOfPoints().distance_m;
    std::vector<Demand> demands;
    for (std::size_t i = 0; i < ground_.points.size(); ++i) {
      if (distance_m[i] > AllowedAtVertices() - kVertexDepthM) {
        demands.push_back({ground_.points.point(i), AllowedAtVertices()});
      }
    }
    for (const Eigen::Vector3d& point : between_) demands.push_back({point, AllowedBetween()});
    return demands;
  }

  const tighten::CoverTarget& target_;
  const CoverOptions& options_;
  const ThreadPool& pool_;
  Backlog* backlog_;
  WorkMeter meter_;
  capsule::PrimitiveSet& set_;
  tighten::SetVariables variables_;
  const std::optional<CoverGround> own_ground_;
  const CoverGround& ground_;
  std::vector<Eigen::Vector3d> between_;  // points inside triangles that had to be asked for
  PointDistances distances_;
  CoverReport report_;
  bool goes_far_ = false;  // the second time
};

}  // namespace

CoverGround MakeCoverGround(const tighten::CoverTarget& target, bool mirrored,
                            const CoverOptions& options, int primitives, const ThreadPool& pool) {
  CoverGround ground;
  if (mirrored) ground.fold = tighten::PointGrid::Fold::kToPositiveX;
  tighten::AreaWeights weights;
  pool.ForEach(2, [&](std::size_t half) {  // they touch different members
    if (half == 0) ground.points = tighten::PointGrid(target.points_m, ground.fold);
    if (half == 1) {
      if (Loosens(options)) weights = tighten::WeightsByArea(target);
      ground.size_m = Loosens(options) ? weights.size_m : tighten::SizeOf(target);
    }
  });
  if (weights.of_point_m2.empty()) return ground;
  std::vector<double> in_order;
  in_order.reserve(weights.of_point_m2.size());
  for (const std::uint32_t i : ground.points.order()) in_order.push_back(weights.of_point_m2[i]);
  const double spacing = std::min(
      kMostSparse, kSparseSpacing / std::sqrt(std::max(1.0, static_cast<double>(primitives))));
  tighten::SparsePoints sparse =
      tighten::MakeSparse(ground.points.points_m(), in_order, spacing * ground.size_m, pool);
  ground.sparse = {tighten::PointGrid(sparse.points_m), std::move(sparse.weights)};
  return ground;
}

CoverReport CoverBody(const tighten::CoverTarget& target, const CoverOptions& options,
                      const ThreadPool& pool, FitObserver& observer, capsule::PrimitiveSet& set,
                      const CoverGround* ground, Backlog* backlog) {
  if (target.points_m.empty() || set.spheres.empty()) {
    return target.points_m.empty() ? CoverReport{} : NothingProved();
  }
  return Coverer(target, options, pool, observer, set, ground, backlog).Run();
}

}  // namespace capfit::coverage
