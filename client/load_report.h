// What `capfit load` says in the end.
#ifndef CAPFIT_CLIENT_LOAD_REPORT_H_
#define CAPFIT_CLIENT_LOAD_REPORT_H_

#include <string>
#include <vector>

#include "client/load_run.h"

namespace capfit::client {

// A table for people, times in milliseconds.
[[nodiscard]] std::string LoadTable(const LoadTally& tally, const std::vector<LoadBody>& bodies);

// One JSON object with the same, times in seconds; ends with a newline.
[[nodiscard]] std::string LoadJson(const LoadTally& tally, const std::vector<LoadBody>& bodies);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_LOAD_REPORT_H_
