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
#include "grpc/health/v1/health.pb.h"
#include "server/server_info.h"
#include "server/service.h"

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

}  // namespace

// In the order in which they need each other.
struct Server::Parts {
  Parts(const ServerConfig& config_in, FitBackend backend_in)
      : config(config_in),
        backend(std::move(backend_in)),
        pool(config.threads),
        executor(config.max_concurrent_fits, config.max_queued_fits),
        service({config, backend, pool, executor},
                DescribeServer(config, pool.threads(), backend)) {}

  const ServerConfig config;
  const FitBackend backend;
  const ThreadPool pool;
  FitExecutor executor;
  Service service;
  int port = 0;
  std::unique_ptr<grpc::Server> grpc_server;
};

absl::StatusOr<std::unique_ptr<Server>> Server::Start(const ServerConfig& config,
                                                      FitBackend backend) {
  EnablePlugins();
  auto parts = std::make_unique<Parts>(config, std::move(backend));
  grpc::ServerBuilder builder;
  builder.RegisterService(&parts->service);
  builder.SetMaxReceiveMessageSize(kMaxReceivedBytes);
  // A second server on the same port is a mistake, not a way to share the load.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
  builder.AddListeningPort(config.listen, grpc::InsecureServerCredentials(), &parts->port);
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
