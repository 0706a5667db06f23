// Attempts of one call, until one succeeds or another is of no use.
#ifndef CAPFIT_CLIENT_RETRIES_H_
#define CAPFIT_CLIENT_RETRIES_H_

#include <grpcpp/client_context.h>

#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "absl/status/status.h"

namespace capfit::client {

inline constexpr int kMaxAttempts = 4;

// The pause that the server asks for in the trailer of a refused call; nothing where it names none.
[[nodiscard]] std::optional<std::chrono::milliseconds> PushbackOf(
    const grpc::ClientContext& context);

// How long to wait after the given attempt (counted from 1) ended with `status`: what the server
// asked for, else twice as long each time. Nothing where another attempt is of no use: for all
// codes but UNAVAILABLE, and RESOURCE_EXHAUSTED with a pause or from gRPC itself, which ends calls
// while others fill the server's memory.
[[nodiscard]] std::optional<std::chrono::milliseconds> PauseAfter(
    const absl::Status& status, int attempt, int max_attempts, const grpc::ClientContext& context);

// Makes attempts until one succeeds, or another is of no use or would end after the deadline:
// attempt(context) gives a StatusOr. gRPC's own retries are off: those of 1.51 stall when
// a call that is still sending its upload is repeated.
template <typename Attempt>
auto WithRetries(double timeout_seconds, int max_attempts, const Attempt& attempt_call)
    -> decltype(attempt_call(std::declval<grpc::ClientContext&>())) {
  const auto deadline = std::chrono::system_clock::now() +
                        std::chrono::milliseconds(static_cast<long>(timeout_seconds * 1000.0));
  for (int attempt = 1;; ++attempt) {
    grpc::ClientContext context;
    context.set_deadline(deadline);
    auto result = attempt_call(context);
    if (result.ok()) return result;
    const auto pause = PauseAfter(result.status(), attempt, max_attempts, context);
    if (!pause || std::chrono::system_clock::now() + *pause >= deadline) return result;
    std::this_thread::sleep_for(*pause);
  }
}

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_RETRIES_H_
