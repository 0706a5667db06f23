// Results and backends made by hand.
#ifndef CAPFIT_TESTS_SERVER_FAKE_FIT_H_
#define CAPFIT_TESTS_SERVER_FAKE_FIT_H_

#include <atomic>
#include <cstddef>

#include "core/pipeline/fit.h"
#include "server/fit_backend.h"

namespace capfit::server {

// A result with every field set to something of its own: three spheres, two capsules, a warning,
// landmarks, a polygon, metrics of two parts, and dense weights and gaps (the middle one NaN) for
// `vertex_count` vertices where that is not 0.
[[nodiscard]] pipeline::FitResult HandMadeResult(std::size_t vertex_count = 0);

// Accepts every option and gives HandMadeResult at once, after progress for each stage.
[[nodiscard]] FitBackend InstantBackend(std::size_t vertex_count = 0);

// A backend whose fit waits until it is cancelled or released, as a long fit would.
struct Gate {
  std::atomic<int> waiting{0};  // fits that wait now
  std::atomic<bool> open{false};
};
[[nodiscard]] FitBackend WaitingBackend(Gate& gate);

}  // namespace capfit::server

#endif  // CAPFIT_TESTS_SERVER_FAKE_FIT_H_
