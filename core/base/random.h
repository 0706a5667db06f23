// Seeded random numbers that are the same on every platform and library.
#ifndef CAPFIT_CORE_BASE_RANDOM_H_
#define CAPFIT_CORE_BASE_RANDOM_H_

#include <cstdint>

namespace capfit {

// SplitMix64: one 64-bit word of state, full period, good enough for sampling and restarts.
// (std:: distributions differ between standard libraries; these do not.)
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  [[nodiscard]] std::uint64_t NextWord() {
    state_ += 0x9E3779B97F4A7C15ull;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  // Uniform in [0, 1).
  [[nodiscard]] double NextUnit() { return static_cast<double>(NextWord() >> 11) * 0x1.0p-53; }
  // Uniform in [low, high).
  [[nodiscard]] double NextIn(double low, double high) { return low + (high - low) * NextUnit(); }
  // Uniform in [0, count); count > 0.
  [[nodiscard]] std::uint64_t NextBelow(std::uint64_t count) {
    return static_cast<std::uint64_t>(NextUnit() * static_cast<double>(count));
  }

 private:
  std::uint64_t state_;
};

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_RANDOM_H_
