#include "server/caller.h"

#include <algorithm>
#include <cstddef>

#include "absl/strings/str_cat.h"
#include "core/base/plain_text.h"
#include "core/base/status.h"

namespace capfit::server {
namespace {

// Empty without one.
std::string MetadataOf(const grpc::CallbackServerContext& context, const char* key) {
  const auto found = context.client_metadata().find(key);
  if (found == context.client_metadata().end()) return "";
  return {found->second.data(), found->second.size()};
}

// version-trace-parent-flags in lower-case hexadecimal: 2, 32, 16 and 2 digits.
bool IsTraceParent(const std::string& text) {
  constexpr std::size_t kLength = 55;
  if (text.size() != kLength) return false;
  for (std::size_t i = 0; i < kLength; ++i) {
    const bool is_dash = i == 2 || i == 35 || i == 52;
    const bool is_hex = (text[i] >= '0' && text[i] <= '9') || (text[i] >= 'a' && text[i] <= 'f');
    if (is_dash ? text[i] != '-' : !is_hex) return false;
  }
  return true;
}

}  // namespace

std::string ClientOf(const grpc::CallbackServerContext& context, const std::string& token_name) {
  if (!token_name.empty()) return absl::StrCat("token/", token_name);
  const auto identity = context.auth_context();
  if (identity == nullptr || !identity->IsPeerAuthenticated()) return HostOfPeer(context.peer());
  std::string client = identity->GetPeerIdentityPropertyName();
  for (const grpc::string_ref& part : identity->GetPeerIdentity()) {
    absl::StrAppend(&client, "/", std::string(part.data(), part.size()));
  }
  return client;
}

std::string HostOfPeer(const std::string& peer) {
  const std::size_t scheme = peer.find(':');
  const std::size_t port = peer.rfind(':');
  if (peer.rfind("ipv", 0) != 0 || port == scheme) return peer;
  std::string host = peer.substr(scheme + 1, port - scheme - 1);
  constexpr char kOpening[] = "%5B";
  constexpr std::size_t kBracket = sizeof(kOpening) - 1;
  if (host.rfind(kOpening, 0) == 0 && host.size() >= 2 * kBracket) {
    host = host.substr(kBracket, host.size() - 2 * kBracket);
  }
  return host;
}

absl::StatusOr<bool> IsBulk(const grpc::CallbackServerContext& context) {
  const std::string word = MetadataOf(context, kPriorityKey);
  if (word.empty() || word == "interactive") return false;
  if (word == "bulk") return true;
  return InvalidField(ErrorReason::kUnknownValue, kPriorityKey,
                      absl::StrCat("is \"", PlainText(word, 40), "\", must be interactive or bulk"),
                      {{"limit", "interactive, bulk"}});
}

bool WantsFreshFit(const grpc::CallbackServerContext& context) {
  return MetadataOf(context, kCacheKey) == "no-cache";
}

std::string TraceOf(const grpc::CallbackServerContext& context) {
  std::string trace = MetadataOf(context, kTraceKey);
  return IsTraceParent(trace) ? trace : "";
}

}  // namespace capfit::server
