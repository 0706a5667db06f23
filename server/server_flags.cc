#include "server/server_flags.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

#include "core/base/did_you_mean.h"
#include "core/base/host_and_port.h"
#include "core/base/number_in.h"
#include "core/base/status.h"
#include "core/base/version.h"
#include "server/caller_check.h"
#include "server/exposure.h"
#include "server/settings.h"
#include "server/shared_cache.h"
#include "server/tls_files.h"

namespace capfit::server {
namespace {

constexpr double kDaySeconds = 86'400.0;
constexpr std::int64_t kMebibyte = 1024 * 1024;
// The pipeline itself takes no more than these, so a flag can only lower them.
constexpr formats::MeshLimits kPipelineLimits;

void AddLimits(CLI::App& app, ServerConfig& config, std::int64_t& max_upload_mb) {
  app.add_option("--max-concurrent-fits", config.max_concurrent_fits,
                 "Fits that run at the same time; 0: as many as threads, at least 2")
      ->check(CLI::Range(0, 64));
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
                 "Memory for results that are given again for the same mesh and options, in MiB: "
                 "of --max-held-mb, at most a quarter; 0: none are kept")
      ->check(CLI::Range(0, 1024 * 1024));
  app.add_option("--cache-redis", config.cache_redis,
                 "HOST[:PORT] of a Redis through which servers share results; empty: none");
  app.add_option("--cache-redis-password-file", config.cache_redis_password_file,
                 "File whose first line is the password of that Redis");
  app.add_option("--cache-redis-seconds", config.cache_redis_seconds,
                 "A call waits so long for an answer of that Redis, then goes on without it")
      ->check(NumberIn(0.01, 60.0));
  app.add_option("--max-held-mb", max_held_mb,
                 "Memory for uploads and answers of all calls, in MiB; beyond: RESOURCE_EXHAUSTED")
      ->check(CLI::Range(16, 1024 * 1024));
  app.add_option("--max-queued-seconds", config.max_queued_seconds,
                 "No fit comes in that would wait longer, as fits went lately")
      ->check(NumberIn(0.0, kDaySeconds));
  app.add_option("--client-percent", config.client_percent,
                 "How much of the places and of both budgets one client may take")
      ->check(CLI::Range(1, 100));
  const auto add_time = [&](const char* name, double& seconds, const char* help) {
    app.add_option(name, seconds, help)->check(NumberIn(0.01, kDaySeconds));
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
  app.add_flag(
      "--channelz", config.channelz,
      "Serve gRPC's tables of connections and calls (grpc.channelz.v1); asks for no token");
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
      ->check(NumberIn(0.0, 3600.0));
  app.add_option("--drain-delay-seconds", config.drain_delay_seconds,
                 "After SIGTERM or SIGINT: time between NOT_SERVING and refusing new calls, for "
                 "load balancers to notice")
      ->check(NumberIn(0.0, 600.0));
}

void AddSecurity(CLI::App& app, ServerConfig& config) {
  app.add_option("--tls-certificate", config.tls.certificate_file,
                 "PEM file of the server's certificate and those between it and the root; read "
                 "again when it changes");
  app.add_option("--tls-key", config.tls.key_file, "PEM file of the key that belongs to it");
  app.add_option("--tls-client-ca", config.tls.client_ca_file,
                 "PEM file of who signs clients' certificates; with it every client needs one");
  app.add_option("--token-file", config.token_file,
                 "File of lines NAME SHA256 [expires=YYYY-MM-DD]: who may call; read again when it "
                 "changes");
  app.add_flag("--insecure-listen", config.insecure_listen,
               "Listen on other addresses than the loopback without TLS and without tokens");
}

void AddConnectionLimits(CLI::App& app, ConnectionLimits& limits) {
  app.add_option("--max-metadata-bytes", limits.max_metadata_bytes, "Metadata of one call")
      ->check(CLI::Range(1024, 1'048'576));
  app.add_option("--max-streams-per-connection", limits.max_streams,
                 "Calls at a time on one connection; further ones wait")
      ->check(CLI::Range(1, 10'000));
  app.add_option("--max-connection-age-seconds", limits.max_age_seconds,
                 "Clients connect anew after this, so that new replicas get traffic")
      ->check(NumberIn(1.0, 86'400.0));
  app.add_option("--max-connection-age-grace-seconds", limits.max_age_grace_seconds,
                 "Calls that run by then may take this long")
      ->check(NumberIn(1.0, 86'400.0));
  app.add_option("--keepalive-seconds", limits.keepalive_seconds,
                 "A quiet connection is asked after this whether the client is still there")
      ->check(NumberIn(1.0, 7200.0));
}

// What is done instead of serving.
struct Errands {
  std::string config_file;
  bool check = false;
  bool print = false;
};

// These name no setting, so neither environment nor file have them.
void AddErrands(CLI::App& app, Errands& errands) {
  app.add_option("--config", errands.config_file,
                 "File of lines NAME = VALUE, the names as those of the flags; also CAPFIT_CONFIG")
      ->configurable(false);
  app.add_flag("--check-config", errands.check,
               "Look at all settings and the files that they name, and end: 0 good, 1 not")
      ->configurable(false);
  app.add_flag("--print-config", errands.print,
               "Print the settings that hold, as --config reads them, and end")
      ->configurable(false);
  app.footer(
      "Each setting can stand in three places, of which the first counts: the flag (--threads 4),\n"
      "the environment (CAPFIT_THREADS=4), and the file that --config names (threads = 4).\n"
      "Exit codes: 0 done; 1 a setting or a file that it names is wrong; 3 it cannot serve.");
}

// A flag that there is not, with the one that may have been meant; "" where all are known.
std::string UnknownFlag(const CLI::App& app, const std::vector<std::string>& words) {
  std::vector<std::string> names;
  for (const CLI::Option* const option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back(absl::StrCat("--", name));
  }
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    if (name.rfind("--", 0) != 0 || std::find(names.begin(), names.end(), name) != names.end()) {
      continue;
    }
    return absl::StrCat("'", name, "' is no flag", DidYouMean(name, names));
  }
  return "";
}

int Complain(const std::string& problem) {
  std::cerr << "capfit-server: " << problem << "\nRun 'capfit-server --help' for help.\n";
  return 1;
}

absl::Status CheckMetricsAddress(const ServerConfig& config) {
  const absl::StatusOr<std::string> whole = WithPort(config.metrics_listen, /*lowest_port=*/0);
  if (!whole.ok()) {
    return InvalidField(ErrorReason::kOutOfRange, "--metrics-listen",
                        absl::StrCat("must be HOST:PORT: ", whole.status().message()));
  }
  if (*whole == config.metrics_listen) return absl::OkStatus();
  return InvalidField(
      ErrorReason::kMissing, "--metrics-listen",
      absl::StrCat("is '", config.metrics_listen, "', must be HOST:PORT: the port is missing"));
}

// What was printed, if it was written.
int AfterPrinting() {
  if (!std::cout.flush().fail()) return 0;
  std::cerr << "capfit-server: cannot write standard output\n";
  return 3;
}

int Check(const ServerConfig& config) {
  if (const absl::Status status = CheckConfig(config); !status.ok()) {
    return Complain(std::string(status.message()));
  }
  for (const std::string& warning : config.warnings) {
    std::cerr << "capfit-server: warning: " << warning << '\n';
  }
  std::cout << "the settings are good\n";
  return AfterPrinting();
}

}  // namespace

absl::Status CheckConfig(const ServerConfig& config) {
  CAPFIT_RETURN_IF_ERROR(CheckExposure(config));
  if (!config.tls.is_on() && !(config.tls.key_file + config.tls.client_ca_file).empty()) {
    return InvalidField(ErrorReason::kMissing, "--tls-certificate",
                        "is missing: --tls-key and --tls-client-ca are of no use without it");
  }
  if (config.tls.is_on()) CAPFIT_RETURN_IF_ERROR(ReadTlsPems(config.tls).status());
  if (config.channelz && !IsLoopback(config.listen) && config.tls.client_ca_file.empty()) {
    return InvalidField(ErrorReason::kConflict, "--channelz",
                        "tells everybody who calls: it needs --tls-client-ca, or to listen on the "
                        "loopback only");
  }
  if (!config.metrics_listen.empty()) CAPFIT_RETURN_IF_ERROR(CheckMetricsAddress(config));
  if (!config.cache_redis.empty()) CAPFIT_RETURN_IF_ERROR(RedisOf(config).status());
  return CallerCheck::Create(config).status();
}

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
  app.add_option("--threads", config.threads,
                 "Threads that compute; 0: one per core, or as many as a container's quota of "
                 "processors allows")
      ->check(CLI::Range(0, 256));
  std::int64_t max_upload_mb = config.upload.max_bytes / kMebibyte;
  AddSecurity(app, config);
  AddConnectionLimits(app, config.connection);
  AddLimits(app, config, max_upload_mb);
  std::int64_t max_held_mb = config.max_held_bytes / kMebibyte;
  std::int64_t cache_mb = config.cache_bytes / kMebibyte;
  AddBudgets(app, config, max_held_mb, cache_mb);
  AddDrain(app, config);
  AddObservation(app, config);
  app.add_option("--log-level", config.log_level, "Least severe level that is logged")
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "off"}));
  Errands errands;
  AddErrands(app, errands);
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (const std::string problem = UnknownFlag(app, words); !problem.empty()) {
    return Complain(problem);
  }
  try {
    if (const absl::Status status = ReadSettings(app, words); !status.ok()) {
      return Complain(std::string(status.message()));
    }
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // help and version
    return Complain(error.what());
  }
  config.warnings = DoubtfulVariables(app);
  config.upload.max_bytes = max_upload_mb * kMebibyte;
  config.max_held_bytes = max_held_mb * kMebibyte;
  config.cache_bytes = cache_mb * kMebibyte;
  if (errands.print) {
    std::cout << app.config_to_str(/*default_also=*/true, /*write_description=*/true);
    return AfterPrinting();
  }
  if (errands.check) return Check(config);
  return std::nullopt;
}

}  // namespace capfit::server
