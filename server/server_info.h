// What GetServerInfo answers.
#ifndef CAPFIT_SERVER_SERVER_INFO_H_
#define CAPFIT_SERVER_SERVER_INFO_H_

#include "capfit/v1/server_info.pb.h"
#include "server/fit_backend.h"
#include "server/server_config.h"

namespace capfit::server {

// `threads`: those that really compute. Features are found by asking the backend's validate about
// each option, so the list never promises what a call would refuse.
[[nodiscard]] v1::GetServerInfoResponse DescribeServer(const ServerConfig& config, int threads,
                                                       const FitBackend& backend);

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_SERVER_INFO_H_
