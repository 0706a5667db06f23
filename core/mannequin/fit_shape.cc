#include "core/mannequin/fit_shape.h"

#include <algorithm>
#include <cmath>

#include "core/mannequin/body_details.h"
#include "core/mannequin/catmull_clark.h"
#include "core/mannequin/girth.h"
#include "core/mannequin/mannequin.h"

namespace capfit::mannequin {
namespace {

using Eigen::Vector3d;

Divisions Even(const QuadMesh& cage, int pieces) {
  Divisions divisions;
  divisions.faces.assign(cage.quads.size(), {pieces, pieces});
  divisions.largest = pieces;
  return divisions;
}

Divisions AtMost(Divisions divisions, int pieces) {
  for (auto& counts : divisions.faces) {
    counts = {std::min(counts[0], pieces), std::min(counts[1], pieces)};
  }
  divisions.largest = std::min(divisions.largest, pieces);
  return divisions;
}

// The girths as they are on the mesh with these divisions.
Girths MeasureGirths(const BodyShape& shape, const Divisions& divisions, double height) {
  const BodyCage cage = BuildBodyCage(shape);
  const SmoothSurface surface(WithMirrorImage(cage.half), LevelsFor(divisions));
  QuadMesh trunk = cage.half;
  trunk.quads.resize(cage.trunk_end);
  trunk = Sample(trunk, surface, divisions);
  ApplyBumps(BodyBumps(shape, cage), trunk.vertices);
  const auto girth = [&](double level) {
    return HalfBodyGirth(trunk.vertices, trunk.quads, level * height) / height;
  };
  return {girth(kBustLevel), girth(kWaistLevel), girth(kHipLevel)};
}

// Girths follow their factors almost in proportion and hardly each other's, so that correcting each
// by what is missing converges in a few steps.
void FitGirths(const Girths& wanted, double height, const Divisions& divisions, double tolerance,
               BodyShape& shape) {
  constexpr int kMaxSteps = 15;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Girths found = MeasureGirths(shape, divisions, height);
    const Girths ratio{wanted.bust / found.bust, wanted.waist / found.waist,
                       wanted.hip / found.hip};
    if (std::max({std::abs(ratio.bust - 1), std::abs(ratio.waist - 1), std::abs(ratio.hip - 1)}) <
        tolerance) {
      return;
    }
    shape.bust_factor *= ratio.bust;
    shape.waist_factor *= ratio.waist;
    shape.hip_factor *= ratio.hip;
  }
}

}  // namespace

double WholeHeight(BodyShape shape) {
  shape.with_head = shape.with_hands = shape.with_feet = true;
  const BodyCage cage = BuildBodyCage(shape);
  const SmoothSurface surface(WithMirrorImage(cage.half), 2);
  QuadMesh body = Sample(cage.half, surface, Even(cage.half, 4));
  ApplyBumps(BodyBumps(shape, cage), body.vertices);
  double height = 0.0;
  for (const Vector3d& p : body.vertices) height = std::max(height, p.y());
  return height;
}

int LevelsFor(const Divisions& divisions) {
  // One and two pieces need no more than the limit of the cage's own corners and middles.
  if (divisions.largest <= 2) return divisions.largest - 1;
  int levels = 2;
  while (levels < 4 && (1 << levels) < divisions.largest) ++levels;
  return levels;
}

Divisions FitShape(const Girths& wanted, double height, int quads, BodyShape& shape) {
  // Roughly first, because the divisions follow the shape, and on a coarse mesh the girths follow
  // the divisions: there the tape lies on chords.
  FitGirths(wanted, height, Even(BuildBodyCage(shape).half, 1), 0.01, shape);
  const BodyCage cage = BuildBodyCage(shape);
  Divisions divisions =
      ChooseDivisions(cage.half, SmoothSurface(WithMirrorImage(cage.half), 2), quads);
  FitGirths(wanted, height, AtMost(divisions, 4), 5e-4, shape);
  return divisions;
}

}  // namespace capfit::mannequin
