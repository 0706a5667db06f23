// The server's certificates and keys, read and judged (see proto/wire/pem_checks.h).
#ifndef CAPFIT_SERVER_TLS_FILES_H_
#define CAPFIT_SERVER_TLS_FILES_H_

#include <string>

#include "absl/status/statusor.h"
#include "absl/time/time.h"

namespace capfit::server {

// Paths of PEM files.
struct TlsConfig {
  std::string certificate_file;  // the server's, then those between it and the root; "": no TLS
  std::string key_file;          // belongs to it; without a passphrase
  std::string client_ca_file;    // who signs clients' certificates; "": clients need none
  [[nodiscard]] bool is_on() const { return !certificate_file.empty(); }
};

// What is in them.
struct TlsPems {
  std::string certificate;
  std::string key;
  std::string client_ca;
  absl::Time valid_until;  // the certificate
};

// INVALID_ARGUMENT with the file's path where one cannot be read, is no PEM, is not valid at this
// time, does not fit to its key, or only one of the pair is told.
[[nodiscard]] absl::StatusOr<TlsPems> ReadTlsPems(const TlsConfig& config);

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_TLS_FILES_H_
