// Who calls, and how urgently.
#ifndef CAPFIT_SERVER_CALLER_H_
#define CAPFIT_SERVER_CALLER_H_

#include <grpcpp/server_context.h>

#include <string>

#include "absl/status/statusor.h"

namespace capfit::server {

// Metadata of a call: interactive (also without it) or bulk.
inline constexpr char kPriorityKey[] = "capfit-priority";
// Metadata of a call that must not be answered from a cache.
inline constexpr char kCacheKey[] = "cache-control";
// W3C trace context, passed through: into the log, and back as initial metadata.
inline constexpr char kTraceKey[] = "traceparent";

// Whom the budgets count a call for: who has proved an identity (token or certificate) by that,
// anybody else by the host that the call comes from, without the port. Calls through one proxy are
// one client unless they have identities.
// `token_name`: of the caller's token, "" without one.
[[nodiscard]] std::string ClientOf(const grpc::CallbackServerContext& context,
                                   const std::string& token_name);

// The host of a peer as gRPC writes it: "192.0.2.7" of "ipv4:192.0.2.7:4711", "2001:db8::1" of
// "ipv6:%5B2001:db8::1%5D:4711"; what is neither ("unix:", "inproc") stays as it is.
[[nodiscard]] std::string HostOfPeer(const std::string& peer);

// INVALID_ARGUMENT for any other word than the two.
[[nodiscard]] absl::StatusOr<bool> IsBulk(const grpc::CallbackServerContext& context);

// Whether the caller wants a fit of its own: `cache-control: no-cache`. Such a call is neither
// answered with a kept result nor is its own kept. Other words are ignored, as in HTTP.
[[nodiscard]] bool WantsFreshFit(const grpc::CallbackServerContext& context);

// As it came where it has the form that the standard asks for, else nothing: what is passed on goes
// into the logs of others.
[[nodiscard]] std::string TraceOf(const grpc::CallbackServerContext& context);

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_CALLER_H_
