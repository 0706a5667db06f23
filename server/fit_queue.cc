#include "server/fit_queue.h"

#include <cmath>
#include <utility>

namespace capfit::server {
namespace {

// Accounts with less are forgotten, so that clients that are gone take no memory.
constexpr double kNothingSeconds = 0.01;

double Decayed(double seconds, double age_seconds) {
  return seconds * std::exp2(-age_seconds / kHalfLifeSeconds);
}

}  // namespace

FitQueue::Ticket FitQueue::Add(WaitingFit fit, double now_seconds) {
  waiting_.emplace(++last_ticket_, Entry{std::move(fit), now_seconds});
  return last_ticket_;
}

bool FitQueue::Remove(Ticket ticket) { return waiting_.erase(ticket) > 0; }

std::optional<FitQueue::Ticket> FitQueue::TakeNext(double now_seconds, bool allow_long) {
  auto best = waiting_.end();
  double least = 0.0;
  for (auto entry = waiting_.begin(); entry != waiting_.end(); ++entry) {
    if (!allow_long && entry->second.fit.expected_seconds > kLongFitSeconds) continue;
    const double sum = SumOf(entry->second, now_seconds);
    if (best != waiting_.end() && sum >= least) continue;
    best = entry;
    least = sum;
  }
  if (best == waiting_.end()) return std::nullopt;
  const Ticket ticket = best->first;
  Charge(best->second.fit, now_seconds);
  waiting_.erase(best);
  return ticket;
}

double FitQueue::SumOf(const Entry& entry, double now_seconds) const {
  return entry.fit.expected_seconds + GotLately(entry.fit.client, now_seconds) +
         (entry.fit.is_bulk ? kBulkHandicapSeconds : 0.0) - (now_seconds - entry.since_seconds);
}

double FitQueue::SecondsBefore(const WaitingFit& fit, double now_seconds) const {
  const double own_sum = SumOf({fit, now_seconds}, now_seconds);
  double seconds = 0.0;
  for (const auto& [ticket, entry] : waiting_) {
    if (SumOf(entry, now_seconds) <= own_sum) seconds += entry.fit.expected_seconds;
  }
  return seconds;
}

double FitQueue::GotLately(const std::string& client, double now_seconds) const {
  const auto account = accounts_.find(client);
  if (account == accounts_.end()) return 0.0;
  return Decayed(account->second.seconds, now_seconds - account->second.as_of_seconds);
}

void FitQueue::Charge(const WaitingFit& fit, double now_seconds) {
  std::erase_if(accounts_, [&](const auto& account) {
    return GotLately(account.first, now_seconds) < kNothingSeconds;
  });
  accounts_[fit.client] = {GotLately(fit.client, now_seconds) + fit.expected_seconds, now_seconds};
}

}  // namespace capfit::server
