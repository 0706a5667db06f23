#include "core/tighten/tighten.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/tighten/penalty_program.h"
#include "core/tighten/set_variables.h"
#include "core/tighten/union_volume.h"

namespace capfit::tighten {
namespace {

using geometry::TaperedCapsule;

// Steeper capsules are little more than their larger end, and engines differ most on them.
constexpr double kMaxSin = 0.8;
// What fixed centres may go, relative to the trust region: the programme wants some room.
constexpr double kFixed = 1e-6;
// Relative to the body's size, as the settings of a phase are.
constexpr double kLeastRadius = 0.003;
constexpr double kLeastFirstRadius = 1e-6;  // that a phase begins with
constexpr double kSampleSpacing = 0.025;
constexpr double kSteepnessReach = 0.05;  // capsules this near to the limit get a row
constexpr double kSteepnessPenalty = 100.0;
// Points deeper than this many trust regions cannot get out in one step: both ends move and grow.
constexpr double kDepthOfInterest = 1.5;
// Added curvature, in volumes per body size squared: keeps idle variables where they are.
constexpr double kIdleCurvature = 1e-3;

constexpr std::size_t kBlocksAtOnce = 8;
// Points this near to equally far out are taken in the caller's order, whatever rounding says.
constexpr double kEqualM = 1e-6;
// Cells do not begin where the coordinates of made meshes like to lie.
constexpr double kCellOffset = 0.3819;

double Between(double first, double last, int step, int steps) {
  if (steps <= 1) return last;
  return first * std::pow(last / first, static_cast<double>(step) / (steps - 1));
}

class Tightener {
 public:
  Tightener(std::span<const PointsToHold> points, double body_size_m, const ThreadPool& pool,
            capsule::PrimitiveSet& set, Backlog* backlog, const FullCells* full)
      : points_(points),
        size_(body_size_m),
        pool_(pool),
        backlog_(backlog),
        full_(full),
        set_(set),
        variables_(set),
        solver_(pool) {
    // A sphere that is a point has nothing to give, and a programme needs some room on both sides.
    for (geometry::Sphere& sphere : set_.spheres) {
      sphere.radius_m = std::max(sphere.radius_m, kLeastFirstRadius * size_);
    }
  }

  void Step(double trust_m, double penalty, const TightenPhase& phase, std::uint64_t seed) {
    shapes_ = capsule::Solids(set_);
    // They touch different members of the programme. The rows come first: this thread, which takes
    // them, goes on with them, and it is slow to fetch much that another one wrote.
    pool_.ForEach(2, [&](std::size_t half) {
      if (half == 0) AddPointRows(kDepthOfInterest * trust_m, phase.row_spacing * size_);
      if (half == 1) AddVolume(seed);
    });
    AddBounds(trust_m, phase.fixed_centers ? kFixed * trust_m : trust_m);
    SetPenalties(penalty);
    if (phase.uniform_radius) {
      AddUniformRows();
    } else {
      AddSteepnessRows();
    }
    Eigen::VectorXd change;
    const auto solve = [&] { change = solver_.Solve(program_, phase.solve_to); };
    if (backlog_ != nullptr) {
      backlog_->Beside(solve);
    } else {
      solve();
    }
    if (change.allFinite()) variables_.Apply(change, set_);
    is_first_ = false;
  }

 private:
  // Linear: the volume's gradient. Quadratic: a sphere that grows, or slides off, exposes more of
  // itself; half its exposed area over its radius is what that costs per square of the step.
  void AddVolume(std::uint64_t seed) {
    const VolumeGradient gradient =
        UnionVolumeGradient(set_, variables_, kSampleSpacing * size_, seed, pool_, full_);
    if (volume_ == 0.0) volume_ = std::max(gradient.volume_m3, 1e-6 * size_ * size_ * size_);
    growth_rate_ = std::max(gradient.area_m2 / volume_, 1e-6 / size_);
    program_.gradient = Eigen::VectorXd::Zero(variables_.count());
    program_.hessian =
        Eigen::VectorXd::Constant(variables_.count(), kIdleCurvature / (size_ * size_));
    for (int i = 0; i < static_cast<int>(set_.spheres.size()); ++i) {
      const Eigen::Vector4d by_sphere = gradient.by_sphere[i] / volume_;
      const int first = variables_.of(i).first;
      program_.gradient.segment<4>(first) += variables_.ToVariables(i, by_sphere);
      program_.hessian.segment<4>(first).array() +=
          0.5 * std::abs(by_sphere.w()) / std::max(set_.spheres[i].radius_m, kLeastRadius * size_);
    }
  }

