// Whether an address may be listened on without protection.
#ifndef CAPFIT_SERVER_EXPOSURE_H_
#define CAPFIT_SERVER_EXPOSURE_H_

#include <string>

#include "absl/status/status.h"
#include "server/server_config.h"

namespace capfit::server {

// 127.0.0.0/8, ::1, localhost, and Unix sockets: only this machine gets there.
[[nodiscard]] bool IsLoopback(const std::string& address);

// FAILED_PRECONDITION where others than this machine could call without TLS and without a token,
// and `insecure_listen` does not say that this is meant.
[[nodiscard]] absl::Status CheckExposure(const ServerConfig& config);

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_EXPOSURE_H_
