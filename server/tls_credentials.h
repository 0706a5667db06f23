// TLS for the server's port.
#ifndef CAPFIT_SERVER_TLS_CREDENTIALS_H_
#define CAPFIT_SERVER_TLS_CREDENTIALS_H_

#include <grpcpp/security/server_credentials.h>

#include <functional>
#include <memory>

#include "absl/status/statusor.h"
#include "server/tls_files.h"

namespace capfit::server {

// TLS 1.2 or 1.3 with the files of `config`; with a client CA no client without a certificate of
// its gets through. Connections that begin a second or more after a file has changed use the new
// ones; running connections go on. The credentials must live as long as the server. New files that
// ReadTlsPems refuses are named in the log, and the former stay in use. Errors as ReadTlsPems.
//
// `on_read` is told until when each certificate is valid that is used from then on: of the first
// one before this returns, of later ones from any thread. The log warns of one that has less than
// two weeks left.
[[nodiscard]] absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> TlsCredentials(
    const TlsConfig& config, const std::function<void(absl::Time)>& on_read);

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_TLS_CREDENTIALS_H_
