#include "client/server_flags.h"

#include <algorithm>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "client/connection.h"
#include "client/picture/file_bytes.h"
#include "core/base/host_and_port.h"
#include "core/base/number_in.h"
#include "core/base/status.h"
#include "proto/wire/pem_checks.h"

namespace capfit::client {

namespace {

CLI::Validator Addresses() {
  CLI::Validator validator;
  validator.description("").operation([](std::string& text) -> std::string {
    const absl::StatusOr<std::vector<std::string>> whole = SplitAddresses(text);
    if (!whole.ok()) return std::string(whole.status().message());
    text = absl::StrJoin(*whole, ",");
    return "";
  });
  return validator;
}

absl::Status ReadInto(const std::string& path, std::string& text) {
  if (path.empty()) return absl::OkStatus();
  CAPFIT_ASSIGN_OR_RETURN(text, ReadFileBytes(path));
  return absl::OkStatus();
}

absl::Status ReadPems(const ServerFlags& flags, Security& security) {
  if (flags.tls_certificate.empty() != flags.tls_key.empty()) {
    const bool needs_key = flags.tls_key.empty();
    return InvalidField(ErrorReason::kMissing, needs_key ? "--tls-key" : "--tls-certificate",
                        needs_key ? "is missing: --tls-certificate needs the key that belongs to it"
                                  : "is missing: --tls-key belongs to a certificate");
  }
  CAPFIT_RETURN_IF_ERROR(ReadInto(flags.tls_ca, security.root_certificates));
  CAPFIT_RETURN_IF_ERROR(ReadInto(flags.tls_certificate, security.certificate));
  CAPFIT_RETURN_IF_ERROR(ReadInto(flags.tls_key, security.key));
  // Of many authorities any may have expired.
  if (!flags.tls_ca.empty()) {
    CAPFIT_RETURN_IF_ERROR(wire::CheckHasCertificate({flags.tls_ca, security.root_certificates}));
  }
  if (flags.tls_certificate.empty()) return absl::OkStatus();
  const wire::PemFile certificate = {flags.tls_certificate, security.certificate};
  CAPFIT_RETURN_IF_ERROR(wire::CheckKey({flags.tls_key, security.key}, certificate));
  return wire::ValidUntil(certificate).status();
}

// gRPC ends the process where a header holds anything else.
absl::Status CheckToken(const std::string& file, const std::string& token) {
  const auto wrong = std::find_if(token.begin(), token.end(),
                                  [](char letter) { return letter < '!' || letter > '~'; });
  if (token.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(file, ": its first line must be a token"));
  }
  if (wrong == token.end()) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(
      file, ": byte ", wrong - token.begin(), " of the token is ",
      static_cast<int>(static_cast<unsigned char>(*wrong)),
      ", must be a printed ASCII character (33 to 126): letters, digits, punctuation"));
}

}  // namespace

CLI::Option* AddServerFlags(CLI::App& command, ServerFlags& flags) {
  CLI::Option* const server =
      command
          .add_option("--server", flags.addresses,
                      absl::StrCat("Server that fits; several with commas between share the calls; "
                                   "without a port: ",
                                   kDefaultPort))
          ->transform(Addresses())
          ->type_name("HOST[:PORT]")
          ->capture_default_str()
          ->group("Server");
  command.add_flag("--tls", flags.tls, "Speak TLS, trusting whom this machine trusts")
      ->group("Server");
  const auto add = [&](const char* flag, std::string& value, const char* type, const char* help) {
    command.add_option(flag, value, help)->type_name(type)->group("Server");
  };
  add("--tls-ca", flags.tls_ca, "FILE", "Speak TLS, trusting only who signed in this PEM file");
  add("--tls-certificate", flags.tls_certificate, "FILE",
      "PEM file of a certificate of your own, for servers that ask for one");
  add("--tls-key", flags.tls_key, "FILE", "PEM file of its key");
  add("--tls-server-name", flags.tls_server_name, "NAME",
      "Name in the server's certificate, where it is not the host of --server");
  add("--token-file", flags.token_file, "FILE",
      "File whose first line is the token that the server asks for");
  return server;
}

absl::StatusOr<Security> SecurityOf(const ServerFlags& flags) {
  Security security;
  security.tls = flags.tls || !flags.tls_ca.empty() || !flags.tls_certificate.empty();
  security.server_name = flags.tls_server_name;
  CAPFIT_RETURN_IF_ERROR(ReadPems(flags, security));
  CAPFIT_RETURN_IF_ERROR(ReadInto(flags.token_file, security.token));
  security.token.resize(std::min(security.token.size(), security.token.find_first_of("\r\n")));
  if (!flags.token_file.empty()) {
    CAPFIT_RETURN_IF_ERROR(CheckToken(flags.token_file, security.token));
  }
  return security;
}

absl::StatusOr<BodyClient> ConnectTo(const ServerFlags& flags) {
  CAPFIT_ASSIGN_OR_RETURN(const Security security, SecurityOf(flags));
  return BodyClient::Connect(flags.addresses, security);
}

CLI::Option* AddTimeoutFlag(CLI::App& command, double& seconds, const std::string& help) {
  return command.add_option("--timeout", seconds, help)
      ->check(NumberIn(0.001, 86'400.0))
      ->type_name("SECONDS")
      ->capture_default_str();
}

absl::Status WithServerAdvice(const absl::Status& status, const std::string& server,
                              const std::string& without) {
  // An error with a reason comes from a server of ours.
  if (ReasonOf(status).has_value()) return status;
  if (absl::IsDeadlineExceeded(status)) {
    return absl::DeadlineExceededError(
        absl::StrCat("no answer from ", server, " within the time that --timeout allows"));
  }
  if (!absl::IsUnavailable(status)) return status;
  const std::string another =
      without.empty() ? "" : absl::StrCat("; ", without, " fits without one");
  return absl::UnavailableError(
      absl::StrCat("cannot reach a server at ", server, " (", std::string(status.message()),
                   "). Is it running? Start one with: capfit-server --listen ", server, another));
}

}  // namespace capfit::client
