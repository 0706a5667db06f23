#include "server/log_sink.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "tests/server/fake_fit.h"
#include "tests/server/service_call.h"
#include "tests/support/scratch.h"

namespace capfit::server {
namespace {

using testing::HasSubstr;
using testing::Not;

// Standard error goes to a file as long as this lives.
class ErrorsTo {
 public:
  explicit ErrorsTo(const std::string& path) : before_(dup(STDERR_FILENO)) {
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    EXPECT_GE(file, 0) << path;
    dup2(file, STDERR_FILENO);
    close(file);
  }
  ~ErrorsTo() {
    std::clearerr(stderr);
    dup2(before_, STDERR_FILENO);
    close(before_);
  }
  ErrorsTo(const ErrorsTo&) = delete;
  ErrorsTo& operator=(const ErrorsTo&) = delete;

 private:
  int before_;
};

std::string TextOf(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(LogSink, CountsLinesThatCannotBeWrittenAndSaysSoLater) {
  const test_support::Scratch scratch;
  const std::string path = scratch.Path("log");
  const auto sink = std::make_shared<LogSink>();
  spdlog::logger logger("test", sink);
  {
    const ErrorsTo file(path);
    logger.info("before");
  }
  {
    const ErrorsTo full("/dev/full");
    for (int i = 0; i < 3; ++i) logger.info("lost");
  }
  EXPECT_EQ(sink->lost_lines(), 3);
  {
    const ErrorsTo file(path);
    logger.info("after");
    logger.info("at last");
  }
  const std::string text = TextOf(path);
  EXPECT_THAT(text, HasSubstr("before"));
  EXPECT_THAT(text, Not(HasSubstr("[info] lost")));
  EXPECT_THAT(text, HasSubstr("3 lines of the log could not be written"));
  EXPECT_LT(text.find("after"), text.find("3 lines"));
  EXPECT_LT(text.find("3 lines"), text.find("at last"));
  EXPECT_EQ(text.find("3 lines"), text.rfind("3 lines")) << "told once";
  EXPECT_EQ(sink->lost_lines(), 3);
}

TEST(LogSink, IsAskedThroughTheDefaultLogger) {
  EXPECT_EQ(LostLogLines(), 0) << "another sink has nothing to tell";
  const std::shared_ptr<spdlog::logger> before = spdlog::default_logger();
  spdlog::set_default_logger(std::make_shared<spdlog::logger>("test", std::make_shared<LogSink>()));
  {
    const ErrorsTo full("/dev/full");
    spdlog::info("lost");
  }
  EXPECT_EQ(LostLogLines(), 1);
  const auto server = StartServer(InstantBackend());
  EXPECT_THAT(server->MetricsText(), HasSubstr("\ncapfit_lost_log_lines_total 1\n"));
  spdlog::set_default_logger(before);
}

}  // namespace
}  // namespace capfit::server
