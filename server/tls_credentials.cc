#include "server/tls_credentials.h"

#include <grpc/grpc.h>
#include <grpc/grpc_security.h>
#include <spdlog/spdlog.h>

#include <mutex>
#include <string>
#include <utility>

#include "absl/time/clock.h"
#include "server/file_watch.h"

namespace capfit::server {
namespace {

// Who renews by hand has two weeks to do it.
constexpr absl::Duration kEnoughTime = absl::Hours(14 * 24);

grpc_ssl_server_certificate_config* ToConfig(const TlsPems& pems) {
  const grpc_ssl_pem_key_cert_pair pair = {pems.key.c_str(), pems.certificate.c_str()};
  // gRPC 1.51 asserts that there are roots, also where clients' certificates are not asked for.
  const std::string& roots = pems.client_ca.empty() ? pems.certificate : pems.client_ca;
  return grpc_ssl_server_certificate_config_create(roots.c_str(), &pair, 1);
}

// gRPC's C++ classes either never reload (SslServerCredentials) or watch the files without judging
// the pair (FileWatcherCertificateProvider: a key that is written a moment before its certificate
// breaks every connection). The C interface under both asks at each handshake; that is used here.
class ReloadingCredentials final : public grpc::ServerCredentials {
 public:
  ReloadingCredentials(const TlsConfig& config, TlsPems first,
                       std::function<void(absl::Time)> on_read)
      : config_(config),
        on_read_(std::move(on_read)),
        watch_({config.certificate_file, config.key_file, config.client_ca_file}),
        next_(std::make_unique<TlsPems>(std::move(first))) {
    Tell(next_->valid_until);
    const auto request = config.client_ca_file.empty()
                             ? GRPC_SSL_DONT_REQUEST_CLIENT_CERTIFICATE
                             : GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY;
    credentials_ = grpc_ssl_server_credentials_create_with_options(
        grpc_ssl_server_credentials_create_options_using_config_fetcher(request, Fetch, this));
  }
  ~ReloadingCredentials() override { grpc_server_credentials_release(credentials_); }
  ReloadingCredentials(const ReloadingCredentials&) = delete;
  ReloadingCredentials& operator=(const ReloadingCredentials&) = delete;

  // Who calls is checked with each call, by CallerCheck.
  void SetAuthMetadataProcessor(
      const std::shared_ptr<grpc::AuthMetadataProcessor>& /*processor*/) override {}

 private:
  int AddPortToServer(const std::string& address, grpc_server* server) override {
    return grpc_server_add_http2_port(server, address.c_str(), credentials_);
  }

  static grpc_ssl_certificate_config_reload_status Fetch(
      void* self, grpc_ssl_server_certificate_config** config) {
    return static_cast<ReloadingCredentials*>(self)->FetchChanged(config);
  }

  grpc_ssl_certificate_config_reload_status FetchChanged(
      grpc_ssl_server_certificate_config** config) {
    const std::lock_guard lock(mutex_);
    if (next_ == nullptr && watch_.HasChanged()) Read();
    if (next_ == nullptr) return GRPC_SSL_CERTIFICATE_CONFIG_RELOAD_UNCHANGED;
    *config = ToConfig(*std::exchange(next_, nullptr));
    return GRPC_SSL_CERTIFICATE_CONFIG_RELOAD_NEW;
  }

  void Read() {
    absl::StatusOr<TlsPems> pems = ReadTlsPems(config_);
    if (pems.ok()) {
      next_ = std::make_unique<TlsPems>(*std::move(pems));
      spdlog::info("certificate read again from {}", config_.certificate_file);
      Tell(next_->valid_until);
    } else {
      spdlog::error("the former certificate stays in use: {}",
                    std::string(pems.status().message()));
    }
  }

  void Tell(absl::Time valid_until) const {
    on_read_(valid_until);
    const absl::Duration left = valid_until - absl::Now();
    if (left > kEnoughTime) return;
    spdlog::warn("the certificate in {} expires in {} days", config_.certificate_file,
                 absl::ToInt64Hours(left) / 24);
  }

  const TlsConfig config_;
  const std::function<void(absl::Time)> on_read_;
  std::mutex mutex_;
  FileWatch watch_;
  std::unique_ptr<TlsPems> next_;  // not yet given to gRPC
  grpc_server_credentials* credentials_ = nullptr;
};

}  // namespace

absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> TlsCredentials(
    const TlsConfig& config, const std::function<void(absl::Time)>& on_read) {
  absl::StatusOr<TlsPems> pems = ReadTlsPems(config);
  if (!pems.ok()) return pems.status();
  return std::make_shared<ReloadingCredentials>(config, *std::move(pems), on_read);
}

}  // namespace capfit::server
