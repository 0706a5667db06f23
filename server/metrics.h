// What operators see: counters and histograms of calls, and gauges of what is held now.
#ifndef CAPFIT_SERVER_METRICS_H_
#define CAPFIT_SERVER_METRICS_H_

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "server/call_record.h"

namespace capfit::server {

// What is looked up when somebody asks for the metrics.
struct Gauges {
  std::int64_t waiting_fits = 0;
  std::int64_t running_fits = 0;
  double expected_wait_seconds = 0.0;
  std::int64_t held_bytes = 0;
  std::int64_t max_held_bytes = 0;
  int pool_threads = 0;
  std::int64_t cache_bytes = 0;
  bool shared_cache_is_up = false;
  std::int64_t lost_log_lines = 0;
  double certificate_expiry_seconds = 0.0;  // since 1970; 0: there is none
};

// All names and labels: docs/operations.md. No label has a value that callers choose.
class Metrics {
 public:
  Metrics();
  ~Metrics();

  // A call is over. Any thread.
  void Count(const CallRecord& record);
  // A call without a record is over: GetServerInfo, or one that was refused before it began.
  void Count(const std::string& method, const absl::Status& status);

  // The shared cache failed in this way; one of a few words.
  void CountCacheError(const char* kind);

  // In Prometheus' text format, with what `gauges` gives and what the process has used.
  [[nodiscard]] std::string Text(const std::function<Gauges()>& gauges) const;

  // Serves them over HTTP under /metrics at `address` ("HOST:PORT"; port 0: any free one) until the
  // result goes; `gauges` must outlive it. UNAVAILABLE when the address cannot be had.
  class Endpoint {
   public:
    virtual ~Endpoint() = default;
    [[nodiscard]] virtual int port() const = 0;
  };
  [[nodiscard]] absl::StatusOr<std::unique_ptr<Endpoint>> Serve(
      const std::string& address, std::function<Gauges()> gauges) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace capfit::server

#endif  // CAPFIT_SERVER_METRICS_H_
