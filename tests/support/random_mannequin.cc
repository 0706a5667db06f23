#include "tests/support/random_mannequin.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/mannequin/proportions.h"

namespace capfit::mannequin {
namespace {

// Girths that belong together: one factor for the build, and a little of their own for each.
void ChooseGirths(Random& random, MannequinOptions& options) {
  const Proportions& usual = ProportionsOf(options.sex);
  const double build = random.NextIn(-0.08, 0.20);
  const double height_m = options.height_m;
  options.bust_m = height_m * usual.bust_girth * (1.0 + build + random.NextIn(-0.05, 0.06));
  options.waist_m = height_m * usual.waist_girth * (1.0 + 1.4 * build + random.NextIn(-0.06, 0.08));
  options.hip_m = height_m * usual.hip_girth * (1.0 + 0.9 * build + random.NextIn(-0.05, 0.06));
  for (std::optional<double>* const girth_m : {&options.bust_m, &options.waist_m, &options.hip_m}) {
    **girth_m = std::clamp(**girth_m, 0.5, 1.8);
  }
}

void ChoosePose(Random& random, MannequinOptions& options) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  options.pose = static_cast<MannequinPose>(random.NextBelow(3));
  const double angle_rad = random.NextIn(12.0, 100.0) * kDegree;
  if (random.NextBelow(2) == 1) options.arm_angle_rad = angle_rad;
}

}  // namespace

MannequinOptions RandomMannequin(std::uint64_t seed, const RandomMannequinLimits& limits) {
  Random random(seed);
  MannequinOptions options;
  options.sex = random.NextBelow(2) == 0 ? MannequinSex::kFemale : MannequinSex::kMale;
  options.height_m = random.NextIn(1.45, 2.05);
  ChooseGirths(random, options);
  ChoosePose(random, options);
  // Even on a scale of ratios: as many coarse meshes as fine ones.
  const double ratio = static_cast<double>(limits.max_faces) / limits.min_faces;
  options.faces =
      std::clamp(static_cast<int>(limits.min_faces * std::pow(ratio, random.NextUnit())),
                 limits.min_faces, limits.max_faces);
  options.quads = random.NextBelow(2) == 0;
  options.with_head = random.NextBelow(4) != 0;
  options.with_hands = random.NextBelow(4) != 0;
  options.with_feet = random.NextBelow(4) != 0;
  return options;
}

}  // namespace capfit::mannequin
