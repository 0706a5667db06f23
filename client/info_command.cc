#include "client/info_command.h"

#include <google/protobuf/util/json_util.h>

#include <cstdio>
#include <memory>
#include <string>

#include "client/body_client.h"
#include "client/exit_code.h"
#include "core/base/status.h"

namespace capfit::client {
namespace {

struct InfoArguments {
  std::string server = "127.0.0.1:50051";
  double timeout_seconds = 10.0;
};

absl::Status RunInfo(const InfoArguments& arguments) {
  CAPFIT_ASSIGN_OR_RETURN(
      const v1::GetServerInfoResponse info,
      BodyClient::Connect(arguments.server).GetServerInfo(arguments.timeout_seconds));
  google::protobuf::util::JsonPrintOptions options;
  options.add_whitespace = true;
  options.preserve_proto_field_names = true;
  std::string text;
  if (!google::protobuf::util::MessageToJsonString(info, &text, options).ok()) {
    return absl::InternalError("the server's answer cannot be shown");
  }
  std::fputs(text.c_str(), stdout);
  return absl::OkStatus();
}

}  // namespace

void AddInfoCommand(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<InfoArguments>();
  CLI::App* const command =
      app.add_subcommand("info", "Show version, limits, formats, engines and features of a server");
  command->add_option("--server", arguments->server, "HOST:PORT")->capture_default_str();
  command->add_option("--timeout", arguments->timeout_seconds, "Seconds to wait")
      ->check(CLI::Range(0.001, 3600.0))
      ->capture_default_str();
  command->callback([arguments, &exit_code] { exit_code = Report(RunInfo(*arguments)); });
}

}  // namespace capfit::client
