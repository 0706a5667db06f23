#include "server/server.h"

#include <grpcpp/ext/channelz_service_plugin.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/resource_quota.h>
#include <grpcpp/security/server_credentials.h>
#include <grpcpp/server.h>
#include <grpcpp/server_builder.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <optional>
#include <thread>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/available_cores.h"
#include "core/base/status.h"
#include "grpc/health/v1/health.pb.h"
#include "server/caller_check.h"
#include "server/log_sink.h"
#include "server/reset_guard.h"
#include "server/server_info.h"
#include "server/service.h"
#include "server/tls_credentials.h"

namespace capfit::server {
namespace {

// Time to tell the callers of unfinished calls.
constexpr std::chrono::milliseconds kLastWord{500};

std::chrono::milliseconds Milliseconds(double seconds) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000.0));
}

// Results that are kept are part of the budget, and leave most of it to calls.
std::int64_t CacheBytes(const ServerConfig& config) {
  return std::min(config.cache_bytes, config.max_held_bytes / 4);
}

AdmissionLimits LimitsOf(const ServerConfig& config) {
  return {config.max_held_bytes - CacheBytes(config),
          config.max_queued_seconds,
          config.max_concurrent_fits + config.max_queued_fits,
          config.max_concurrent_fits,
          config.client_percent / 100.0,
          config.retry_pushback_ms};
}

// With numbers for what is left to the server. As many fits as threads serve the most bodies a
// second; of two one may be short, and need not wait for a long one.
ServerConfig Resolved(ServerConfig config) {
  constexpr int kLeastFits = 2;
  constexpr int kMostFits = 64;
  if (config.threads == 0) config.threads = AvailableCores();
  if (config.max_concurrent_fits == 0) {
    config.max_concurrent_fits = std::clamp(config.threads, kLeastFits, kMostFits);
  }
  return config;
}

