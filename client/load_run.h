// Many calls, as fast as they are answered or at a given rate.
#ifndef CAPFIT_CLIENT_LOAD_RUN_H_
#define CAPFIT_CLIENT_LOAD_RUN_H_

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "client/latency_histogram.h"

namespace capfit::client {

struct LoadBody {
  std::string name;
  std::string bytes;  // of a mesh file
};

// What one call gave.
struct LoadAnswer {
  absl::Status status;
  std::string result;         // of a call that is OK: equal for equal results, "" for an empty one
  std::int64_t bytes = 0;     // of the answer
  bool has_pushback = false;  // a refused call was told when to come again
};

struct LoadPlan {
  double seconds = 10.0;   // no call begins later; those that run by then are waited for
  int clients = 8;         // calls at a time at most
  double rate = 0.0;       // calls a second, whatever the answers do; 0: each client calls again as
                           // soon as it has its answer
  std::uint64_t seed = 0;  // of the order of the bodies
};

// With a rate, times count from the moment at which a call was due: a server that stalls cannot
// hide by keeping the caller from calling.
struct LoadTally {
  double seconds = 0.0;                       // until the last answer
  LatencyHistogram answered;                  // calls that were OK
  std::vector<LatencyHistogram> by_body;      // the same, by body
  LatencyHistogram refused;                   // all others
  std::map<std::string, std::int64_t> codes;  // by the name of the code, "OK" among them
  std::int64_t late_calls = 0;  // due while all clients were busy, for more than 10 ms
  std::int64_t bytes_sent = 0;  // of bodies whose calls were OK
  std::int64_t bytes_received = 0;
  std::int64_t empty_results = 0;
  std::int64_t differing_results = 0;         // not the bits of the first result of the same body
  std::int64_t refused_without_pushback = 0;  // RESOURCE_EXHAUSTED alone
  std::map<std::string, std::string> first_message;  // of each code but OK

  // Whether no result was wrong and all calls were OK; without `strict` calls may also be refused
  // as a full server does it, RESOURCE_EXHAUSTED with the time to come again, if any was OK.
  [[nodiscard]] bool IsGood(bool strict) const;
};

// Called from several threads at once.
using LoadCall = std::function<LoadAnswer(const LoadBody& body)>;

// `bodies` is not empty. Blocks until all is over.
[[nodiscard]] LoadTally RunLoad(const std::vector<LoadBody>& bodies, const LoadPlan& plan,
                                const LoadCall& call);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_LOAD_RUN_H_
