#include "server/metrics.h"

#include <prometheus/counter.h>
#include <prometheus/exposer.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>
#include <sys/resource.h>
#include <unistd.h>

#include <exception>
#include <fstream>
#include <optional>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "server/admission.h"

namespace capfit::server {
namespace {

using prometheus::Counter;
using prometheus::Family;
using prometheus::Histogram;
using prometheus::MetricFamily;

// From a cached answer to the largest body under load: each bound 2.5 or 2 times the last.
const Histogram::BucketBoundaries& SecondsBuckets() {
  static const Histogram::BucketBoundaries bounds = {0.005, 0.01, 0.025, 0.05, 0.1,  0.25, 0.5,
                                                     1.0,   2.5,  5.0,   10.0, 25.0, 60.0, 300.0};
  return bounds;
}

MetricFamily GaugeFamily(const char* name, const char* help, double value,
                         prometheus::MetricType type = prometheus::MetricType::Gauge) {
  prometheus::ClientMetric metric;
  (type == prometheus::MetricType::Gauge ? metric.gauge.value : metric.counter.value) = value;
  return {name, help, type, {metric}};
}

double ResidentBytes() {
  std::ifstream in("/proc/self/statm");
  double whole = 0.0;
  double resident = 0.0;
  in >> whole >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double CpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::vector<MetricFamily> FamiliesOf(const Gauges& now) {
  const auto number = [](auto value) { return static_cast<double>(value); };
  std::vector<MetricFamily> families = {
      GaugeFamily("capfit_queue_jobs", "Fits that wait", number(now.waiting_fits)),
      GaugeFamily("capfit_running_fits", "Fits that run", number(now.running_fits)),
      GaugeFamily("capfit_expected_wait_seconds", "How long a fit that came now would wait",
                  now.expected_wait_seconds),
      GaugeFamily("capfit_held_bytes", "Memory that uploads and answers hold of their budget",
                  number(now.held_bytes)),
      GaugeFamily("capfit_max_held_bytes", "That budget", number(now.max_held_bytes)),
      GaugeFamily("capfit_pool_threads", "Threads that compute", number(now.pool_threads)),
      GaugeFamily("capfit_cache_bytes", "Memory that cached results hold", number(now.cache_bytes)),
      GaugeFamily("capfit_shared_cache_up", "1 while the shared cache answers",
                  now.shared_cache_is_up ? 1.0 : 0.0),
      GaugeFamily("capfit_lost_log_lines_total", "Lines of the log that could not be written",
                  number(now.lost_log_lines), prometheus::MetricType::Counter),
      GaugeFamily("process_resident_memory_bytes", "Resident memory", ResidentBytes()),
      GaugeFamily("process_cpu_seconds_total", "Processor time used, of user and system",
                  CpuSeconds(), prometheus::MetricType::Counter)};
  if (now.certificate_expiry_seconds > 0.0) {
    families.push_back(GaugeFamily("capfit_certificate_expiry_timestamp_seconds",
                                   "When the server's certificate ends, in seconds since 1970",
                                   now.certificate_expiry_seconds));
  }
  return families;
}

// What ran out, or why else a call was not answered with a result.
std::string RefusalOf(const absl::Status& status) {
  for (const auto& [name, value] : FactsOf(status)) {
    if (name == kResourceFact) return value;
  }
  const std::optional<ErrorReason> reason = ReasonOf(status);
  return reason ? std::string(ErrorReasonName(*reason)) : "other";
}

// The registry's metrics and those of the moment.
class Collector final : public prometheus::Collectable {
 public:
  Collector(std::shared_ptr<prometheus::Registry> registry, std::function<Gauges()> gauges)
      : registry_(std::move(registry)), gauges_(std::move(gauges)) {}

  [[nodiscard]] std::vector<MetricFamily> Collect() const override {
    std::vector<MetricFamily> families = registry_->Collect();
    for (MetricFamily& family : FamiliesOf(gauges_())) families.push_back(std::move(family));
    return families;
  }

 private:
  std::shared_ptr<prometheus::Registry> registry_;
  std::function<Gauges()> gauges_;
};

class HttpEndpoint final : public Metrics::Endpoint {
 public:
  HttpEndpoint(const std::string& address, std::shared_ptr<Collector> collector)
      : exposer_(address), collector_(std::move(collector)) {
    exposer_.RegisterCollectable(collector_);
  }
  [[nodiscard]] int port() const override {
    const std::vector<int> ports = exposer_.GetListeningPorts();
    return ports.empty() ? 0 : ports.front();
  }

 private:
  prometheus::Exposer exposer_;
  std::shared_ptr<Collector> collector_;
};

}  // namespace

struct Metrics::Parts {
  Family<Counter>& Counters(const char* name, const char* help) {
    return prometheus::BuildCounter().Name(name).Help(help).Register(*registry);
  }
  Family<Histogram>& Histograms(const char* name, const char* help) {
    return prometheus::BuildHistogram().Name(name).Help(help).Register(*registry);
  }

