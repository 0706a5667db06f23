// Times of many calls in little memory.
#ifndef CAPFIT_CLIENT_LATENCY_HISTOGRAM_H_
#define CAPFIT_CLIENT_LATENCY_HISTOGRAM_H_

#include <array>
#include <cstdint>

namespace capfit::client {

// Counts in buckets whose bounds grow by 2.2 % each (32 for a doubling), from 1 us to 19 hours:
// a quantile is at most that much too large, however many calls there were.
class LatencyHistogram {
 public:
  void Add(double seconds);
  void Add(const LatencyHistogram& other);

  [[nodiscard]] std::int64_t count() const { return count_; }
  [[nodiscard]] double max_seconds() const { return max_seconds_; }
  // 0 where nothing was counted.
  [[nodiscard]] double mean_seconds() const;
  // The time that a `fraction` of all calls did not exceed, in seconds; `fraction` in (0, 1]. 0
  // where nothing was counted.
  [[nodiscard]] double Quantile(double fraction) const;

 private:
  static constexpr int kBucketsPerDoubling = 32;
  static constexpr int kDoublings = 36;
  std::array<std::int64_t, kBucketsPerDoubling * kDoublings> buckets_{};
  std::int64_t count_ = 0;
  double sum_seconds_ = 0.0;
  double max_seconds_ = 0.0;
};

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_LATENCY_HISTOGRAM_H_
