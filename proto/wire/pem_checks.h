// Certificates and keys, judged before gRPC sees them: gRPC takes wrong ones without a word, and
// then no connection comes about.
#ifndef CAPFIT_PROTO_WIRE_PEM_CHECKS_H_
#define CAPFIT_PROTO_WIRE_PEM_CHECKS_H_

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"

namespace capfit::wire {

// What a file holds.
struct PemFile {
  std::string path;
  std::string text;
};

// INVALID_ARGUMENT, with the file's path, where it has no certificate in PEM.
[[nodiscard]] absl::Status CheckHasCertificate(const PemFile& file);

// Until when its first certificate is valid. INVALID_ARGUMENT where there is none or it is not
// valid at this time.
[[nodiscard]] absl::StatusOr<absl::Time> ValidUntil(const PemFile& file);

// INVALID_ARGUMENT where it is no private key in PEM without a passphrase, or not that of the first
// certificate.
[[nodiscard]] absl::Status CheckKey(const PemFile& key, const PemFile& certificate);

}  // namespace capfit::wire

#endif  // CAPFIT_PROTO_WIRE_PEM_CHECKS_H_
