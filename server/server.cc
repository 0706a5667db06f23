#include "server/server.h"

#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/security/server_credentials.h>
#include <grpcpp/server.h>
#include <grpcpp/server_builder.h>

#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "grpc/health/v1/health.pb.h"
#include "server/caller_check.h"
#include "server/server_info.h"
#include "server/service.h"
#include "server/tls_credentials.h"

namespace capfit::server {
namespace {

std::chrono::milliseconds Milliseconds(double seconds) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000.0));
}

// Once per process, before the first server is built.
void EnablePlugins() {
  static const bool done = [] {
    // gRPC's own health service brings no descriptor; naming the generated one links it in, so that
    // reflection can describe the service.
    grpc::health::v1::HealthCheckRequest::descriptor();
    grpc::EnableDefaultHealthCheckService(true);
    grpc::reflection::InitProtoReflectionServerBuilderPlugin();
    return true;
  }();
  static_cast<void>(done);
}

// A handshake that is not over by then ends: as long as a slow line needs.
constexpr int kHandshakeMilliseconds = 10'000;
// A client that does not answer a ping within this is gone.
constexpr int kKeepaliveTimeoutMilliseconds = 20'000;
// Clients may ping as often as this; one that pings more often is sent away (ENHANCE_YOUR_CALM).
constexpr int kLeastPingMilliseconds = 10'000;

void LimitConnections(const ConnectionLimits& limits, grpc::ServerBuilder& builder) {
  const auto milliseconds = [](double seconds) { return static_cast<int>(seconds * 1000.0); };
  for (const auto& [name, value] : {
           std::pair{GRPC_ARG_MAX_METADATA_SIZE, limits.max_metadata_bytes},
           std::pair{GRPC_ARG_MAX_CONCURRENT_STREAMS, limits.max_streams},
           std::pair{GRPC_ARG_MAX_CONNECTION_AGE_MS, milliseconds(limits.max_age_seconds)},
           std::pair{GRPC_ARG_MAX_CONNECTION_AGE_GRACE_MS,
                     milliseconds(limits.max_age_grace_seconds)},
           std::pair{GRPC_ARG_KEEPALIVE_TIME_MS, milliseconds(limits.keepalive_seconds)},
           std::pair{GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kKeepaliveTimeoutMilliseconds},
           std::pair{GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1},
           std::pair{GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, kLeastPingMilliseconds},
           std::pair{GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, kHandshakeMilliseconds},
       }) {
    builder.AddChannelArgument(name, value);
  }
}

}  // namespace

// In the order in which they need each other.
struct Server::Parts {
  Parts(const ServerConfig& config_in, FitBackend backend_in, CallerCheck callers_in)
      : config(config_in),
        backend(std::move(backend_in)),
        pool(config.threads),
        executor(config.max_concurrent_fits, config.max_queued_fits),
        service({config, backend, pool, executor}, std::move(callers_in),
                DescribeServer(config, pool.threads(), backend)) {}

  const ServerConfig config;
  const FitBackend backend;
  const ThreadPool pool;
  FitExecutor executor;
  Service service;
  // gRPC asks them with each handshake, but does not keep them.
  std::shared_ptr<grpc::ServerCredentials> credentials;
  int port = 0;
  std::unique_ptr<grpc::Server> grpc_server;
};

absl::StatusOr<std::unique_ptr<Server>> Server::Start(const ServerConfig& config,
                                                      FitBackend backend) {
  EnablePlugins();
  CAPFIT_ASSIGN_OR_RETURN(CallerCheck callers, CallerCheck::Create(config));
  std::shared_ptr<grpc::ServerCredentials> credentials = grpc::InsecureServerCredentials();
  if (config.tls.is_on()) {
    CAPFIT_ASSIGN_OR_RETURN(credentials, TlsCredentials(config.tls));
  }
  auto parts = std::make_unique<Parts>(config, std::move(backend), std::move(callers));
  grpc::ServerBuilder builder;
  builder.RegisterService(&parts->service);
  builder.SetMaxReceiveMessageSize(kMaxReceivedBytes);
  // A second server on the same port is a mistake, not a way to share the load.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
  LimitConnections(config.connection, builder);
  parts->credentials = std::move(credentials);
  builder.AddListeningPort(config.listen, parts->credentials, &parts->port);
  parts->grpc_server = builder.BuildAndStart();
  if (parts->grpc_server == nullptr) {
    return absl::UnavailableError(absl::StrCat("cannot listen on ", config.listen));
  }
  parts->grpc_server->GetHealthCheckService()->SetServingStatus(
      v1::BodyApproximationService::service_full_name(), true);
  return std::unique_ptr<Server>(new Server(std::move(parts)));
}

Server::Server(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

Server::~Server() {
  if (parts_->grpc_server != nullptr) Drain();
}

int Server::port() const { return parts_->port; }

std::shared_ptr<grpc::Channel> Server::InProcessChannel() {
  return parts_->grpc_server->InProcessChannel({});
}

void Server::Drain() {
  if (parts_->grpc_server == nullptr) return;
  parts_->grpc_server->GetHealthCheckService()->SetServingStatus(false);
  std::this_thread::sleep_for(Milliseconds(parts_->config.drain_delay_seconds));
  parts_->grpc_server->Shutdown(std::chrono::system_clock::now() +
                                Milliseconds(parts_->config.drain_seconds));
  parts_->grpc_server->Wait();
  parts_->grpc_server.reset();
}

}  // namespace capfit::server
