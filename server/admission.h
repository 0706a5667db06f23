// Who may come in: budgets for the memory that calls hold and for the work that waits.
#ifndef CAPFIT_SERVER_ADMISSION_H_
#define CAPFIT_SERVER_ADMISSION_H_

#include <cstdint>
#include <map>
#include <mutex>
#include <string>

#include "absl/status/status.h"

namespace capfit::server {

struct AdmissionLimits {
  std::int64_t max_held_bytes = 1024LL * 1024 * 1024;
  double max_queued_seconds = 60.0;
  int max_jobs = 258;  // that run or wait
  int concurrent_fits = 2;
  double client_share = 0.75;   // (0, 1]: what one client may have of each budget
  int least_pushback_ms = 500;  // nobody is told to come again sooner
};

// What an open call is counted with before it has sent anything: gRPC's own state of a stream. It
// bounds how many calls may be open.
inline constexpr std::int64_t kBytesOfACall = 64LL * 1024;

// The fact of a refusal that says when to come again, in milliseconds.
inline constexpr char kRetryFact[] = "retry_ms";
// The fact that says what ran out: "held_bytes", "queued_seconds" or "queued_fits", each for all or
// for the client ("client_held_bytes", ...), or the caller's time, "deadline".
inline constexpr char kResourceFact[] = "resource";

// The sums over all calls. Safe from any thread. Nothing is ever waited for: who cannot have
// something is refused at once, so calls that hold a part each can never block one another.
class Admission {
 public:
  explicit Admission(const AdmissionLimits& limits) : limits_(limits) {}

  [[nodiscard]] const AdmissionLimits& limits() const { return limits_; }
  [[nodiscard]] std::int64_t held_bytes() const;
  // How long a fit that came now would wait for its turn, in expected seconds.
  [[nodiscard]] double ExpectedWaitSeconds() const;
  // What a call may hold that is alone on this server.
  [[nodiscard]] std::int64_t most_bytes_of_a_call() const;

 private:
  friend class Holding;
  struct Use {
    int calls = 0;
    std::int64_t bytes = 0;
    int jobs = 0;
    double seconds = 0.0;
  };
  [[nodiscard]] absl::Status CheckBytes(const Use& client, std::int64_t more) const;
  [[nodiscard]] absl::Status CheckQueue(const Use& client) const;
  [[nodiscard]] absl::Status Full(const char* resource, const std::string& what,
                                  double wait_seconds) const;
  [[nodiscard]] double SecondsUntilAJobEnds() const;

  const AdmissionLimits limits_;
  mutable std::mutex mutex_;
  Use all_;
  std::map<std::string, Use> clients_;  // with an open call
};

// What one call holds; given back when it goes. For one thread at a time.
//
// Refusals are RESOURCE_EXHAUSTED with kRetryFact and kResourceFact; what does not even fit into an
// idle server is INVALID_ARGUMENT (TOO_LARGE) that names the limit.
class Holding {
 public:
  // `client` as in caller.h.
  Holding(Admission& admission, std::string client);
  ~Holding();
  Holding(const Holding&) = delete;
  Holding& operator=(const Holding&) = delete;

  // Takes what an open call costs; to be asked first.
  [[nodiscard]] absl::Status Open();
  // Whether `bytes` could be held now and a fit could queue now. Takes nothing: what a header
  // claims is looked at, so that an honest caller is refused before it sends, and a liar holds
  // nothing.
  [[nodiscard]] absl::Status CheckClaim(std::int64_t bytes) const;
  // From now on the call holds `bytes` beside what an open call costs; less is never refused.
  [[nodiscard]] absl::Status HoldBytes(std::int64_t bytes);
  // The same without asking: for what is there already.
  void HoldAnyway(std::int64_t bytes);
  // Refuses a fit that would have its turn only after its caller has gone: who has
  // `patience_seconds` left must wait less. Takes nothing.
  [[nodiscard]] absl::Status CheckPatience(double wait_seconds, double patience_seconds) const;
  // From now on a fit of this call waits or runs, until EndFit.
  [[nodiscard]] absl::Status BeginFit(double expected_seconds);
  void EndFit();

  [[nodiscard]] const std::string& client() const { return client_; }

 private:
  void Add(std::int64_t bytes);

  Admission& admission_;
  const std::string client_;
  std::int64_t bytes_ = 0;
  double seconds_ = 0.0;
  bool has_fit_ = false;
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_ADMISSION_H_
