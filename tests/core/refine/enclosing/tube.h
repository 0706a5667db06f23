// A tube to be enclosed, and what encloses it.
#ifndef CAPFIT_TESTS_CORE_REFINE_ENCLOSING_TUBE_H_
#define CAPFIT_TESTS_CORE_REFINE_ENCLOSING_TUBE_H_

#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/capsule/mirrored_set.h"
#include "core/refine/enclosing/enclosing_task.h"

namespace capfit::refine {

inline constexpr double kRadius = 0.1;
inline constexpr double kLength = 1.0;

// A tube along y from 0 to kLength, open at both ends.
inline tighten::CoverTarget Tube() {
  constexpr int kRings = 41;
  constexpr int kAround = 24;
  tighten::CoverTarget target;
  for (int ring = 0; ring < kRings; ++ring) {
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.5) / kAround;
      target.points_m.own().emplace_back(kRadius * std::cos(angle), kLength * ring / (kRings - 1),
                                         kRadius * std::sin(angle));
      if (ring == 0) continue;
      const auto at = [&](int r, int k) {
        return static_cast<std::uint32_t>(r * kAround + k % kAround);
      };
      target.triangles.own().push_back({at(ring - 1, i), at(ring, i), at(ring, i + 1)});
      target.triangles.own().push_back({at(ring - 1, i), at(ring, i + 1), at(ring - 1, i + 1)});
    }
  }
  return target;
}

inline const EnclosingTask& TubeTask() {
  static const EnclosingTask task(Tube(), /*symmetric=*/false, 0.0, 0.03);
  return task;
}

// Spheres of the tube's radius along it; nothing is tied.
inline capsule::MirroredSet Beads(int count) {
  capsule::MirroredSet graph;
  for (int i = 0; i < count; ++i) {
    graph.AddSphere({{0.0, kLength * i / (count - 1), 0.0}, 1.02 * kRadius}, false);
  }
  return graph;
}

// The same, each tied to the next.
inline capsule::MirroredSet Chain(int count) {
  capsule::MirroredSet graph = Beads(count);
  for (int i = 0; i + 1 < count; ++i) graph.AddCapsule(i, i + 1);
  return graph;
}

}  // namespace capfit::refine

#endif  // CAPFIT_TESTS_CORE_REFINE_ENCLOSING_TUBE_H_
