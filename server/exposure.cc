#include "server/exposure.h"

#include "absl/strings/str_cat.h"

namespace capfit::server {

bool IsLoopback(const std::string& address) {
  for (const char* const begin :
       {"127.", "localhost:", "[::1]:", "ipv4:127.", "ipv6:[::1]:", "unix:", "unix-abstract:"}) {
    if (address.rfind(begin, 0) == 0) return true;
  }
  return false;
}

absl::Status CheckExposure(const ServerConfig& config) {
  const bool is_protected = config.tls.is_on() || !config.token_file.empty();
  if (is_protected || config.insecure_listen || IsLoopback(config.listen)) return absl::OkStatus();
  return absl::FailedPreconditionError(
      absl::StrCat("--listen ", config.listen,
                   " is open to other machines without TLS and without a token: set "
                   "--tls-certificate and --tls-key, or --token-file, or say --insecure-listen if "
                   "the network around it is trusted"));
}

}  // namespace capfit::server
