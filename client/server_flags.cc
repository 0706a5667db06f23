#include "client/server_flags.h"

#include "absl/strings/str_cat.h"
#include "core/base/host_and_port.h"
#include "core/base/status.h"

namespace capfit::client {

CLI::Option* AddServerFlag(CLI::App& command, std::string& server) {
  CLI::Validator address;
  address.description("").operation([](std::string& text) -> std::string {
    const absl::StatusOr<std::string> whole = WithPort(text);
    if (!whole.ok()) return std::string(whole.status().message());
    text = *whole;
    return "";
  });
  return command
      .add_option("--server", server,
                  absl::StrCat("Server that fits; without a port: ", kDefaultPort))
      ->transform(address)
      ->type_name("HOST[:PORT]")
      ->capture_default_str();
}

CLI::Option* AddTimeoutFlag(CLI::App& command, double& seconds, const std::string& help) {
  return command.add_option("--timeout", seconds, help)
      ->check(CLI::Range(0.001, 86'400.0))
      ->type_name("SECONDS")
      ->capture_default_str();
}

absl::Status WithServerAdvice(const absl::Status& status, const std::string& server,
                              const std::string& without) {
  // An error with a reason comes from a server of ours.
  if (!absl::IsUnavailable(status) || ReasonOf(status).has_value()) return status;
  const std::string another =
      without.empty() ? "" : absl::StrCat("; ", without, " fits without one");
  return absl::UnavailableError(
      absl::StrCat("cannot reach a server at ", server, " (", std::string(status.message()),
                   "). Is it running? Start one with: capfit-server --listen ", server, another));
}

}  // namespace capfit::client
