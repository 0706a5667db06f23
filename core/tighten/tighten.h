// Makes the set as small as it can be while everything stays inside: centres and radii together, by
// sequential convex programming. What the growing step of the paper (III-D) gives away, this takes
// back.
#ifndef CAPFIT_CORE_TIGHTEN_TIGHTEN_H_
#define CAPFIT_CORE_TIGHTEN_TIGHTEN_H_

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/backlog.h"
#include "core/base/thread_pool.h"
#include "core/base/work_meter.h"
#include "core/capsule/primitive_set.h"
#include "core/tighten/full_cells.h"
#include "core/tighten/penalty_program.h"
#include "core/tighten/point_grid.h"

namespace capfit::tighten {

// A run of steps whose settings go from first to last in equal ratios. Lengths are relative to the
// size of the body, the square root of its surface area (1.1 to 1.6 m for an adult).
struct TightenPhase {
  int steps = 8;
  double first_trust = 0.01;  // how far a coordinate or radius may go in one step
  double last_trust = 0.01;
  // What points cost when they stick out, relative to what the volume costs when the whole surface
  // moves by as much. With weights: all points together. Above 1; small: points may be left out for
  // the while, and the set finds its shape. Without weights: each of them; a few tenths: all points
  // must be inside.
  double first_penalty = 3.0;
  double last_penalty = 3.0;
  // How far each step's programme is solved: by default far better than its rows are true. Where a
  // gap leaves it unfinished, vertices moved by a millionth can change the number of iterations and
  // with it the result; most_iterations do not depend on them. The next step's programme makes up
  // for what few iterations leave over. Trials that are only compared may take a gap of hundredths.
  SolveTo solve_to = {};
  // 0: a row for each point near the surface. Else one for each cell of this edge length and solid,
  // for the point that asks for most there: enough to end with, where another step follows that
  // sees what the others ask for.
  double row_spacing = 0.0;
  // Radii alone: the centres stay.
  bool fixed_centers = false;
  // Pulls the two radii of each capsule together, at a price: nearly equal, not exactly.
  bool uniform_radius = false;
};

// The set carried to another pose of the body.
struct CarriedPose {
  // By sphere: where its centre is now for a centre at rest_m in the set, and how what is around it
  // has turned since, so that a centre moved at rest by d has moved here by turn * d.
  std::vector<Eigen::Vector3d> rest_m;
  std::vector<Eigen::Vector3d> now_m;
  std::vector<Eigen::Matrix3d> turns;
};

// Points that must come in.
struct PointsToHold {
  const PointGrid& points;
  double allowed_m = 0.0;  // how far each may stick out; negative: how deep it must be
  // What each weighs, by the caller's index, any unit; or empty.
  std::span<const double> weights{};
  // Where the points are in another pose: into the set as that carries it. Not with folded points.
  const CarriedPose* pose = nullptr;
  // Their distances before the first step, if known, down to 1.5 of its trust regions.
  const UnionDistances* at_first = nullptr;
};

// Each step takes the least volume of the union, by its gradient, under one linear row for each
// point near the surface: a point of distance s at axis parameter t of its nearest solid must have
// s - (1-t)(n.da + dra) - t(n.db + drb) <= allowed, or pay the penalty. No step makes a capsule
// steeper than sin 0.8 or a radius smaller than 3 thousandths of the body's size, nor such ones
// worse. Mirrored spheres stay exact images.
//
// Points may be folded (PointGrid::Fold) where the set is its own mirror image. The result depends
// on the points smoothly but where the nearest solid of one changes. Costs 3 ms a step for ten
// thousand points and some fifty solids; stops early when cancelled. Adds the set's primitives to
// the meter in each step. The result is not feasible by itself: at the last trust region's accuracy
// only. The programmes are solved on this thread and on idle ones, which do a backlog first.
// Full cells are not left empty (see UnionVolumeGradient).
void Tighten(std::span<const PointsToHold> points, double body_size_m, const TightenPhase& phase,
             std::uint64_t seed, const ThreadPool& pool, const WorkMeter& meter,
             capsule::PrimitiveSet& set, Backlog* backlog = nullptr,
             const FullCells* full = nullptr);

}  // namespace capfit::tighten

#endif  // CAPFIT_CORE_TIGHTEN_TIGHTEN_H_
