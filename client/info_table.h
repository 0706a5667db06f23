// What a server says of itself, for people.
#ifndef CAPFIT_CLIENT_INFO_TABLE_H_
#define CAPFIT_CLIENT_INFO_TABLE_H_

#include <string>

#include "capfit/v1/server_info.pb.h"

namespace capfit::client {

// Version, limits, formats, engines and features: aligned columns, sizes in MiB, each kind of
// feature on a line of its own ("quality: paper, tight"), ending with a newline.
[[nodiscard]] std::string InfoTable(const v1::GetServerInfoResponse& info);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_INFO_TABLE_H_
