#include "server/admission.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/status.h"

namespace capfit::server {
namespace {

// Who is sent away for longer had better ask another replica.
constexpr double kLongestPushbackSeconds = 60.0;
constexpr std::int64_t kMebibyte = 1024 * 1024;

absl::Status CheckFitsAlone(const Admission& admission, std::int64_t bytes) {
  if (bytes <= admission.most_bytes_of_a_call()) return absl::OkStatus();
  const std::string limit = absl::StrCat(admission.most_bytes_of_a_call());
  return InvalidField(
      ErrorReason::kTooLarge, "mesh",
      absl::StrCat("and its answer take ", bytes, " bytes of memory, must take at most ", limit,
                   " on this server"),
      {{"value", absl::StrCat(bytes)}, {"limit", limit}});
}

}  // namespace

std::int64_t Admission::held_bytes() const {
  const std::lock_guard lock(mutex_);
  return all_.bytes;
}

double Admission::ExpectedWaitSeconds() const {
  const std::lock_guard lock(mutex_);
  return all_.seconds / limits_.concurrent_fits;
}

std::int64_t Admission::most_bytes_of_a_call() const {
  return static_cast<std::int64_t>(limits_.client_share *
                                   static_cast<double>(limits_.max_held_bytes)) -
         kBytesOfACall;
}

double Admission::SecondsUntilAJobEnds() const {
  return all_.jobs == 0 ? 0.0 : all_.seconds / all_.jobs / limits_.concurrent_fits;
}

absl::Status Admission::Full(const char* resource, const std::string& what,
                             double wait_seconds) const {
  const double seconds = std::clamp(wait_seconds, 0.0, kLongestPushbackSeconds);
  const int wait_ms =
      std::max(limits_.least_pushback_ms, static_cast<int>(std::ceil(seconds * 1000.0)));
  return Refused(ErrorReason::kServerFull,
                 absl::StrCat(what, ", try again in ", wait_ms, " ms or ask another replica"),
                 {{kResourceFact, resource}, {kRetryFact, absl::StrCat(wait_ms)}});
}

absl::Status Admission::CheckBytes(const Use& client, std::int64_t more) const {
  if (more <= 0) return absl::OkStatus();
  if (all_.bytes + more > limits_.max_held_bytes) {
    return Full("held_bytes",
                absl::StrCat("uploads and answers hold ", all_.bytes / kMebibyte, " of the ",
                             limits_.max_held_bytes / kMebibyte, " MiB of this server"),
                SecondsUntilAJobEnds());
  }
  const std::int64_t share = most_bytes_of_a_call() + kBytesOfACall;
  if (client.bytes + more <= share) return absl::OkStatus();
  return Full("client_held_bytes",
              absl::StrCat("this client's uploads and answers hold ", client.bytes / kMebibyte,
                           " of its ", share / kMebibyte, " MiB"),
              SecondsUntilAJobEnds());
}

// The first fit of a client waits behind those of others only, so no share keeps it out.
absl::Status Admission::CheckQueue(const Use& client) const {
  if (all_.jobs >= limits_.max_jobs) {
    return Full("queued_fits",
                absl::StrCat("all ", limits_.max_jobs, " places of this server are taken"),
                SecondsUntilAJobEnds());
  }
  const double wait = all_.seconds / limits_.concurrent_fits;
  if (wait > limits_.max_queued_seconds) {
    return Full("queued_seconds",
                absl::StrFormat("%.1f s of work are waiting, this server takes more below %.1f s",
                                wait, limits_.max_queued_seconds),
                wait - limits_.max_queued_seconds);
  }
  const int most_jobs = static_cast<int>(std::ceil(limits_.client_share * limits_.max_jobs));
  if (client.jobs >= most_jobs) {
    return Full("client_queued_fits",
                absl::StrCat("this client has taken all its ", most_jobs, " places"),
                SecondsUntilAJobEnds());
  }
  const double own_wait = client.seconds / limits_.concurrent_fits;
  const double share = limits_.client_share * limits_.max_queued_seconds;
  if (own_wait <= share) return absl::OkStatus();
  return Full(
      "client_queued_seconds",
      absl::StrFormat("%.1f s of this client's work are waiting, more is taken below %.1f s",
                      own_wait, share),
      own_wait - share);
}

Holding::Holding(Admission& admission, std::string client)
    : admission_(admission), client_(std::move(client)) {
  const std::lock_guard lock(admission_.mutex_);
  ++admission_.clients_[client_].calls;
}

Holding::~Holding() {
  EndFit();
  const std::lock_guard lock(admission_.mutex_);
  Add(-bytes_);
  const auto use = admission_.clients_.find(client_);
  if (--use->second.calls == 0) admission_.clients_.erase(use);
}

// With the admission's lock held.
void Holding::Add(std::int64_t bytes) {
  bytes_ += bytes;
  admission_.all_.bytes += bytes;
  admission_.clients_[client_].bytes += bytes;
}

absl::Status Holding::Open() { return HoldBytes(0); }

absl::Status Holding::CheckClaim(std::int64_t bytes) const {
  CAPFIT_RETURN_IF_ERROR(CheckFitsAlone(admission_, bytes));
  const std::lock_guard lock(admission_.mutex_);
  const Admission::Use& use = admission_.clients_[client_];
  CAPFIT_RETURN_IF_ERROR(admission_.CheckBytes(use, bytes));
  return admission_.CheckQueue(use);
}

absl::Status Holding::HoldBytes(std::int64_t bytes) {
  CAPFIT_RETURN_IF_ERROR(CheckFitsAlone(admission_, bytes));
  const std::lock_guard lock(admission_.mutex_);
  const std::int64_t more = bytes + kBytesOfACall - bytes_;
  CAPFIT_RETURN_IF_ERROR(admission_.CheckBytes(admission_.clients_[client_], more));
  Add(more);
  return absl::OkStatus();
}

void Holding::HoldAnyway(std::int64_t bytes) {
  const std::lock_guard lock(admission_.mutex_);
  Add(bytes + kBytesOfACall - bytes_);
}

absl::Status Holding::CheckPatience(double wait_seconds, double patience_seconds) const {
  if (wait_seconds <= 0.0 || wait_seconds < patience_seconds) return absl::OkStatus();
  return admission_.Full(
      "deadline",
      absl::StrFormat("this fit would wait %.1f s for its turn, and its deadline passes in %.1f s",
                      wait_seconds, std::max(0.0, patience_seconds)),
      wait_seconds - patience_seconds);
}

absl::Status Holding::BeginFit(double expected_seconds) {
  const std::lock_guard lock(admission_.mutex_);
  Admission::Use& use = admission_.clients_[client_];
  CAPFIT_RETURN_IF_ERROR(admission_.CheckQueue(use));
  has_fit_ = true;
  seconds_ = expected_seconds;
  for (Admission::Use* const sum : {&admission_.all_, &use}) {
    ++sum->jobs;
    sum->seconds += seconds_;
  }
  return absl::OkStatus();
}

void Holding::EndFit() {
  if (!has_fit_) return;
  has_fit_ = false;
  const std::lock_guard lock(admission_.mutex_);
  for (Admission::Use* const sum : {&admission_.all_, &admission_.clients_[client_]}) {
    // Sums of doubles that come and go leave crumbs; with no job there is nothing.
    if (--sum->jobs == 0) sum->seconds = seconds_;
    sum->seconds -= seconds_;
  }
}

}  // namespace capfit::server
