#include "core/base/host_and_port.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace capfit {
namespace {

constexpr int kHighestPort = 65'535;

absl::Status Wrong(const std::string& address, const std::string& problem) {
  return InvalidField(ErrorReason::kOutOfRange, absl::StrCat("'", address, "'"), problem);
}

// "unix:...", "dns:///...", "ipv6:[::1]:7": gRPC's own names.
bool HasScheme(const std::string& address) {
  for (const char* const scheme : {"unix:", "unix-abstract:", "ipv4:", "ipv6:", "dns:"}) {
    if (address.rfind(scheme, 0) == 0) return true;
  }
  return address.find("://") != std::string::npos;
}

struct Pieces {
  std::string host;
  std::optional<std::string> port;
};

// At the last colon, but for those of an IPv6 address.
Pieces Split(const std::string& address) {
  if (!address.empty() && address.front() == '[') {
    const std::size_t end = address.find(']');
    if (end == std::string::npos) return {"", std::nullopt};
    const std::string rest = address.substr(end + 1);
    if (rest.empty()) return {address, std::nullopt};
    return {rest.front() == ':' ? address.substr(0, end + 1) : "", rest.substr(1)};
  }
  const auto colons = std::count(address.begin(), address.end(), ':');
  if (colons == 0) return {address, std::nullopt};
  if (colons > 1) return {absl::StrCat("[", address, "]"), std::nullopt};
  const std::size_t colon = address.find(':');
  return {address.substr(0, colon), address.substr(colon + 1)};
}

bool IsDigits(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char letter) {
    return std::isdigit(letter) != 0;
  });
}

}  // namespace

absl::StatusOr<std::string> WithPort(const std::string& address, int lowest_port,
                                     int default_port) {
  if (HasScheme(address)) return address;
  const Pieces pieces = Split(address);
  const bool has_blank = std::any_of(address.begin(), address.end(), [](unsigned char letter) {
    return std::isspace(letter) != 0;
  });
  if (pieces.host.empty() || has_blank) {
    return Wrong(address, "is no address, must be HOST, HOST:PORT or [IPV6]:PORT");
  }
  if (!pieces.port) return absl::StrCat(pieces.host, ":", default_port);
  int port = -1;
  if (!IsDigits(*pieces.port) || !absl::SimpleAtoi(*pieces.port, &port) || port < lowest_port ||
      port > kHighestPort) {
    return Wrong(address, absl::StrCat("has port ", *pieces.port, ", must be a whole number in [",
                                       lowest_port, ", ", kHighestPort, "]"));
  }
  return absl::StrCat(pieces.host, ":", port);
}

}  // namespace capfit