// Once per process, before the first server is built.
void PrepareProcess() {
  static const bool done = [] {
    // Whoever reads the log, or a Redis, may go while something is written to it.
    std::signal(SIGPIPE, SIG_IGN);
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
// What is read of a connection at once is parsed even if the connection is cut meanwhile: 500
// streams that are begun and reset.
constexpr int kMostReadBytes = 64 * 1024;
// A client that does not answer a ping within this is gone.
constexpr int kKeepaliveTimeoutMilliseconds = 20'000;
// Clients may ping as often as this; one that pings more often is sent away (ENHANCE_YOUR_CALM).
constexpr int kLeastPingMilliseconds = 10'000;

void LimitConnections(const ConnectionLimits& limits, grpc::ServerBuilder& builder) {
  const auto milliseconds = [](double seconds) { return static_cast<int>(seconds * 1000.0); };
  for (const auto& [name, value] : {
           std::pair{GRPC_ARG_MAX_METADATA_SIZE, limits.max_metadata_bytes},
           std::pair{GRPC_ARG_MAX_CONCURRENT_STREAMS, limits.max_streams},
           std::pair{GRPC_ARG_TCP_MAX_READ_CHUNK_SIZE, kMostReadBytes},
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
  Parts(const ServerConfig& config_in, FitBackend backend_in, CallerCheck callers_in,
        std::unique_ptr<Metrics> metrics_in, std::unique_ptr<SharedCache> shared_cache_in)
      : config(config_in),
        backend(std::move(backend_in)),
        pool(config.threads),
        admission(LimitsOf(config)),
        cache(CacheBytes(config)),
        metrics(std::move(metrics_in)),
        shared_cache(std::move(shared_cache_in)),
        executor(config.max_concurrent_fits),
        service({config, backend, pool, admission, cost, executor, *metrics, cache, *shared_cache,
                 watchdog, stop_at},
                std::move(callers_in), DescribeServer(config, pool.threads(), backend)) {}

  const ServerConfig config;
  const FitBackend backend;
  const ThreadPool pool;
  Admission admission;
  FitCost cost;
  std::atomic<Watchdog::Clock::time_point> stop_at{Watchdog::Clock::time_point::max()};
  Watchdog watchdog;
  ResultCache cache;
  const std::unique_ptr<Metrics> metrics;
  const std::unique_ptr<SharedCache> shared_cache;
  FitExecutor executor;
  Service service;
  // Seconds since 1970; 0: there is none. The credentials write it.
  std::shared_ptr<const std::atomic<double>> certificate_expiry;
  // gRPC asks them with each handshake, but does not keep them.
  std::shared_ptr<grpc::ServerCredentials> credentials;
  int port = 0;
  std::unique_ptr<grpc::Server> grpc_server;
  std::unique_ptr<Metrics::Endpoint> metrics_endpoint;

  [[nodiscard]] Gauges Now() const {
    return {static_cast<std::int64_t>(executor.waiting()),
            static_cast<std::int64_t>(executor.running()),
            admission.ExpectedWaitSeconds(),
            admission.held_bytes(),
            admission.limits().max_held_bytes,
            pool.threads(),
            cache.bytes(),
            shared_cache->is_up(),
            LostLogLines(),
            *certificate_expiry};
  }
};

absl::StatusOr<std::unique_ptr<Server>> Server::Start(const ServerConfig& wished,
                                                      FitBackend backend) {
  PrepareProcess();
  const ServerConfig config = Resolved(wished);
  CAPFIT_ASSIGN_OR_RETURN(CallerCheck callers, CallerCheck::Create(config));
  const auto certificate_expiry = std::make_shared<std::atomic<double>>(0.0);
  std::shared_ptr<grpc::ServerCredentials> credentials = grpc::InsecureServerCredentials();
  if (config.tls.is_on()) {
    CAPFIT_ASSIGN_OR_RETURN(credentials,
                            TlsCredentials(config.tls, [certificate_expiry](absl::Time end) {
                              *certificate_expiry = absl::ToDoubleSeconds(end - absl::UnixEpoch());
                            }));
  }
  auto metrics = std::make_unique<Metrics>();
  CAPFIT_ASSIGN_OR_RETURN(std::unique_ptr<SharedCache> shared_cache,
                          SharedCache::Create(config, *metrics));
  auto parts = std::make_unique<Parts>(config, std::move(backend), std::move(callers),
                                       std::move(metrics), std::move(shared_cache));
  parts->certificate_expiry = certificate_expiry;
  if (!config.metrics_listen.empty()) {
    CAPFIT_ASSIGN_OR_RETURN(
        parts->metrics_endpoint,
        parts->metrics->Serve(config.metrics_listen, [now = parts.get()] { return now->Now(); }));
  }
  // gRPC has it for the whole process.
  if (config.channelz) grpc::channelz::experimental::InitChannelzService();
  grpc::ServerBuilder builder;
  builder.RegisterService(&parts->service);
  builder.SetMaxReceiveMessageSize(kMaxReceivedBytes);
  // A fuse behind our own budget, for what gRPC holds before we see it: messages half received.
  builder.SetResourceQuota(
      grpc::ResourceQuota("capfit").Resize(static_cast<std::size_t>(config.max_held_bytes)));
  // A second server on the same port is a mistake, not a way to share the load.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
  LimitConnections(config.connection, builder);
  const auto reset_guard = std::make_shared<ResetGuard>(parts->watchdog);
  CountResets(reset_guard, builder);
  parts->credentials = std::move(credentials);
  builder.AddListeningPort(config.listen, parts->credentials, &parts->port);
  parts->grpc_server = builder.BuildAndStart();
  if (parts->grpc_server == nullptr) {
    return absl::UnavailableError(absl::StrCat("cannot listen on ", config.listen));
  }
  reset_guard->Guard(parts->port);
  parts->grpc_server->GetHealthCheckService()->SetServingStatus(
      v1::BodyApproximationService::service_full_name(), true);
  return std::unique_ptr<Server>(new Server(std::move(parts)));
}

Server::Server(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

Server::~Server() {
  if (parts_->grpc_server != nullptr) Drain();
}

int Server::port() const { return parts_->port; }

std::int64_t Server::held_bytes() const { return parts_->admission.held_bytes(); }

std::size_t Server::waiting_fits() const { return parts_->executor.waiting(); }

int Server::metrics_port() const {
  return parts_->metrics_endpoint == nullptr ? 0 : parts_->metrics_endpoint->port();
}

std::string Server::MetricsText() const {
  return parts_->metrics->Text([this] { return parts_->Now(); });
}

std::shared_ptr<grpc::Channel> Server::InProcessChannel() {
  return parts_->grpc_server->InProcessChannel({});
}

void Server::Drain() {
  if (parts_->grpc_server == nullptr) return;
  parts_->grpc_server->GetHealthCheckService()->SetServingStatus(false);
  std::this_thread::sleep_for(Milliseconds(parts_->config.drain_delay_seconds));
  // Calls that are still there see the end of the grace themselves and say so; gRPC cuts off only
  // what does not.
  const auto grace = Milliseconds(parts_->config.drain_seconds);
  parts_->stop_at = Watchdog::Clock::now() + grace;
  parts_->grpc_server->Shutdown(std::chrono::system_clock::now() + grace + kLastWord);
  parts_->grpc_server->Wait();
  parts_->grpc_server.reset();
}

}  // namespace capfit::server
