// The way to one server or several.
#ifndef CAPFIT_CLIENT_CONNECTION_H_
#define CAPFIT_CLIENT_CONNECTION_H_

#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace capfit::client {

// How the two sides know each other. PEM texts, not paths.
struct Security {
  bool tls = false;               // also without `root_certificates`: the machine's own are used
  std::string root_certificates;  // who signs the server's certificate
  std::string certificate;        // the client's own, for servers that ask for one,
  std::string key;                // and its key
  std::string server_name;        // in the server's certificate; "": the first address's host
  std::string token;              // "": none is sent
};

// "HOST[:PORT]", or several with commas between: those of `addresses`, each with its port.
// INVALID_ARGUMENT names the one that is wrong.
[[nodiscard]] absl::StatusOr<std::vector<std::string>> SplitAddresses(const std::string& addresses);

// Where "HOST[:PORT],HOST[:PORT]" is, as gRPC writes it: one address as it stands, several as those
// of their hosts at this moment. A name of a scheme ("dns:///capfit:50051") is looked up again by
// gRPC whenever a connection breaks. UNAVAILABLE where a host has no address.
[[nodiscard]] absl::StatusOr<std::string> TargetOf(const std::string& addresses);

// gRPC's service config for `target`: calls go round all addresses of a name or a list. Several
// addresses are asked for their health, so that a server that is about to stop gets no more calls;
// one address is not, since it may be a proxy, whose health says nothing about who is behind it.
[[nodiscard]] std::string ServiceConfig(const std::string& target);

// Sends the token with a call; "" sends none.
void AddToken(const std::string& token, grpc::ClientContext& context);

// Does not block; connects with the first call. Errors as SplitAddresses and TargetOf.
[[nodiscard]] absl::StatusOr<std::shared_ptr<grpc::Channel>> OpenChannel(
    const std::string& addresses, const Security& security);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_CONNECTION_H_
