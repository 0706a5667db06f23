// The calls that `capfit load` makes.
#ifndef CAPFIT_CLIENT_LOAD_CALLS_H_
#define CAPFIT_CLIENT_LOAD_CALLS_H_

#include "absl/status/statusor.h"
#include "client/load_run.h"
#include "client/server_flags.h"
#include "core/pipeline/fit.h"

namespace capfit::client {

struct LoadCallOptions {
  pipeline::FitOptions fit;
  double timeout_seconds = 300.0;
  int max_attempts = 1;  // 1: every refusal is counted
  bool is_fresh = true;  // results that a server has kept are not asked for
};

// ApproximateBodyUnary: one message each way.
[[nodiscard]] absl::StatusOr<LoadCall> UnaryLoad(const ServerFlags& server,
                                                 const LoadCallOptions& options);
// ApproximateBody: in chunks.
[[nodiscard]] absl::StatusOr<LoadCall> StreamedLoad(const ServerFlags& server,
                                                    const LoadCallOptions& options);
// The fit itself in this process on a shared pool of one thread per core: what a server on the same
// cores is measured by.
[[nodiscard]] absl::StatusOr<LoadCall> LocalLoad(const LoadCallOptions& options);

}  // namespace capfit::client

#endif  // CAPFIT_CLIENT_LOAD_CALLS_H_
