// Mannequins by lot, for tests and load.
#ifndef CAPFIT_TESTS_SUPPORT_RANDOM_MANNEQUIN_H_
#define CAPFIT_TESTS_SUPPORT_RANDOM_MANNEQUIN_H_

#include <cstdint>

#include "core/mannequin/mannequin.h"

namespace capfit::mannequin {

struct RandomMannequinLimits {
  int min_faces = 2'000;
  int max_faces = 40'000;
};

// Options that MakeMannequin accepts: sex, height 1.45 m to 2.05 m, slim to heavy with bust, waist
// and hip each a little off the common build, arms anywhere from 12 to 100 degrees (every other
// one in a named pose), quads or triangles, each of head, hands and feet cut off one time in four.
// Same seed, same options on every platform.
[[nodiscard]] MannequinOptions RandomMannequin(std::uint64_t seed,
                                               const RandomMannequinLimits& limits = {});

}  // namespace capfit::mannequin

#endif  // CAPFIT_TESTS_SUPPORT_RANDOM_MANNEQUIN_H_
