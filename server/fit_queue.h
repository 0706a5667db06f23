// In which order waiting fits begin. No threads and no clock: the caller brings both.
#ifndef CAPFIT_SERVER_FIT_QUEUE_H_
#define CAPFIT_SERVER_FIT_QUEUE_H_

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace capfit::server {

struct WaitingFit {
  std::string client;  // see caller.h
  bool is_bulk = false;
  double expected_seconds = 0.0;
};

// A bulk fit is taken as if it were so much longer: interactive ones go first, but none waits for
// ever.
inline constexpr double kBulkHandicapSeconds = 30.0;
// What a client got counts against it, half of it after this time.
inline constexpr double kHalfLifeSeconds = 30.0;
// Fits that are expected to take longer leave one place to shorter ones.
inline constexpr double kLongFitSeconds = 10.0;

// Next is the fit for which this sum of seconds is least: what it is expected to take, what its
// client got lately, the handicap if it is bulk, less the time that it has waited. So small bodies
// pass large ones, clients take turns however many calls they send, and a fit whose sum was S when
// it came is passed by none that comes S seconds later. Equals go in the order in which they came.
//
// Not for several threads at once. Add and Remove: O(log n); TakeNext: O(n), 10,000 fits in well
// under a millisecond.
class FitQueue {
 public:
  using Ticket = std::uint64_t;

  // `now_seconds` is of any clock that never goes back.
  Ticket Add(WaitingFit fit, double now_seconds);
  // Nothing when no fit waits, or only long ones and `allow_long` is false. Charges its client.
  [[nodiscard]] std::optional<Ticket> TakeNext(double now_seconds, bool allow_long);
  // The expected seconds of those that would be taken before `fit` if it came now. O(n).
  [[nodiscard]] double SecondsBefore(const WaitingFit& fit, double now_seconds) const;
  // False when it has been taken already.
  bool Remove(Ticket ticket);
  [[nodiscard]] std::size_t size() const { return waiting_.size(); }

 private:
  struct Entry {
    WaitingFit fit;
    double since_seconds;
  };
  struct Account {
    double seconds = 0.0;
    double as_of_seconds = 0.0;
  };
  // What the order goes by; the least is next.
  [[nodiscard]] double SumOf(const Entry& entry, double now_seconds) const;
  [[nodiscard]] double GotLately(const std::string& client, double now_seconds) const;
  void Charge(const WaitingFit& fit, double now_seconds);

  Ticket last_ticket_ = 0;
  std::map<Ticket, Entry> waiting_;
  std::map<std::string, Account> accounts_;
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_FIT_QUEUE_H_
