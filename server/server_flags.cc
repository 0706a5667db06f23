#include "server/server_flags.h"

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/host_and_port.h"
#include "core/base/version.h"

namespace capfit::server {
namespace {

constexpr double kDaySeconds = 86'400.0;
constexpr std::int64_t kMebibyte = 1024 * 1024;
// The pipeline itself takes no more than these, so a flag can only lower them.
constexpr formats::MeshLimits kPipelineLimits;

void AddLimits(CLI::App& app, ServerConfig& config, std::int64_t& max_upload_mb) {
  app.add_option("--max-concurrent-fits", config.max_concurrent_fits,
                 "Fits that run at the same time")
      ->check(CLI::Range(1, 64));
  app.add_option("--max-queued-fits", config.max_queued_fits,
                 "Further fits that may wait; beyond: RESOURCE_EXHAUSTED")
      ->check(CLI::Range(0, 10'000));
  app.add_option("--max-upload-mb", max_upload_mb, "Size of one uploaded mesh in MiB")
      ->check(CLI::Range(1, 4096));
  app.add_option("--max-vertices", config.upload.mesh.max_vertices, "Vertices of one mesh")
      ->check(CLI::Range(std::size_t{4}, kPipelineLimits.max_vertices));
  app.add_option("--max-faces", config.upload.mesh.max_faces, "Faces of one mesh")
      ->check(CLI::Range(std::size_t{4}, kPipelineLimits.max_faces));
  app.add_option("--retry-pushback-ms", config.retry_pushback_ms,
                 "How long a refused client is told to wait at least, in milliseconds")
      ->check(CLI::Range(0, 600'000));
}

// What calls may hold, and for how long.
void AddBudgets(CLI::App& app, ServerConfig& config, std::int64_t& max_held_mb,
                std::int64_t& cache_mb) {
  app.add_option("--cache-mb", cache_mb,
                 "Memory for results that are given again for the same mesh and options, in MiB; "
                 "0: none are kept")
      ->check(CLI::Range(0, 1024 * 1024));
  app.add_option("--max-held-mb", max_held_mb,
                 "Memory for uploads and answers of all calls, in MiB; beyond: RESOURCE_EXHAUSTED")
      ->check(CLI::Range(16, 1024 * 1024));
  app.add_option("--max-queued-seconds", config.max_queued_seconds,
                 "No fit comes in that would wait longer, as fits went lately")
      ->check(CLI::Range(0.0, kDaySeconds));
  app.add_option("--client-percent", config.client_percent,
                 "How much of the places and of both budgets one client may take")
      ->check(CLI::Range(1, 100));
  const auto add_time = [&](const char* name, double& seconds, const char* help) {
    app.add_option(name, seconds, help)->check(CLI::Range(0.01, kDaySeconds));
  };
  add_time("--upload-idle-seconds", config.upload_idle_seconds,
           "An upload of which nothing came for so long is ended");
  add_time("--max-upload-seconds", config.max_upload_seconds, "Time for one upload as a whole");
  add_time("--read-idle-seconds", config.read_idle_seconds,
           "A caller who has not taken a message of its answer for so long is cut off");
  add_time("--max-fit-seconds", config.max_fit_seconds, "Time for one fit, waiting not included");
}

void AddObservation(CLI::App& app, ServerConfig& config) {
  app.add_option("--metrics-listen", config.metrics_listen,
                 "HOST:PORT that serves /metrics to Prometheus; empty: nowhere");
  const auto take_format = [&config](const std::string& word) {
    config.log_format = word == "json" ? LogFormat::kJson : LogFormat::kText;
  };
  app.add_option_function<std::string>("--log-format", take_format, "Form of the log's lines")
      ->check(CLI::IsMember({"text", "json"}))
      ->default_str("text");
}

void AddDrain(CLI::App& app, ServerConfig& config) {
  app.add_option("--drain-seconds", config.drain_seconds,
                 "After SIGTERM or SIGINT: running calls may finish within this")
      ->check(CLI::Range(0.0, 3600.0));
  app.add_option("--drain-delay-seconds", config.drain_delay_seconds,
                 "After SIGTERM or SIGINT: time between NOT_SERVING and refusing new calls, for "
                 "load balancers to notice")
      ->check(CLI::Range(0.0, 600.0));
}

}  // namespace

std::optional<int> ParseFlags(int argc, const char* const* argv, ServerConfig& config) {
  CLI::App app{"capfit-server: human body meshes as few spheres and tapered capsules, over gRPC"};
  app.option_defaults()->always_capture_default();
  app.set_version_flag("--version", std::string(Version()));
  CLI::Validator address;
  address.description("").operation([](std::string& text) -> std::string {
    const absl::StatusOr<std::string> whole = WithPort(text, /*lowest_port=*/0);
    if (!whole.ok()) return std::string(whole.status().message());
    text = *whole;
    return "";
  });
  app.add_option("--listen", config.listen,
                 "HOST[:PORT] to listen on, without a port 50051; port 0: any free one")
      ->transform(address);
  app.add_option("--port-file", config.port_file, "File to write the chosen port to");
  app.add_option("--threads", config.threads, "Threads that compute; 0: one per core")
      ->check(CLI::Range(0, 256));
  std::int64_t max_upload_mb = config.upload.max_bytes / kMebibyte;
  AddLimits(app, config, max_upload_mb);
  std::int64_t max_held_mb = config.max_held_bytes / kMebibyte;
  std::int64_t cache_mb = config.cache_bytes / kMebibyte;
  AddBudgets(app, config, max_held_mb, cache_mb);
  AddDrain(app, config);
  AddObservation(app, config);
  app.add_option("--log-level", config.log_level, "Least severe level that is logged")
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "off"}));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 1;
  }
  config.upload.max_bytes = max_upload_mb * kMebibyte;
  config.max_held_bytes = max_held_mb * kMebibyte;
  config.cache_bytes = cache_mb * kMebibyte;
  return std::nullopt;
}

}  // namespace capfit::server
