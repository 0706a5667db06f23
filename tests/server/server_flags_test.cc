#include "server/server_flags.h"

#include <gtest/gtest.h>

#include <vector>

namespace capfit::server {
namespace {

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
