#include "core/base/work_meter.h"

#include <algorithm>

namespace capfit {

void WorkMeter::Expect(double until, std::int64_t work) {
  from_ = until_;
  until_ = std::clamp(until, from_, 1.0);
  expected_ = std::max(std::int64_t{1}, work);
  done_ = 0;
  observer_.OnFraction(from_);
}

void WorkMeter::Add(std::int64_t work) const {
  const std::int64_t done = done_.fetch_add(work) + work;
  if (std::this_thread::get_id() != owner_) return;
  const double share = static_cast<double>(done) / static_cast<double>(expected_);
  // Rounding must not tell more than the next part begins with.
  observer_.OnFraction(std::min(until_, from_ + std::min(1.0, share) * (until_ - from_)));
}

}  // namespace capfit
