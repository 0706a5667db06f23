#include "server/tls_files.h"

#include <fstream>
#include <iterator>
#include <utility>

#include "core/base/status.h"
#include "proto/wire/pem_checks.h"

namespace capfit::server {
namespace {

absl::StatusOr<wire::PemFile> ReadPemFile(const std::string& path) {
  const auto wrong = [&path](const char* problem) {
    return InvalidField(ErrorReason::kMalformedFile, path, problem);
  };
  std::ifstream in(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in.is_open() || in.bad()) return wrong("cannot be read");
  if (text.empty()) return wrong("is empty or cannot be read");
  return wire::PemFile{path, std::move(text)};
}

}  // namespace

absl::StatusOr<TlsPems> ReadTlsPems(const TlsConfig& config) {
  if (config.key_file.empty()) {
    return InvalidField(ErrorReason::kMissing, "--tls-key",
                        "is missing: --tls-certificate needs the key that belongs to it");
  }
  CAPFIT_ASSIGN_OR_RETURN(wire::PemFile certificate, ReadPemFile(config.certificate_file));
  CAPFIT_ASSIGN_OR_RETURN(wire::PemFile key, ReadPemFile(config.key_file));
  CAPFIT_RETURN_IF_ERROR(wire::CheckKey(key, certificate));
  TlsPems pems;
  CAPFIT_ASSIGN_OR_RETURN(pems.valid_until, wire::ValidUntil(certificate));
  pems.certificate = std::move(certificate.text);
  pems.key = std::move(key.text);
  if (config.client_ca_file.empty()) return pems;
  CAPFIT_ASSIGN_OR_RETURN(wire::PemFile authority, ReadPemFile(config.client_ca_file));
  CAPFIT_RETURN_IF_ERROR(wire::ValidUntil(authority).status());
  pems.client_ca = std::move(authority.text);
  return pems;
}

}  // namespace capfit::server
