// Who calls: asked before anything else is done for a call.
#ifndef CAPFIT_SERVER_CALLER_CHECK_H_
#define CAPFIT_SERVER_CALLER_CHECK_H_

#include <grpcpp/server_context.h>

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "server/server_config.h"
#include "server/token_file.h"

namespace capfit::server {

// Tokens are looked at here and not by gRPC's AuthMetadataProcessor, which exists only with TLS
// (tokens also serve behind a proxy that ends TLS), would close the health service too, and gives
// errors without details. Safe from several threads at once.
class CallerCheck {
 public:
  // INVALID_ARGUMENT as TokenFile::Open.
  [[nodiscard]] static absl::StatusOr<CallerCheck> Create(const ServerConfig& config);

  // The caller's name: of its token; "" where the server asks for none. UNAUTHENTICATED as
  // TokenFile::NameOf; of refusals at most one a second is logged, with the number of those before.
  [[nodiscard]] absl::StatusOr<std::string> NameOf(const grpc::CallbackServerContext& context);

 private:
  void LogRefusal(const std::string& peer, const absl::Status& status);

  struct Refusals {
    std::mutex mutex;
    std::chrono::steady_clock::time_point last_line;
    int since_last_line = 0;
  };
  std::unique_ptr<TokenFile> tokens_;  // nothing: everyone may call
  std::unique_ptr<Refusals> refusals_ = std::make_unique<Refusals>();
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_CALLER_CHECK_H_
