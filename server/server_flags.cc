#include "server/server_flags.h"

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/host_and_port.h"
#include "core/base/version.h"

namespace capfit::server {
namespace {

constexpr std::int64_t kMebibyte = 1024 * 1024;
// The pipeline itself takes no more than these, so a flag can only lower them.
constexpr formats::MeshLimits kPipelineLimits;

void AddLimits(CLI::App& app, ServerConfig& config, std::int64_t& max_upload_mb) {
  app.add_option("--max-concurrent-fits", config.max_concurrent_fits,
                 "Fits that run at the same time")
      ->check(CLI::Range(1, 64));
  app.add_option("--max-queued-fits", config.max_queued_fits,
                 "Further calls that may upload and wait; beyond: RESOURCE_EXHAUSTED")
      ->check(CLI::Range(0, 10'000));
  app.add_option("--max-upload-mb", max_upload_mb, "Size of one uploaded mesh in MiB")
      ->check(CLI::Range(1, 4096));
  app.add_option("--max-vertices", config.upload.mesh.max_vertices, "Vertices of one mesh")
      ->check(CLI::Range(std::size_t{4}, kPipelineLimits.max_vertices));
  app.add_option("--max-faces", config.upload.mesh.max_faces, "Faces of one mesh")
      ->check(CLI::Range(std::size_t{4}, kPipelineLimits.max_faces));
  app.add_option("--retry-pushback-ms", config.retry_pushback_ms,
                 "How long a refused client is told to wait, in milliseconds")
      ->check(CLI::Range(0, 600'000));
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
  AddDrain(app, config);
  app.add_option("--log-level", config.log_level, "Least severe level that is logged")
      ->check(CLI::IsMember({"trace", "debug", "info", "warn", "error", "off"}));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 1;
  }
  config.upload.max_bytes = max_upload_mb * kMebibyte;
  return std::nullopt;
}

}  // namespace capfit::server
