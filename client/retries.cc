#include "client/retries.h"

#include <algorithm>

#include "absl/strings/match.h"
#include "absl/strings/numbers.h"

namespace capfit::client {
namespace {

constexpr std::chrono::milliseconds kFirstPause{200};
constexpr std::chrono::milliseconds kLongestPause{10'000};
constexpr char kPushbackTrailer[] = "grpc-retry-pushback-ms";
// How gRPC tells of HTTP/2's ENHANCE_YOUR_CALM. A server whose memory others fill ends streams with
// it before capfit has a say, whosever they are; it passes.
constexpr char kCalm[] = "RST_STREAM with error code 11";

}  // namespace

std::optional<std::chrono::milliseconds> PushbackOf(const grpc::ClientContext& context) {
  const auto& trailers = context.GetServerTrailingMetadata();
  const auto pushback = trailers.find(kPushbackTrailer);
  if (pushback == trailers.end()) return std::nullopt;
  int milliseconds = 0;
  const absl::string_view text(pushback->second.data(), pushback->second.size());
  if (!absl::SimpleAtoi(text, &milliseconds)) return std::nullopt;
  return std::chrono::milliseconds(milliseconds);
}

std::optional<std::chrono::milliseconds> PauseAfter(const absl::Status& status, int attempt,
                                                    int max_attempts,
                                                    const grpc::ClientContext& context) {
  if (!absl::IsUnavailable(status) && !absl::IsResourceExhausted(status)) return std::nullopt;
  if (attempt >= max_attempts) return std::nullopt;
  if (const auto pushback = PushbackOf(context)) {
    // Below 0: the server asks not to be asked again.
    return pushback->count() < 0 ? std::nullopt : pushback;
  }
  if (absl::IsResourceExhausted(status) && !absl::StrContains(status.message(), kCalm)) {
    return std::nullopt;
  }
  return std::min(kLongestPause, kFirstPause * (1 << std::min(attempt - 1, 10)));
}

}  // namespace capfit::client
