#include "server/caller_check.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <utility>

#include "core/base/status.h"

namespace capfit::server {

absl::StatusOr<CallerCheck> CallerCheck::Create(const ServerConfig& config) {
  CallerCheck check;
  if (!config.token_file.empty()) {
    CAPFIT_ASSIGN_OR_RETURN(check.tokens_, TokenFile::Open(config.token_file));
  }
  return check;
}

absl::StatusOr<std::string> CallerCheck::NameOf(const grpc::CallbackServerContext& context) {
  if (tokens_ == nullptr) return "";
  const auto found = context.client_metadata().find("authorization");
  std::optional<std::string_view> authorization;
  if (found != context.client_metadata().end()) {
    authorization.emplace(found->second.data(), found->second.size());
  }
  absl::StatusOr<std::string> name = tokens_->NameOf(authorization);
  if (!name.ok()) LogRefusal(context.peer(), name.status());
  return name;
}

// Whoever tries thousands of tokens must not fill the log.
void CallerCheck::LogRefusal(const std::string& peer, const absl::Status& status) {
  const std::lock_guard lock(refusals_->mutex);
  ++refusals_->since_last_line;
  const auto now = std::chrono::steady_clock::now();
  if (now - refusals_->last_line < std::chrono::seconds(1)) return;
  refusals_->last_line = now;
  spdlog::warn("refused peer={} calls={} status=UNAUTHENTICATED: {}", peer,
               std::exchange(refusals_->since_last_line, 0), std::string(status.message()));
}

}  // namespace capfit::server
