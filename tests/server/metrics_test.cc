// What is counted, over a real HTTP port, and whether Prometheus' own tool accepts it.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "server/admission.h"
#include "tests/server/fake_fit.h"
#include "tests/server/service_call.h"

namespace capfit::server {
namespace {

using testing::HasSubstr;

// The answer to one GET, headers included; empty when nobody listens.
std::string Get(int port, const std::string& path) {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  std::string answer;
  if (connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) {
    const std::string request =
        "GET " + path + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
    EXPECT_EQ(send(fd, request.data(), request.size(), 0), static_cast<ssize_t>(request.size()));
    char buffer[4096];
    for (ssize_t n = 0; (n = recv(fd, buffer, sizeof(buffer), 0)) > 0;) {
      answer.append(buffer, static_cast<std::size_t>(n));
    }
  }
  close(fd);
  return answer;
}

// The value of the line that begins with `name`, -1 without one.
double ValueOf(const std::string& text, const std::string& name) {
  const std::size_t at = text.find("\n" + name + " ");
  return at == std::string::npos ? -1.0 : std::atof(text.c_str() + at + name.size() + 2);
}

TEST(Metrics, CountCallsByMethodAndCodeAndTimeTheirStages) {
  ServerConfig config;
  config.metrics_listen = "127.0.0.1:0";
  config.cache_bytes = 0;  // each call is to be a fit
  const auto server = StartServer(InstantBackend(), config);
  for (int i = 0; i < 3; ++i) {
    Call call(*server);
    call.Send({Header(), Chunk()});
    EXPECT_TRUE(call.Finish().ok());
  }
  Call wrong(*server);
  wrong.Send({Chunk()});
  EXPECT_FALSE(wrong.Finish().ok());
  const std::string text = Get(server->metrics_port(), "/metrics");
  EXPECT_THAT(text, HasSubstr("200 OK"));
  const std::string method = "method=\"ApproximateBody\"";
  EXPECT_EQ(ValueOf(text, "capfit_calls_total{code=\"OK\"," + method + "}"), 3);
  EXPECT_EQ(ValueOf(text, "capfit_calls_total{code=\"INVALID_ARGUMENT\"," + method + "}"), 1);
  EXPECT_EQ(ValueOf(text, "capfit_call_seconds_count{" + method + "}"), 4);
  EXPECT_EQ(ValueOf(text, "capfit_stage_seconds_count{stage=\"circle\"}"), 3);
  EXPECT_NEAR(ValueOf(text, "capfit_stage_seconds_sum{stage=\"circle\"}"), 3 * 0.4, 1e-9);
  EXPECT_EQ(ValueOf(text, "capfit_queue_seconds_count"), 3);
  EXPECT_EQ(ValueOf(text, "capfit_received_bytes_total"), 3 * 48);
  EXPECT_EQ(ValueOf(text, "capfit_refused_total{reason=\"OUT_OF_ORDER\"}"), 1);
  EXPECT_EQ(ValueOf(text, "capfit_wasted_seconds_total"), 0);
  EXPECT_EQ(ValueOf(text, "capfit_pool_threads"), 1);
  EXPECT_GT(ValueOf(text, "process_resident_memory_bytes"), 1e6);
}

TEST(Metrics, ShowWhatRunsWaitsAndWasWasted) {
  Gate gate;
  ServerConfig config;
  config.max_concurrent_fits = 1;
  const auto server = StartServer(WaitingBackend(gate), config);
  Call running(LoopbackChannel(*server));
  running.Send({Header(), Chunk()});
  ASSERT_TRUE(WaitFor([&] { return gate.waiting == 1; }));
  Call waiting(LoopbackChannel(*server));
  waiting.Send({Header(), Chunk()});
  ASSERT_TRUE(WaitFor([&] { return server->waiting_fits() == 1; }));
  const std::string text = server->MetricsText();
  EXPECT_EQ(ValueOf(text, "capfit_running_fits"), 1);
  EXPECT_EQ(ValueOf(text, "capfit_queue_jobs"), 1);
  EXPECT_GT(ValueOf(text, "capfit_expected_wait_seconds"), 0);
  EXPECT_GE(ValueOf(text, "capfit_held_bytes"), 2 * kBytesOfACall);
  running.context.TryCancel();
  EXPECT_TRUE(
      WaitFor([&] { return ValueOf(server->MetricsText(), "capfit_wasted_seconds_total") > 0; }));
  gate.open = true;
  EXPECT_TRUE(waiting.Finish().ok());
}

TEST(Metrics, APortThatIsTakenIsAnErrorThatNamesIt) {
  ServerConfig config;
  config.metrics_listen = "127.0.0.1:0";
  const auto server = StartServer(InstantBackend(), config);
  config.listen = "127.0.0.1:0";
  config.metrics_listen = "127.0.0.1:" + std::to_string(server->metrics_port());
  const absl::Status status = Server::Start(config, InstantBackend()).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kUnavailable);
  EXPECT_THAT(std::string(status.message()), HasSubstr(config.metrics_listen));
}

TEST(Metrics, PleasePrometheusOwnTool) {
  if (std::system("command -v promtool > /dev/null") != 0) {
    GTEST_SKIP() << "SKIPPED: no promtool: apt-get install prometheus";
  }
  const auto server = StartServer(InstantBackend());
  Call call(*server);
  call.Send({Header(), Chunk()});
  EXPECT_TRUE(call.Finish().ok());
  std::FILE* const tool = popen("promtool check metrics", "w");
  ASSERT_NE(tool, nullptr);
  const std::string text = server->MetricsText();
  EXPECT_EQ(std::fwrite(text.data(), 1, text.size(), tool), text.size());
  EXPECT_EQ(pclose(tool), 0);
}

TEST(Trace, GoesBackToTheCallerIfItIsOne) {
  const auto server = StartServer(InstantBackend());
  const std::string trace = "00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01";
  for (const std::string& sent : {trace, std::string("no trace \"at\" all"), std::string()}) {
    Call call(server->InProcessChannel(), {{"traceparent", sent}});
    call.Send({Header(), Chunk()});
    EXPECT_TRUE(call.Finish().ok());
    const auto& metadata = call.context.GetServerInitialMetadata();
    const auto found = metadata.find("traceparent");
    EXPECT_EQ(found != metadata.end(), sent == trace);
  }
}

}  // namespace
}  // namespace capfit::server
