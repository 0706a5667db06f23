#include "server/server_flags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/scratch.h"

namespace capfit::server {
namespace {

using testing::HasSubstr;

std::optional<int> Parse(std::vector<const char*> words, ServerConfig& config) {
  words.insert(words.begin(), "capfit-server");
  return ParseFlags(static_cast<int>(words.size()), words.data(), config);
}

TEST(ServerFlags, NoneGiveTheDefaults) {
  ServerConfig config;
  EXPECT_EQ(Parse({}, config), std::nullopt);
  EXPECT_EQ(config.listen, "127.0.0.1:50051");
  EXPECT_EQ(config.upload.max_bytes, 128 * 1024 * 1024);
}

TEST(ServerFlags, AreTaken) {
  ServerConfig config;
  EXPECT_EQ(Parse({"--listen",
                   "[::1]:7",
                   "--threads",
                   "3",
                   "--max-upload-mb",
                   "5",
                   "--max-concurrent-fits",
                   "1",
                   "--max-queued-fits",
                   "0",
                   "--max-faces",
                   "900",
                   "--drain-seconds",
                   "1.5",
                   "--max-held-mb",
                   "64",
                   "--cache-mb",
                   "8",
                   "--log-format",
                   "json",
                   "--upload-idle-seconds",
                   "2.5"},
                  config),
            std::nullopt);
  EXPECT_EQ(config.listen, "[::1]:7");
  EXPECT_EQ(config.threads, 3);
  EXPECT_EQ(config.upload.max_bytes, 5 * 1024 * 1024);
  EXPECT_EQ(config.max_concurrent_fits, 1);
  EXPECT_EQ(config.max_queued_fits, 0);
  EXPECT_EQ(config.upload.mesh.max_faces, 900U);
  EXPECT_EQ(config.drain_seconds, 1.5);
  EXPECT_EQ(config.max_held_bytes, 64 * 1024 * 1024);
  EXPECT_EQ(config.cache_bytes, 8 * 1024 * 1024);
  EXPECT_EQ(config.log_format, LogFormat::kJson);
  EXPECT_EQ(config.upload_idle_seconds, 2.5);
}

std::string FileOf(const std::string& text) {
  static const test_support::Scratch scratch;
  const std::string path = scratch.Path("flags");
  std::ofstream(path) << text;
  return path;
}

// A variable of the environment as long as it lives.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
  ~Variable() { unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};

TEST(ServerFlags, FlagsComeBeforeTheEnvironmentAndThatBeforeTheFile) {
  const std::string file = FileOf(
      "# a comment\nthreads = 3\nmax-faces = 500\ndrain-seconds = 7.5\nlog-level = \"debug\"\n"
      "insecure-listen = true\nport-file = \"\"\n");
  const Variable threads("CAPFIT_THREADS", "4");
  const Variable faces("CAPFIT_MAX_FACES", "600");
  const Variable empty("CAPFIT_DRAIN_SECONDS", "");
  ServerConfig config;
  EXPECT_EQ(Parse({"--config", file.c_str(), "--threads", "5"}, config), std::nullopt);
  EXPECT_EQ(config.threads, 5);
  EXPECT_EQ(config.upload.mesh.max_faces, 600U);
  EXPECT_EQ(config.drain_seconds, 7.5);
  EXPECT_EQ(config.log_level, "debug");
  EXPECT_TRUE(config.insecure_listen);
}

std::string ErrorOf(const std::vector<const char*>& words) {
  ServerConfig config;
  testing::internal::CaptureStderr();
  EXPECT_EQ(Parse(words, config), 1);
  return testing::internal::GetCapturedStderr();
}

TEST(ServerFlags, WhatIsWrongIsNamedWithItsPlace) {
  const std::string unknown = FileOf("thread = 3\n");
  EXPECT_THAT(ErrorOf({"--config", unknown.c_str()}),
              HasSubstr(unknown + " has 'thread', which is no setting; did you mean threads?"));
  const std::string wrong = FileOf("threads = 999\n");
  EXPECT_THAT(ErrorOf({"--config", wrong.c_str()}),
              HasSubstr(wrong + ": threads is wrong: Value 999 not in range 0 to 256"));
  const std::string no_number = FileOf("max-fit-seconds = nan\n");
  EXPECT_THAT(ErrorOf({"--config", no_number.c_str()}),
              HasSubstr("max-fit-seconds is wrong: 'nan' must be a number in [0.01, 86400]"));
  EXPECT_THAT(ErrorOf({"--drain-seconds", "nan"}),
              HasSubstr("'nan' must be a number in [0, 3600]"));
  EXPECT_THAT(ErrorOf({"--config", "/nowhere"}), HasSubstr("/nowhere cannot be read"));
  EXPECT_THAT(ErrorOf({"--thread", "3"}),
              HasSubstr("'--thread' is no flag; did you mean --threads?"));
  const Variable variable("CAPFIT_LOG_LEVEL", "loud");
  EXPECT_THAT(ErrorOf({}), HasSubstr("CAPFIT_LOG_LEVEL is wrong: loud not in"));
}

TEST(ServerFlags, VariablesThatLookLikeASettingAreAWarning) {
  const Variable mistyped("CAPFIT_THREDS", "4");
  const Variable begun("CAPFIT_DRAIN", "4");
  const Variable good("CAPFIT_LOG_LEVEL", "warn");
  const Variable file("CAPFIT_CONFIG", "");
  const Variable of_others("CAPFIT_SERVICE_HOST", "10.0.0.7");
  const Variable of_a_service("CAPFIT_PORT", "tcp://10.0.0.7:50051");
  ServerConfig config;
  EXPECT_EQ(Parse({}, config), std::nullopt);
  EXPECT_THAT(config.warnings,
              testing::ElementsAre("CAPFIT_DRAIN is no setting; did you mean CAPFIT_DRAIN_SECONDS?",
                                   "CAPFIT_THREDS is no setting; did you mean CAPFIT_THREADS?"));
}

TEST(ServerFlags, TheAddressOfMetricsIsLookedAtWithTheOthers) {
  ServerConfig config;
  for (const char* const good : {"", "127.0.0.1:0", "[::1]:9100", "0.0.0.0:9100"}) {
    config.metrics_listen = good;
    EXPECT_TRUE(CheckConfig(config).ok()) << good;
  }
  for (const auto& [address, problem] :
       {std::pair("127.0.0.1", "is '127.0.0.1', must be HOST:PORT: the port is missing"),
        std::pair("127.0.0.1:99999", "has port 99999, must be a whole number in [0, 65535]")}) {
    config.metrics_listen = address;
    const absl::Status status = CheckConfig(config);
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << address;
    EXPECT_THAT(std::string(status.message()), HasSubstr("--metrics-listen"));
    EXPECT_THAT(std::string(status.message()), HasSubstr(problem));
  }
}

TEST(ServerFlags, ThePrintedSettingsAreReadBackTheSame) {
  const auto print = [](const std::vector<const char*>& words) {
    ServerConfig config;
    testing::internal::CaptureStdout();
    EXPECT_EQ(Parse(words, config), 0);
    return testing::internal::GetCapturedStdout();
  };
  const std::string printed =
      print({"--listen", "[::1]:7", "--max-upload-mb", "5", "--print-config"});
  EXPECT_THAT(printed, HasSubstr("max-upload-mb=5"));
  EXPECT_THAT(printed, HasSubstr("[::1]:7"));
  const std::string file = FileOf(printed);
  EXPECT_EQ(print({"--config", file.c_str(), "--print-config"}), printed);
}

TEST(ServerFlags, TheCheckLooksAtWhatTheSettingsName) {
  ServerConfig config;
  testing::internal::CaptureStdout();
  EXPECT_EQ(Parse({"--check-config"}, config), 0);
  static_cast<void>(testing::internal::GetCapturedStdout());
  EXPECT_THAT(ErrorOf({"--check-config", "--listen", "0.0.0.0:1"}), HasSubstr("--insecure-listen"));
  EXPECT_THAT(ErrorOf({"--check-config", "--token-file", "/nowhere"}),
              HasSubstr("/nowhere cannot be read"));
}

TEST(ServerFlags, WrongOnesEndTheProgram) {
  ServerConfig config;
  testing::internal::CaptureStderr();
  EXPECT_EQ(Parse({"--thread", "3"}, config), 1);
  EXPECT_EQ(Parse({"--threads", "-1"}, config), 1);
  EXPECT_EQ(Parse({"--log-level", "loud"}, config), 1);
  EXPECT_EQ(Parse({"--log-format", "xml"}, config), 1);
  EXPECT_EQ(Parse({"--client-percent", "0"}, config), 1);
  EXPECT_NE(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace capfit::server