  void AddBounds(double trust_m, double center_trust_m) {
    program_.upper = Eigen::VectorXd::Constant(variables_.count(), center_trust_m);
    for (const int i : variables_.representatives()) {
      program_.upper[variables_.of(i).first + 3] = trust_m;
    }
    program_.lower = -program_.upper;
    for (const int i : variables_.representatives()) {
      const double radius = set_.spheres[i].radius_m;
      const double room = std::max(radius - kLeastRadius * size_, 1e-3 * std::min(trust_m, radius));
      double& lower = program_.lower[variables_.of(i).first + 3];
      lower = std::max(lower, -room);
    }
  }

  PenaltyRow RowOf(const capsule::CapsuleEnds& solid, const Eigen::Vector4d& by_a,
                   const Eigen::Vector4d& by_b, double value, double penalty) const {
    PenaltyRow row;
    row.value = value;
    row.penalty = penalty;
    row.first = {variables_.of(solid[0]).first, variables_.of(solid[1]).first};
    Eigen::Map<Eigen::Matrix<double, 8, 1>> coefficients(row.coefficients.data());
    coefficients.head<4>() = variables_.ToVariables(solid[0], by_a);
    coefficients.tail<4>() = variables_.ToVariables(solid[1], by_b);
    if (row.first[0] == row.first[1]) {  // a sphere, or a bar between two images
      coefficients.head<4>() += coefficients.tail<4>();
      row.first[1] = -1;
    }
    return row;
  }

  // How fast a point's distance falls as the sphere moves and grows.
  static Eigen::Vector4d SpeedOf(const Eigen::Vector3d& normal, const CarriedPose* pose,
                                 int sphere) {
    const Eigen::Vector3d at_rest =
        pose == nullptr ? normal : pose->turns[sphere].transpose() * normal;
    return {at_rest.x(), at_rest.y(), at_rest.z(), 1.0};
  }

  // `place`: of the point in the grid.
  PenaltyRow PointRow(const PointsToHold& points, const std::vector<TaperedCapsule>& shapes,
                      std::uint32_t place, std::int32_t nearest, double penalty) const {
    const geometry::CapsuleDistance at = shapes[nearest].Locate(points.points.point(place));
    const capsule::CapsuleEnds& solid = variables_.solids()[nearest];
    return RowOf(solid, -(1.0 - at.axis_parameter) * SpeedOf(at.normal, points.pose, solid[0]),
                 -at.axis_parameter * SpeedOf(at.normal, points.pose, solid[1]),
                 at.distance_m - points.allowed_m, penalty);
  }

  std::vector<TaperedCapsule> ShapesIn(const CarriedPose& pose) const {
    capsule::PrimitiveSet carried = set_;
    for (std::size_t i = 0; i < carried.spheres.size(); ++i) {
      carried.spheres[i].center_m =
          pose.now_m[i] + pose.turns[i] * (set_.spheres[i].center_m - pose.rest_m[i]);
    }
    return capsule::Solids(carried);
  }

