// capfit-server: reads its settings, serves until SIGTERM or SIGINT, drains, exits 0.
#include <pthread.h>
#include <signal.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <string>

#include "core/base/large_pages.h"
#include "server/log_format.h"
#include "server/log_sink.h"
#include "server/server.h"
#include "server/server_flags.h"

namespace capfit::server {
namespace {

// Blocks the signals in this thread and all that it starts, so that one sigwait gets them.
sigset_t BlockStopSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

// Written beside and renamed, so that a reader never sees half a number.
bool WritePortFile(const std::string& path, int port) {
  const std::string unfinished = path + ".tmp";
  {
    std::ofstream out(unfinished);
    out << port << '\n';
    if (!out.flush()) return false;
  }
  return std::rename(unfinished.c_str(), path.c_str()) == 0;
}

int Run(int argc, const char* const* argv) {
  ServerConfig config;
  if (const std::optional<int> exit_code = ParseFlags(argc, argv, config)) return *exit_code;
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("capfit-server", std::make_shared<LogSink>()));
  SetLogFormat(config.log_format);
  spdlog::set_level(spdlog::level::from_str(config.log_level));
  for (const std::string& warning : config.warnings) spdlog::warn("{}", warning);
  if (const absl::Status status = CheckConfig(config); !status.ok()) {
    spdlog::error("{}", std::string(status.message()));
    return 1;
  }
  const sigset_t signals = BlockStopSignals();
  const absl::StatusOr<std::unique_ptr<Server>> server =
      Server::Start(config, {pipeline::ValidateOptions, pipeline::Fit});
  if (!server.ok()) {
    spdlog::error("{}", std::string(server.status().message()));
    return 3;
  }
  const int port = (*server)->port();
  spdlog::info("listening on {} (port {}){}{}", config.listen, port,
               config.tls.is_on() ? " with TLS" : "",
               config.token_file.empty() ? "" : " for those who have a token");
  if (!config.port_file.empty() && !WritePortFile(config.port_file, port)) {
    spdlog::error("cannot write the port to {}", config.port_file);
    return 3;
  }
  int signal = 0;
  sigwait(&signals, &signal);
  spdlog::info("signal {}: not serving any more, draining", signal);
  (*server)->Drain();
  spdlog::info("drained");
  return 0;
}

}  // namespace
}  // namespace capfit::server

int main(int argc, char** argv) {
  capfit::RestartWithLargePages(argv);
  return capfit::server::Run(argc, argv);
}
