#include "client/latency_histogram.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace capfit::client {

void LatencyHistogram::Add(double seconds) {
  const double microseconds = std::max(1.0, seconds * 1e6);
  const auto last = static_cast<double>(buckets_.size() - 1);
  const double bucket = std::min(last, std::floor(std::log2(microseconds) * kBucketsPerDoubling));
  ++buckets_[static_cast<std::size_t>(bucket)];
  ++count_;
  sum_seconds_ += seconds;
  max_seconds_ = std::max(max_seconds_, seconds);
}

void LatencyHistogram::Add(const LatencyHistogram& other) {
  for (std::size_t i = 0; i < buckets_.size(); ++i) buckets_[i] += other.buckets_[i];
  count_ += other.count_;
  sum_seconds_ += other.sum_seconds_;
  max_seconds_ = std::max(max_seconds_, other.max_seconds_);
}

double LatencyHistogram::mean_seconds() const {
  return count_ == 0 ? 0.0 : sum_seconds_ / static_cast<double>(count_);
}

double LatencyHistogram::Quantile(double fraction) const {
  const auto wanted = static_cast<std::int64_t>(std::ceil(fraction * static_cast<double>(count_)));
  std::int64_t seen = 0;
  for (std::size_t i = 0; i < buckets_.size(); ++i) {
    seen += buckets_[i];
    if (seen < wanted || seen == 0) continue;
    const double bound = std::exp2(static_cast<double>(i + 1) / kBucketsPerDoubling) * 1e-6;
    return std::min(bound, max_seconds_);
  }
  return max_seconds_;
}

}  // namespace capfit::client