  void AddPointRows(double depth_m, double spacing_m) {
    near_weight_ = 0.0;
    batches_ = 0;
    if (shapes_.empty()) return;
    for (const PointsToHold& points : points_) {
      const std::vector<TaperedCapsule> shapes =
          points.pose == nullptr ? shapes_ : ShapesIn(*points.pose);
      const bool is_known = is_first_ && points.at_first != nullptr;
      UnionDistances measured;
      if (!is_known) measured = points.points.DistancesTo(shapes, -depth_m, pool_);
      const UnionDistances& distances = is_known ? *points.at_first : measured;
      const std::size_t blocks = points.points.blocks().size();
      const std::size_t chunks = (blocks + kBlocksAtOnce - 1) / kBlocksAtOnce;
      const std::size_t first = std::exchange(batches_, batches_ + chunks);
      if (program_.batches.size() < batches_) program_.batches.resize(batches_);
      std::vector<double> near_weights(chunks, 0.0);
      pool_.ForChunks(blocks, kBlocksAtOnce, [&](std::size_t begin, std::size_t end) {
        const std::size_t chunk = begin / kBlocksAtOnce;
        std::vector<PenaltyRow>& rows = program_.batches[first + chunk].rows;
        rows.clear();
        if (spacing_m <= 0.0) {  // nearly all of the points may ask for one
          const std::vector<PointGrid::Block>& all = points.points.blocks();
          rows.reserve(all[end - 1].end - all[begin].begin);
        }
        for (std::size_t b = begin; b < end; ++b) {
          if (spacing_m > 0.0) {
            AddDemanding(points, shapes, distances, b, depth_m, spacing_m, rows);
          } else {
            near_weights[chunk] += AddAll(points, shapes, distances, b, depth_m, rows);
          }
        }
      });
      for (const double weight : near_weights) near_weight_ += weight;
    }
  }

  // All points near the surface: a choice among them could fall out differently for vertices that
  // differ by rounding alone. For the same reason those just near enough count for nothing yet
  // where weights are added up; as rows they do not bind.
  double AddAll(const PointsToHold& points, const std::vector<TaperedCapsule>& shapes,
                const UnionDistances& distances, std::size_t b, double depth_m,
                std::vector<PenaltyRow>& rows) const {
    double near_weight = 0.0;
    const PointGrid::Block& block = points.points.blocks()[b];
    for (std::uint32_t i = block.begin; i < block.end; ++i) {
      const double excess = distances.distance_m[i] - points.allowed_m;
      if (excess <= -depth_m) continue;
      const double ramp = std::min(1.0, 2.0 * (1.0 + excess / depth_m));
      const double weight = points.weights.empty() ? 1.0 : points.weights[points.points.order()[i]];
      near_weight += ramp * weight;
      rows.push_back(PointRow(points, shapes, i, distances.solid[i], weight));
    }
    return near_weight;
  }

  // Of the points of a cell that are nearest to the same solid, or to its image, the one furthest
  // out.
  void AddDemanding(const PointsToHold& points, const std::vector<TaperedCapsule>& shapes,
                    const UnionDistances& distances, std::size_t b, double depth_m,
                    double spacing_m, std::vector<PenaltyRow>& rows) const {
    std::array<std::uint64_t, PointGrid::kMaxBlock> cells;   // keys
    std::array<std::uint32_t, PointGrid::kMaxBlock> chosen;  // point of each
    std::size_t count = 0;
    const PointGrid::Block& block = points.points.blocks()[b];
    const double per_m = 1.0 / spacing_m;
    for (std::uint32_t i = block.begin; i < block.end; ++i) {
      if (distances.distance_m[i] - points.allowed_m <= -depth_m) continue;
      const std::uint64_t key = CellKey(points.points.point(i), per_m, distances.solid[i]);
      std::size_t c = 0;
      while (c < count && cells[c] != key) ++c;
      if (c == count) {
        cells[count] = key;
        chosen[count++] = i;
      } else if (distances.distance_m[i] > distances.distance_m[chosen[c]] + kEqualM) {
        chosen[c] = i;
      }
    }
    for (std::size_t c = 0; c < count; ++c) {
      rows.push_back(PointRow(points, shapes, chosen[c], distances.solid[chosen[c]], 1.0));
    }
  }

  // The same for points of a block that share a cell and a solid, or its image. 16 bits for each
  // number: cells further apart than that are not in one block.
  std::uint64_t CellKey(const Eigen::Vector3d& point, double per_m, std::int32_t solid) const {
    const auto place = [&](int axis) {
      const double at = std::floor(point[axis] * per_m + kCellOffset);
      return std::uint64_t{static_cast<std::uint16_t>(static_cast<std::int64_t>(at))};
    };
    const std::size_t own = solid;
    const std::uint64_t pair = std::min(own, variables_.image_of_solid(own));
    return pair << 48 | place(0) << 32 | place(1) << 16 | place(2);
  }