  std::shared_ptr<prometheus::Registry> registry = std::make_shared<prometheus::Registry>();
  Family<Counter>& calls = Counters("capfit_calls_total", "Calls that are over");
  Family<Histogram>& call_seconds =
      Histograms("capfit_call_seconds", "Time of a call from its begin to its last message");
  Family<Histogram>& stage_seconds =
      Histograms("capfit_stage_seconds", "Time of each stage of a fit that came to its end");
  Histogram& queue_seconds =
      Histograms("capfit_queue_seconds", "Time that a fit waited for its turn")
          .Add({}, SecondsBuckets());
  Counter& received_bytes =
      Counters("capfit_received_bytes_total", "Bytes of meshes that were uploaded").Add({});
  Counter& wasted_seconds =
      Counters("capfit_wasted_seconds_total", "Time of fits whose result nobody got").Add({});
  Family<Counter>& refused =
      Counters("capfit_refused_total", "Calls without a result, by what ran out or by reason");
  Family<Counter>& cache_hits = Counters(
      "capfit_cache_hits_total", "Calls that were answered without a fit, by who kept the result");
  Family<Counter>& cache_errors =
      Counters("capfit_cache_errors_total", "What was wrong with the shared cache");
};

Metrics::Metrics() : parts_(std::make_unique<Parts>()) {}

Metrics::~Metrics() = default;

void Metrics::Count(const CallRecord& record) {
  parts_->calls.Add({{"method", record.method}, {"code", CodeName(record)}}).Increment();
  parts_->call_seconds.Add({{"method", record.method}}, SecondsBuckets()).Observe(record.seconds);
  parts_->received_bytes.Increment(static_cast<double>(record.received_bytes));
  parts_->wasted_seconds.Increment(WastedSeconds(record));
  if (record.fit_seconds > 0.0) parts_->queue_seconds.Observe(record.queued_seconds);
  if (record.cached != Cached::kNo) {
    parts_->cache_hits.Add({{"tier", CachedName(record.cached)}}).Increment();
  }
  if (!record.status.ok()) {
    parts_->refused.Add({{"reason", RefusalOf(record.status)}}).Increment();
  }
  for (int i = 0; i < kStageCount; ++i) {
    const double seconds = record.stage_seconds[i];
    if (seconds <= 0.0) continue;
    const std::string stage(StageName(static_cast<Stage>(i)));
    parts_->stage_seconds.Add({{"stage", stage}}, SecondsBuckets()).Observe(seconds);
  }
}

void Metrics::Count(const std::string& method, const absl::Status& status) {
  CallRecord record;
  record.status = status;
  parts_->calls.Add({{"method", method}, {"code", CodeName(record)}}).Increment();
}

void Metrics::CountCacheError(const char* kind) {
  parts_->cache_errors.Add({{"kind", kind}}).Increment();
}

std::string Metrics::Text(const std::function<Gauges()>& gauges) const {
  return prometheus::TextSerializer().Serialize(Collector(parts_->registry, gauges).Collect());
}

absl::StatusOr<std::unique_ptr<Metrics::Endpoint>> Metrics::Serve(
    const std::string& address, std::function<Gauges()> gauges) const {
  try {
    auto collector = std::make_shared<Collector>(parts_->registry, std::move(gauges));
    return std::make_unique<HttpEndpoint>(address, std::move(collector));
  } catch (const std::exception& error) {
    return absl::UnavailableError(
        absl::StrCat("cannot listen on ", address, " for metrics: ", error.what()));
  }
}

}  // namespace capfit::server
