// How many seconds a fit will take: a guess that learns from the fits of this server.
#ifndef CAPFIT_SERVER_FIT_COST_H_
#define CAPFIT_SERVER_FIT_COST_H_

#include <array>
#include <cstdint>
#include <mutex>

#include "core/pipeline/fit.h"

namespace capfit::server {

// What is known of a fit before it runs.
struct FitSize {
  std::int64_t faces = 0;
  pipeline::Quality quality = pipeline::Quality::kPaper;
  bool is_dense = false;  // dense weights
};

// Fits are kept apart by quality, by dense weights and by size (each kind four times the one
// before). Before the first of a kind the guess is what a plain machine of two cores takes; each
// fit that ends well then moves the guess for its kind a fifth of the way. Guesses order the queue
// and bound it: they need not be right, only in the right order of size.
class FitCost {
 public:
  FitCost();
  // Seconds, > 0.
  [[nodiscard]] double ExpectedSeconds(const FitSize& size) const;
  // Such a fit took so long.
  void Learn(const FitSize& size, double seconds);

 private:
  static constexpr std::size_t kSizes = 12;
  [[nodiscard]] static std::size_t KindOf(const FitSize& size);

  mutable std::mutex mutex_;
  std::array<double, 2 * pipeline::kQualityCount * kSizes>
      factor_{};  // by kind: seconds taken / seconds guessed at first
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_FIT_COST_H_
