// A server with TLS or tokens on the loopback, and calls to it.
#ifndef CAPFIT_TESTS_SERVER_SECURED_SERVER_H_
#define CAPFIT_TESTS_SERVER_SECURED_SERVER_H_

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "client/body_client.h"
#include "server/server.h"
#include "tests/server/fake_fit.h"

namespace capfit::server {

inline std::unique_ptr<Server> StartSecured(ServerConfig config) {
  config.listen = "127.0.0.1:0";
  config.threads = 1;
  auto started = Server::Start(config, InstantBackend());
  EXPECT_TRUE(started.ok()) << started.status();
  return *std::move(started);
}

// One call on a connection of its own.
inline absl::Status AskInfo(const Server& server, const client::Security& security) {
  const auto connected =
      client::BodyClient::Connect("127.0.0.1:" + std::to_string(server.port()), security);
  if (!connected.ok()) return connected.status();
  return connected->GetServerInfo(/*timeout_seconds=*/5.0).status();
}

// Whether `condition` comes true within twenty seconds.
template <typename Condition>
bool Soon(const Condition& condition) {
  for (int i = 0; i < 200; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

}  // namespace capfit::server

#endif  // CAPFIT_TESTS_SERVER_SECURED_SERVER_H_
