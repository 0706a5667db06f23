// Flags and words of the commands that call a server.
#ifndef CAPFIT_CLIENT_SERVER_FLAGS_H_
#define CAPFIT_CLIENT_SERVER_FLAGS_H_

#include <CLI/CLI.hpp>
#include <string>

#include "absl/status/status.h"
#include "client/body_client.h"

namespace capfit::client {

inline constexpr char kDefaultServer[] = "127.0.0.1:50051";

// Which server or servers, and how the two sides know each other.
struct ServerFlags {
  std::string addresses = kDefaultServer;  // with commas between
  bool tls = false;
  std::string tls_ca;  // these are paths
  std::string tls_certificate;
  std::string tls_key;
  std::string tls_server_name;
  std::string token_file;  // its first line is the token
};

// --server and the flags of Security, in the group "Server". --server takes addresses as
// SplitAddresses (connection.h) does, and makes them whole.
CLI::Option* AddServerFlags(CLI::App& command, ServerFlags& flags);

// Security with the files read; NOT_FOUND where one cannot be.
[[nodiscard]] absl::StatusOr<Security> SecurityOf(const ServerFlags& flags);

// BodyClient::Connect with them.
[[nodiscard]] absl::StatusOr<BodyClient> ConnectTo(const ServerFlags& flags);

// --timeout, in seconds.
CLI::Option* AddTimeoutFlag(CLI::App& command, double& seconds, const std::string& help);

// Where nobody answers at `server`: the same error with what to try. `without` is the flag that
// does without a server; "" for none.
[[nodiscard]] absl::Status WithServerAdvice(const absl::Status& status, const std::string& server,
                                            const std::string& without);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_SERVER_FLAGS_H_
