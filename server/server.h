// The running server: service, health, reflection, and an orderly end.
#ifndef CAPFIT_SERVER_SERVER_H_
#define CAPFIT_SERVER_SERVER_H_

#include <grpcpp/channel.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "core/base/thread_pool.h"
#include "server/fit_backend.h"
#include "server/server_config.h"

namespace capfit::server {

class Server {
 public:
  // Listens and serves from here on. UNAVAILABLE when an address cannot be had: it is named;
  // INVALID_ARGUMENT for certificates and tokens that are wrong.
  static absl::StatusOr<std::unique_ptr<Server>> Start(const ServerConfig& config,
                                                       FitBackend backend);
  // Drains, if nobody has.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // The port it listens on; 0 where the address has none (a Unix socket).
  [[nodiscard]] int port() const;

  // What calls hold of the memory budget now, and how many fits wait.
  [[nodiscard]] std::int64_t held_bytes() const;
  [[nodiscard]] std::size_t waiting_fits() const;

  // The port that serves metrics, 0 without one; and what it serves.
  [[nodiscard]] int metrics_port() const;
  [[nodiscard]] std::string MetricsText() const;

  // A channel to this server without a network, for tests.
  [[nodiscard]] std::shared_ptr<grpc::Channel> InProcessChannel();

  // Health says NOT_SERVING; after `drain_delay_seconds` new calls are refused; running ones may
  // finish within `drain_seconds`, what is left then ends with UNAVAILABLE. Returns when all is
  // over.
  void Drain();

 private:
  struct Parts;
  explicit Server(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_SERVER_H_