  // Together the rows weigh `penalty` times as much as the volume does when the whole surface
  // moves: so it means the same for any number of points, and below 1 everything would shrink to
  // nothing.
  void SetPenalties(double penalty) {
    const bool is_weighted = !points_.empty() && !points_.front().weights.empty();
    const double each = penalty * growth_rate_ / (is_weighted ? near_weight_ : 1.0);
    program_.batches.resize(batches_);
    for (RowBatch& batch : program_.batches) batch.penalty_factor = each;
  }

  // |r_a - r_b| <= kMaxSin * length. Where that is broken already it must not get worse.
  void AddSteepnessRows() {
    std::vector<PenaltyRow>& rows = program_.batches.emplace_back().rows;
    for (std::size_t k = 0; k < shapes_.size(); ++k) {
      const capsule::CapsuleEnds& solid = variables_.solids()[k];
      if (solid[0] == solid[1]) continue;
      const TaperedCapsule& shape = shapes_[k];
      const double difference = shape.a().radius_m - shape.b().radius_m;
      const double excess = std::abs(difference) - kMaxSin * shape.length_m();
      if (excess < -kSteepnessReach * size_) continue;
      Eigen::Vector4d by_a;
      by_a << kMaxSin * shape.axis(), difference >= 0.0 ? 1.0 : -1.0;
      rows.push_back(RowOf(solid, by_a, -by_a, std::min(excess, 0.0), kSteepnessPenalty / size_));
    }
  }

  // |r_a - r_b| <= 0, a row for each sign.
  void AddUniformRows() {
    std::vector<PenaltyRow>& rows = program_.batches.emplace_back().rows;
    for (std::size_t k = 0; k < shapes_.size(); ++k) {
      const capsule::CapsuleEnds& solid = variables_.solids()[k];
      if (solid[0] == solid[1]) continue;
      const double difference = shapes_[k].a().radius_m - shapes_[k].b().radius_m;
      const Eigen::Vector4d radius(0.0, 0.0, 0.0, 1.0);
      const double penalty = kSteepnessPenalty / size_;
      rows.push_back(RowOf(solid, radius, -radius, difference, penalty));
      rows.push_back(RowOf(solid, -radius, radius, -difference, penalty));
    }
  }

  std::span<const PointsToHold> points_;
  bool is_first_ = true;      // step
  double near_weight_ = 0.0;  // of the points near the surface
  double size_;
  const ThreadPool& pool_;
  Backlog* backlog_;
  const FullCells* full_;
  capsule::PrimitiveSet& set_;
  SetVariables variables_;
  PenaltySolver solver_;
  PenaltyProgram program_;   // of the last step: its memory serves again
  std::size_t batches_ = 0;  // of rows, for points
  std::vector<TaperedCapsule> shapes_;
  double growth_rate_ = 0.0;  // relative volume that one metre of growth everywhere adds
  double volume_ = 0.0;       // of the union when the phase began: the unit of the objective
};

}  // namespace

void Tighten(std::span<const PointsToHold> points, double body_size_m, const TightenPhase& phase,
             std::uint64_t seed, const ThreadPool& pool, const WorkMeter& meter,
             capsule::PrimitiveSet& set, Backlog* backlog, const FullCells* full) {
  Tightener tightener(points, body_size_m, pool, set, backlog, full);
  for (int i = 0; i < phase.steps && !meter.IsCancelled(); ++i) {
    const double trust = Between(phase.first_trust, phase.last_trust, i, phase.steps);
    const double penalty = Between(phase.first_penalty, phase.last_penalty, i, phase.steps);
    tightener.Step(trust * body_size_m, penalty, phase, seed + static_cast<std::uint64_t>(i));
    meter.Add(set.primitive_count());
  }
}

}  // namespace capfit::tighten
