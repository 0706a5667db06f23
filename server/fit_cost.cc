#include "server/fit_cost.h"

#include <algorithm>
#include <cmath>

#include "core/base/enum_index.h"

namespace capfit::server {
namespace {

// Measured on two cores with 64 primitives: tests/bench/stage_times.sh.
constexpr double kSmallestSeconds = 0.05;
constexpr double kSecondsPerFace = 4e-6;
constexpr std::array<double, pipeline::kQualityCount> kQualityFactors = {1.0, 1.0, 3.0};
constexpr double kDenseFactor = 2.5;

constexpr double kStep = 0.2;  // one odd fit in five moves a guess no further than itself
// Whatever a clock or a stalled machine says, a guess stays a number to calculate with.
constexpr double kMaxFactor = 1000.0;

double FirstGuess(const FitSize& size) {
  double seconds = kSmallestSeconds +
                   kSecondsPerFace * static_cast<double>(std::max<std::int64_t>(0, size.faces));
  seconds *= kQualityFactors[Index(size.quality)];
  if (size.is_dense) seconds *= kDenseFactor;
  return seconds;
}

}  // namespace

FitCost::FitCost() { factor_.fill(1.0); }

std::size_t FitCost::KindOf(const FitSize& size) {
  const double steps = std::log2(static_cast<double>(std::max<std::int64_t>(1, size.faces))) / 2.0;
  const std::size_t by_size = std::min(kSizes - 1, static_cast<std::size_t>(steps));
  const std::size_t by_way = 2 * static_cast<std::size_t>(size.quality) + (size.is_dense ? 1U : 0U);
  return by_way * kSizes + by_size;
}

double FitCost::ExpectedSeconds(const FitSize& size) const {
  const std::lock_guard lock(mutex_);
  return FirstGuess(size) * factor_[KindOf(size)];
}

void FitCost::Learn(const FitSize& size, double seconds) {
  const double now = std::clamp(seconds / FirstGuess(size), 1.0 / kMaxFactor, kMaxFactor);
  const std::lock_guard lock(mutex_);
  double& factor = factor_[KindOf(size)];
  factor += kStep * (now - factor);
}

}  // namespace capfit::server
