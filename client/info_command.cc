#include "client/info_command.h"

#include <google/protobuf/util/json_util.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <string>

#include "client/body_client.h"
#include "client/connection.h"
#include "client/exit_code.h"
#include "client/info_table.h"
#include "client/server_flags.h"
#include "core/base/status.h"
#include "grpc/health/v1/health.grpc.pb.h"
#include "proto/wire/status_conversion.h"

namespace capfit::client {
namespace {

struct InfoArguments {
  ServerFlags server;
  double timeout_seconds = 10.0;
  bool as_json = false;
  bool is_probe = false;
};

absl::StatusOr<std::string> InfoJson(const v1::GetServerInfoResponse& info) {
  google::protobuf::util::JsonPrintOptions options;
  options.add_whitespace = true;
  options.preserve_proto_field_names = true;
  std::string text;
  if (!google::protobuf::util::MessageToJsonString(info, &text, options).ok()) {
    return absl::InternalError("the server's answer cannot be shown");
  }
  return text;
}

// The standard health service answers without a token, so the probe of a container needs none.
absl::Status Probe(const InfoArguments& arguments) {
  CAPFIT_ASSIGN_OR_RETURN(const Security security, SecurityOf(arguments.server));
  CAPFIT_ASSIGN_OR_RETURN(const std::shared_ptr<grpc::Channel> channel,
                          OpenChannel(arguments.server.addresses, security));
  grpc::ClientContext context;
  context.set_deadline(
      std::chrono::system_clock::now() +
      std::chrono::milliseconds(static_cast<long>(1000 * arguments.timeout_seconds)));
  grpc::health::v1::HealthCheckRequest request;
  request.set_service(v1::BodyApproximationService::service_full_name());
  grpc::health::v1::HealthCheckResponse response;
  const grpc::Status status =
      grpc::health::v1::Health::NewStub(channel)->Check(&context, request, &response);
  if (!status.ok()) return wire::FromGrpcStatus(status);
  if (response.status() == grpc::health::v1::HealthCheckResponse::SERVING) return absl::OkStatus();
  return absl::UnavailableError("the server is not serving");
}

absl::Status RunInfo(const InfoArguments& arguments) {
  if (arguments.is_probe) return Probe(arguments);
  CAPFIT_ASSIGN_OR_RETURN(const BodyClient client, ConnectTo(arguments.server));
  const absl::StatusOr<v1::GetServerInfoResponse> info =
      client.GetServerInfo(arguments.timeout_seconds);
  if (!info.ok()) return WithServerAdvice(info.status(), arguments.server.addresses, "");
  CAPFIT_ASSIGN_OR_RETURN(const std::string text,
                          arguments.as_json ? InfoJson(*info) : InfoTable(*info));
  std::fputs(text.c_str(), stdout);
  return absl::OkStatus();
}

}  // namespace

void AddInfoCommand(CLI::App& app, int& exit_code) {
  const auto arguments = std::make_shared<InfoArguments>();
  CLI::App* const command =
      app.add_subcommand("info", "Show version, limits, formats, engines and features of a server");
  AddServerFlags(*command, arguments->server);
  AddTimeoutFlag(*command, arguments->timeout_seconds, "Seconds to wait");
  command->add_flag("--json", arguments->as_json, "Print GetServerInfoResponse as JSON instead");
  command->add_flag("--probe", arguments->is_probe,
                    "Only ask whether it serves, without a token: exit code 0 or 3");
  command->callback([arguments, &exit_code] { exit_code = Report(RunInfo(*arguments)); });
}

}  // namespace capfit::client
