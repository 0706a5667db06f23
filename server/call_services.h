// What all calls of a server share.
#ifndef CAPFIT_SERVER_CALL_SERVICES_H_
#define CAPFIT_SERVER_CALL_SERVICES_H_

#include <atomic>
#include <chrono>

#include "server/admission.h"
#include "server/fit_backend.h"
#include "server/fit_cost.h"
#include "server/fit_executor.h"
#include "server/metrics.h"
#include "server/result_cache.h"
#include "server/server_config.h"
#include "server/shared_cache.h"
#include "server/watchdog.h"

namespace capfit::server {

// Must outlive the calls.
struct CallServices {
  const ServerConfig& config;
  const FitBackend& backend;
  const ThreadPool& pool;
  Admission& admission;
  FitCost& cost;
  FitExecutor& executor;
  Metrics& metrics;
  ResultCache& cache;
  SharedCache& shared_cache;
  Watchdog& watchdog;
  // When a stopping server's grace ends; never before it stops.
  const std::atomic<std::chrono::steady_clock::time_point>& stop_at;
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_CALL_SERVICES_H_
