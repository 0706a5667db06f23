#include "client/connection.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <netdb.h>
#include <sys/socket.h>

#include <array>
#include <set>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "core/base/host_and_port.h"
#include "core/base/status.h"

namespace capfit::client {
namespace {

constexpr char kRoundRobin[] = R"("loadBalancingConfig": [{"round_robin": {}}])";
constexpr char kHealthCheck[] =
    R"("healthCheckConfig": {"serviceName": "capfit.v1.BodyApproximationService"})";

struct FreeAddresses {
  void operator()(addrinfo* list) const { freeaddrinfo(list); }
};

std::string HostOf(const std::string& address) { return address.substr(0, address.rfind(':')); }

std::string WithoutBrackets(const std::string& host) {
  return !host.empty() && host.front() == '[' ? host.substr(1, host.size() - 2) : host;
}

// The first numeric address of "host:port", IPv4 if it has one; the family beside it.
absl::StatusOr<std::pair<int, std::string>> Resolve(const std::string& address) {
  const std::string host = WithoutBrackets(HostOf(address));
  const std::string port = address.substr(address.rfind(':') + 1);
  for (const int family : {AF_INET, AF_INET6}) {
    addrinfo hints = {};
    hints.ai_family = family;
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    if (getaddrinfo(host.c_str(), nullptr, &hints, &found) != 0) continue;
    const std::unique_ptr<addrinfo, FreeAddresses> owner(found);
    std::array<char, NI_MAXHOST> text{};
    getnameinfo(found->ai_addr, found->ai_addrlen, text.data(), text.size(), nullptr, 0,
                NI_NUMERICHOST);
    return std::pair(family, family == AF_INET ? absl::StrCat(text.data(), ":", port)
                                               : absl::StrCat("[", text.data(), "]:", port));
  }
  return absl::UnavailableError(absl::StrCat("no address is known for the host of ", address));
}

std::shared_ptr<grpc::ChannelCredentials> CredentialsOf(const Security& security) {
  if (!security.tls && security.root_certificates.empty()) {
    return grpc::InsecureChannelCredentials();
  }
  return grpc::SslCredentials({security.root_certificates, security.key, security.certificate});
}

}  // namespace

absl::StatusOr<std::vector<std::string>> SplitAddresses(const std::string& addresses) {
  std::vector<std::string> whole;
  for (const auto& piece : absl::StrSplit(addresses, ',')) {
    CAPFIT_ASSIGN_OR_RETURN(std::string address, WithPort(std::string(piece)));
    whole.push_back(std::move(address));
  }
  return whole;
}

// gRPC takes several addresses in one target only as numbers of one family.
absl::StatusOr<std::string> TargetOf(const std::string& addresses) {
  CAPFIT_ASSIGN_OR_RETURN(const std::vector<std::string> whole, SplitAddresses(addresses));
  if (whole.size() == 1) return whole.front();
  std::vector<std::string> numbers;
  std::set<int> families;
  for (const std::string& address : whole) {
    CAPFIT_ASSIGN_OR_RETURN(const auto resolved, Resolve(address));
    families.insert(resolved.first);
    numbers.push_back(resolved.second);
  }
  if (families.size() > 1) {
    return InvalidField(ErrorReason::kConflict, absl::StrCat("'", addresses, "'"),
                        "mixes IPv4 and IPv6, use one of them");
  }
  return absl::StrCat(*families.begin() == AF_INET ? "ipv4:" : "ipv6:",
                      absl::StrJoin(numbers, ","));
}

std::string ServiceConfig(const std::string& target) {
  const bool is_several =
      target.find(',') != std::string::npos || target.find("://") != std::string::npos;
  return is_several ? absl::StrCat("{", kRoundRobin, ", ", kHealthCheck, "}")
                    : absl::StrCat("{", kRoundRobin, "}");
}

// Not as call credentials, which gRPC allows only with TLS: a token also serves in front of a proxy
// on this machine that speaks TLS.
void AddToken(const std::string& token, grpc::ClientContext& context) {
  if (!token.empty()) context.AddMetadata("authorization", absl::StrCat("Bearer ", token));
}

absl::StatusOr<std::shared_ptr<grpc::Channel>> OpenChannel(const std::string& addresses,
                                                           const Security& security) {
  CAPFIT_ASSIGN_OR_RETURN(const std::string target, TargetOf(addresses));
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_ENABLE_RETRIES, 0);  // the reason: retries.h
  arguments.SetServiceConfigJSON(ServiceConfig(target));
  arguments.SetMaxReceiveMessageSize(-1);  // a server's answer is as long as the body needs
  std::string name = security.server_name;
  if (name.empty() && target.find(',') != std::string::npos) {
    name = WithoutBrackets(HostOf(SplitAddresses(addresses)->front()));
  }
  if (!name.empty()) arguments.SetSslTargetNameOverride(name);
  return grpc::CreateCustomChannel(target, CredentialsOf(security), arguments);
}

}  // namespace capfit::client
