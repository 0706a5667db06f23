// The address of a server, as people write it.
#ifndef CAPFIT_CORE_BASE_HOST_AND_PORT_H_
#define CAPFIT_CORE_BASE_HOST_AND_PORT_H_

#include <string>

#include "absl/status/statusor.h"

namespace capfit {

inline constexpr int kDefaultPort = 50051;

// `address` with its port: "host", "host:port", "127.0.0.1:7", "::1", "[::1]" and "[::1]:7" are
// understood, and the default port is put where none is: "host" gives "host:50051", "::1" gives
// "[::1]:50051". Addresses with a scheme of gRPC's ("unix:/run/capfit", "dns:///host:7") stay as
// they are. INVALID_ARGUMENT "'host:70000' has port 70000, must be a whole number in [1, 65535]":
// `lowest_port` is 0 where any free port may be asked for.
[[nodiscard]] absl::StatusOr<std::string> WithPort(const std::string& address, int lowest_port = 1,
                                                   int default_port = kDefaultPort);

}  // namespace capfit

#endif  // CAPFIT_CORE_BASE_HOST_AND_PORT_H_
